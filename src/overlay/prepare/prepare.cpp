#include "src/overlay/prepare/prepare.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <string>
#include <vector>

#include "format/error.h"
#include "geoidx.h"
#include "src/index/section_tags.h"
#include "src/overlay/prepare/bounds.h"
#include "src/overlay/prepare/large_overlays.h"
#include "src/overlay/prepare/middles.h"
#include "src/overlay/prepare/overlay_tables.h"
#include "src/overlay/prepare/proportion.h"

namespace geodesic {

namespace {

void measure_segments(OverlayIndex& index) {
    const Rings& rings = index.rings;
    index.longest_segment.assign(index.numbering.patch_count(), 0.f);
    for (uint32_t p = 0; p < index.numbering.patch_count(); ++p)
        for (uint32_t k = rings.begin[p]; k < rings.begin[p + 1]; ++k)
            index.longest_segment[p] = std::fmax(index.longest_segment[p], rings.segment_length[k]);
}

// All hop tables, by their kinds. Kernels read past the end of a table, so that there are more codes behind
// each kind, up to a whole block.
template <class Code>
struct HopParts {
    std::span<Code> border, owned, inner, internal;
    std::span<Code> inner_middles; // two offsets a code
};

uint64_t size_of_part(uint64_t codes) { return SourceCode::whole_blocks(codes + TableCode::PADDING); }

uint64_t size_of_middles(const OverlayIndex& index) {
    static_assert(MiddleOffset::PADDING <= sizeof(uint16_t) * TableCode::PADDING);
    return size_of_part((index.hops.inner_begin.back() + 1) / 2);
}

uint64_t hop_code_count(const OverlayIndex& index) {
    return size_of_part(index.hops.border_begin.back()) + size_of_part(index.hops.owned_begin.back()) +
           size_of_part(index.hops.inner_begin.back()) +
           size_of_part(index.numbering.internal_table_begin.back()) + size_of_middles(index);
}

std::span<const uint8_t> bytes_of(std::span<const uint16_t> offsets) {
    return {reinterpret_cast<const uint8_t*>(offsets.data()), offsets.size_bytes()};
}
std::span<uint8_t> bytes_of(std::span<uint16_t> offsets) {
    return {reinterpret_cast<uint8_t*>(offsets.data()), offsets.size_bytes()};
}

template <class Code>
HopParts<Code> parts_of(const OverlayIndex& index, std::span<Code> codes) {
    const auto take = [&](uint64_t count) {
        const auto part = codes.first(size_of_part(count));
        codes = codes.subspan(part.size());
        return part;
    };
    HopParts<Code> parts;
    parts.border = take(index.hops.border_begin.back());
    parts.owned = take(index.hops.owned_begin.back());
    parts.inner = take(index.hops.inner_begin.back());
    parts.internal = take(index.numbering.internal_table_begin.back());
    parts.inner_middles = codes;
    return parts;
}

void view_hop_codes(OverlayIndex& index, std::span<const uint16_t> codes) {
    const auto parts = parts_of(index, codes);
    index.hops.codes = codes;
    index.hops.border = parts.border;
    index.hops.owned = parts.owned;
    index.hops.inner = parts.inner;
    index.hops.internal = parts.internal;
    index.hops.inner_middles = bytes_of(parts.inner_middles);
}

// Marks, of the vertices in the overlay of a patch's parent, those that are on the patch's border.
void mark_border(const Numbering& numbering, uint32_t patch, HopTables& hops) {
    const uint64_t first = hops.on_border_begin[patch];
    for (uint32_t slot = numbering.border_begin[patch]; slot < numbering.border_begin[patch + 1]; ++slot) {
        const uint64_t flag = first + numbering.overlay_position[slot];
        hops.on_border[flag / 8] = static_cast<uint8_t>(hops.on_border[flag / 8] | 1 << flag % 8);
    }
}

void mark_borders(const Numbering& numbering, HopTables& hops) {
    hops.on_border_begin.assign(2, 0); // the whole mesh has no parent
    for (uint32_t p = 1; p < numbering.patch_count(); ++p)
        hops.on_border_begin.push_back(hops.on_border_begin.back() +
                                       numbering.overlay_size(numbering.parent[p]));
    hops.on_border.assign((hops.on_border_begin.back() + 7) / 8, 0);
    for (uint32_t p = 1; p < numbering.patch_count(); ++p) mark_border(numbering, p, hops);
}

void lay_out_hop_tables(OverlayIndex& index) {
    const Numbering& numbering = index.numbering;
    HopTables& hops = index.hops;
    for (auto* begin : {&hops.border_begin, &hops.owned_begin, &hops.inner_begin}) begin->assign(1, 0);
    const auto add_table = [](Array<uint64_t>& begin, uint64_t size) {
        begin.push_back(begin.back() + size);
        require_room_for(begin.back());
    };
    for (uint32_t p = 0; p < numbering.patch_count(); ++p) {
        add_table(hops.inner_begin, uint64_t{numbering.inner_size(p)} * index.rings.size(p));
        if (p >= numbering.first_leaf()) continue;
        add_table(hops.border_begin, index.border_table_size(p));
        add_table(hops.owned_begin, index.owned_table_size(p));
    }
    mark_borders(numbering, hops);
}

// ---- From the stored tables to rows

// Those of parents before those of their children, which have larger numbers.
void write_overlay_tables(const StoredIndex& stored, const OverlayIndex& index,
                          const HopParts<uint16_t>& parts) {
    const uint16_t* codes = stored.overlay_codes.data();
    for (uint32_t p = 0; p < index.numbering.first_leaf(); ++p) {
        write_overlay_table(index, p, codes,
                            {parts.border.data() + index.hops.border_begin[p],
                             parts.owned.data() + index.hops.owned_begin[p],
                             parts.inner.data() + index.hops.inner_begin[p]});
        codes += index.numbering.overlay_entries(p);
    }
}

// Writes the inner table of a leaf. `stored` has a row for each vertex of its border.
void write_leaf_rows(const OverlayIndex& index, uint32_t leaf, const uint16_t* stored, uint16_t* rows) {
    const uint32_t count = index.numbering.internal_size(leaf), places = index.rings.size(leaf);
    const uint16_t* const position = index.rings.position.data() + index.rings.begin[leaf];
    for (uint32_t i = 0; i < count; ++i)
        for (uint32_t k = 0; k < places; ++k) *rows++ = stored[size_t{position[k]} * count + i];
}

void write_leaf_tables(const StoredIndex& stored, const OverlayIndex& index,
                       const HopParts<uint16_t>& parts) {
    const Numbering& numbering = index.numbering;
    for (uint32_t leaf = numbering.first_leaf(); leaf < numbering.patch_count(); ++leaf)
        write_leaf_rows(index, leaf,
                        stored.border_internal_codes.data() + numbering.border_internal_entry(leaf, 0, 0),
                        parts.inner.data() + index.hops.inner_begin[leaf]);
    std::ranges::copy(stored.internal_codes, parts.internal.begin());
}

void make_hop_codes(const StoredIndex& stored, OverlayIndex& index) {
    index.hops.made.resize(hop_code_count(index));
    view_hop_codes(index, index.hops.made);
    const auto parts = parts_of(index, std::span(index.hops.made));
    write_overlay_tables(stored, index, parts);
    write_leaf_tables(stored, index, parts);
    make_middle_tables(index, bytes_of(parts.inner_middles));
}

// Whether no code is over the largest, which is that of no path.
bool are_codes(std::span<const uint16_t> values) {
    unsigned all = 0;
    for (const uint16_t value : values) all |= value;
    return all <= TableCode::UNREACHED;
}

void take_hop_codes(const StoredIndex& stored, OverlayIndex& index) {
    const uint64_t needed = hop_code_count(index);
    if (stored.hop_codes.size() != needed)
        throw Error(GEOIDX_ERROR_CORRUPT,
                    "section HOPS holds " + std::to_string(stored.hop_codes.size()) + " codes, not " +
                        std::to_string(needed),
                    TAG_HOP_CODES);
    if (!are_codes(stored.hop_codes.first(needed - size_of_middles(index))))
        throw Error(GEOIDX_ERROR_CORRUPT, "section HOPS holds what is no code of a distance", TAG_HOP_CODES);
    view_hop_codes(index, stored.hop_codes);
}

}

void prepare_overlay(const StoredIndex& stored, OverlayIndex& index) {
    number_vertices(stored, index.numbering);
    index.quantum.assign(stored.quantum.begin(), stored.quantum.end());
    index.shift.assign(stored.shift.begin(), stored.shift.end());
    lay_out_rings(stored.segments, index.numbering, index.rings);
    choose_large_overlays(index);
    require_proportion(index);
    measure_segments(index);
    measure_middle_strides(index);
    lay_out_hop_tables(index);
    if (stored.description.codec == GEOIDX_CODEC_MAPPED)
        take_hop_codes(stored, index);
    else
        make_hop_codes(stored, index);
    make_inner_bounds(index);
    index.measured.largest_errors = stored.errors_of_measured;
    take_pairs(stored.measured_pairs, index.numbering.vertex_count(), index.measured);
    take_steep_edges(stored.steep_edges, index.numbering.vertex_count(), index.steep);
}

void restore_overlay(const OverlayIndex& index, StoredIndex& stored) {
    const Numbering& numbering = index.numbering;
    restore_numbering(numbering, stored);
    stored.quantum.assign(index.quantum.begin(), index.quantum.end());
    stored.shift.assign(index.shift.begin(), index.shift.end());
    stored.segments = segments_of_rings(index.rings, numbering);
    for (uint32_t p = 0; p < numbering.first_leaf(); ++p) {
        const uint32_t border = numbering.border_size(p), size = numbering.overlay_size(p);
        for (uint32_t i = border; i < size; ++i)
            for (uint32_t j = 0; j < border; ++j) stored.overlay_codes.push_back(index.overlay_code(p, i, j));
        for (uint32_t i = border; i < size; ++i)
            for (uint32_t j = border; j < i; ++j) stored.overlay_codes.push_back(index.overlay_code(p, i, j));
    }
    for (uint32_t leaf = numbering.first_leaf(); leaf < numbering.patch_count(); ++leaf)
        for (uint32_t i = 0; i < numbering.border_size(leaf); ++i)
            for (uint32_t j = 0; j < numbering.internal_size(leaf); ++j)
                stored.border_internal_codes.push_back(index.border_internal_code(leaf, i, j));
    const auto internal = index.hops.internal.first(numbering.internal_table_begin.back());
    stored.internal_codes.assign(internal.begin(), internal.end());
    stored.hop_codes = index.hops.codes;
    stored.errors_of_measured = index.measured.largest_errors;
    stored.measured_pairs = restore_pairs(index.measured);
    stored.steep_edges = restore_pairs(index.steep);
}

}
