#pragma once

#include <algorithm>
#include <cstdint>
#include <memory_resource>
#include <span>

#include "src/overlay/tables/tables.h"

namespace geodesic {

// Of several sources, those that may be the nearest ones to a border vertex or beside it, and how far away
// each of them is. The nearest one alone would do for sums of distances. The others are for paths that cross
// a border between two vertices whose nearest sources differ: to place a source in the plane of a segment
// takes its distances from both ends.
class NearestSources {
public:
    struct Way {
        float distance;
        uint32_t source;
    };

    NearestSources(const OverlayIndex& index, std::pmr::memory_resource* memory)
        : index_(index), longest_segment_(memory), count_(memory), few_(memory), others_(memory) {}

    // Forgets all ways. Call it before the first add(), too.
    void clear();

    // Only one thread at a time may add ways to the same vertex. The order of calls changes nothing.
    void add(uint32_t border_vertex, const Way& way);

    // The nearest source, or NONE.
    uint32_t nearest(uint32_t border_vertex) const {
        return few_of(border_vertex).empty() ? NONE : few_of(border_vertex).front().source;
    }
    // Calls use(way) for the way from each source that is known, the nearest ones first.
    template <class Use>
    void for_each_way(uint32_t border_vertex, const Use& use) const {
        for (const Way& way : few_of(border_vertex)) use(way);
        for (const Way& way : others_of(border_vertex))
            if (way.distance <= farthest_kept(border_vertex)) use(way);
    }
    // Whether more than one source is no farther than the nearest one by more than this. Some must reach it.
    bool are_several_within(uint32_t border_vertex, float beyond_nearest) const {
        const auto few = few_of(border_vertex);
        return few.size() > 1 && few[1].distance <= few[0].distance + beyond_nearest;
    }
    // Calls use(source) for each source that is no farther than the nearest one by more than this.
    template <class Use>
    void for_each_source_within(uint32_t border_vertex, float beyond_nearest, const Use& use) const {
        const auto few = few_of(border_vertex);
        if (few.empty()) return;
        const float farthest = few.front().distance + beyond_nearest;
        for (const Way& way : few) {
            if (way.distance > farthest) return;
            use(way.source);
        }
        for (const Way& way : others_of(border_vertex))
            if (way.distance <= farthest) use(way.source);
    }

private:
    // So many of the nearest sources of a vertex are kept in any case.
    static constexpr size_t FEW = 32;
    // Others are kept if they are no farther than the nearest one by so many segments. Where a source is the
    // nearest one of a point of the surface, it is no farther than the nearest one from anywhere else by more
    // than twice the way from that point, and paths are straightened over a segment and two more on each
    // side.
    static constexpr float SEGMENTS_KEPT = 2 * (1 + Rings::REACH);

    static bool is_before(const Way& a, const Way& b) {
        return a.distance < b.distance || (a.distance == b.distance && a.source < b.source);
    }

    std::span<const Way> few_of(uint32_t border_vertex) const {
        return {few_.data() + border_vertex * FEW, count_[border_vertex]};
    }
    std::span<const Way> others_of(uint32_t border_vertex) const {
        if (count_[border_vertex] < FEW) return {};
        return others_[border_vertex];
    }
    float farthest_kept(uint32_t border_vertex) const {
        return few_of(border_vertex).front().distance + SEGMENTS_KEPT * longest_segment_[border_vertex];
    }
    void find_longest_segments();
    void keep_among_others(uint32_t border_vertex, const Way& way);
    void take_from_others(uint32_t border_vertex, uint32_t source);

    const OverlayIndex& index_;
    // By number of border vertices:
    Array<float> longest_segment_; // of all borders that the vertex lies on
    Array<uint8_t> count_;         // of few_
    Array<Way> few_;               // the nearest ones, FEW each, in ascending order of their distances
    // Sources that are not in few_, in ascending order of their keys. They are of use only while few_ is
    // full. Those beyond farthest_kept() are passed over: it falls when nearer sources come.
    Array<Array<Way>> others_;
};

}
