#include "src/overlay/fields/nearest_sources.h"

namespace geodesic {

void NearestSources::clear() {
    if (longest_segment_.empty()) find_longest_segments();
    count_.assign(longest_segment_.size(), 0);
    few_.resize(count_.size() * FEW);
    others_.resize(count_.size());
}

void NearestSources::find_longest_segments() {
    const Numbering& numbering = index_.numbering;
    longest_segment_.assign(numbering.border_vertex_count(), 0);
    for (uint32_t patch = 0; patch < numbering.patch_count(); ++patch)
        for (const uint32_t vertex : numbering.border_of(patch))
            longest_segment_[vertex] = std::max(longest_segment_[vertex], index_.longest_segment[patch]);
}

void NearestSources::add(uint32_t border_vertex, const Way& way) {
    Way* const few = few_.data() + border_vertex * FEW;
    uint8_t& count = count_[border_vertex];
    const bool is_full = count == FEW;
    const bool is_among_few = !is_full || !is_before(few[FEW - 1], way);
    if (!is_among_few && way.distance > farthest_kept(border_vertex)) return;
    Way* place = std::ranges::find(few, few + count, way.source, &Way::source);
    const bool is_known = place != few + count;
    if (is_known && place->distance <= way.distance) return;
    if (!is_among_few) return keep_among_others(border_vertex, way);
    if (!is_known) {
        if (is_full) {
            take_from_others(border_vertex, way.source);
            keep_among_others(border_vertex, *--place);
        } else if (++count == FEW) {
            others_[border_vertex].clear(); // which the latest sources have left
        }
    }
    for (; place != few && is_before(way, *(place - 1)); --place) *place = *(place - 1);
    *place = way;
}

// A source is kept once, with its least distance.
void NearestSources::keep_among_others(uint32_t border_vertex, const Way& way) {
    if (way.distance > farthest_kept(border_vertex)) return;
    Array<Way>& others = others_[border_vertex];
    const auto place = std::ranges::lower_bound(others, way.source, {}, &Way::source);
    if (place == others.end() || place->source != way.source)
        others.insert(place, way);
    else
        place->distance = std::min(place->distance, way.distance);
}

void NearestSources::take_from_others(uint32_t border_vertex, uint32_t source) {
    Array<Way>& others = others_[border_vertex];
    const auto place = std::ranges::lower_bound(others, source, {}, &Way::source);
    if (place != others.end() && place->source == source) others.erase(place);
}

}
