#pragma once

#include <memory_resource>
#include <span>

#include "src/overlay/sssd/ascent.h"
#include "src/overlay/sssd/border_crossing.h"
#include "src/overlay/sssd/border_range.h"

namespace geodesic {

// Which segments of a border range a path is straightened over: those beside the vertex with the least sum of
// distances, or all of them, which is for ends that lie near each other.
enum class Straighten { BESIDE_LEAST_SUM, EVERYWHERE };

// The distances of one end from the vertices of its border ranges, border by border.
class MeasuredEnd {
public:
    MeasuredEnd(const OverlayIndex& index, std::pmr::memory_resource* memory);

    // Forgets the end that was measured before; to be called after each climb.
    void begin() { ranges_.clear(); }

    // Measures all ranges of a candidate, one for each patch of the ascent. Distances of the candidates
    // before are kept from the first border on as long as their ranges cover those of this one.
    void measure(const Ascent& ascent, std::span<const BorderRange> ranges, Straighten straighten,
                 BorderCrossing& crossing);

    // The range of the last border, which may be wider than what was asked for, and the distances there.
    BorderRange last_range() const { return ranges_.back(); }
    std::span<const float> last_distances() const;

    // Crosses from the range of the last border to a range of a sibling's border.
    void cross_to(const Ascent& ascent, uint32_t sibling, BorderRange range, Straighten straighten,
                  BorderCrossing& crossing, std::span<float> out) const;

private:
    // Where the distances of a border begin.
    float* distances_of(size_t border) { return distances_.data() + border * stride_; }

    const OverlayIndex& index_;
    const size_t stride_;
    Array<BorderRange> ranges_; // Those that are measured, from the first border on.
    Array<float> distances_;
};

// Returns the length of the shortest path that crosses a border range, given the distances from both ends to
// the places of the range, or infinity if there is none.
float shortest_path(const Rings& rings, BorderRange range, std::span<const float> from,
                    std::span<const float> to, Straighten straighten);

}
