#pragma once

#include <cstdint>
#include <memory_resource>
#include <optional>
#include <span>

#include "src/index/point_sources.h"
#include "src/overlay/tables/tables.h"

namespace geodesic {

// What a point of a face is to a sweep: the distances to the border and to the internal vertices of a leaf,
// as if it were an internal vertex of that leaf itself, and to vertices that it sees beyond its polygon. Ways
// that bend at one of these, hops from the border of the leaf may miss: they unfold a whole segment from one
// place. Or a vertex whose field begins with an offset: then `vertex` is set, and there are no distances. The
// offset is not part of the distances, nor of ways that are known besides; a sweep from several sources adds
// it behind each hop.
struct PointWays {
    struct Beyond {
        uint32_t number;
        float distance;
    };

    explicit PointWays(std::pmr::memory_resource* memory) : distance(memory), beyond(memory) {}

    float offset = 0;
    uint32_t vertex = NONE;
    uint32_t leaf = NONE;  // unless it is a vertex
    Array<float> distance; // border vertices in the order of the border, then internal vertices
    Array<Beyond> beyond;
    std::span<const KnownWay> known; // which the caller keeps
};

// A vertex with the place that the tables of a leaf have for it.
struct LeafVertex {
    uint32_t border_position; // NONE if it is internal
    uint32_t internal;        // counted from the first one of the leaf
};

// Whether a vertex is inside of a leaf or on its border.
bool is_in_leaf(const Numbering& numbering, uint32_t leaf, uint32_t number);
// Whether all corners of a face are.
bool are_in_leaf(const Numbering& numbering, uint32_t leaf, const std::array<uint32_t, 3>& corners);

// Where the edge between two vertices runs along the border of a leaf, counts the vertices between its ends,
// which are added ones, and writes the first of them, from `a` on, as far as there is room. Nothing if it
// does not.
std::optional<size_t> find_on_border(const OverlayIndex& index, uint32_t leaf, uint32_t a, uint32_t b,
                                     double length, std::span<VertexBetween> found);

// Whether the edge runs along the border.
inline bool is_on_border(const OverlayIndex& index, uint32_t leaf, uint32_t a, uint32_t b, double length) {
    return find_on_border(index, leaf, a, b, length, {}).has_value();
}

// Distances of points by the tables of their leaves, which have all vertices of their polygons. What is
// returned lasts until the next call.
class PointsInLeaf {
public:
    PointsInLeaf(const OverlayIndex& index, std::pmr::memory_resource* memory)
        : index_(index), columns_(memory), rows_(memory), distances_(memory) {}

    // Whether two points, of which one is not at a vertex, are in one leaf.
    bool has_both(const FacePoint& point, const FacePoint& other) const;
    // From such a point.
    float to_point(const FacePoint& point, const FacePoint& other);
    // From one vertex of the leaf.
    float to_vertex(const FacePoint& point, uint32_t number) const;
    // From the border of the leaf, in the order of the border.
    std::span<const float> to_border(const FacePoint& point);
    // From the border of the leaf, then from its internal vertices.
    std::span<const float> to_all(const FacePoint& point);

private:
    template <class FillRow>
    std::span<const float> look_out(const FacePoint& point, size_t count, const FillRow& fill_row);
    void take_columns(uint32_t leaf);
    void fill_border_row(uint32_t leaf, const LeafVertex& from, float* row) const;
    void fill_internal_row(uint32_t leaf, const LeafVertex& from, float* row) const;

    const OverlayIndex& index_;
    Array<OverlayColumn> columns_; // of the border's vertices, in the overlay of the leaf's parent
    Array<float> rows_, distances_;
};

// The row of a point to the ring of its leaf, as the inner table has it for vertices, but in steps of its
// own: the tables of the leaf may hold no distance that is as long, or none at all.
struct PointRow {
    explicit PointRow(std::pmr::memory_resource* memory) : codes(memory) {}

    float quantum = 0;
    Array<uint16_t> codes;
};
// From the distances by position in the border.
void fill_row(const OverlayIndex& index, uint32_t leaf, std::span<const float> to_border, PointRow& row);

}
