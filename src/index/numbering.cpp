#include "src/index/numbering.h"

#include <cmath>
#include <string>
#include <vector>

#include "format/error.h"
#include "src/index/section_tags.h"
#include "src/index/stored.h"

namespace geodesic {

Numbering::Numbering(std::pmr::memory_resource* memory)
    : level_begin(memory), parent(memory), child_begin(memory), positions(memory), owned_begin(memory),
      internal_begin(memory), border_begin(memory), border(memory), owner(memory), leaf_of_block(memory),
      overlay_position(memory), vertex_borders_begin(memory), vertex_borders(memory),
      border_internal_begin(memory), internal_table_begin(memory) {}

namespace {

// ---- From the counts of the file

void number_patches(const StoredIndex& stored, Numbering& numbering) {
    numbering.parent.assign(1, NONE);
    numbering.level_begin.assign({0, 1});
    numbering.child_begin.clear();
    for (uint32_t l = 0; l < stored.level_count; ++l) {
        for (uint32_t p = numbering.level_begin[l]; p < numbering.level_begin[l + 1]; ++p) {
            numbering.child_begin.push_back(numbering.patch_count());
            numbering.parent.insert(numbering.parent.end(), stored.child_count[p], p);
        }
        numbering.level_begin.push_back(numbering.patch_count());
    }
    numbering.child_begin.resize(size_t{numbering.patch_count()} + 1, numbering.patch_count());
}

// begin[i + 1] = begin[i] + counts[i].
void add_up(uint32_t first, const std::vector<uint32_t>& counts, Array<uint32_t>& begin) {
    begin.assign(1, first);
    for (const uint32_t count : counts) begin.push_back(begin.back() + count);
}

void number_borders(const StoredIndex& stored, Numbering& numbering) {
    numbering.position_step = stored.position_step;
    numbering.position_origin = stored.position_origin;
    numbering.positions.assign(stored.positions.begin(), stored.positions.end());
    add_up(0, stored.owned_count, numbering.owned_begin);
    numbering.owned_begin.resize(size_t{numbering.patch_count()} + 1, numbering.owned_begin.back());
    add_up(numbering.owned_begin.back(), stored.internal_count, numbering.internal_begin);
    add_up(0, stored.border_size, numbering.border_begin);
    numbering.border_begin.insert(numbering.border_begin.begin(), 0); // the root has no border
    numbering.border.assign(stored.border.begin(), stored.border.end());
}

// ---- What follows

void derive_owners(Numbering& numbering) {
    numbering.owner.resize(numbering.border_vertex_count());
    for (uint32_t p = 0; p < numbering.patch_count(); ++p)
        for (uint32_t v = numbering.owned_begin[p]; v < numbering.owned_begin[p + 1]; ++v)
            numbering.owner[v] = p;
}

void derive_overlay_positions(Numbering& numbering) {
    numbering.overlay_position.assign(numbering.border.size(), NONE);
    std::vector<uint32_t> position(numbering.border_vertex_count(), NONE); // in the overlay of one parent
    for (uint32_t p = 0; p < numbering.first_leaf(); ++p) {
        const auto outer = numbering.border_of(p);
        for (uint32_t i = 0; i < outer.size(); ++i) position[outer[i]] = i;
        const auto size = static_cast<uint32_t>(outer.size());
        for (uint32_t v = numbering.owned_begin[p]; v < numbering.owned_begin[p + 1]; ++v)
            position[v] = size + v - numbering.owned_begin[p];
        for (uint32_t i = numbering.border_begin[numbering.child_begin[p]];
             i < numbering.border_begin[numbering.child_begin[p + 1]]; ++i) {
            numbering.overlay_position[i] = position[numbering.border[i]];
            if (numbering.overlay_position[i] == NONE)
                throw Error(GEOIDX_ERROR_CORRUPT,
                            "border vertex " + std::to_string(numbering.border[i]) +
                                " is not in the overlay of patch " + std::to_string(p),
                            TAG_BORDERS);
        }
        for (uint32_t v : outer) position[v] = NONE;
        for (uint32_t v = numbering.owned_begin[p]; v < numbering.owned_begin[p + 1]; ++v) position[v] = NONE;
    }
}

// Every overlay position needs a slot on the border of a child.
void require_children_around(const Numbering& numbering) {
    std::vector<uint8_t> has_slot; // per position of one overlay
    for (uint32_t p = 0; p < numbering.first_leaf(); ++p) {
        has_slot.assign(numbering.overlay_size(p), 0);
        for (uint32_t slot = numbering.border_begin[numbering.child_begin[p]];
             slot < numbering.border_begin[numbering.child_begin[p + 1]]; ++slot)
            has_slot[numbering.overlay_position[slot]] = 1;
        const auto without = std::ranges::find(has_slot, 0);
        if (without == has_slot.end()) continue;
        const auto position = static_cast<uint32_t>(without - has_slot.begin());
        throw Error(GEOIDX_ERROR_CORRUPT,
                    "border vertex " + std::to_string(numbering.overlay_number(p, position)) +
                        " is on the border of no child of patch " + std::to_string(p),
                    TAG_BORDERS);
    }
}

void derive_vertex_borders(Numbering& numbering) {
    numbering.vertex_borders_begin.assign(size_t{numbering.border_vertex_count()} + 1, 0);
    for (uint32_t v : numbering.border) ++numbering.vertex_borders_begin[v + 1];
    for (size_t v = 1; v < numbering.vertex_borders_begin.size(); ++v)
        numbering.vertex_borders_begin[v] += numbering.vertex_borders_begin[v - 1];
    numbering.vertex_borders.resize(numbering.border.size());
    std::vector<uint32_t> next(numbering.vertex_borders_begin.begin(),
                               numbering.vertex_borders_begin.end() - 1);
    for (uint32_t p = 0; p < numbering.patch_count(); ++p) {
        const auto border = numbering.border_of(p);
        for (uint32_t i = 0; i < border.size(); ++i) numbering.vertex_borders[next[border[i]]++] = {p, i};
    }
}

void derive_leaves(Numbering& numbering) {
    const uint32_t first = numbering.border_vertex_count(), count = numbering.vertex_count() - first;
    uint32_t leaf = numbering.first_leaf();
    numbering.leaf_of_block.clear();
    for (uint64_t i = 0; i < count; i += Numbering::LEAF_BLOCK) {
        while (numbering.first_internal(leaf) + numbering.internal_size(leaf) <= first + i) ++leaf;
        numbering.leaf_of_block.push_back(leaf);
    }
    numbering.leaf_of_block.push_back(numbering.patch_count() - 1);
}

void lay_out_leaf_tables(Numbering& numbering) {
    numbering.border_internal_begin.assign(1, 0);
    numbering.internal_table_begin.assign(1, 0);
    for (uint32_t leaf = numbering.first_leaf(); leaf < numbering.patch_count(); ++leaf) {
        const uint64_t border = numbering.border_size(leaf), internal = numbering.internal_size(leaf);
        numbering.border_internal_begin.push_back(numbering.border_internal_begin.back() + border * internal);
        numbering.internal_table_begin.push_back(numbering.internal_table_begin.back() +
                                                 triangle_size(internal));
        require_room_for(numbering.border_internal_begin.back());
        require_room_for(numbering.internal_table_begin.back());
    }
}

// The differences between neighbouring elements.
template <class Begin>
std::vector<uint32_t> counts_of(const Begin& begin, size_t count) {
    std::vector<uint32_t> counts(count);
    for (size_t i = 0; i < count; ++i) counts[i] = begin[i + 1] - begin[i];
    return counts;
}

}

void number_vertices(const StoredIndex& stored, Numbering& numbering) {
    number_patches(stored, numbering);
    number_borders(stored, numbering);
    derive_owners(numbering);
    derive_overlay_positions(numbering);
    require_children_around(numbering);
    derive_vertex_borders(numbering);
    derive_leaves(numbering);
    lay_out_leaf_tables(numbering);
}

void restore_numbering(const Numbering& numbering, StoredIndex& stored) {
    const size_t inner = numbering.first_leaf(), leaves = numbering.patch_count() - inner;
    stored.level_count = numbering.level_count();
    stored.child_count = counts_of(numbering.child_begin, inner);
    stored.position_step = numbering.position_step;
    stored.position_origin = numbering.position_origin;
    stored.positions.assign(numbering.positions.begin(), numbering.positions.end());
    stored.owned_count = counts_of(numbering.owned_begin, inner);
    stored.internal_count = counts_of(numbering.internal_begin, leaves);
    stored.border_size = counts_of(std::span(numbering.border_begin).subspan(1), inner + leaves - 1);
    stored.border.assign(numbering.border.begin(), numbering.border.end());
}

void require_room_for(uint64_t entries) {
    constexpr uint64_t MOST = uint64_t{1} << 40;
    if (entries > MOST)
        throw Error(GEOIDX_ERROR_LIMIT, "the tables would have " + std::to_string(entries) + " entries");
}

double straight_distance(const Numbering& numbering, uint32_t a, uint32_t b) {
    double square = 0;
    for (size_t k = 0; k < 3; ++k) {
        const double difference = numbering.positions[a][k] - numbering.positions[b][k];
        square += difference * difference;
    }
    return double{numbering.position_step} * std::sqrt(square);
}

}
