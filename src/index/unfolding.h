#pragma once

#include <algorithm>
#include <cmath>
#include <experimental/simd>
#include <limits>

#include "src/index/overlay_tables.h"

namespace geodesic {

// Four floats side by side: one vector register of any processor, so that results are the same on all.
using FourFloats = std::experimental::simd<float, std::experimental::simd_abi::deduce_t<float, 4>>;

// Something for each of the two border segments on each side of a border vertex, in the order of the border.
struct BySegment {
    FourFloats first, second; // of its two ends
};

template <class OfVertex>
BySegment by_segment(const OfVertex& of_vertex) { // of_vertex(0) .. of_vertex(4)
    return {FourFloats([&](auto k) { return of_vertex(static_cast<int>(k)); }),
            FourFloats([&](auto k) { return of_vertex(static_cast<int>(k) + 1); })};
}

// Four border segments, each in a plane of its own: first end at 0, second at (length, 0), and the source
// that both are seen from at (x, -y).
struct UnfoldedSegments {
    // The distances of the ends from the source; lengths are NaN where there is no segment.
    UnfoldedSegments(const BySegment& from, const FourFloats& lengths)
        : length(lengths), half_inverse(0.5f / lengths), x(foot(from)), y(height(from, x)) {}
    UnfoldedSegments() = default;

    // The square of the shortest straight way from the source over a segment to a point beyond, at these
    // distances from the ends; infinity where there is none.
    float square_across(const BySegment& to) const {
        const FourFloats to_x = foot(to), to_y = height(to, to_x);
        const FourFloats sum = y + to_y, across = x - to_x;
        const FourFloats crossing = x * to_y + to_x * y; // times the sum; NaN if it does not unfold
        FourFloats square = std::numeric_limits<float>::infinity();
        where(crossing > 0 && crossing < length * sum, square) = across * across + sum * sum;
        return std::experimental::hmin(square);
    }

private:
    // How far along the segment the foot of a point lies, and how far off the segment the point.
    FourFloats foot(const BySegment& to) const {
        return (to.first - to.second) * (to.first + to.second) * half_inverse + 0.5f * length;
    }
    static FourFloats height(const BySegment& to, const FourFloats& foot) {
        return sqrt((to.first - foot) * (to.first + foot));
    }

    FourFloats length, half_inverse, x, y;
};

// The way from a source over a border vertex to a target, straightened over the segments near that vertex
// where that is shorter. first_slot: where the border's slots begin; from(i) and to(i): distances of position
// i.
template <class From, class To>
float straightened(const OverlayTables& tables, uint32_t first_slot, uint32_t position, const From& from,
                   const To& to) {
    const OverlayTables::Neighbourhood near = tables.around(first_slot, position);
    const UnfoldedSegments segments(by_segment([&](int k) { return from(near.position[k]); }),
                                    FourFloats(near.length, std::experimental::element_aligned));
    const float square = segments.square_across(by_segment([&](int k) { return to(near.position[k]); }));
    return std::min(from(position) + to(position), std::sqrt(square));
}

}
