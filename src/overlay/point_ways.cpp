#include "src/overlay/point_ways.h"

#include <algorithm>

namespace geodesic {

namespace {

// A vertex with the place that the tables of a leaf have for it.
struct LeafVertex {
    uint32_t border_position; // NONE if it is internal
    uint32_t internal;        // counted from the first one of the leaf
};

LeafVertex leaf_vertex(const Numbering& numbering, uint32_t leaf, uint32_t number) {
    if (numbering.is_border(number)) return {numbering.border_position(leaf, number), NONE};
    return {NONE, number - numbering.first_internal(leaf)};
}

float distance_between(const OverlayIndex& index, uint32_t leaf, const LeafVertex& a, const LeafVertex& b) {
    const Numbering& numbering = index.numbering;
    if (a.internal != NONE && b.internal != NONE)
        return a.internal == b.internal
                   ? 0
                   : index.distance(index.internal_code(leaf, a.internal, b.internal), leaf);
    if (a.internal != NONE)
        return index.distance(index.border_internal_code(leaf, b.border_position, a.internal), leaf);
    if (b.internal != NONE) return distance_between(index, leaf, b, a);
    const uint32_t* const positions = numbering.overlay_position.data() + numbering.border_begin[leaf];
    const uint32_t parent = numbering.parent[leaf];
    return index.distance(
        index.overlay_code(parent, positions[a.border_position], positions[b.border_position]), parent);
}

// The corners of a point's face, found once for all vertices that are asked for.
struct PointInLeaf {
    PointInLeaf(const OverlayIndex& index, uint32_t leaf, const FacePoint& point)
        : index(index), leaf(leaf), point(point) {
        for (size_t k = 0; k < 3; ++k) corners[k] = leaf_vertex(index.numbering, leaf, point.corners[k]);
    }

    float distance_to(const LeafVertex& vertex) const {
        std::array<double, 3> from_corners;
        for (size_t k = 0; k < 3; ++k)
            from_corners[k] = double{distance_between(index, leaf, corners[k], vertex)};
        return static_cast<float>(distance_over(point, from_corners));
    }

    const OverlayIndex& index;
    const uint32_t leaf;
    const FacePoint& point;
    std::array<LeafVertex, 3> corners;
};

}

bool is_in_leaf(const Numbering& numbering, uint32_t leaf, uint32_t number) {
    if (numbering.is_border(number)) return numbering.border_position(leaf, number) != NONE;
    return numbering.leaf_of(number) == leaf;
}

uint32_t leaf_of_face(const Numbering& numbering, const std::array<uint32_t, 3>& corners) {
    const auto has_all = [&](uint32_t leaf) {
        return std::ranges::all_of(corners, [&](uint32_t c) { return is_in_leaf(numbering, leaf, c); });
    };
    for (const uint32_t corner : corners)
        if (!numbering.is_border(corner)) {
            const uint32_t leaf = numbering.leaf_of(corner);
            return has_all(leaf) ? leaf : NONE;
        }
    for (const PatchPosition& at : numbering.borders_of(corners[0]))
        if (at.patch >= numbering.first_leaf() && has_all(at.patch)) return at.patch;
    return NONE;
}

float distance_in_leaf(const OverlayIndex& index, uint32_t leaf, uint32_t a, uint32_t b) {
    return distance_between(index, leaf, leaf_vertex(index.numbering, leaf, a),
                            leaf_vertex(index.numbering, leaf, b));
}

float distance_in_leaf(const OverlayIndex& index, uint32_t leaf, const FacePoint& point, uint32_t number) {
    return PointInLeaf(index, leaf, point).distance_to(leaf_vertex(index.numbering, leaf, number));
}

void fill_border_ways(const OverlayIndex& index, uint32_t leaf, const FacePoint& point,
                      Array<float>& distances) {
    const PointInLeaf from(index, leaf, point);
    distances.clear();
    for (uint32_t i = 0; i < index.numbering.border_size(leaf); ++i)
        distances.push_back(from.distance_to({i, NONE}));
}

void fill_ways(const OverlayIndex& index, uint32_t leaf, const FacePoint& point, float offset,
               PointWays& ways) {
    const PointInLeaf from(index, leaf, point);
    const uint32_t borders = index.numbering.border_size(leaf), inner = index.numbering.internal_size(leaf);
    ways.leaf = leaf;
    ways.distance.clear();
    for (uint32_t i = 0; i < borders; ++i) ways.distance.push_back(offset + from.distance_to({i, NONE}));
    for (uint32_t i = 0; i < inner; ++i) ways.distance.push_back(offset + from.distance_to({NONE, i}));
}

// The codes that fill up the last block are those of vertices that are not reached.
void fill_row(const OverlayIndex& index, uint32_t leaf, const FacePoint& point, PointRow& row) {
    const uint32_t first = index.rings.begin[leaf], places = index.rings.size(leaf);
    float longest = 0;
    fill_border_ways(index, leaf, point, row.distances);
    for (const float distance : row.distances)
        if (distance < INFINITE) longest = std::max(longest, distance);
    row.quantum = longest / float{TableCode::LARGEST};
    row.codes.assign(SourceCode::whole_blocks(places) + TableCode::PADDING, TableCode::UNREACHED);
    for (uint32_t k = 0; k < places; ++k)
        row.codes[k] = TableCode::nearest_to(row.distances[index.rings.position[first + k]], row.quantum);
}

}
