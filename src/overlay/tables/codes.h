#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>

#include "src/base/numbers.h"

namespace geodesic {

// In the overlay engine a stored distance is a code: a whole number of steps of a quantum. This file has all
// kinds of codes and the rounding of entries; kernels/rounding.h rounds the distances of sources.

// An entry of a table: the distance of two vertices, in steps of the quantum of the table's patch.
struct TableCode {
    static constexpr uint16_t LARGEST = 0x7ffe;
    static constexpr uint16_t UNREACHED = 0x7fff; // there is no path
    // Kernels read rows in blocks of up to this many entries, and one entry more, so that so many follow the
    // last table.
    static constexpr size_t PADDING = 32;

    // The codes of a table are multiples of 2^shift, at most so large a shift.
    static constexpr int MOST_SHIFT = 14;

    // Only a distance of 0 is rounded to 0, so that different vertices never are at distance 0.
    static uint16_t nearest_to(float distance, float quantum, int shift = 0) {
        if (distance == INFINITE) return UNREACHED;
        if (distance == 0 || !(quantum > 0)) return 0;
        const double steps = std::round(double{distance} / std::ldexp(double{quantum}, shift));
        return static_cast<uint16_t>(
            static_cast<int>(std::clamp(steps, 1.0, static_cast<double>(LARGEST >> shift))) << shift);
    }

    // The code of the same distance in steps of another quantum.
    static uint16_t converted(uint16_t code, float from_quantum, float to_quantum) {
        if (code == 0 || code == UNREACHED || !(to_quantum > 0)) return code;
        return in_range(std::round(code * double{from_quantum} / double{to_quantum}));
    }

    // The nearest code for each of many distances, of which none is longer than LARGEST steps. steps_each is
    // steps_per_distance() of the quantum. Quicker than nearest_to(), by a division and by rounding in float.
    static void round_all(std::span<const float> distances, float steps_each, uint16_t* codes) {
        for (size_t i = 0; i < distances.size(); ++i) {
            const float distance = distances[i], least = distance > 0 ? 1 : 0;
            const float steps = std::min(std::max(distance * steps_each + 0.5f, least), float{LARGEST});
            codes[i] =
                static_cast<uint16_t>(static_cast<int32_t>(distance < INFINITE ? steps : float{UNREACHED}));
        }
    }

    static float distance(uint16_t code, float quantum) {
        return code == UNREACHED ? INFINITE : static_cast<float>(code) * quantum;
    }

private:
    static uint16_t in_range(double steps) {
        return static_cast<uint16_t>(std::clamp(steps, 1.0, double{LARGEST}));
    }
};

// The distance of a source from a border vertex, as a code to which kernels add table entries in 16 bits. It
// counts steps beyond the nearest vertex of the border, which itself has the smallest number, NEAREST, so
// that the sums fit into 16 bits. A vertex that the source does not reach has UNREACHED, and so have the
// codes that fill up the last block.
struct SourceCode {
    static constexpr int16_t NEAREST = std::numeric_limits<int16_t>::min(), UNREACHED = 0;

    // A sum of NO_SUM or more may come from a vertex that is not reached, or from an entry without a path.
    static constexpr int32_t NO_SUM = NEAREST + TableCode::UNREACHED;

    // Kernels read this many codes at once.
    static constexpr size_t BLOCK = 32;
    static constexpr size_t whole_blocks(size_t count) { return (count + BLOCK - 1) / BLOCK * BLOCK; }
    static_assert(TableCode::PADDING >= BLOCK, "the last row of a table is read in whole blocks");
};

// What a distance is multiplied by to be in steps of a quantum: finite, too, where the quantum is so small
// that its inverse is not, because 0 times infinity is no number; 0 where the quantum is 0, and all codes are
// the same.
inline float steps_per_distance(float quantum) {
    return quantum > 0 ? std::min(1 / quantum, std::numeric_limits<float>::max()) : 0;
}

// The distance of a vertex from the middle of a segment is kept as one byte beside the codes of its distances
// from the two ends: how much shorter it is than their mean, as a whole number of *strides* of so many steps
// each. In a plane that is at most half the length of the segment, which is no more than LARGEST strides;
// what is longer than the mean counts as long as it. Where there is a gap instead of a segment, a stride has
// 0 steps.
struct MiddleOffset {
    static constexpr int LARGEST = 255;
    // Kernels read the offsets of a block of places and up to 16 more, so that so many follow the last table.
    static constexpr size_t PADDING = 2 * TableCode::PADDING;
    static_assert(PADDING >= SourceCode::BLOCK + 16);
    // Only tables of which a segment is longer than all distances would need longer ones.
    static constexpr int LONGEST_STRIDE = 127;

    // Of a segment of this length, or of a gap, which has NaN as its length.
    static int16_t stride(float length, float quantum) {
        if (!(length > 0)) return 0;
        const float steps = length * steps_per_distance(quantum) * (0.5f / LARGEST) + 1;
        return static_cast<int16_t>(std::min(steps, float{LONGEST_STRIDE}));
    }

    // Of two codes, rounded up.
    static uint16_t mean(uint16_t first, uint16_t second) {
        return static_cast<uint16_t>((first + second + 1) / 2);
    }
    static uint16_t code(uint16_t first, uint16_t second, uint8_t offset, int stride) {
        return static_cast<uint16_t>(mean(first, second) - offset * stride);
    }
};

}
