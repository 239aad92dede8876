#pragma once

#include <memory_resource>
#include <span>

#include "src/overlay/border_field.h"
#include "src/overlay/tables.h"

namespace geodesic {

// Distances by number, `stride` floats apart: several fields can lie in one array, side by side at each
// vertex.
struct DistanceField {
    float* first;
    size_t stride = 1;
    float& operator[](size_t number) const { return first[number * stride]; }
};

// From the border of one patch after the other to the overlay of its parent.
class OuterCrossing {
public:
    OuterCrossing(const OverlayIndex& index, std::pmr::memory_resource* memory);

    // From the border of a child of some patch. Returns whether it is reached.
    bool see(uint32_t child, DistanceField distance) {
        return see(child, distance, segments_from(rings_, rings_.begin[child]));
    }
    // Likewise, with other segments, which must outlive the crossing.
    bool see(uint32_t child, DistanceField distance, const RingSegments& segments);

    // If it is reached: to each overlay position, infinite on the child's own border. winners: of
    // CrossingKernel.
    std::span<float> cross(uint16_t* winners = nullptr);

    // Those of the overlay.
    Rows rows() const { return {rows_.data(), numbering_.overlay_size(numbering_.parent[child_])}; }

private:
    const OverlayIndex& index_;
    const Numbering& numbering_;
    const Rings& rings_;
    BorderField field_;
    uint32_t child_ = 0;
    Array<const uint16_t*> rows_;
    Array<float> outside_; // per row
};

}
