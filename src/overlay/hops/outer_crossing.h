#pragma once

#include <memory_resource>
#include <span>

#include "src/overlay/hops/overlay_crossing.h"
#include "src/overlay/tables/tables.h"

namespace geodesic {

// Distances by vertex number, `stride` floats apart, so that several fields can lie in one array, side by
// side at each vertex.
struct DistanceField {
    float* first;
    size_t stride = 1;
    float& operator[](size_t number) const { return first[number * stride]; }
};

// Hops up and across of a field: from the border of a patch to the whole overlay of its parent, or to one
// border in it.
class OuterCrossing {
public:
    OuterCrossing(const OverlayIndex& index, std::pmr::memory_resource* memory);

    // Chooses the patch, a child of the patch whose overlay is wanted, and reads the distances of its border.
    // Returns whether the source reaches it.
    bool begin(uint32_t child, DistanceField distance) {
        return begin(child, distance, segments_from(rings_, rings_.begin[child]));
    }
    // Does the same with other segments, which must stay valid until the hop is done.
    bool begin(uint32_t child, DistanceField distance, const RingSegments& segments);

    // The same, where only one border in that overlay is wanted: that of the parent or of another child. What
    // is known of it stays as it is.
    bool begin_to_border(uint32_t child, uint32_t patch, DistanceField distance,
                         const RingSegments& segments);

    // Hops to each vertex of what is wanted whose distance is not known: of the whole overlay, those that are
    // not on the child's own border. Call it only if begin() or begin_to_border() returned true.
    std::span<float> cross();

    // The numbers of these vertices.
    std::span<const uint32_t> targets() const { return numbers_; }

private:
    void read_border(uint32_t child, DistanceField distance, const RingSegments& segments);
    void add_on_border(uint32_t position);
    void add_owned(uint32_t position);

    const OverlayIndex& index_;
    const Numbering& numbering_;
    const Rings& rings_;
    OverlayCrossing crossing_;
    uint32_t child_ = 0, parent_ = 0;
    Array<uint32_t> numbers_;        // per target: first those on the parent's border
    Array<uint32_t> places_, owned_; // of the targets: places of the parent's ring, and owned vertices
    Array<float> outside_;           // per target: the distance
};

}
