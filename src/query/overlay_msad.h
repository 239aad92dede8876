#pragma once

#include <span>

#include "src/index/index.h"
#include "src/query/border_field.h"

namespace geodesic {

// Distances by number, `stride` floats apart: several fields can lie in one array, side by side at each
// vertex.
struct DistanceField {
    float* first;
    size_t stride = 1;
    float& operator[](size_t number) const { return first[number * stride]; }
};

// Multiple sources, all destinations on overlay tables: one sweep up from the leaves of the sources, one down
// to all leaves. Vertices are given by their numbers.
class OverlayMsad {
public:
    OverlayMsad(const Index& index, std::pmr::memory_resource* memory);

    // distance[number], of every vertex; patches beyond `radius` are left out, and their vertices at
    // infinity.
    void sweep(std::span<const uint32_t> sources, float radius, std::span<float> distance);

    // The first half, into a field of infinity: distances to the overlays of all patches that a source lies
    // in.
    void climb(std::span<const uint32_t> sources, DistanceField distance);

private:
    void start_from(uint32_t source, DistanceField distance);
    void ascend(uint32_t child, DistanceField distance);
    void descend(uint32_t patch, float radius, std::span<float> distance);
    void hop(uint32_t patch, float quantum, const uint16_t* first_row, DistanceField distance, float radius,
             std::span<float> out);

    const Index& index_;
    const OverlayTables& tables_;
    BorderField field_; // of the hop at hand
    Array<const uint16_t*> rows_;
    Array<float> out_;              // per row
    Array<uint32_t> sources_below_; // per patch
};

}
