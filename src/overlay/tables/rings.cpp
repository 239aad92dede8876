#include "src/overlay/tables/rings.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "format/error.h"
#include "src/index/section_tags.h"

namespace geodesic {

namespace {

constexpr uint32_t REACH = Rings::REACH;
constexpr float GAP = Rings::GAP;

void add_place(Rings& rings, uint32_t position, float length, bool own) {
    rings.position.push_back(static_cast<uint16_t>(position));
    rings.segment_length.push_back(length);
    rings.half_inverse.push_back(0.5f / length);
    rings.is_own.push_back(own ? -1 : 0);
}

// Adds the vertices from position `first` of a border on, one for each length, which is that of the segment
// to the next one; in a closed chain, the last segment leads to the first vertex.
void add_chain(Rings& rings, uint32_t first, std::span<const float> lengths, bool is_closed) {
    const auto count = static_cast<uint32_t>(lengths.size());
    for (uint32_t step = 0; step < count + 2 * REACH; ++step) {
        const bool own = step >= REACH && step < count + REACH;
        const uint32_t around = (step + REACH * count - REACH) % count;
        const uint32_t along = std::clamp(step, REACH, count + REACH - 1) - REACH;
        const uint32_t i = is_closed ? around : along;
        const bool gap = is_closed ? step + 1 == count + 2 * REACH : !own || i + 1 == count;
        add_place(rings, first + i, gap ? GAP : lengths[i], own);
    }
    const auto end = static_cast<uint32_t>(rings.position.size()) - REACH;
    rings.chains.push_back({end - count, end - 1, is_closed});
}

[[noreturn]] void refuse_segment(uint32_t patch, uint32_t from, uint32_t to) {
    throw Error(GEOIDX_ERROR_CORRUPT,
                "a segment joins positions " + std::to_string(from) + " and " + std::to_string(to) +
                    " on the border of patch " + std::to_string(patch),
                TAG_SEGMENTS);
}

// Adds the bridges that begin on one border, the first of `bridges`, and takes these off. The border begins
// at a slot and has so many positions.
void add_bridges(Rings& rings, uint32_t patch, uint32_t slot, uint32_t size,
                 std::span<const Bridge>& bridges) {
    std::pair<uint32_t, uint32_t> last{0, 0};
    for (; !bridges.empty() && bridges.front().slot - slot < size; bridges = bridges.subspan(1)) {
        const uint32_t begin = bridges.front().slot - slot, end = bridges.front().end;
        if (end <= begin || end >= size || std::pair(begin, end) <= last) refuse_segment(patch, begin, end);
        last = {begin, end};
        add_place(rings, begin, bridges.front().length, false);
        add_place(rings, end, GAP, false);
    }
}

void end_ring(Rings& rings) {
    if (rings.position.size() > Rings::MOST_PLACES_OF_ALL)
        throw Error(GEOIDX_ERROR_LIMIT, "borders have more places than the overlay engine can take");
    const auto end = static_cast<uint32_t>(rings.position.size());
    if (end - rings.begin.back() > Rings::MOST_PLACES)
        throw Error(GEOIDX_ERROR_LIMIT, "the border of patch " + std::to_string(rings.begin.size() - 1) +
                                            " has " + std::to_string(end - rings.begin.back()) +
                                            " places, more than the overlay engine can take");
    rings.begin.push_back(end);
    rings.chain_begin.push_back(static_cast<uint32_t>(rings.chains.size()));
}

// The end of the chain that begins at position `first` of a patch's border: one more than its last position.
// A vertex without segments is a chain by itself.
uint32_t end_of_chain(uint32_t first, std::span<const uint32_t> segment_end, uint32_t patch) {
    for (auto i = first;; ++i) {
        const uint32_t next = segment_end[i];
        if (next == i + 1 && next < segment_end.size()) continue;
        if (next != NONE && (next != first || i == first)) refuse_segment(patch, i, next);
        return i + 1;
    }
}

// Fills what follows from the positions, place by place.
void number_places(const Numbering& numbering, Rings& rings) {
    rings.vertex.assign(rings.position.size(), 0);
    rings.place_of_slot.resize(numbering.border.size());
    for (uint32_t p = 0; p < numbering.patch_count(); ++p)
        for (uint32_t k = rings.begin[p]; k < rings.begin[p + 1]; ++k) {
            const uint32_t slot = numbering.border_begin[p] + rings.position[k];
            rings.vertex[k] = numbering.border[slot];
            if (rings.is_own[k]) rings.place_of_slot[slot] = static_cast<uint16_t>(k - rings.begin[p]);
        }
}

}

void lay_out_rings(const BorderSegments& segments, const Numbering& numbering, Rings& rings) {
    std::span<const Bridge> bridges = segments.bridges;
    rings.begin.assign(1, 0);
    rings.chain_begin.assign(1, 0);
    for (uint32_t p = 0; p < numbering.patch_count(); ++p) {
        const uint32_t slot = numbering.border_begin[p], size = numbering.border_size(p);
        const auto ends = std::span(segments.end).subspan(slot, size);
        const auto lengths = std::span(segments.length).subspan(slot, size);
        for (uint32_t i = 0, end; i < size; i = end) {
            end = end_of_chain(i, ends, p);
            add_chain(rings, i, lengths.subspan(i, end - i), ends[end - 1] != NONE);
        }
        add_bridges(rings, p, slot, size, bridges);
        end_ring(rings);
    }
    if (!bridges.empty())
        throw Error(GEOIDX_ERROR_CORRUPT, "bridges are not in the order of their slots", TAG_SEGMENTS);
    for (size_t i = 0; i < Rings::PADDING; ++i) add_place(rings, 0, GAP, false);
    const auto shrink = [](auto&... arrays) { (arrays.shrink_to_fit(), ...); };
    shrink(rings.begin, rings.position, rings.segment_length, rings.half_inverse, rings.is_own,
           rings.chain_begin, rings.chains);
    number_places(numbering, rings);
}

BorderSegments segments_of_rings(const Rings& rings, const Numbering& numbering) {
    BorderSegments segments(numbering.border.size());
    for (uint32_t p = 0; p < numbering.patch_count(); ++p) {
        for (uint32_t i = 0; i < numbering.border_size(p); ++i) {
            const size_t place = own_place(rings, numbering, p, i);
            if (std::isnan(rings.segment_length[place])) continue;
            const uint32_t slot = numbering.border_begin[p] + i;
            segments.end[slot] = rings.position[place + 1];
            segments.length[slot] = rings.segment_length[place];
        }
        for_each_bridge(rings, p, [&](uint32_t place, float length) {
            segments.bridges.push_back(
                {numbering.border_begin[p] + rings.position[place], rings.position[place + 1], length});
        });
    }
    return segments;
}

}
