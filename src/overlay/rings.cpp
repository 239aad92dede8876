#include "src/overlay/rings.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <string>

#include "format/error.h"
#include "src/index/section_tags.h"

namespace geodesic {

namespace {

constexpr uint32_t REACH = Rings::REACH;
constexpr float GAP = Rings::GAP;

void add_place(Rings& rings, uint32_t position, float length, bool own) {
    rings.position.push_back(position);
    rings.segment_length.push_back(length);
    rings.half_inverse.push_back(0.5f / length);
    rings.is_own.push_back(own ? -1 : 0);
}

[[noreturn]] void refuse_segment(uint32_t patch, uint32_t from, uint32_t to) {
    throw Error(GEOIDX_ERROR_CORRUPT,
                "a segment joins positions " + std::to_string(from) + " and " + std::to_string(to) +
                    " on the border of patch " + std::to_string(patch),
                TAG_SEGMENTS);
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

}

void RingWriter::begin() {
    rings_.begin.assign(1, 0);
    rings_.chain_begin.assign(1, 0);
}

void RingWriter::add_chain(const Chain& chain) {
    const auto count = static_cast<uint32_t>(chain.positions.size());
    for (uint32_t step = 0; step < count + 2 * REACH; ++step) {
        const bool own = step >= REACH && step < count + REACH;
        const uint32_t around = (step + REACH * count - REACH) % count;
        const uint32_t along = std::clamp(step, REACH, count + REACH - 1) - REACH;
        const uint32_t i = chain.is_closed ? around : along;
        const bool gap = chain.is_closed ? step + 1 == count + 2 * REACH : !own || i + 1 == count;
        add_place(rings_, chain.positions[i], gap ? GAP : chain.lengths[i], own);
    }
    const auto end = static_cast<uint32_t>(rings_.position.size()) - REACH;
    rings_.chains.push_back({end - count, end - 1, chain.is_closed});
}

void RingWriter::end_ring() {
    const auto end = static_cast<uint32_t>(rings_.position.size());
    if (end - rings_.begin.back() > Rings::MOST_PLACES)
        throw Error(GEOIDX_ERROR_LIMIT, "the border of patch " + std::to_string(rings_.begin.size() - 1) +
                                            " has " + std::to_string(end - rings_.begin.back()) +
                                            " vertices or so, more than the overlay engine can take");
    rings_.begin.push_back(end);
    rings_.chain_begin.push_back(static_cast<uint32_t>(rings_.chains.size()));
}

void RingWriter::end() {
    for (size_t i = 0; i < Rings::PADDING; ++i) add_place(rings_, 0, GAP, false);
    const auto shrink = [](auto&... arrays) { (arrays.shrink_to_fit(), ...); };
    shrink(rings_.begin, rings_.position, rings_.segment_length, rings_.half_inverse, rings_.is_own,
           rings_.chain_begin, rings_.chains);
}

std::vector<Chain> chains_of_ring(const Rings& rings, uint32_t patch) {
    std::vector<Chain> chains;
    for (const auto& [first, last, is_closed] : rings.chains_of(patch)) {
        const uint32_t size = last - first + 1;
        chains.push_back({{rings.position.data() + first, size},
                          {rings.segment_length.data() + first, size},
                          is_closed != 0});
    }
    return chains;
}

void lay_out_rings(std::span<const uint32_t> segment_end, std::span<const float> segment_length,
                   const Numbering& numbering, BorderRings& rings) {
    std::vector<uint32_t> positions(numbering.largest_border_size());
    std::iota(positions.begin(), positions.end(), 0u);
    RingWriter writer(rings);
    writer.begin();
    for (uint32_t p = 0; p < numbering.patch_count(); ++p) {
        const uint32_t slot = numbering.border_begin[p], size = numbering.border_size(p);
        const auto ends = segment_end.subspan(slot, size);
        const auto lengths = segment_length.subspan(slot, size);
        for (uint32_t i = 0, end; i < size; i = end) {
            end = end_of_chain(i, ends, p);
            writer.add_chain({std::span(positions).subspan(i, end - i), lengths.subspan(i, end - i),
                              ends[end - 1] != NONE});
        }
        writer.end_ring();
    }
    rings.place_of_slot.resize(numbering.border.size());
    for (uint32_t p = 0; p < numbering.patch_count(); ++p)
        for (uint32_t k = rings.begin[p]; k < rings.begin[p + 1]; ++k)
            if (rings.is_own[k])
                rings.place_of_slot[numbering.border_begin[p] + rings.position[k]] = k - rings.begin[p];
    writer.end();
    rings.vertex.assign(rings.position.size(), 0);
    for (uint32_t p = 0; p < numbering.patch_count(); ++p)
        for (uint32_t k = rings.begin[p]; k < rings.begin[p + 1]; ++k)
            rings.vertex[k] = numbering.border_of(p)[rings.position[k]];
}

BorderSegments segments_of_rings(const BorderRings& rings, const Numbering& numbering) {
    BorderSegments segments(numbering.border.size());
    for (size_t slot = 0; slot < numbering.border.size(); ++slot) {
        const size_t place = rings.begin[numbering.patch_of_slot[slot]] + rings.place_of_slot[slot];
        if (std::isnan(rings.segment_length[place])) continue;
        segments.end[slot] = rings.position[place + 1];
        segments.length[slot] = rings.segment_length[place];
    }
    return segments;
}

}
