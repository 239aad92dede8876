#pragma once

#include <memory_resource>
#include <span>

#include "src/overlay/hops/border_part.h"
#include "src/overlay/hops/overlay_crossing.h"
#include "src/overlay/sssd/ascent.h"
#include "src/overlay/sssd/few_crossing.h"

namespace geodesic {

// What a hop leads to, of the places of a part.
class HopTargets {
public:
    HopTargets(const OverlayIndex& index, std::pmr::memory_resource* memory)
        : columns_(index.rings.largest_size(), memory), places_(columns_.size(), memory) {}

    void clear() { count_ = 0; }
    void add(uint32_t column, uint32_t index) {
        columns_[count_] = column;
        places_[count_++] = index;
    }

    bool is_empty() const { return count_ == 0; }
    std::span<const uint32_t> columns() const { return {columns_.data(), count_}; } // of OverlayCrossing
    // Their indices in the part.
    std::span<const uint32_t> places() const { return {places_.data(), count_}; }

private:
    size_t count_ = 0;
    Array<uint32_t> columns_, places_;
};

// Scratch for crossing one border. Both ends use the same one, in turn, and nothing stays in it.
struct BorderCrossing {
    BorderCrossing(const OverlayIndex& index, std::pmr::memory_resource* memory)
        : hop(index, memory), few(index, memory), on_ring(index, memory), owned(index, memory),
          beside(memory), distances(index.rings.largest_size(), memory),
          winners(index.rings.largest_size(), memory) {
        beside.reserve(index.rings.largest_size());
    }

    void begin() {
        on_ring.clear();
        owned.clear();
        beside.clear();
    }

    OverlayCrossing hop;
    FewCrossing few;
    HopTargets on_ring, owned; // on the parent's ring, and owned by the parent
    // The indices of vertices that lie on the border that is crossed, too, but beside the part of it.
    Array<uint32_t> beside;
    Array<float> distances;
    Array<uint16_t> winners;
};

// The distances of one end from the vertices of parts of borders, border by border.
class MeasuredEnd {
public:
    MeasuredEnd(const OverlayIndex& index, std::pmr::memory_resource* memory);

    // Forgets the end that was measured before; to be called after each climb.
    void begin() { parts_.clear(); }

    // Measures all parts of a candidate, one for each patch of the ascent. Distances of the candidates before
    // are kept from the first border on as long as their parts cover those of this one.
    void measure(const Ascent& ascent, std::span<const BorderPart> parts, BorderCrossing& crossing);

    // The parts that are measured, from the first border on, which may be larger than what was asked for, and
    // the distances in the last one, with infinity behind them up to whole blocks.
    std::span<const BorderPart> parts() const { return parts_; }
    const BorderPart& last_part() const { return parts_.back(); }
    const float* last_distances() const { return distances_.data() + (parts_.size() - 1) * stride_; }

    // The place, counted from the first one of its ring, on the border before that the way to a place of a
    // measured part comes over.
    uint16_t winner_before(size_t border, uint32_t place) const {
        return winners_[border * stride_ + parts_[border].index(place)];
    }

    // Crosses from the part of the last border to a part of a sibling's border. The way to the i-th place of
    // that part comes over winners[i], a place of the last border, counted from the first one of its ring.
    void cross_to(const Ascent& ascent, uint32_t sibling, const BorderPart& part, BorderCrossing& crossing,
                  std::span<float> out, std::span<uint16_t> winners) const;

private:
    // Where the distances of a border begin.
    float* distances_of(size_t border) { return distances_.data() + border * stride_; }

    const OverlayIndex& index_;
    const size_t stride_;
    Array<BorderPart> parts_;
    Array<float> distances_;
    Array<uint16_t> winners_; // see winner_before()
};

}
