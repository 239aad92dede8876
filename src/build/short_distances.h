#pragma once

#include <algorithm>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

#include "src/mesh/parts.h"

namespace geodesic {

// Up to which distance a float beside the extent of a part of a mesh does not tell two points from one. As a
// share of such a distance, what is rounded anywhere on the part is large, and says nothing of answers: a
// program that asks for sin(pi) gets some 1e-16, and a pole made by it is a ring of vertices that far apart.
// How wide other parts are, and how far away they lie, changes nothing. What no normal float holds is too
// short anywhere.
struct ShortDistances {
    // Of parts whose extents are the diagonals of their bounding boxes.
    explicit ShortDistances(const Parts& parts) : part_of_vertex(parts.of_vertex) {
        for (const Part& part : parts.parts) of_part.push_back(beside(part.diagonal));
    }
    ShortDistances(std::vector<uint32_t> part_of_vertex, std::vector<double> of_part)
        : part_of_vertex(std::move(part_of_vertex)), of_part(std::move(of_part)) {}

    static double beside(double extent) {
        using Float = std::numeric_limits<float>;
        return std::max(double{Float::epsilon()} * extent, double{Float::min()});
    }

    // On the part that a vertex belongs to.
    double up_to(uint32_t vertex) const { return of_part[part_of_vertex[vertex]]; }

    std::vector<uint32_t> part_of_vertex;
    std::vector<double> of_part;
};

}
