#pragma once

#include <cstdint>
#include <vector>

#include "src/mesh/mesh.h"
#include "src/metric/workers.h"

namespace geodesic {

// The mesh split into patches, each split again. Patches of all levels are numbered through: level by level,
// and within a level by parent, so that a patch's children are consecutive. Patch 0 is the root, the whole
// mesh.
struct Hierarchy {
    std::vector<uint32_t> level_begin; // level l: patches level_begin[l] .. level_begin[l + 1] - 1
    std::vector<uint32_t> parent;      // per patch; the root's is NONE
    std::vector<uint32_t>
        child_begin; // children of p: child_begin[p] .. child_begin[p + 1] - 1; none of a leaf
    std::vector<uint32_t> leaf_of_face;

    uint32_t level_count() const { return static_cast<uint32_t>(level_begin.size()) - 2; } // below the root
    uint32_t patch_count() const { return static_cast<uint32_t>(parent.size()); }
    uint32_t first_leaf() const { return level_begin[level_count()]; }
};

// Whether a patch is another one or lies in it. A parent has a smaller number than its children.
inline bool is_within(const Hierarchy& hierarchy, uint32_t patch, uint32_t ancestor) {
    while (patch != NONE && patch > ancestor) patch = hierarchy.parent[patch];
    return patch == ancestor;
}

struct HierarchyOptions {
    std::vector<uint32_t> split; // split[l]: how many patches each patch of level l is split into
    uint32_t lloyd_iterations = 4;
    uint64_t seed = 0;
    // Per level as split, none if empty: whether the number is that of a patch of average size, and others
    // are split in proportion to theirs.
    std::vector<uint8_t> in_proportion = {};
};

// What an automatic hierarchy aims at.
struct SplitShape {
    double leaf_vertices;
    double largest_split;
};

// Measured on scans of 35,000 to 390,000 vertices (bench/). Graph: larger leaves answer faster and more
// exactly, but the file grows. Overlay: larger leaves answer faster, smaller ones need fewer table entries,
// which the borders of a larger mesh need more of.
inline constexpr SplitShape GRAPH_SPLIT{120, 40};
SplitShape overlay_split(uint32_t vertex_count);

// How many levels, and how many patches each patch is split into, for a mesh of this size; counts given by
// the caller (not 0) are kept.
std::vector<uint32_t> automatic_split(uint32_t vertex_count, uint32_t level_count,
                                      std::span<const uint32_t> given, const SplitShape& shape);

// The paper's section 3.1. Every patch hangs together over edges and has at most one border ring, so that a
// level can have more patches than asked for.
Hierarchy build_hierarchy(const Mesh& mesh, const HierarchyOptions& options, Workers& workers);

}
