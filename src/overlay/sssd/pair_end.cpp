#include "src/overlay/sssd/pair_end.h"

#include <algorithm>

#include "src/base/prefetch.h"
#include "src/overlay/sssd/border_parts.h"

namespace geodesic {

BorderPart part_before(const OverlayIndex& index, uint32_t patch, const SampledAscent& sampled, size_t next,
                       uint32_t before, uint32_t sample) {
    const auto length = [&](uint32_t over) { return sampled.way_over(next, over, sample); };
    return part_near(index, patch, ways_near(index, patch, before, length));
}

void PairEnd::climb(const OverlayIndex& index, const PathEnd& of, uint32_t top, bool with_labels) {
    if (of.vertex == NONE)
        climb_from_point(index, of, top, ascent);
    else
        geodesic::climb(index, of.vertex, top, with_labels, ascent);
    measured.begin();
}

bool PairEnd::crosses_segments(const OverlayIndex& index) const {
    return std::ranges::any_of(ascent.patches,
                               [&](uint32_t patch) { return index.longest_segment[patch] > 0; });
}

bool PairEnd::take_whole_borders(const OverlayIndex& index) {
    parts.clear();
    for (const uint32_t patch : ascent.patches) {
        if (index.rings.size(patch) == 0) return false;
        parts.emplace_back(whole_border(index.rings, patch));
    }
    return true;
}

void PairEnd::take_parts(const OverlayIndex& index, uint32_t sample, const BorderPart& last_part) {
    parts.resize(ascent.patches.size());
    parts.back() = last_part;
    for (size_t b = parts.size(); b-- > 1;) {
        const uint32_t before = sampled.sample_before(b, sample);
        parts[b - 1] = part_before(index, ascent.patches[b - 1], sampled, b, before, sample);
        sample = before;
    }
    const Rings& rings = index.rings;
    for (size_t b = 0; b < parts.size(); ++b)
        for (const BorderRange& range : parts[b].ranges()) {
            // The slots of a border follow each other as its places do, but for those that repeat vertices.
            const uint32_t patch = ascent.patches[b], in_ring = range.first - rings.begin[patch];
            const uint32_t about = std::min(in_ring, index.numbering.border_size(patch) - 1);
            prefetch(&index.numbering.overlay_position[index.numbering.border_begin[patch] + about],
                     range.size());
            prefetch(rings.position.data() + range.first, range.size());
            prefetch(rings.segment_length.data() + range.first, range.size());
            prefetch(rings.half_inverse.data() + range.first, range.size());
            prefetch(rings.is_own.data() + range.first, range.size());
            prefetch(rings.vertex.data() + range.first, range.size());
        }
}

void PairEnd::take_parts_within(const OverlayIndex& index, float length) {
    parts.clear();
    for (size_t b = 0; b < ascent.patches.size(); ++b)
        parts.push_back(part_within(index, ascent.patches[b], sampled.ways_over(b), length));
}

bool PairEnd::move_parts(const OverlayIndex& index, uint32_t place) {
    bool moved = false;
    for (size_t b = parts.size(); b-- > 0;) {
        const BorderPart& measured_part = measured.parts()[b];
        parts[b] = part_beside(index, ascent.patches[b], measured_part, place);
        moved = moved || !measured_part.covers(parts[b]);
        if (b > 0) place = index.rings.begin[ascent.patches[b - 1]] + measured.winner_before(b, place);
    }
    return moved;
}

}
