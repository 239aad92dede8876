#pragma once

#include <span>

#include "src/index/index.h"
#include "src/query/border_field.h"
#include "src/query/inner_sweep.h"

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

    // Of sweep(); at least 1, which it is at first.
    void set_threads(uint32_t count);

    // distance[number], of every vertex; patches beyond `radius` are left out, and their vertices at
    // infinity.
    void sweep(std::span<const uint32_t> sources, float radius, std::span<float> distance);

    // Distances to the borders of all patches on levels 1 to `level`, and to what lies just inside of the
    // patches that the source lies in; the others are infinite.
    void sweep_borders(uint32_t source, uint32_t level, std::span<float> distance);

    // The first half, into a field of infinity: distances to the overlays of all patches that a source lies
    // in.
    void climb(std::span<const uint32_t> sources, DistanceField distance);

private:
    // What one thread needs on the way down.
    struct Descent {
        Descent(const Index& index, size_t most_rows, std::pmr::memory_resource* memory)
            : sweep(index, 1, memory), inside(most_rows, memory) {}
        InnerSweep sweep;
        Array<float> inside;
    };

    void start_from(uint32_t source, DistanceField distance);
    void ascend(uint32_t child, DistanceField distance);
    void descend_everywhere(float radius, std::span<float> distance);
    void descend_into(uint32_t patch, float radius, std::span<float> distance, Descent& descent) const;
    void descend(uint32_t patch, float radius, std::span<float> distance, Descent& descent) const;

    const Index& index_;
    const OverlayTables& tables_;
    BorderField ascent_;
    Array<const uint16_t*> rows_; // of the ascent
    Array<float> outside_;        // per row
    Array<Descent> descents_;     // one a thread
    uint32_t source_count_ = 0;
    Array<uint32_t> sources_below_; // per patch
};

}
