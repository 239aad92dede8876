#pragma once

#include <memory_resource>
#include <span>

#include "src/overlay/hops/border_field.h"
#include "src/overlay/kernels/dispatch.h"
#include "src/overlay/tables/tables.h"

namespace geodesic {

// Hops down: from the border of a patch to its inner vertices, for one source or for several at once. The
// distances of a vertex from the `sources` sources lie side by side.
class InnerSweep {
public:
    // `sources` is 1 or FIELDS_AT_ONCE.
    InnerSweep(const OverlayIndex& index, size_t sources, std::pmr::memory_resource* memory);

    // Chooses the patch and reads the distances of its border, distances[number * sources + i] from the i-th
    // source. Returns whether there is anything to hop to: not if the patch has no inner vertices, if no
    // source reaches its border, or if its whole border lies beyond the radius of every source.
    bool begin(uint32_t patch, const float* distances, float radius = INFINITE) {
        return begin(patch, distances, segments_from(rings_, rings_.begin[patch]), radius);
    }
    // Does the same with other segments, which must stay valid until the hop is done.
    bool begin(uint32_t patch, const float* distances, const RingSegments& segments, float radius);

    // Hops to the inner vertices of that patch; call it only if begin() returned true. Writes inside[i *
    // sources + source].
    void cross_to(float* inside);

    // Does the same, but returns the distances, which stay valid until the next hop.
    std::span<float> cross();

private:
    Rows rows();
    std::span<float> result();
    bool begin_from(size_t source);
    void cross_near(size_t source, float* inside);

    const OverlayIndex& index_;
    const Numbering& numbering_;
    const Rings& rings_;
    const Kernels& kernels_;
    size_t sources_;
    uint32_t patch_ = 0;
    RingSegments segments_{};
    BorderDistances border_{};
    BorderCodes codes_{};
    Array<float> distance_, middle_distance_; // [place * sources + source], as are the codes
    Array<int16_t> code_, middle_, bound_;
    std::array<float, FIELDS_AT_ONCE> nearest_{};
    Array<float> result_; // [inner vertex * sources + source]
    BorderField field_;   // this and what follows are for one source at a time
    Array<const uint16_t*> rows_;
    Array<float> from_one_; // per row
};

}
