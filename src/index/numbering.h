#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <memory_resource>
#include <span>

#include "src/base/array.h"
#include "src/base/numbers.h"

namespace geodesic {

struct StoredIndex;

// The number of entries below the diagonal of a symmetric table with `size` rows, and the index of the entry
// (i, j) among them, i > j.
constexpr uint64_t triangle_size(uint64_t size) { return size < 2 ? 0 : size * (size - 1) / 2; }
constexpr uint64_t below_diagonal(uint64_t i, uint64_t j) { return i * (i - 1) / 2 + j; }

// A position in the border of a patch, or in its overlay, which begins with the border.
struct PatchPosition {
    uint32_t patch;
    uint32_t position;
};

// What both engines derive from the hierarchy, the borders and the counts of vertices: which patch each
// vertex belongs to, and where each leaf's tables begin. Vertices have numbers in this order: first the
// border vertices, grouped by *owner*, the patch on whose children's borders they first appear, then the
// internal vertices, grouped by leaf. Patches are numbered as in Hierarchy.
//
// The overlay of an inner patch P is the union of its children's borders. It consists of the border of P, in
// its order, and then of the vertices that P owns. A position in this list is called an overlay position.
struct Numbering {
    explicit Numbering(std::pmr::memory_resource* memory);
    // A copy would have its arrays in the memory resource that the program has made its default.
    Numbering(const Numbering&) = delete;
    Numbering(Numbering&&) = default;
    Numbering& operator=(Numbering&&) = default;

    // The hierarchy.
    Array<uint32_t> level_begin; // level l has the patches level_begin[l] .. level_begin[l + 1] - 1
    Array<uint32_t> parent;      // per patch; NONE for the root
    Array<uint32_t> child_begin; // p has the children child_begin[p] .. child_begin[p + 1] - 1

    // Vertices.
    float position_step = 1;
    std::array<double, 3> position_origin{};
    Array<std::array<int32_t, 3>> positions; // per number, in steps from the origin
    Array<uint32_t> owned_begin;             // p owns the numbers owned_begin[p] .. owned_begin[p + 1] - 1
    Array<uint32_t> internal_begin; // likewise for the internal vertices of leaf first_leaf() + i; [0] is the
                                    // number of border vertices
    Array<uint32_t> border_begin;   // patch p has border[border_begin[p]] .. border[border_begin[p + 1] - 1]
    Array<uint32_t> border;         // the vertices' numbers
    Array<uint32_t> owner;          // per border vertex
    // Of every LEAF_BLOCK-th internal vertex, the leaf; the last leaf at the end.
    Array<uint32_t> leaf_of_block;
    static constexpr uint32_t LEAF_BLOCK = 16;

    // A *slot* is an index in `border`: it stands for one vertex on the border of one patch.
    Array<uint32_t> overlay_position;     // per slot: position in the overlay of the patch's parent
    Array<uint32_t> vertex_borders_begin; // per border vertex: where its borders begin, by ascending patch
    Array<PatchPosition> vertex_borders;  // the borders that a vertex is on, and where

    // Where the tables of each leaf begin, and at the end, where those of the last one end.
    Array<uint64_t> border_internal_begin, internal_table_begin;

    uint32_t level_count() const { return static_cast<uint32_t>(level_begin.size()) - 2; }
    uint32_t patch_count() const { return static_cast<uint32_t>(parent.size()); }
    uint32_t first_leaf() const { return level_begin[level_count()]; }
    uint32_t vertex_count() const { return static_cast<uint32_t>(positions.size()); }
    uint32_t border_vertex_count() const { return internal_begin[0]; }
    bool is_border(uint32_t number) const { return number < border_vertex_count(); }
    uint32_t leaf_of(uint32_t internal) const {
        const uint32_t* block = leaf_of_block.data() + (internal - border_vertex_count()) / LEAF_BLOCK;
        if (block[0] == block[1]) return block[0];
        const uint32_t* begin = internal_begin.data();
        const uint32_t* next =
            std::upper_bound(begin + block[0] - first_leaf(), begin + block[1] - first_leaf() + 1, internal);
        return first_leaf() + static_cast<uint32_t>(next - begin) - 1;
    }
    bool is_within(uint32_t patch, uint32_t ancestor) const {
        while (patch != NONE && patch > ancestor) patch = parent[patch];
        return patch == ancestor;
    }

    std::span<const uint32_t> border_of(uint32_t patch) const {
        return {border.data() + border_begin[patch], border.data() + border_begin[patch + 1]};
    }
    uint32_t border_size(uint32_t patch) const { return border_begin[patch + 1] - border_begin[patch]; }
    uint32_t internal_size(uint32_t leaf) const {
        return internal_begin[leaf - first_leaf() + 1] - internal_begin[leaf - first_leaf()];
    }
    uint32_t first_internal(uint32_t leaf) const { return internal_begin[leaf - first_leaf()]; }
    uint32_t overlay_size(uint32_t patch) const {
        return border_size(patch) + owned_begin[patch + 1] - owned_begin[patch];
    }
    std::span<const PatchPosition> borders_of(uint32_t border_vertex) const {
        return {vertex_borders.data() + vertex_borders_begin[border_vertex],
                vertex_borders.data() + vertex_borders_begin[border_vertex + 1]};
    }

