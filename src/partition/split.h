#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "src/mesh/mesh.h"
#include "src/metric/metric.h"
#include "src/partition/random.h"

namespace geodesic {

// The patches that a patch is split into, each by its faces, and what the borders between them cost before
// small pieces join others: they have few and short edges where it is little (see shorten_borders).
struct Split {
    std::vector<std::vector<uint32_t>> patches;
    uint64_t border_cost;
};

// What is the same for all patches of a mesh.
struct Splitting {
    const Mesh& mesh;
    std::span<const double> edge_lengths;          // of all edges
    std::span<const uint32_t> component_of_vertex; // see Components
    uint32_t lloyd_iterations;
};

// Splits a patch, given by its faces, into about `count` patches of faces, each connected, which are round by
// the distances of the solver. There are more of them where the faces themselves are not connected.
//
// A patch may have several border rings, as a section of a tube has. (The paper splits such a patch until
// each part has one. That cuts tubes lengthwise, again and again, and makes the borders of lattices and of
// meshes with handles many times longer.)
Split split_patch(const Splitting& splitting, std::span<const uint32_t> faces, uint32_t count,
                  FieldSolver& solver, Random& random);

}
