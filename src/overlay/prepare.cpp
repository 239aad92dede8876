#include "src/overlay/prepare.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <string>
#include <vector>

#include "format/error.h"
#include "geoidx.h"
#include "src/index/section_tags.h"
#include "src/overlay/middles.h"
#include "src/overlay/proportion.h"

namespace geodesic {

namespace {

void measure_segments(OverlayIndex& index) {
    const Rings& rings = index.rings;
    index.longest_segment.assign(index.numbering.patch_count(), 0.f);
    for (uint32_t p = 0; p < index.numbering.patch_count(); ++p)
        for (uint32_t k = rings.begin[p]; k < rings.begin[p + 1]; ++k)
            index.longest_segment[p] = std::fmax(index.longest_segment[p], rings.segment_length[k]);
}

// The codes of all hop tables, by their kinds. Kernels read past the end of a table, so that there are more
// codes behind each kind, up to a whole block.
template <class Code>
struct HopParts {
    std::span<Code> outer, inner, inner_middles, internal;
};

uint64_t size_of_part(uint64_t codes) { return SourceCode::whole_blocks(codes + TableCode::PADDING); }

uint64_t hop_code_count(const OverlayIndex& index) {
    return size_of_part(index.hops.outer_begin.back()) + 2 * size_of_part(index.hops.inner_begin.back()) +
           size_of_part(index.numbering.internal_table_begin.back());
}

template <class Code>
HopParts<Code> parts_of(const OverlayIndex& index, std::span<Code> codes) {
    const auto take = [&](uint64_t count) {
        const auto part = codes.first(size_of_part(count));
        codes = codes.subspan(part.size());
        return part;
    };
    HopParts<Code> parts;
    parts.outer = take(index.hops.outer_begin.back());
    parts.inner = take(index.hops.inner_begin.back());
    parts.inner_middles = take(index.hops.inner_begin.back());
    parts.internal = take(index.numbering.internal_table_begin.back());
    return parts;
}

void view_hop_codes(OverlayIndex& index, std::span<const uint16_t> codes) {
    const auto parts = parts_of(index, codes);
    index.hops.codes = codes;
    index.hops.outer = parts.outer;
    index.hops.inner = parts.inner;
    index.hops.inner_middles = parts.inner_middles;
    index.hops.internal = parts.internal;
}

void lay_out_hop_tables(OverlayIndex& index) {
    const Numbering& numbering = index.numbering;
    HopTables& hops = index.hops;
    hops.outer_begin.assign(2, 0);
    hops.inner_begin.assign(2, 0);
    for (uint32_t p = 1; p < numbering.patch_count(); ++p) {
        const uint64_t places = index.rings.size(p);
        hops.outer_begin.push_back(hops.outer_begin.back() +
                                   numbering.overlay_size(numbering.parent[p]) * places);
        hops.inner_begin.push_back(hops.inner_begin.back() + numbering.inner_size(p) * places);
        require_room_for(hops.outer_begin.back());
        require_room_for(hops.inner_begin.back());
    }
}

// ---- From the stored tables to rows along rings

// The overlay table of a patch as a square. Entries for two vertices on the patch's border are 0, since the
// file does not store them.
class OverlaySquare {
public:
    OverlaySquare(const Numbering& numbering, uint32_t patch, const uint16_t* stored)
        : size_(numbering.overlay_size(patch)), codes_(size_ * size_, 0) {
        const size_t border = numbering.border_size(patch), owned = numbering.inner_size(patch);
        for (size_t i = 0; i < owned; ++i)
            for (size_t j = 0; j < border; ++j) set(border + i, j, *stored++);
        for (size_t i = 0; i < owned; ++i)
            for (size_t j = 0; j < i; ++j) set(border + i, border + j, *stored++);
    }

    const uint16_t* row(size_t i) const { return codes_.data() + i * size_; }

private:
    void set(size_t i, size_t j, uint16_t code) { codes_[i * size_ + j] = codes_[j * size_ + i] = code; }

