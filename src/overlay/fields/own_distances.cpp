#include "src/overlay/fields/own_distances.h"

namespace geodesic {

// Where a source is the nearest one of a point of a segment, it is at most a segment's length farther from
// one end of it than the nearest one there: by the way over the point. This is what "may be the nearest" is
// told by.

// Returns the source if only one may be the nearest somewhere on the border, and NONE otherwise.
uint32_t OwnDistances::only_source(uint32_t patch, const NearestSources& nearest) const {
    uint32_t only = NONE;
    for (const uint32_t vertex : index_.numbering.border_of(patch)) {
        const uint32_t source = nearest.nearest(vertex);
        if (source == NONE) continue;
        if (only == NONE) only = source;
        if (source != only || nearest.are_several_within(vertex, index_.longest_segment[patch])) return NONE;
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
    for (const uint32_t vertex : border)
        nearest.for_each_source_within(vertex, index_.longest_segment[patch], [&](uint32_t source) {
            if (last_way_[source] != NONE) return;
            sources_.push_back(source);
            last_way_[source] = FIRST;
        });
    for (const uint32_t vertex : border)
        nearest.for_each_way(vertex, [&](const NearestSources::Way& way) {
            uint32_t& last = last_way_[way.source];
            if (last == NONE) return;
            ways_.push_back({vertex, way.distance, last});
            last = static_cast<uint32_t>(ways_.size() - 1);
        });
}

}
