#include "src/overlay/prepare.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <string>
#include <vector>

#include "format/error.h"
#include "geoidx.h"
#include "src/index/section_tags.h"
#include "src/overlay/bounds.h"
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
    std::span<Code> outer, kept, inner, inner_middles, internal;
};

uint64_t size_of_part(uint64_t codes) { return SourceCode::whole_blocks(codes + TableCode::PADDING); }

uint64_t hop_code_count(const OverlayIndex& index) {
    return size_of_part(index.hops.outer_begin.back()) + size_of_part(index.hops.kept_begin.back()) +
           2 * size_of_part(index.hops.inner_begin.back()) +
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
    parts.kept = take(index.hops.kept_begin.back());
    parts.inner = take(index.hops.inner_begin.back());
    parts.inner_middles = take(index.hops.inner_begin.back());
    parts.internal = take(index.numbering.internal_table_begin.back());
    return parts;
}

void view_hop_codes(OverlayIndex& index, std::span<const uint16_t> codes) {
    const auto parts = parts_of(index, codes);
    index.hops.codes = codes;
    index.hops.outer = parts.outer;
    index.hops.kept = parts.kept;
    index.hops.inner = parts.inner;
    index.hops.inner_middles = parts.inner_middles;
    index.hops.internal = parts.internal;
}

// Finds the rows that a patch's outer table leaves out. Returns how many others there are.
uint32_t number_outer_rows(const Numbering& numbering, uint32_t patch, HopTables& hops) {
    if (numbering.border_size(patch) == 0) {
        hops.row_begin.push_back(hops.own_before.size());
        return 0;
    }
    const uint32_t size = numbering.overlay_size(numbering.parent[patch]);
    const auto first = hops.own_before.insert(hops.own_before.end(), size, 0);
    for (uint32_t slot = numbering.border_begin[patch]; slot < numbering.border_begin[patch + 1]; ++slot)
        first[numbering.overlay_position[slot]] = HopTables::OWN;
    uint16_t own = 0;
    for (uint32_t i = 0; i < size; ++i)
        if (first[i] == HopTables::OWN)
            ++own;
        else
            first[i] = own;
    hops.row_begin.push_back(hops.own_before.size());
    return size - own;
}

// Numbers the vertices that each patch keeps. Returns how many there are, per patch.
std::vector<uint16_t> number_kept_vertices(const Numbering& numbering, HopTables& hops) {
    std::vector<uint16_t> count(numbering.patch_count(), 0);
    hops.kept_number.assign(numbering.border.size(), 0);
    for_each_kept(numbering,
                  [&](uint32_t slot) { hops.kept_number[slot] = count[numbering.patch_of_slot[slot]]++; });
    return count;
}

void lay_out_hop_tables(OverlayIndex& index) {
    const Numbering& numbering = index.numbering;
    HopTables& hops = index.hops;
    const auto kept = number_kept_vertices(numbering, hops);
    for (auto* begin : {&hops.outer_begin, &hops.kept_begin, &hops.inner_begin, &hops.row_begin})
        begin->assign(2, 0);
    const auto add_table = [](Array<uint64_t>& begin, uint64_t codes) {
        begin.push_back(begin.back() + codes);
        require_room_for(begin.back());
    };
    uint64_t rows = 0;
    for (uint32_t p = 1; p < numbering.patch_count(); ++p)
        if (numbering.border_size(p) > 0) rows += numbering.overlay_size(numbering.parent[p]);
    hops.own_before.reserve(rows);
    for (uint32_t p = 1; p < numbering.patch_count(); ++p) {
        const uint64_t places = index.rings.size(p);
        add_table(hops.outer_begin, number_outer_rows(numbering, p, hops) * places);
        add_table(hops.kept_begin, triangle_size(kept[p]));
        add_table(hops.inner_begin, numbering.inner_size(p) * places);
    }
}

// ---- From the stored tables to rows along rings

