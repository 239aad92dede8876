#include "src/overlay/fields/point_ways.h"

#include <algorithm>
#include <utility>

#include "src/overlay/kernels/dispatch.h"

namespace geodesic {

namespace {

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
    const auto in_parent = numbering.positions_in_parent(leaf);
    const uint32_t parent = numbering.parent[leaf];
    return index.distance(
        index.overlay_code(parent, in_parent[a.border_position], in_parent[b.border_position]), parent);
}

// A vertex of a border, and the segment that leads to it.
struct Joined {
    uint32_t position;
    float segment;
};

// What a vertex of a border is joined to besides the one before. Nothing if that is not one vertex. An added
// vertex, between the ends of an edge on the border of a leaf, is joined to two: the parts of a face stay in
// its leaf.
std::optional<Joined> only_other(const OverlayIndex& index, uint32_t leaf, uint32_t position,
                                 uint32_t before) {
    Joined other{NONE, 0};
    size_t count = 0;
    for_each_joined(index.rings, index.numbering, leaf, position, [&](uint32_t joined, float segment) {
        if (joined == before) return;
        other = {joined, segment};
        ++count;
    });
    if (count != 1) return std::nullopt;
    return other;
}

// Walks along the border from a position, over the segment to `at`, until it comes to the end or has passed
// more than a length. Counts the vertices on the way, and writes the first of them. Nothing if it does not
// come to the end.
std::optional<size_t> walk_along(const OverlayIndex& index, uint32_t leaf, uint32_t begin, Joined at,
                                 uint32_t end, double length, std::span<VertexBetween> found) {
    constexpr double TOLERANCE = 1e-6;
    const auto border = index.numbering.border_of(leaf);
    double along = double{at.segment};
    uint32_t before = begin;
    for (size_t count = 0; along <= length * (1 + TOLERANCE); ++count) {
        if (at.position == end) return count;
        if (at.position == begin) break; // all around
        if (count < found.size()) found[count] = {border[at.position], along};
        const auto next = only_other(index, leaf, at.position, before);
        if (!next) break;
        before = std::exchange(at, *next).position;
        along += double{at.segment};
    }
    return std::nullopt;
}

}

bool is_in_leaf(const Numbering& numbering, uint32_t leaf, uint32_t number) {
    if (numbering.is_border(number)) return numbering.border_position(leaf, number) != NONE;
    return numbering.leaf_of(number) == leaf;
}

bool are_in_leaf(const Numbering& numbering, uint32_t leaf, const std::array<uint32_t, 3>& corners) {
    return std::ranges::all_of(corners, [&](uint32_t c) { return is_in_leaf(numbering, leaf, c); });
}

// Segments from one end to the other that are no longer than the edge together lie on it.
std::optional<size_t> find_on_border(const OverlayIndex& index, uint32_t leaf, uint32_t a, uint32_t b,
                                     double length, std::span<VertexBetween> found) {
    const Numbering& numbering = index.numbering;
    if (!numbering.is_border(a) || !numbering.is_border(b)) return std::nullopt;
    const uint32_t begin = numbering.border_position(leaf, a), end = numbering.border_position(leaf, b);
    if (begin == NONE || end == NONE) return std::nullopt;
    std::optional<size_t> between;
    for_each_joined(index.rings, numbering, leaf, begin, [&](uint32_t first, float segment) {
        if (!between) between = walk_along(index, leaf, begin, {first, segment}, end, length, found);
    });
    return between;
}

bool PointsInLeaf::has_both(const FacePoint& point, const FacePoint& other) const {
    if (point.vertex != NONE) return is_in_leaf(index_.numbering, other.leaf, point.vertex);
    if (other.vertex != NONE) return is_in_leaf(index_.numbering, point.leaf, other.vertex);
    return point.leaf == other.leaf;
}

float PointsInLeaf::to_vertex(const FacePoint& point, uint32_t number) const {
    const uint32_t leaf = point.leaf;
    const LeafVertex to = leaf_vertex(index_.numbering, leaf, number);
    std::array<double, FacePoint::MOST_VERTICES> from_vertices;
    for (size_t k = 0; k < point.vertex_count; ++k)
        from_vertices[k] =
            double{distance_between(index_, leaf, leaf_vertex(index_.numbering, leaf, point.numbers[k]), to)};
    return static_cast<float>(distance_over(point, from_vertices));
}

// Fills a row from each vertex of the point's polygon.
template <class FillRow>
std::span<const float> PointsInLeaf::look_out(const FacePoint& point, size_t count, const FillRow& fill_row) {
    const size_t row_size = NearRange::whole_parts(count);
    rows_.assign(point.vertex_count * row_size, INFINITE);
    distances_.resize(row_size);
    for (size_t k = 0; k < point.vertex_count; ++k) fill_row(point.numbers[k], rows_.data() + k * row_size);
    runnable_kernels().back().look_out(point, rows_.data(), row_size, distances_.data());
    return std::span(distances_).first(count);
}

