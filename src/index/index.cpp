#include "src/index/index.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "format/error.h"
#include "src/index/proportion.h"

namespace geodesic {

Index::Index(std::pmr::memory_resource* memory)
    : level_begin(memory), parent(memory), child_begin(memory), number_of_id(memory), positions(memory),
      owned_begin(memory), internal_begin(memory), border_begin(memory), border(memory),
      border_table_begin(memory), crossing_table_begin(memory), internal_table_begin(memory),
      border_tables(memory), crossing_tables(memory), internal_tables(memory), overlay_tables(memory),
      overlay_position(memory), patch_of_slot(memory), overlay_begin(memory), slot_begin(memory),
      slots(memory), place_begin(memory), places(memory), leaf_of_internal(memory), owner(memory) {}

namespace {

void require_room(uint64_t entries) {
    constexpr uint64_t MOST = uint64_t{1} << 40;
    if (entries > MOST)
        throw Error(GEOIDX_ERROR_LIMIT, "the tables would have " + std::to_string(entries) + " entries");
}

}

void allocate_overlay_tables(Index& index) {
    require_proportion(index);
    OverlayTables& tables = index.overlay_tables;
    tables.outer_begin.assign(2, 0);
    tables.inner_begin.assign(2, 0);
    for (uint32_t p = 1; p < index.patch_count(); ++p) {
        const uint64_t places = index.ring_size(p);
        tables.outer_begin.push_back(tables.outer_begin.back() +
                                     index.overlay_size(index.parent[p]) * places);
        tables.inner_begin.push_back(tables.inner_begin.back() + index.inner_size(p) * places);
        require_room(tables.outer_begin.back());
        require_room(tables.inner_begin.back());
    }
    tables.outer_tables.resize(tables.outer_begin.back() + OverlayTables::PADDING);
    tables.inner_tables.resize(tables.inner_begin.back() + OverlayTables::PADDING);
    tables.internal_tables.resize(index.internal_table_begin.back());
}

void allocate_tables(Index& index) {
    index.border_table_begin.assign(1, 0);
    for (uint32_t p = 0; p < index.patch_count(); ++p) {
        const uint64_t size = index.border_size(p);
        index.border_table_begin.push_back(index.border_table_begin.back() + size * size);
    }
    index.crossing_table_begin.assign(1, 0);
    index.internal_table_begin.assign(1, 0);
    for (uint32_t leaf = index.first_leaf(); leaf < index.patch_count(); ++leaf) {
        const uint64_t border = index.border_size(leaf), internal = index.internal_size(leaf);
        index.crossing_table_begin.push_back(index.crossing_table_begin.back() + border * internal);
        index.internal_table_begin.push_back(index.internal_table_begin.back() +
                                             (internal ? internal * (internal - 1) / 2 : 0));
    }
    for (uint64_t entries : {index.border_table_begin.back(), index.crossing_table_begin.back(),
                             index.internal_table_begin.back()})
        require_room(entries);
    if (index.engine == GEOIDX_ENGINE_OVERLAY) return;
    index.border_tables.resize(index.border_table_begin.back());
    index.crossing_tables.resize(index.crossing_table_begin.back());
    index.internal_tables.resize(index.internal_table_begin.back());
}

uint16_t Index::border_code(uint32_t patch, uint32_t i, uint32_t j) const {
    const uint32_t slot = border_begin[patch] + j;
    const uint16_t code =
        overlay_tables.outer_tables[outer_row(patch, overlay_position[border_begin[patch] + i]) +
                                    overlay_tables.place_of_slot[slot]];
    const double quantum = double{overlay_tables.quantum[patch]};
    if (code == 0 || code == OverlayTables::UNREACHED || !(quantum > 0)) return code;
    const double steps = std::round(code * double{overlay_tables.quantum[parent[patch]]} / quantum);
    return static_cast<uint16_t>(std::clamp(steps, 1.0, double{OverlayTables::LARGEST}));
}

namespace {

void derive_owners(Index& index) {
    index.owner.resize(index.border_vertex_count());
    for (uint32_t p = 0; p < index.patch_count(); ++p)
        for (uint32_t v = index.owned_begin[p]; v < index.owned_begin[p + 1]; ++v) index.owner[v] = p;
}

void derive_overlay_positions(Index& index) {
    index.overlay_position.assign(index.border.size(), NONE);
    std::vector<uint32_t> position(index.border_vertex_count(), NONE); // in the overlay of one parent
    for (uint32_t p = 0; p < index.first_leaf(); ++p) {
        const auto outer = index.border_of(p);
        for (uint32_t i = 0; i < outer.size(); ++i) position[outer[i]] = i;
        const auto size = static_cast<uint32_t>(outer.size());
        for (uint32_t v = index.owned_begin[p]; v < index.owned_begin[p + 1]; ++v)
            position[v] = size + v - index.owned_begin[p];
        for (uint32_t i = index.border_begin[index.child_begin[p]];
             i < index.border_begin[index.child_begin[p + 1]]; ++i) {
            index.overlay_position[i] = position[index.border[i]];
            if (index.overlay_position[i] == NONE)
                throw Error(GEOIDX_ERROR_CORRUPT, "border vertex " + std::to_string(index.border[i]) +
                                                      " is not in the overlay of patch " + std::to_string(p));
        }
        for (uint32_t v : outer) position[v] = NONE;
        for (uint32_t v = index.owned_begin[p]; v < index.owned_begin[p + 1]; ++v) position[v] = NONE;
    }
}

// Every place in an overlay needs one on a child's border, so that there are no more of these than fit 32
// bits.
void require_children_around(const Index& index) {
    uint64_t places = 0;
    for (uint32_t p = 0; p < index.first_leaf(); ++p) places += index.overlay_size(p);
    if (places > index.border.size())
        throw Error(GEOIDX_ERROR_CORRUPT, "the overlays have " + std::to_string(places) +
                                              " places, but the borders of children only " +
                                              std::to_string(index.border.size()));
}

void derive_slots(Index& index) {
    index.patch_of_slot.resize(index.border.size());
    for (uint32_t p = 0; p < index.patch_count(); ++p)
        std::fill(index.patch_of_slot.begin() + index.border_begin[p],
                  index.patch_of_slot.begin() + index.border_begin[p + 1], p);
    require_children_around(index);
    index.overlay_begin.assign(1, 0);
    for (uint32_t p = 0; p < index.first_leaf(); ++p)
        index.overlay_begin.push_back(index.overlay_begin.back() + index.overlay_size(p));
    const auto overlay_of = [&](size_t slot) {
        return index.overlay_begin[index.parent[index.patch_of_slot[slot]]] + index.overlay_position[slot];
    };
    index.slot_begin.assign(size_t{index.overlay_begin.back()} + 1, 0);
    for (size_t slot = 0; slot < index.border.size(); ++slot) ++index.slot_begin[overlay_of(slot) + 1];
    for (size_t i = 1; i < index.slot_begin.size(); ++i) index.slot_begin[i] += index.slot_begin[i - 1];
    index.slots.resize(index.border.size());
    std::vector<uint32_t> next(index.slot_begin.begin(), index.slot_begin.end() - 1);
    for (uint32_t slot = 0; slot < index.border.size(); ++slot) index.slots[next[overlay_of(slot)]++] = slot;
    for (uint32_t p = 0; p < index.first_leaf(); ++p)
        for (uint32_t i = 0; i < index.overlay_size(p); ++i)
            if (index.slots_of(p, i).empty())
                throw Error(GEOIDX_ERROR_CORRUPT,
                            "border vertex " + std::to_string(index.overlay_number(p, i)) +
                                " is on the border of no child of patch " + std::to_string(p));
}

void derive_places(Index& index) {
    index.place_begin.assign(size_t{index.border_vertex_count()} + 1, 0);
    for (uint32_t v : index.border) ++index.place_begin[v + 1];
    for (size_t v = 1; v < index.place_begin.size(); ++v) index.place_begin[v] += index.place_begin[v - 1];
    index.places.resize(index.border.size());
    std::vector<uint32_t> next(index.place_begin.begin(), index.place_begin.end() - 1);
    for (uint32_t p = 0; p < index.patch_count(); ++p) {
        const auto border = index.border_of(p);
        for (uint32_t i = 0; i < border.size(); ++i) index.places[next[border[i]]++] = {p, i};
    }
}

}

void derive(Index& index) {
    derive_owners(index);
    derive_overlay_positions(index);
    derive_slots(index);
    derive_places(index);
    index.leaf_of_internal.resize(index.vertex_count() - index.border_vertex_count());
    for (uint32_t leaf = index.first_leaf(); leaf < index.patch_count(); ++leaf)
        for (uint32_t i = 0; i < index.internal_size(leaf); ++i)
            index.leaf_of_internal[index.first_internal(leaf) - index.border_vertex_count() + i] = leaf;
}

double straight_distance(const Index& index, uint32_t a, uint32_t b) {
    double square = 0;
    for (size_t k = 0; k < 3; ++k) {
        const double difference = double{index.positions[a][k]} - double{index.positions[b][k]};
        square += difference * difference;
    }
    return std::sqrt(square);
}

}
