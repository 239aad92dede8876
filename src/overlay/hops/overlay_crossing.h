#pragma once

#include <memory_resource>
#include <span>

#include "src/overlay/hops/border_field.h"
#include "src/overlay/hops/border_part.h"
#include "src/overlay/hops/turned_rows.h"
#include "src/overlay/tables/ring_segments.h"
#include "src/overlay/tables/tables.h"

namespace geodesic {

// A hop from some or all of a patch's border to any vertices of the overlay of its parent. The object is used
// for one hop after the other.
class OverlayCrossing {
public:
    OverlayCrossing(const OverlayIndex& index, std::pmr::memory_resource* memory);

    // Begins with a part of the patch's border, or with all of it and segments that stay valid. The caller
    // then writes the distances of these places to the result. The patch must not be the whole mesh.
    std::span<float> begin(uint32_t patch, const BorderPart& part);
    std::span<float> begin(uint32_t patch, const RingSegments& segments);

    // Prepares the distances that were written. Returns whether the source reaches any of the places.
    bool finish() { return field_.finish(); }

    // Once finish() has returned true: hops to places of the parent's ring, and to vertices that the parent
    // owns, both counted from 0. distances[i] is infinite where there is no way. winners[i], if not NULL, is
    // the index of the place that the way leads over, or BorderFromSource::NO_PLACE.
    void cross_to_ring(Columns places, float* distances, uint16_t* winners = nullptr);
    void cross_to_owned(Columns owned, float* distances, uint16_t* winners = nullptr);

private:
    std::span<float> begin(uint32_t patch, const BorderPart& part, const RingSegments& segments,
                           const int8_t* is_own);
    // row_at(position) is the row of the vertex at a position of the parent's overlay.
    template <class RowAt>
    void cross(const RowAt& row_at, Columns columns, float* distances, uint16_t* winners);
    void cross_to_owned_of_large(Columns owned, float* distances, uint16_t* winners);
    void find_places_in_parent();
    void turn_rows(uint32_t first, uint32_t last);
    void cross_rows(Columns columns, float* distances, uint16_t* winners);
    void cross_near(Columns columns, float* distances);
    void cross_near_block(Columns columns, size_t first, float* distances) const;
    void cross_near_row(uint32_t column, float& distance);

    const OverlayIndex& index_;
    BorderField field_;
    uint32_t patch_ = 0, parent_ = 0;
    BorderPart part_;
    PartOfRing of_part_;
    Array<const uint16_t*> rows_; // per place: to the ring, or to the owned vertices
    Array<uint16_t> near_row_;    // scratch: from one column to the places
    // Of a large parent.
    Array<OverlayColumn> from_; // per place: its vertex in the parent's overlay; found when it is needed
    TurnedRows from_ring_, from_owned_;
    Array<uint32_t> columns_in_rows_; // of a run, counted from the first entry of its rows
};

}