    // The positions of a patch's border, in its order, in the overlay of the patch's parent.
    std::span<const uint32_t> positions_in_parent(uint32_t patch) const {
        return {overlay_position.data() + border_begin[patch],
                overlay_position.data() + border_begin[patch + 1]};
    }

    // The position of a border vertex in the border of a patch, or NONE if it is not on it. Few borders are
    // quicker to go through.
    uint32_t border_position(uint32_t patch, uint32_t border_vertex) const {
        constexpr size_t FEW = 16;
        auto borders = borders_of(border_vertex);
        if (borders.size() > FEW) {
            const auto at = std::ranges::lower_bound(borders, patch, {}, &PatchPosition::patch);
            borders = borders.subspan(static_cast<size_t>(at - borders.begin()));
            borders = borders.first(std::min<size_t>(borders.size(), 1));
        }
        for (const PatchPosition& at : borders)
            if (at.patch == patch) return at.position;
        return NONE;
    }

    // The number of the vertex at a position in a patch's overlay, and the position of a border vertex in its
    // owner's overlay.
    uint32_t overlay_number(uint32_t patch, uint32_t position) const {
        const uint32_t size = border_size(patch);
        return position < size ? border[border_begin[patch] + position]
                               : owned_begin[patch] + position - size;
    }
    uint32_t position_at_owner(uint32_t border_vertex) const {
        const uint32_t patch = owner[border_vertex];
        return border_size(patch) + border_vertex - owned_begin[patch];
    }

    // The inner vertices of a patch lie one hop inside its border. They are the vertices that the patch owns
    // or, in a leaf, the internal vertices.
    uint32_t inner_size(uint32_t patch) const {
        return patch < first_leaf() ? owned_begin[patch + 1] - owned_begin[patch] : internal_size(patch);
    }
    uint32_t first_inner(uint32_t patch) const {
        return patch < first_leaf() ? owned_begin[patch] : first_internal(patch);
    }
    // The patch that a vertex is an inner vertex of, which is its owner or its leaf.
    uint32_t innermost_patch(uint32_t number) const {
        return is_border(number) ? owner[number] : leaf_of(number);
    }

    // The number of distances that the overlay engine stores for an inner patch: from each vertex that it
    // owns to its border, and among the vertices that it owns.
    uint64_t overlay_entries(uint32_t patch) const {
        return uint64_t{inner_size(patch)} * border_size(patch) + triangle_size(inner_size(patch));
    }

    uint64_t leaf_entries() const { return border_internal_begin.back() + internal_table_begin.back(); }
    // The number of distances that the overlay engine stores for all patches.
    uint64_t overlay_engine_entries() const {
        uint64_t entries = leaf_entries();
        for (uint32_t p = 0; p < first_leaf(); ++p) entries += overlay_entries(p);
        return entries;
    }

    // The index of an entry in the tables of leaves. Internal vertices are given by their positions in the
    // leaf, and i != j.
    uint64_t border_internal_entry(uint32_t leaf, uint32_t border_position, uint32_t internal) const {
        return border_internal_begin[leaf - first_leaf()] + uint64_t{border_position} * internal_size(leaf) +
               internal;
    }
    uint64_t internal_entry(uint32_t leaf, uint32_t i, uint32_t j) const {
        return internal_table_begin[leaf - first_leaf()] +
               (i > j ? below_diagonal(i, j) : below_diagonal(j, i));
    }

    uint32_t largest_border_size() const {
        uint32_t largest = 0;
        for (uint32_t p = 0; p < patch_count(); ++p) largest = std::max(largest, border_size(p));
        return largest;
    }
    uint32_t largest_inner_size() const {
        uint32_t largest = 0;
        for (uint32_t p = 0; p < patch_count(); ++p) largest = std::max(largest, inner_size(p));
        return largest;
    }
    uint32_t largest_overlay_size() const {
        uint32_t largest = 0;
        for (uint32_t p = 0; p < first_leaf(); ++p) largest = std::max(largest, overlay_size(p));
        return largest;
    }
};

// Fills a numbering from HIER, POSI and BORD, in place of what it held. Throws Error CORRUPT where a vertex
// on the border of a patch is not in the overlay of the patch's parent, and where a vertex in the overlay of
// a patch is on the border of none of its children. Throws Error LIMIT where tables would be too large.
void number_vertices(const StoredIndex& stored, Numbering& numbering);

// Does the opposite: fills HIER, POSI and BORD from a numbering.
void restore_numbering(const Numbering& numbering, StoredIndex& stored);

// Throws Error LIMIT if a table with this many entries would be too large.
void require_room_for(uint64_t entries);

// The length of the straight line between two vertices, given by their numbers.
double straight_distance(const Numbering& numbering, uint32_t a, uint32_t b);

}
