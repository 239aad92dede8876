#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstring>
#include <limits>

#include "src/base/plane.h"
#include "src/overlay/tables/tables.h"

namespace geodesic {

// Floats side by side. Every lane is computed by itself, so that the results are the same for vectors of any
// width.
template <size_t BYTES>
struct FloatVector {
    using Type [[gnu::vector_size(BYTES)]] = float;
};
template <size_t BYTES>
using Floats = typename FloatVector<BYTES>::Type;

// The functions below are always inlined, so that they are compiled for the processor of their caller. They
// return nothing, because how a wide vector is returned depends on the processor, too.

template <class V>
[[gnu::always_inline]] inline void take_square_root(V& v) {
    for (size_t i = 0; i < sizeof v / sizeof(float); ++i) v[i] = std::sqrt(v[i]);
}

// Distances are rounded, and so a point beside a segment can have distances from its two ends that are too
// short together. Squares that come out a little negative by this are taken for 0. Others are NaN: along the
// surface, the ends of a long edge can be much nearer to each other than along the edge.
template <class V>
[[gnu::always_inline]] inline void mend_square(const V& length, V& square) {
    const V least = LEAST_SQUARE * (length * length);
    const V none = V{} + std::numeric_limits<float>::quiet_NaN();
    square = square < least ? none : (square < 0 ? V{} : square);
}

// The square of the distance from the middle of a segment to a point that has these distances from its ends.
// It is NaN if the length is, or if there is no such point.
template <class V>
[[gnu::always_inline]] inline void middle_square(const V& from_first, const V& from_second, const V& length,
                                                 V& square) {
    square = 0.5f * (from_first * from_first + from_second * from_second) - 0.25f * (length * length);
    mend_square(length, square);
}

// Border segments. Each lies in a plane of its own, with its first end at 0 and its second end at (length,
// 0).
template <class V>
struct Segments {
    V length, half_inverse; // half_inverse is 0.5 / length; both are NaN for a gap

    // Places a point that has these distances from the two ends in the plane of its segment: `foot` is how
    // far along the segment it lies, and `height` how far off the segment. `height` is NaN if there is no
    // such point.
    [[gnu::always_inline]] void place_point(const V& from_first, const V& from_second, V& foot,
                                            V& height) const {
        foot = (from_first - from_second) * (from_first + from_second) * half_inverse + 0.5f * length;
        height = (from_first - foot) * (from_first + foot);
        mend_square(length, height);
        take_square_root(height);
    }
};

// Segments, and the position of a source on one side of each of them.
template <class V>
struct SegmentsFromSource {
    Segments<V> segments;
    V foot, height;

    // The square of the straight way from the source over the segment to a point on its other side, which has
    // these distances from the ends. It is infinite if the straight line does not cross the segment between
    // its ends.
    [[gnu::always_inline]] void square_across(const V& from_first, const V& from_second, V& square) const {
        V to_foot, to_height;
        segments.place_point(from_first, from_second, to_foot, to_height);
        const V off = height + to_height, along = foot - to_foot;
        const V none = V{} + INFINITE;
        // The distance of the crossing from the nearer end, times `off`. (GCC 12 makes no vector instructions
        // of two comparisons joined by && where vectors have 64 bytes.)
        V crossing = foot * to_height + to_foot * height;
        const V to_second = segments.length * off - crossing;
        crossing = to_second < crossing ? to_second : crossing;
        square = crossing > 0 ? along * along + off * off : none;
    }
};

// One float for each segment beside a border vertex: REACH on each side, in the order of the border.
using BesideFloats = Floats<2 * Rings::REACH * sizeof(float)>;

inline BesideFloats beside_floats(const float* first) {
    BesideFloats floats;
    std::memcpy(&floats, first, sizeof floats);
    return floats;
}

// The length of the way from a source over a place of a ring, counted over all rings, to a target. Where it
// is shorter, the way straightened over one of the segments beside that place counts. from(k) and to(k) are
// the distances of the source and of the target from place k.
template <class From, class To>
float straightened(const Rings& rings, size_t place, const From& from, const To& to) {
    const size_t first_segment = place - Rings::REACH;
    const auto ends = [&](const auto& distance, BesideFloats& first, BesideFloats& second) {
        for (size_t k = 0; k < 4; ++k) {
            first[k] = distance(first_segment + k);
            second[k] = distance(first_segment + k + 1);
        }
    };
    SegmentsFromSource<BesideFloats> from_source{{beside_floats(rings.segment_length.data() + first_segment),
                                                  beside_floats(rings.half_inverse.data() + first_segment)},
                                                 {},
                                                 {}};
    BesideFloats first, second, squares;
    ends(from, first, second);
    from_source.segments.place_point(first, second, from_source.foot, from_source.height);
    ends(to, first, second);
    from_source.square_across(first, second, squares);
    const float square = std::min(std::min(squares[0], squares[1]), std::min(squares[2], squares[3]));
    return std::min(from(place) + to(place), std::sqrt(square));
}

}
