#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <memory_resource>
#include <span>
#include <vector>

#include "geoidx.h"
#include "src/index/overlay_tables.h"
#include "src/mesh/mesh.h"

namespace geodesic {

template <class T>
using Array = std::pmr::vector<T>;

// Accuracy against the metric, relative, over all targets of some random sources.
struct MeasuredError {
    uint32_t sources = 0;
    double mean = 0, signed_mean = 0, p99 = 0, p999 = 0, max = 0;
    double mean_at_vertices = 0; // where paths cross borders at vertices only
};

// A border vertex's place in a patch's border.
struct BorderPlace {
    uint32_t patch;
    uint32_t position;
};

// Everything that queries read. Vertices are numbered anew: first the border vertices, grouped by their
// *owner*, the patch on whose children's borders they first appear, then the internal vertices, grouped by
// leaf and sorted by distance to its border. Patches are numbered as in Hierarchy.
//
// The overlay of an inner patch P is the union of its children's borders: the border of P itself, in its
// order, then the vertices that P owns. Positions in it are called overlay positions.
struct Index {
    explicit Index(std::pmr::memory_resource* memory);

    // What the mesh and the options were.
    uint64_t id_count = 0, triangle_count = 0, mesh_fingerprint = 0, seed = 0;
    uint32_t metric = 0;
    uint32_t engine = GEOIDX_ENGINE_GRAPH; // GEOIDX_ENGINE_*: which tables there are
    uint32_t metric_flags = 0;             // GEOIDX_METRIC_*
    uint64_t metric_fingerprint = 0;       // of what decides the metric besides the mesh; 0: nothing
    double delta = 0, bounding_box_diagonal = 0;
    MeasuredError error;
    // distance(a, b) >= bound_scale * |a - b|: what keeps A* admissible under any metric.
    float bound_scale = 0;

    // The hierarchy.
    Array<uint32_t> level_begin, parent, child_begin;

    // Vertices.
    Array<uint32_t> number_of_id;          // per caller's id; NONE: unreachable
    Array<std::array<float, 3>> positions; // per number
    Array<uint32_t> owned_begin;    // numbers owned by patch p: owned_begin[p] .. owned_begin[p + 1] - 1
    Array<uint32_t> internal_begin; // internal vertices of leaf first_leaf() + i: likewise; [0] is the
                                    // number of border vertices
    Array<uint32_t> border_begin;   // the border of patch p: border[border_begin[p]] ..
    Array<uint32_t> border;         // numbers, sorted along the border ring

    // Where tables begin, of either engine.
    Array<uint64_t> border_table_begin;   // per patch: Bv x Bv, full, rows and columns in border order
    Array<uint64_t> crossing_table_begin; // per leaf: Bv x Iv, a row per border vertex
    Array<uint64_t> internal_table_begin; // per leaf: Iv x Iv below the diagonal, row by row
    Array<float> border_tables, crossing_tables, internal_tables; // of the graph engine
    OverlayTables overlay_tables;                                 // of the overlay engine

    // Derived from the above by derive().
    // A slot is an index in `border`: a place of a vertex in one patch's border.
    Array<uint32_t> overlay_position; // per slot: position in the overlay of the patch's parent
    Array<uint32_t> patch_of_slot;
    Array<uint32_t> overlay_begin; // per inner patch: where its overlay positions begin in slot_begin
    Array<uint32_t>
        slot_begin; // slots of overlay position i of patch p: from slot_begin[overlay_begin[p] + i]
    Array<uint32_t> slots;
    Array<uint32_t> place_begin; // per border vertex: its places, in ascending order of patches
    Array<BorderPlace> places;
    Array<uint32_t> leaf_of_internal; // [number - border_vertex_count()]
    Array<uint32_t> owner;            // per border vertex

    uint32_t level_count() const { return static_cast<uint32_t>(level_begin.size()) - 2; }
    uint32_t patch_count() const { return static_cast<uint32_t>(parent.size()); }
    uint32_t first_leaf() const { return level_begin[level_count()]; }
    uint32_t vertex_count() const { return static_cast<uint32_t>(positions.size()); }
    uint32_t border_vertex_count() const { return internal_begin[0]; }
    bool is_border(uint32_t number) const { return number < border_vertex_count(); }
    uint32_t leaf_of(uint32_t internal) const { return leaf_of_internal[internal - border_vertex_count()]; }

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
    std::span<const uint32_t> slots_of(uint32_t patch, uint32_t overlay_position) const {
        const uint32_t* begin = slot_begin.data() + overlay_begin[patch] + overlay_position;
        return {slots.data() + begin[0], slots.data() + begin[1]};
    }
    std::span<const BorderPlace> places_of(uint32_t border_vertex) const {
        return {places.data() + place_begin[border_vertex], places.data() + place_begin[border_vertex + 1]};
    }

    // The vertex at a position in a patch's overlay, and the position of a border vertex in that of its
    // owner.
    uint32_t overlay_number(uint32_t patch, uint32_t position) const {
        const uint32_t size = border_size(patch);
        return position < size ? border[border_begin[patch] + position]
                               : owned_begin[patch] + position - size;
    }
    uint32_t position_at_owner(uint32_t border_vertex) const {
        const uint32_t patch = owner[border_vertex];
        return border_size(patch) + border_vertex - owned_begin[patch];
    }