    size_t size_;
    std::vector<uint16_t> codes_;
};

// Writes `count` rows along the ring of a patch, end to end: for each place, the entry in the column of its
// vertex. row(i) points to the i-th row of entries, and column[position] is where in it the entry for a
// position in the border is.
template <class Row>
void write_rows(const OverlayIndex& index, uint32_t patch, uint32_t count, std::span<const uint32_t> column,
                const Row& row, uint16_t* out) {
    const uint32_t* position = index.rings.position.data() + index.rings.begin[patch];
    std::vector<uint32_t> column_of_place(index.rings.size(patch));
    for (size_t k = 0; k < column_of_place.size(); ++k) column_of_place[k] = column[position[k]];
    for (uint32_t i = 0; i < count; ++i) {
        const uint16_t* entries = row(i);
        for (const uint32_t k : column_of_place) *out++ = entries[k];
    }
}

void write_outer_table(const OverlayIndex& index, const OverlaySquare& of_parent, uint32_t patch,
                       std::span<uint16_t> outer) {
    const Numbering& numbering = index.numbering;
    const std::span<const uint32_t> overlay_position{
        numbering.overlay_position.data() + numbering.border_begin[patch], numbering.border_size(patch)};
    write_rows(
        index, patch, numbering.overlay_size(numbering.parent[patch]), overlay_position,
        [&](uint32_t i) { return of_parent.row(i); }, outer.data() + index.outer_row(patch, 0));
}

// 0, 1, 2 ...
std::vector<uint32_t> numbers_to(uint32_t end) {
    std::vector<uint32_t> numbers(end);
    std::iota(numbers.begin(), numbers.end(), 0u);
    return numbers;
}

void write_overlay_tables(const StoredIndex& stored, const OverlayIndex& index,
                          const HopParts<uint16_t>& parts) {
    const Numbering& numbering = index.numbering;
    const uint16_t* codes = stored.overlay_codes.data();
    for (uint32_t p = 0; p < numbering.first_leaf(); ++p) {
        const OverlaySquare square(numbering, p, codes);
        codes += numbering.overlay_entries(p);
        for (uint32_t child = numbering.child_begin[p]; child < numbering.child_begin[p + 1]; ++child)
            write_outer_table(index, square, child, parts.outer);
        if (p == 0) continue;
        const uint32_t border = numbering.border_size(p);
        write_rows(
            index, p, numbering.inner_size(p), numbers_to(border),
            [&](uint32_t i) { return square.row(border + i); }, parts.inner.data() + index.inner_row(p, 0));
    }
}

void write_leaf_tables(const StoredIndex& stored, const OverlayIndex& index,
                       const HopParts<uint16_t>& parts) {
    const Numbering& numbering = index.numbering;
    std::vector<uint16_t> rows;
    for (uint32_t leaf = numbering.first_leaf(); leaf < numbering.patch_count(); ++leaf) {
        const uint32_t border = numbering.border_size(leaf), count = numbering.internal_size(leaf);
        const uint16_t* entry =
            stored.border_internal_codes.data() + numbering.border_internal_entry(leaf, 0, 0);
        rows.resize(size_t{count} * border);
        for (uint32_t i = 0; i < border; ++i)
            for (uint32_t j = 0; j < count; ++j) rows[size_t{j} * border + i] = *entry++;
        write_rows(
            index, leaf, count, numbers_to(border),
            [&](uint32_t i) { return rows.data() + size_t{i} * border; },
            parts.inner.data() + index.inner_row(leaf, 0));
    }
    std::ranges::copy(stored.internal_codes, parts.internal.begin());
}

// The distance of two positions on the border of a patch, from the table of its parent, in steps of the
// patch's own quantum.
uint16_t code_by_parent(const OverlayIndex& index, uint32_t patch, uint32_t i, uint32_t j) {
    const Numbering& numbering = index.numbering;
    const uint32_t first_slot = numbering.border_begin[patch];
    const uint64_t row = index.outer_row(patch, numbering.overlay_position[first_slot + i]);
    return TableCode::converted(index.hops.outer[row + index.rings.place_of_slot[first_slot + j]],
                                index.quantum[numbering.parent[patch]], index.quantum[patch]);
}

// The distance of two vertices on a patch's border is stored only in the table of the patch's parent. Parents
// are treated before their children, so that their own tables are complete.
void take_border_codes_from_parents(const OverlayIndex& index, std::span<uint16_t> outer) {
    const Numbering& numbering = index.numbering;
    for (uint32_t child = numbering.child_begin[1]; child < numbering.patch_count(); ++child) {
        const uint32_t patch = numbering.parent[child], border = numbering.border_size(patch);
        const uint32_t* overlay_position = numbering.overlay_position.data() + numbering.border_begin[child];
        const uint32_t* position = index.rings.position.data() + index.rings.begin[child];
        uint16_t* code = outer.data() + index.outer_row(child, 0);
        for (uint32_t i = 0; i < border; ++i)
            for (uint32_t k = 0; k < index.rings.size(child); ++k, ++code)
                if (const uint32_t j = overlay_position[position[k]]; j < border && i != j)
                    *code = code_by_parent(index, patch, std::max(i, j), std::min(i, j));
    }
}

void make_hop_codes(const StoredIndex& stored, OverlayIndex& index) {
    index.hops.made.resize(hop_code_count(index));
    view_hop_codes(index, index.hops.made);
    const auto parts = parts_of(index, std::span(index.hops.made));
    write_overlay_tables(stored, index, parts);
    write_leaf_tables(stored, index, parts);
    take_border_codes_from_parents(index, parts.outer);
    make_middle_tables(index, parts.inner_middles);
}

void take_hop_codes(const StoredIndex& stored, OverlayIndex& index) {
    const uint64_t needed = hop_code_count(index);
    if (stored.hop_codes.size() != needed)
        throw Error(GEOIDX_ERROR_CORRUPT,
                    "section HOPS holds " + std::to_string(stored.hop_codes.size()) + " codes, not " +
                        std::to_string(needed),
                    TAG_HOP_CODES);
    view_hop_codes(index, stored.hop_codes);
}

}

void prepare_overlay(const StoredIndex& stored, OverlayIndex& index) {
    number_vertices(stored, index.numbering);
    index.quantum.assign(stored.quantum.begin(), stored.quantum.end());
    index.shift.assign(stored.shift.begin(), stored.shift.end());
    lay_out_rings(stored.segment_end, stored.segment_length, index.numbering, index.rings);
    require_proportion(index);
    measure_segments(index);
    lay_out_hop_tables(index);
    if (stored.description.codec == GEOIDX_CODEC_MAPPED)
        take_hop_codes(stored, index);
    else
        make_hop_codes(stored, index);
}

void restore_overlay(const OverlayIndex& index, StoredIndex& stored) {
    const Numbering& numbering = index.numbering;
    restore_numbering(numbering, stored);
    stored.quantum.assign(index.quantum.begin(), index.quantum.end());
    stored.shift.assign(index.shift.begin(), index.shift.end());
    BorderSegments segments = segments_of_rings(index.rings, numbering);
    stored.segment_end = std::move(segments.end);
    stored.segment_length = std::move(segments.length);
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
}

}
