#pragma once

#include <memory_resource>
#include <span>

#include "src/overlay/kernels/dispatch.h"
#include "src/overlay/tables/ring_segments.h"
#include "src/overlay/tables/tables.h"

namespace geodesic {

// The distances of a source from the places of one ring, prepared for the kernels that hop from it. The
// object is used for one border after the other.
class BorderField {
public:
    BorderField(const OverlayIndex& index, std::pmr::memory_resource* memory);

    // Begins a border with so many places, and what is known of each. The caller then writes the distances of
    // these places to the result. `quantum` is that of the rows that will be added.
    std::span<float> begin(size_t places, const RingSegments& segments, const int8_t* is_own, float quantum) {
        border_ = {places,       code_.data(),   distance_.data(), segments.length, segments.half_inverse,
                   foot_.data(), height_.data(), quantum,          near_segments_};
        is_own_ = is_own;
        return std::span(distance_).first(places);
    }

    // Prepares the distances that were written. Returns whether the source reaches any of the places.
    bool finish();

    // These may be called once finish() has returned true; Kernels describes them. cross_near() reads and
    // writes distances, and does nothing if no place is near.
    const NearRange& near_range() const { return range_; }
    bool is_near() const { return range_.is_near(); }
    void cross(Rows rows, Columns columns, float* distances, uint16_t* winners) const {
        kernels_.cross(border_, rows, columns, distances, winners);
    }
    void cross_near_columns(Rows rows, size_t first, float* ways) const {
        kernels_.cross_near_columns(border_, range_, rows, first, ways);
    }
    void cross_near(Rows rows, float* distances) const {
        if (is_near()) kernels_.cross_near(border_, range_, rows, distances);
    }

private:
    const Kernels& kernels_;
    const float near_segments_;
    BorderFromSource border_{};
    const int8_t* is_own_ = nullptr;
    NearRange range_{};
    Array<float> distance_;
    Array<int16_t> code_;
    Array<float> foot_, height_;
};

}
