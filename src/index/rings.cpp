#include "src/index/rings.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "format/error.h"

namespace geodesic {

namespace {

constexpr uint32_t REACH = Rings::REACH;
constexpr float GAP = Rings::GAP;

void add_place(Rings& rings, uint32_t position, uint32_t vertex, float length, bool own) {
    rings.position.push_back(position);
    rings.vertex.push_back(vertex);
    rings.segment_length.push_back(length);
    rings.half_inverse.push_back(0.5f / length);
    rings.is_own.push_back(own ? -1 : 0);
    rings.chain.push_back(static_cast<uint32_t>(rings.chains.size()));
}

[[noreturn]] void refuse_segment(uint32_t patch, uint32_t from, uint32_t to) {
    throw Error(GEOIDX_ERROR_CORRUPT, "a segment joins positions " + std::to_string(from) + " and " +
                                          std::to_string(to) + " on the border of patch " +
                                          std::to_string(patch));
}

// The chain of segments that begins at position `first` of a patch's border; a vertex without segments is one
// by itself.
Chain chain_at(uint32_t first, const BorderSegments& segments, const Index& index, uint32_t patch) {
    const uint32_t first_slot = index.border_begin[patch], size = index.border_size(patch);
    Chain chain;
    for (uint32_t i = first;; ++i) {
        chain.positions.push_back(i);
        chain.lengths.push_back(segments.length[first_slot + i]);
        const uint32_t next = segments.next[first_slot + i];
        if (next == i + 1 && next < size) continue;
        chain.is_closed = next != NONE;
        if (chain.is_closed && (next != first || i == first)) refuse_segment(patch, i, next);
        return chain;
    }
}

}

void RingWriter::begin() { rings_.begin.assign(1, 0); }

void RingWriter::add_chain(const Chain& chain, std::span<const uint32_t> border) {
    const auto count = static_cast<uint32_t>(chain.positions.size());
    for (uint32_t step = 0; step < count + 2 * REACH; ++step) {
        const bool own = step >= REACH && step < count + REACH;
        const uint32_t around = (step + REACH * count - REACH) % count;
        const uint32_t along = std::clamp(step, REACH, count + REACH - 1) - REACH;
        const uint32_t i = chain.is_closed ? around : along;
        const bool gap = chain.is_closed ? step + 1 == count + 2 * REACH : !own || i + 1 == count;
        add_place(rings_, chain.positions[i], border[chain.positions[i]], gap ? GAP : chain.lengths[i], own);
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
}

void RingWriter::end() {
    for (size_t i = 0; i < Rings::PADDING; ++i) add_place(rings_, 0, 0, GAP, false);
}

std::vector<Chain> chains_of_ring(const Rings& rings, uint32_t patch) {
    std::vector<Chain> chains;
    for (uint32_t k = rings.begin[patch]; k < rings.begin[patch + 1];) {
        const auto& [first, last, is_closed] = rings.chains[rings.chain[k]];
        chains.push_back({{rings.position.begin() + first, rings.position.begin() + last + 1},
                          {rings.segment_length.begin() + first, rings.segment_length.begin() + last + 1},
                          is_closed != 0});
        k = last + REACH + 1;
    }
    return chains;
}

void lay_out_rings(const BorderSegments& segments, Index& index) {
    OverlayTables& tables = index.overlay_tables;
    RingWriter writer(tables.rings);
    writer.begin();
    for (uint32_t p = 0; p < index.patch_count(); ++p) {
        for (uint32_t i = 0; i < index.border_size(p);) {
            const Chain chain = chain_at(i, segments, index, p);
            writer.add_chain(chain, index.border_of(p));
            i += static_cast<uint32_t>(chain.positions.size());
        }
        writer.end_ring();
    }
    tables.place_of_slot.resize(index.border.size());
    for (uint32_t p = 0; p < index.patch_count(); ++p)
        for (uint32_t k = tables.rings.begin[p]; k < tables.rings.begin[p + 1]; ++k)
            if (tables.rings.is_own[k])
                tables.place_of_slot[index.border_begin[p] + tables.rings.position[k]] =
                    k - tables.rings.begin[p];
    writer.end();
}

BorderSegments segments_of_rings(const Index& index) {
    const OverlayTables& tables = index.overlay_tables;
    BorderSegments segments(index.border.size());
    for (size_t slot = 0; slot < index.border.size(); ++slot) {
        const size_t place = tables.rings.begin[index.patch_of_slot[slot]] + tables.place_of_slot[slot];
        if (std::isnan(tables.rings.segment_length[place])) continue;
        segments.next[slot] = tables.rings.position[place + 1];
        segments.length[slot] = tables.rings.segment_length[place];
    }
    return segments;
}

}
