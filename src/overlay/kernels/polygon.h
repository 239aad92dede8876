#pragma once

#include "src/overlay/kernels/dispatch.h"
#include "src/overlay/kernels/lanes.h"

namespace geodesic {

// The kernel that looks out of the polygon of a point: what Kernels says of look_out() is done by the struct
// of this name. Only dispatch.cpp includes this.

// An edge of a polygon in all lanes.
template <class V>
struct PolygonEdge {
    explicit PolygonEdge(const FacePoint::Edge& edge)
        : segments{V{} + static_cast<float>(edge.length), V{} + static_cast<float>(0.5 / edge.length)},
          foot(V{} + static_cast<float>(edge.foot)), height(V{} + static_cast<float>(edge.height)),
          seen_from(V{} + static_cast<float>(edge.seen_from)),
          seen_to(V{} + static_cast<float>(edge.seen_to)) {}

    // The squares of straight ways to vertices that have these distances from the ends; infinite if a line
    // does not cross what is seen of the edge.
    [[gnu::always_inline]] void square_across(const V& from_first, const V& from_second, V& square) const {
        V to_foot, to_height;
        segments.place_point(from_first, from_second, to_foot, to_height);
        const V off = height + to_height, along = foot - to_foot, none = V{} + INFINITE;
        const V crossing = off > 0 ? foot * to_height + to_foot * height : foot,
                weight = off > 0 ? off : V{} + 1;
        const V past_begin = crossing - seen_from * weight, before_end = seen_to * weight - crossing;
        const V inside = past_begin < before_end ? past_begin : before_end;
        square = inside >= 0 ? along * along + off * off : none;
    }

    Segments<V> segments;
    V foot, height, seen_from, seen_to;
};

template <size_t BYTES>
struct LookOut {
    [[gnu::always_inline]] static void run(const FacePoint& point, const float* rows, size_t row_size,
                                           float* distances) {
        using V = Floats<BYTES>;
        const auto row = [&](size_t k, size_t c, V& floats) { load(rows + k * row_size + c, floats); };
        std::fill_n(distances, row_size, INFINITE);
        for (size_t i = 0; i < point.edge_count; ++i) {
            const PolygonEdge<V> edge(point.edges[i]);
            for (size_t c = 0; c < row_size; c += Lanes<BYTES>::FLOATS) {
                V from_first, from_second, square, least;
                row(point.edges[i].first, c, from_first);
                row(point.edges[i].second, c, from_second);
                edge.square_across(from_first, from_second, square);
                load(distances + c, least);
                lower(least, square);
                store(least, distances + c);
            }
        }
        for (size_t c = 0; c < row_size; c += Lanes<BYTES>::FLOATS) {
            V least, from, certain{};
            load(distances + c, least);
            take_square_root(least);
            for (size_t k = 0; k < point.vertex_count; ++k) {
                const V straight = V{} + static_cast<float>(point.straight[k]);
                row(k, c, from);
                lower<V>(least, straight + from);
                lower<V>(certain, straight - from);
            }
            store<V>(least < -certain ? -certain : least, distances + c);
        }
    }
};

}
