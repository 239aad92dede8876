#include "src/overlay/own_distances.h"

namespace geodesic {

// Where a source is the nearest one of a point of a segment, it is at most a segment's length farther from
// one end of it than the nearest one there: by the way over the point. This is what "may be the nearest" is
// told by.

// Returns the source if only one may be the nearest somewhere on the border, and NONE otherwise.
uint32_t OwnDistances::only_source(uint32_t patch, const NearestSources& nearest) const {
    uint32_t only = NONE;
    for (const uint32_t vertex : index_.numbering.border_of(patch)) {
        const auto all = nearest.of(vertex);
        if (all.empty()) continue;
        if (only == NONE) only = all[0].source;
        if (all[0].source != only) return NONE;
        if (all.size() > 1 && all[1].distance <= all[0].distance + index_.longest_segment[patch]) return NONE;
    }
    return only;
}

// What the border before has left, too, where a lack of memory ended its hops.
void OwnDistances::forget() {
    for (const uint32_t source : sources_) last_way_[source] = NONE;
    for (const Way& way : ways_) own_[way.border_vertex] = INFINITE;
    sources_.clear();
    ways_.clear();
}

void OwnDistances::collect(uint32_t patch, const NearestSources& nearest) {
    forget();
    own_.resize(index_.numbering.border_vertex_count(), INFINITE);
    if (last_way_.size() < keys_) last_way_.resize(keys_, NONE);
    const auto border = index_.numbering.border_of(patch);
    for (const uint32_t vertex : border) {
        const auto all = nearest.of(vertex);
        for (const NearestSources::Way& way : all) {
            if (way.distance > all[0].distance + index_.longest_segment[patch]) break;
            if (last_way_[way.source] != NONE) continue;
            sources_.push_back(way.source);
            last_way_[way.source] = FIRST;
        }
    }
    for (const uint32_t vertex : border)
        for (const NearestSources::Way& way : nearest.of(vertex)) {
            uint32_t& last = last_way_[way.source];
            if (last == NONE) continue;
            ways_.push_back({vertex, way.distance, last});
            last = static_cast<uint32_t>(ways_.size() - 1);
        }
}

}
