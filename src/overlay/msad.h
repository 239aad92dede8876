#pragma once

#include <span>

#include "src/overlay/border_sources.h"
#include "src/overlay/inner_sweep.h"
#include "src/overlay/near_sources.h"
#include "src/overlay/outer_crossing.h"
#include "src/overlay/tables.h"

namespace geodesic {

// Distances to the nearest of multiple sources, for all destinations over overlay tables, by one sweep up
// from all sources and one sweep down to all leaves. The sweeps also carry which source each border vertex is
// nearest to. Vertices are given by their numbers.
class OverlayMsad {
public:
    OverlayMsad(const OverlayIndex& index, std::pmr::memory_resource* memory);

    // Sets how many threads sweep() uses, at least 1. It is 1 at first.
    void set_threads(uint32_t count);

    // Fills distance[number] of every vertex. Patches whose whole border is farther than `radius` are
    // skipped, and their vertices stay at infinity.
    void sweep(std::span<const uint32_t> sources, float radius, std::span<float> distance);

private:
    // What one thread works with.
    struct Scratch {
        Scratch(const OverlayIndex& index, std::pmr::memory_resource* memory);
        void begin();
        void find_sources(size_t rows, bool of_each);

        InnerSweep sweep;
        BorderSources border_sources;
        NearCrossing near;
        NearSources near_sources; // border vertices close to a source that this thread found
        Array<NearVertex> near_vertices;
        Array<uint32_t> source; // per row of a hop: the source of the way
        Array<uint16_t> winners;
    };

    void start_from(uint32_t source, std::span<float> distance);
    void look_around(uint32_t source, std::span<const float> distance);
    void hop_up(uint32_t child, std::span<float> distance);
    void hop_down(uint32_t patch, float radius, std::span<float> distance, Scratch& scratch);
    void cross_near(uint32_t patch, bool from_inside, const NearCrossing::Ways& ways, Scratch& scratch) const;
    void take_lesser(const NearCrossing::Ways& ways, std::span<float> distance);

    const OverlayIndex& index_;
    const Numbering& numbering_;
    OuterCrossing up_;
    Scratch top_; // for the sweep up, and for the patches that are not shared out to threads
    Array<Scratch> of_thread_;
    Array<uint32_t> sources_inside_; // per patch: how many
    Array<uint32_t> nearest_source_; // by number, of the border vertices that a source reaches
};

}
