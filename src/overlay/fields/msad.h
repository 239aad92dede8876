#pragma once

#include <span>

#include "src/overlay/fields/ascend.h"
#include "src/overlay/fields/nearest_sources.h"
#include "src/overlay/fields/own_distances.h"
#include "src/overlay/hops/inner_sweep.h"
#include "src/overlay/hops/outer_crossing.h"
#include "src/overlay/tables/tables.h"

namespace geodesic {

// Distances to the nearest of multiple sources, for all destinations over overlay tables, by one sweep up
// from all sources and one sweep down to all leaves. Each source crosses by itself the borders on which it
// may be the nearest one. What is known besides corrects what tables say, source by source: how far a vertex
// is from one of several sources at least is no bound for all. Vertices are given by their numbers.
class OverlayMsad {
public:
    OverlayMsad(const OverlayIndex& index, std::pmr::memory_resource* memory);

    // Sets how many threads sweep() uses, at least 1. It is 1 at first.
    void set_threads(uint32_t count);

    // What a sweep fills, by number: the distance of every vertex and, unless `source` is empty, the key of
    // the source that it comes from, or NONE where no source reaches.
    struct Field {
        std::span<float> distance;
        std::span<uint32_t> source{};
    };
    // Patches whose whole border is farther than `radius` are skipped, and their vertices stay at infinity,
    // but for those that a way is known to.
    void sweep(const Sources& sources, float radius, const Field& field);

private:
    // What one thread works with.
    struct Scratch {
        Scratch(const OverlayIndex& index, std::pmr::memory_resource* memory);

        std::span<const float> add_offset(std::span<const float> found, float offset);

        InnerSweep sweep;
        OwnDistances own;
        Array<float> with_offset;
    };

    bool is_within(uint32_t source, uint32_t patch) const;
    float offset(uint32_t source) const { return sources_.offset(numbering_, source); }
    auto offset_of_sources() const {
        return [this](uint32_t source) { return offset(source); };
    }
    // As Sources has it, with the offset.
    template <class Use>
    void for_each_known(uint32_t source, uint32_t first, uint32_t end, const Use& use) const {
        sources_.for_each_known(index_, source, first, end, [&](const KnownWay& way) {
            use(KnownWay{way.number, way.length + offset(source), way.least + offset(source)});
        });
    }
    void begin(const Field& field);
    void lower_corrected(const Field& field, uint32_t first, std::span<const float> found,
                         uint32_t source) const;
    void take_known(const Field& field);
    void correct_border_vertex(const Field& field, uint32_t border_vertex) const;
    void hop_up(uint32_t child, std::span<float> distance);
    void hop_down(uint32_t patch, float radius, const Field& field, Scratch& scratch);
    void add_way(uint32_t border_vertex, float distance, uint32_t source);

    const OverlayIndex& index_;
    const Numbering& numbering_;
    OuterCrossing up_;
    Scratch top_; // for the sweep up, and for the patches that are not shared out to threads
    Array<Scratch> of_thread_;
    Array<uint32_t> sources_inside_; // per patch: how many
    NearestSources nearest_;
    Array<uint32_t> corrected_; // border vertices of which something is known from any source
    Sources sources_{};         // of the sweep that runs
};

}