// Over both polygons: from the vertices of the other one to the point, then to the other point.
float PointsInLeaf::to_point(const FacePoint& point, const FacePoint& other) {
    if (point.vertex != NONE) return to_vertex(other, point.vertex);
    if (other.vertex != NONE) return to_vertex(point, other.vertex);
    const uint32_t leaf = point.leaf;
    std::array<LeafVertex, FacePoint::MOST_VERTICES> to;
    for (size_t k = 0; k < other.vertex_count; ++k)
        to[k] = leaf_vertex(index_.numbering, leaf, other.numbers[k]);
    const auto from_point = look_out(point, other.vertex_count, [&](uint32_t number, float* row) {
        const LeafVertex from = leaf_vertex(index_.numbering, leaf, number);
        for (size_t k = 0; k < other.vertex_count; ++k) row[k] = distance_between(index_, leaf, from, to[k]);
    });
    std::array<double, FacePoint::MOST_VERTICES> from_vertices;
    std::ranges::copy(from_point, from_vertices.begin());
    return static_cast<float>(distance_over(other, from_vertices));
}

std::span<const float> PointsInLeaf::to_border(const FacePoint& point) {
    const uint32_t leaf = point.leaf;
    take_columns(leaf);
    return look_out(point, columns_.size(), [&](uint32_t number, float* row) {
        fill_border_row(leaf, leaf_vertex(index_.numbering, leaf, number), row);
    });
}

std::span<const float> PointsInLeaf::to_all(const FacePoint& point) {
    const uint32_t leaf = point.leaf;
    take_columns(leaf);
    const size_t borders = columns_.size(), inner = index_.numbering.internal_size(leaf);
    return look_out(point, borders + inner, [&](uint32_t number, float* row) {
        const LeafVertex from = leaf_vertex(index_.numbering, leaf, number);
        fill_border_row(leaf, from, row);
        fill_internal_row(leaf, from, row + borders);
    });
}

void PointsInLeaf::take_columns(uint32_t leaf) {
    const Numbering& numbering = index_.numbering;
    columns_.clear();
    for (const uint32_t position : numbering.positions_in_parent(leaf))
        columns_.push_back(index_.overlay_column(numbering.parent[leaf], position));
}

void PointsInLeaf::fill_border_row(uint32_t leaf, const LeafVertex& from, float* row) const {
    const Numbering& numbering = index_.numbering;
    const size_t count = columns_.size();
    if (from.internal != NONE) {
        const uint16_t* const codes = index_.hops.inner.data() + index_.inner_row(leaf, from.internal);
        const uint16_t* const places = index_.rings.place_of_slot.data() + numbering.border_begin[leaf];
        const float quantum = index_.quantum[leaf];
        for (size_t i = 0; i < count; ++i) row[i] = TableCode::distance(codes[places[i]], quantum);
        return;
    }
    const uint32_t parent = numbering.parent[leaf],
                   position = numbering.positions_in_parent(leaf)[from.border_position];
    const float quantum = index_.quantum[parent];
    if (index_.is_large[parent]) {
        for (size_t i = 0; i < count; ++i)
            row[i] = TableCode::distance(index_.overlay_code(parent, position, columns_[i]), quantum);
        return;
    }
    const uint16_t* const to_ring = index_.row_to_ring(parent, position);
    const uint16_t* const to_owned = index_.row_to_owned(parent, position);
    for (size_t i = 0; i < count; ++i)
        row[i] =
            TableCode::distance((columns_[i].is_owned ? to_owned : to_ring)[columns_[i].number], quantum);
}

void PointsInLeaf::fill_internal_row(uint32_t leaf, const LeafVertex& from, float* row) const {
    for (uint32_t i = 0; i < index_.numbering.internal_size(leaf); ++i)
        row[i] = distance_between(index_, leaf, from, {NONE, i});
}

// The codes that fill up the last block are those of vertices that are not reached.
void fill_row(const OverlayIndex& index, uint32_t leaf, std::span<const float> to_border, PointRow& row) {
    const uint32_t first = index.rings.begin[leaf], places = index.rings.size(leaf);
    float longest = 0;
    for (const float distance : to_border)
        if (distance < INFINITE) longest = std::max(longest, distance);
    row.quantum = longest / float{TableCode::LARGEST};
    row.codes.assign(SourceCode::whole_blocks(places) + TableCode::PADDING, TableCode::UNREACHED);
    for (uint32_t k = 0; k < places; ++k)
        row.codes[k] = TableCode::nearest_to(to_border[index.rings.position[first + k]], row.quantum);
}

}