    // Of the overlay engine.
    uint32_t ring_size(uint32_t patch) const { return overlay_tables.rings.size(patch); }
    // What lies inside of a patch one hop from its border: what it owns, or the internal vertices of a leaf.
    uint32_t inner_size(uint32_t patch) const {
        return patch < first_leaf() ? owned_begin[patch + 1] - owned_begin[patch] : internal_size(patch);
    }
    uint32_t first_inner(uint32_t patch) const {
        return patch < first_leaf() ? owned_begin[patch] : first_internal(patch);
    }
    // Distances that are stored of an inner patch: from what it owns to its border, and among what it owns.
    uint64_t overlay_entries(uint32_t patch) const {
        const uint64_t owned = inner_size(patch);
        return owned * border_size(patch) + (owned ? owned * (owned - 1) / 2 : 0);
    }
    // Distances in a label to the border of a patch.
    uint32_t label_size(uint32_t patch) const {
        const uint32_t size = border_size(patch);
        return size <= OverlayTables::LABELLED_WHOLE
                   ? size
                   : static_cast<uint32_t>(overlay_tables.samples_of(patch).size());
    }
    bool is_labelled_whole(uint32_t patch) const { return label_size(patch) == border_size(patch); }
    bool is_within(uint32_t patch, uint32_t ancestor) const {
        while (patch != NONE && patch > ancestor) patch = parent[patch];
        return patch == ancestor;
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
    // The patch that a vertex lies inside of so: its owner or its leaf.
    uint32_t entry(uint32_t number) const { return is_border(number) ? owner[number] : leaf_of(number); }

    // Where a row begins in the outer table of a patch: of a position in its parent's overlay; and in the
    // inner one.
    uint64_t outer_row(uint32_t patch, uint32_t overlay_position) const {
        return overlay_tables.outer_begin[patch] + uint64_t{overlay_position} * ring_size(patch);
    }
    uint64_t inner_row(uint32_t patch, uint32_t inner) const {
        return overlay_tables.inner_begin[patch] + uint64_t{inner} * ring_size(patch);
    }
    // An entry of the overlay table of an inner patch.
    uint16_t overlay_code(uint32_t patch, uint32_t i, uint32_t j) const {
        const uint32_t slot = slots_of(patch, j).front();
        return overlay_tables
            .outer_tables[outer_row(patch_of_slot[slot], i) + overlay_tables.place_of_slot[slot]];
    }
    // The same entry for two border positions of a patch, by the table of its parent, which knows it, too, so
    // that it is stored once.
    uint16_t border_code(uint32_t patch, uint32_t i, uint32_t j) const;
    uint16_t crossing_code(uint32_t leaf, uint32_t border_position, uint32_t internal) const {
        return overlay_tables
            .inner_tables[inner_row(leaf, internal) +
                          overlay_tables.place_of_slot[border_begin[leaf] + border_position]];
    }

    const float* border_row(uint32_t patch, uint32_t position) const {
        return border_tables.data() + border_table_begin[patch] + uint64_t{position} * border_size(patch);
    }
    // Places of entries in the crossing and internal tables of a leaf; internal vertices by position in it,
    // i != j.
    uint64_t crossing_place(uint32_t leaf, uint32_t border_position, uint32_t internal) const {
        return crossing_table_begin[leaf - first_leaf()] + uint64_t{border_position} * internal_size(leaf) +
               internal;
    }
    uint64_t internal_place(uint32_t leaf, uint32_t i, uint32_t j) const {
        return internal_table_begin[leaf - first_leaf()] +
               (i > j ? below_diagonal(i, j) : below_diagonal(j, i));
    }
    const float* crossing_row(uint32_t leaf, uint32_t position) const {
        return crossing_tables.data() + crossing_place(leaf, position, 0);
    }
    // Place of the pair i > j in a table below the diagonal.
    static uint64_t below_diagonal(uint64_t i, uint64_t j) { return i * (i - 1) / 2 + j; }
    // Distance of two internal vertices of a leaf, given by their positions in it.
    float internal_distance(uint32_t leaf, uint32_t i, uint32_t j) const {
        return i == j ? 0 : internal_tables[internal_place(leaf, i, j)];
    }
};

// Sizes of tables follow from the numbers of vertices: fills the *_table_begin and sizes the tables of the
// graph engine. Throws Error LIMIT when they would not fit.
void allocate_tables(Index& index);

// Likewise those of the overlay engine, when the rings are laid out and allocate_tables() was called. Throws
// Error LIMIT where they, or the labels, would be out of proportion to what the file holds.
void allocate_overlay_tables(Index& index);

// Fills what is derived; throws Error CORRUPT where a border vertex is on the border of a patch but not in
// its parent's overlay, or in the overlay of a patch, but on no border of its children.
void derive(Index& index);

// The length of the straight line between two vertices, given by their numbers.
double straight_distance(const Index& index, uint32_t a, uint32_t b);

}
