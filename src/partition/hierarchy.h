#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "src/mesh/mesh.h"
#include "src/metric/workers.h"

namespace geodesic {

// The mesh, split into patches, each of which is split again. The patches of all levels are numbered
// together: level by level, and within a level by parent, so that the children of a patch have consecutive
// numbers. Patch 0 is the root, which is the whole mesh.
struct Hierarchy {
    std::vector<uint32_t> level_begin; // level l has the patches level_begin[l] .. level_begin[l + 1] - 1
    std::vector<uint32_t> parent;      // per patch; the root's is NONE
    std::vector<uint32_t>
        child_begin; // p has the children child_begin[p] .. child_begin[p + 1] - 1; a leaf has none
    std::vector<uint32_t> leaf_of_face;

    uint32_t level_count() const { return static_cast<uint32_t>(level_begin.size()) - 2; } // below the root
    uint32_t patch_count() const { return static_cast<uint32_t>(parent.size()); }
    uint32_t first_leaf() const { return level_begin[level_count()]; }
};

// Whether the first patch is the second one or lies inside of it. A parent has a smaller number than its
// children.
inline bool is_within(const Hierarchy& hierarchy, uint32_t patch, uint32_t ancestor) {
    while (patch != NONE && patch > ancestor) patch = hierarchy.parent[patch];
    return patch == ancestor;
}

struct HierarchyOptions {
    std::vector<uint32_t> split; // split[l]: how many patches each patch of level l is split into
    uint32_t lloyd_iterations = 4;
    uint64_t seed = 0;
    // Per level, as `split` has them; empty means false for all. Where it is true, split[l] is meant for a
    // patch of average size, and each patch is split into a number in proportion to its faces.
    std::vector<uint8_t> in_proportion = {};
    // Of each edge of the mesh; empty means those that follow from the positions.
    std::vector<double> edge_lengths = {};
    // Patches of more than LARGE_PATCH faces are split by these distances instead of the metric's, or by the
    // metric's if there are none. Borders are moved to where they are short anyway, and the exact metric
    // takes longest where it has least to tell: on large and smooth surfaces.
    std::shared_ptr<const Metric> rough_metric = {};
    static constexpr size_t LARGE_PATCH = 4000;
    // By these distances, if there are any, patches are split, too. That split is taken if it has no fewer
    // patches and its borders cost at most 1 / LEAST_GAIN as much. Where triangles are long and narrow,
    // patches that are round by the metric have borders of many short edges, and those that are round by the
    // roots of lengths have few long ones; but paths over long edges are less exact.
    std::shared_ptr<const Metric> root_metric = {};
    static constexpr uint64_t LEAST_GAIN = 2;
};

// The sizes that a hierarchy is given where the caller does not choose them.
struct SplitShape {
    double leaf_vertices;
    double largest_split;
};

// Measured on scans of 35,000 to 390,000 vertices (bench/). Larger leaves answer faster; of the graph engine,
// more exactly, too, but the file grows. Of the overlay engine they need more table entries.
inline constexpr SplitShape GRAPH_SPLIT{120, 40}, OVERLAY_SPLIT{64, 6};

// Chooses the number of levels, and the number of patches that each patch is split into, for a mesh of this
// size. Numbers that the caller gave (other than 0) are kept.
std::vector<uint32_t> automatic_split(uint32_t vertex_count, uint32_t level_count,
                                      std::span<const uint32_t> given, const SplitShape& shape);

// Builds the hierarchy (paper section 3.1). The faces of each patch are connected over edges. To reach that,
// a level may get more patches than were asked for.
Hierarchy build_hierarchy(const Mesh& mesh, const HierarchyOptions& options, Workers& workers);

}
