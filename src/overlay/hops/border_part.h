#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <memory_resource>
#include <span>

#include "src/overlay/tables/ring_segments.h"
#include "src/overlay/tables/tables.h"

namespace geodesic {

// Consecutive places of a ring, counted over all rings.
struct BorderRange {
    uint32_t first, last;

    uint32_t size() const { return last - first + 1; }
    bool covers(const BorderRange& other) const { return first <= other.first && other.last <= last; }
};

// A part of a border: one or more ranges of its ring, in their order, with places between them. Its places
// have an index, counted from the first one through all ranges. A part around the place where the ring cuts
// a closed chain open has two ranges, one at each end of the chain.
class BorderPart {
public:
    static constexpr size_t MOST_RANGES = 4;

    BorderPart() = default;
    explicit BorderPart(BorderRange range) { add(range); }

    // Adds a range, which may be empty and begins no sooner than any before. It is joined with the one
    // before, and with the places between them, if these are few or if there are too many ranges.
    void add(BorderRange range) {
        if (range.size() == 0) return;
        if (count_ > 0 && (count_ == MOST_RANGES || is_beside(range))) return join(range);
        ranges_[count_++] = range;
        size_ += range.size();
    }

    std::span<const BorderRange> ranges() const { return {ranges_.data(), count_}; }
    uint32_t size() const { return size_; }
    bool covers(const BorderPart& other) const;
    // The place with this index, which is less than size().
    uint32_t place(uint32_t index) const {
        const BorderRange* range = ranges_.data();
        for (; index >= range->size(); ++range) index -= range->size();
        return range->first + index;
    }
    // The index of a place, or NONE.
    uint32_t index(uint32_t place) const {
        uint32_t before = 0;
        for (const BorderRange& range : ranges()) {
            if (place >= range.first && place <= range.last) return before + place - range.first;
            before += range.size();
        }
        return NONE;
    }

    // Calls function(place) for all places, in the order of their indices.
    template <class Function>
    void for_each_place(const Function& function) const {
        for (const BorderRange& range : ranges())
            for (uint32_t place = range.first; place <= range.last; ++place) function(place);
    }

private:
    // Whether what kernels read of a range, REACH places on each side of it, touches that of the last one.
    bool is_beside(BorderRange range) const {
        return range.first <= ranges_[count_ - 1].last + 2 * Rings::REACH + 1;
    }
    void join(BorderRange range);

    std::array<BorderRange, MOST_RANGES> ranges_{};
    uint32_t count_ = 0, size_ = 0;
};

// The whole border of a patch.
inline BorderRange whole_border(const Rings& rings, uint32_t patch) {
    return {rings.begin[patch], rings.begin[patch + 1] - 1};
}

// How many places of a part, which has all bridges of the border, are of its chains. They come first.
inline uint32_t places_of_chains(const Rings& rings, uint32_t patch, const BorderPart& part) {
    return part.size() - rings.bridge_places(patch);
}

// What kernels read of the places of a part, by their indices: arrays of the rings where it has one range,
// and copies otherwise, in which each range ends with a gap.
class PartOfRing {
public:
    PartOfRing(const Rings& rings, std::pmr::memory_resource* memory);

    void take(const BorderPart& part);

    RingSegments segments() const { return segments_; }
    const int8_t* is_own() const { return is_own_; }

private:
    const Rings& rings_;
    RingSegments segments_{};
    const int8_t* is_own_ = nullptr;
    Array<float> lengths_, half_inverses_; // the copies
    Array<int8_t> is_own_copy_;
};

}
