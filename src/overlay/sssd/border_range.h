#pragma once

#include <algorithm>
#include <cstdint>
#include <limits>
#include <memory_resource>
#include <span>

#include "src/overlay/sssd/ascent.h"

namespace geodesic {

// The part of a border that a path may cross: consecutive places of the border's ring, counted over all
// rings.
struct BorderRange {
    uint32_t first, last;

    uint32_t size() const { return last - first + 1; }
    bool covers(const BorderRange& other) const { return first <= other.first && other.last <= last; }
};

// Consecutive places of a coarse ring, counted from its first place; empty until one is added.
struct SampleRange {
    uint32_t first = std::numeric_limits<uint32_t>::max(), last = 0;

    bool is_empty() const { return first > last; }
    void add(uint32_t place) {
        first = std::min(first, place);
        last = std::max(last, place);
    }
};

// Returns the range from the least to the greatest winner of a crossing; those without a way do not count.
SampleRange range_of_winners(std::span<const uint16_t> winners);

// Returns the range of all samples of the last border that are no farther from the end than `reach`. The
// ascent's sample_distances must have been read.
SampleRange samples_within(const OverlayIndex& index, const Ascent& ascent, float reach);

// The ranges of all borders that paths from one end to some samples of its last border may cross. They are
// found from the last border to the first one.
class BorderRanges {
public:
    BorderRanges(const OverlayIndex& index, std::pmr::memory_resource* memory);

    // Reads what the ranges of all candidates of an end have in common; to be called before find().
    void begin(const Ascent& ascent);

    // Finds the ranges of paths to samples of the last border and asks for the memory that measuring reads.
    // Returns whether such paths exist; otherwise, ranges() says nothing.
    bool find(const Ascent& ascent, SampleRange samples);

    // Takes the whole of all borders of the ascent. Returns whether each has any vertex: around a separate
    // part there may be none.
    bool take_whole(const Ascent& ascent);

    // There is one range for each patch of the ascent.
    std::span<const BorderRange> ranges() const { return ranges_; }

private:
    void read_codes(const Ascent& ascent, uint32_t patch, std::span<int16_t> out);
    SampleRange samples_before(const Ascent& ascent, size_t border, SampleRange samples);
    void prefetch_tables(const Ascent& ascent, size_t border) const;

    const OverlayIndex& index_;
    Array<BorderRange> ranges_;     // One for each patch of the ascent.
    Array<int16_t> first_codes_;    // From the end to the places of the first border's coarse ring.
    Array<int16_t> codes_;          // From the end to the places of another border's coarse ring.
    Array<float> sample_distances_; // Scratch of read_codes(): from the end to the samples of a border.
    Array<int16_t> sample_codes_;   // Scratch of read_codes(): the codes of these distances.
    Array<const uint16_t*> rows_;   // Scratch of samples_before(): the rows of the samples.
    Array<uint16_t> winners_;       // Scratch of samples_before(): over which place each row is reached.
};

}