// The overlay table of a patch as a square.
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

    // The distances of vertices on the patch's border are stored in the table of its parent only.
    void take_border_from(const OverlayIndex& index, uint32_t patch, const OverlaySquare& of_parent) {
        const Numbering& numbering = index.numbering;
        const float from = index.quantum[numbering.parent[patch]], to = index.quantum[patch];
        const uint32_t* position = numbering.overlay_position.data() + numbering.border_begin[patch];
        for (size_t i = 0; i < numbering.border_size(patch); ++i)
            for (size_t j = 0; j < i; ++j)
                set(i, j, TableCode::converted(of_parent.row(position[i])[position[j]], from, to));
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
    const uint32_t border = numbering.border_size(patch),
                   size = border > 0 ? numbering.overlay_size(numbering.parent[patch]) : 0;
    std::vector<uint32_t> outside;
    for (uint32_t i = 0; i < size; ++i)
        if (index.outer_row(patch, i)) outside.push_back(i);
    write_rows(
        index, patch, static_cast<uint32_t>(outside.size()),
        {numbering.overlay_position.data() + numbering.border_begin[patch], border},
        [&](uint32_t i) { return of_parent.row(outside[i]); }, outer.data() + index.hops.outer_begin[patch]);
}

// All vertices that a patch keeps are on its border.
void write_kept_table(const OverlayIndex& index, const OverlaySquare& of_parent, uint32_t patch,
                      std::span<uint16_t> kept) {
    const Numbering& numbering = index.numbering;
    std::vector<uint32_t> vertices; // in the order of the overlay, which is that of their numbers
    for (uint32_t slot = numbering.border_begin[patch]; slot < numbering.border_begin[patch + 1]; ++slot) {
        const uint32_t position = numbering.overlay_position[slot];
        if (kept_slot(numbering, numbering.parent[patch], position) == slot) vertices.push_back(position);
    }
    std::ranges::sort(vertices);
    uint16_t* code = kept.data() + index.hops.kept_begin[patch];
    for (size_t i = 0; i < vertices.size(); ++i)
        for (size_t j = 0; j < i; ++j) *code++ = of_parent.row(vertices[i])[vertices[j]];
}

// 0, 1, 2 ...
std::vector<uint32_t> numbers_to(uint32_t end) {
    std::vector<uint32_t> numbers(end);
    std::iota(numbers.begin(), numbers.end(), 0u);
    return numbers;
}

// Writes the tables that are made from overlay tables, those of parents before those of their children.
class OverlayTableWriter {
public:
    OverlayTableWriter(const StoredIndex& stored, const OverlayIndex& index, const HopParts<uint16_t>& parts)
        : index_(index), numbering_(index.numbering), parts_(parts) {
        const uint16_t* codes = stored.overlay_codes.data();
        for (uint32_t p = 0; p < numbering_.first_leaf(); ++p) {
            codes_.push_back(codes);
            codes += numbering_.overlay_entries(p);
        }
    }

    void write(uint32_t patch, const OverlaySquare* of_parent) const {
        OverlaySquare square(numbering_, patch, codes_[patch]);
        if (of_parent) {
            square.take_border_from(index_, patch, *of_parent);
            const uint32_t border = numbering_.border_size(patch);
            write_rows(
                index_, patch, numbering_.inner_size(patch), numbers_to(border),
                [&](uint32_t i) { return square.row(border + i); },
                parts_.inner.data() + index_.inner_row(patch, 0));
        }
        for (uint32_t child = numbering_.child_begin[patch]; child < numbering_.child_begin[patch + 1];
             ++child) {
            write_outer_table(index_, square, child, parts_.outer);
            write_kept_table(index_, square, child, parts_.kept);
            if (child < numbering_.first_leaf()) write(child, &square);
        }
    }

private:
    const OverlayIndex& index_;
    const Numbering& numbering_;
    const HopParts<uint16_t>& parts_;
    std::vector<const uint16_t*> codes_; // per inner patch: those of its overlay table
};

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

void make_hop_codes(const StoredIndex& stored, OverlayIndex& index) {
    index.hops.made.resize(hop_code_count(index));
    view_hop_codes(index, index.hops.made);
    const auto parts = parts_of(index, std::span(index.hops.made));
    OverlayTableWriter(stored, index, parts).write(0, nullptr);
    write_leaf_tables(stored, index, parts);
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
    make_inner_bounds(index);
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
