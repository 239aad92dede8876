#pragma once

#include <algorithm>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

#include "src/mesh/components.h"

namespace geodesic {

// Up to which distance a float beside the extent of a component does not tell two points from one. As a
// share of such a distance, what is rounded anywhere on it is large, and says nothing of answers: a
// program that asks for sin(pi) gets some 1e-16, and a pole made by it is a ring of vertices that far apart.
// How wide other components are, and how far away they lie, changes nothing. What no normal float holds is
// too short anywhere.
struct ShortDistances {
    // Of components whose extents are the diagonals of their bounding boxes.
    explicit ShortDistances(const Components& components) : component_of_vertex(components.of_vertex) {
        for (const Component& component : components.all) of_component.push_back(beside(component.diagonal));
    }
    ShortDistances(std::vector<uint32_t> component_of_vertex, std::vector<double> of_component)
        : component_of_vertex(std::move(component_of_vertex)), of_component(std::move(of_component)) {}

    static double beside(double extent) {
        using Float = std::numeric_limits<float>;
        return std::max(double{Float::epsilon()} * extent, double{Float::min()});
    }

    // On the component that a vertex belongs to.
    double up_to(uint32_t vertex) const { return of_component[component_of_vertex[vertex]]; }

    std::vector<uint32_t> component_of_vertex;
    std::vector<double> of_component;
};

}
