#pragma once

#include <memory_resource>
#include <span>

#include "src/overlay/sssd/ascent.h"
#include "src/overlay/sssd/border_crossing.h"
#include "src/overlay/sssd/border_range.h"

namespace geodesic {

// The distances of one end from the vertices of its border ranges, border by border.
class MeasuredEnd {
public:
    MeasuredEnd(const OverlayIndex& index, std::pmr::memory_resource* memory);

    // Forgets the end that was measured before; to be called after each climb.
    void begin() { ranges_.clear(); }

    // Measures all ranges of a candidate, one for each patch of the ascent. Distances of the candidates
    // before are kept from the first border on as long as their ranges cover those of this one.
    void measure(const Ascent& ascent, std::span<const BorderRange> ranges, BorderCrossing& crossing);

    // The range of the last border, which may be wider than what was asked for, and the distances there, with
    // infinity behind them up to whole blocks.
    BorderRange last_range() const { return ranges_.back(); }
    const float* last_distances() const { return distances_.data() + (ranges_.size() - 1) * stride_; }

    // Crosses from the range of the last border to a range of a sibling's border.
    void cross_to(const Ascent& ascent, uint32_t sibling, BorderRange range, BorderCrossing& crossing,
                  std::span<float> out) const;

private:
    // Where the distances of a border begin.
    float* distances_of(size_t border) { return distances_.data() + border * stride_; }

    const OverlayIndex& index_;
    const size_t stride_;
    Array<BorderRange> ranges_; // Those that are measured, from the first border on.
    Array<float> distances_;
};

}
