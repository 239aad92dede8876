#pragma once

#include <memory_resource>
#include <span>

#include "src/overlay/overlay_crossing.h"
#include "src/overlay/sssd/ascent.h"
#include "src/overlay/sssd/border_range.h"

namespace geodesic {

// What a hop leads to, of the places of a range.
class HopTargets {
public:
    HopTargets(const OverlayIndex& index, std::pmr::memory_resource* memory)
        : columns_(index.rings.largest_size(), memory), places_(columns_.size(), memory) {}

    void clear() { count_ = 0; }
    void add(uint32_t column, uint32_t place) {
        columns_[count_] = column;
        places_[count_++] = place;
    }

    bool is_empty() const { return count_ == 0; }
    std::span<const uint32_t> columns() const { return {columns_.data(), count_}; } // of OverlayCrossing
    // Counted from the first place of the range.
    std::span<const uint32_t> places() const { return {places_.data(), count_}; }

private:
    size_t count_ = 0;
    Array<uint32_t> columns_, places_;
};

// Scratch for crossing one border. Both ends use the same one, in turn, and nothing stays in it.
struct BorderCrossing {
    BorderCrossing(const OverlayIndex& index, std::pmr::memory_resource* memory)
        : hop(index, memory), on_ring(index, memory), owned(index, memory), beside(memory),
          distances(index.rings.largest_size(), memory), winners(index.rings.largest_size(), memory) {
        beside.reserve(index.rings.largest_size());
    }

    void begin() {
        on_ring.clear();
        owned.clear();
        beside.clear();
    }

    OverlayCrossing hop;
    HopTargets on_ring, owned; // on the parent's ring, and owned by the parent
    // The places of vertices that lie on the border that is crossed, too, but beside the range there.
    Array<uint32_t> beside;
    Array<float> distances;
    Array<uint16_t> winners;
};

// The distances of one end from the vertices of its border ranges, border by border.
class MeasuredEnd {
public:
    MeasuredEnd(const OverlayIndex& index, std::pmr::memory_resource* memory);

    // Forgets the end that was measured before; to be called after each climb.
    void begin() { ranges_.clear(); }

    // Measures all ranges of a candidate, one for each patch of the ascent. Distances of the candidates
    // before are kept from the first border on as long as their ranges cover those of this one.
    void measure(const Ascent& ascent, std::span<const BorderRange> ranges, BorderCrossing& crossing);

    // The ranges that are measured, from the first border on, which may be wider than what was asked for, and
    // the distances in the last one, with infinity behind them up to whole blocks.
    std::span<const BorderRange> ranges() const { return ranges_; }
    BorderRange last_range() const { return ranges_.back(); }
    const float* last_distances() const { return distances_.data() + (ranges_.size() - 1) * stride_; }

    // The place, on the border before, that the way to a place of a measured range comes over.
    uint32_t place_before(size_t border, uint32_t place) const {
        return crossed_[border - 1] + winners_[border * stride_ + place - ranges_[border].first];
    }

    // Crosses from the range of the last border to a range of a sibling's border. The way to the i-th place
    // of the range comes over the place first + winners[i] of the last border, where `first` is what is
    // returned.
    uint32_t cross_to(const Ascent& ascent, uint32_t sibling, BorderRange range, BorderCrossing& crossing,
                      std::span<float> out, std::span<uint16_t> winners) const;

private:
    // Where the distances of a border begin.
    float* distances_of(size_t border) { return distances_.data() + border * stride_; }

    const OverlayIndex& index_;
    const size_t stride_;
    Array<BorderRange> ranges_;
    Array<float> distances_;
    // The way to a place comes over the place crossed_[b - 1] + winner of the border before.
    Array<uint16_t> winners_;
    Array<uint32_t> crossed_; // per border: the first of the places that the kernel has crossed
};

}
