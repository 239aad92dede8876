#pragma once

#include <memory_resource>

#include "src/overlay/hops/border_part.h"
#include "src/overlay/kernels/dispatch.h"
#include "src/overlay/tables/tables.h"

namespace geodesic {

// A hop from a part of a patch's border with few places, which takes less time than an OverlayCrossing, and
// is straightened over all segments of the part. The object is used for one hop after the other.
class FewCrossing {
public:
    FewCrossing(const OverlayIndex& index, std::pmr::memory_resource* memory)
        : index_(index), of_part_(index.rings, memory) {}

    // Whether a hop from this part to so many places takes less time.
    static bool is_quicker(const BorderPart& part, size_t columns) {
        return part.size() <= FewPlaces::MOST && columns <= MOST_COLUMNS;
    }

    // Begins with a part of the patch's border, for which is_quicker() must hold, and the distances of its
    // places. A block behind the last distance must be readable, too. Part and distances must stay valid. The
    // patch must not be the whole mesh.
    void begin(uint32_t patch, const BorderPart& part, const float* distances);

    // As those of OverlayCrossing; winners are indices in the part, and must not be NULL. A large parent has
    // no rows to the vertices that it owns, so that there is no hop to these.
    void cross_to_ring(Columns places, float* distances, uint16_t* winners) const;
    void cross_to_owned(Columns owned, float* distances, uint16_t* winners) const;

private:
    static constexpr size_t MOST_COLUMNS = 64;

    // row_at(position) is the row of the vertex at a position of the parent's overlay.
    template <class RowAt>
    void cross(const RowAt& row_at, Columns columns, float* distances, uint16_t* winners) const;

    const OverlayIndex& index_;
    PartOfRing of_part_;
    uint32_t patch_ = 0, parent_ = 0;
    const BorderPart* part_ = nullptr;
    FewPlaces few_{};
};

}
