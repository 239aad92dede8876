#pragma once

#include <cstddef>
#include <memory_resource>

#include "src/overlay/border_field.h"

namespace geodesic {

// Scratch for crossing one border. Both ends use the same one, in turn, and nothing stays in it.
struct BorderCrossing {
    BorderCrossing(const OverlayIndex& index, std::pmr::memory_resource* memory)
        : field(index, memory), rows(memory) {
        rows.reserve(index.rings.largest_size());
    }

    BorderField field;
    Array<const uint16_t*> rows;
};

// Returns a row of the coarse table of a patch: one code for each place of the patch's coarse ring. `row`
// counts the samples of the parent's border and then those of the borders of all its children, in the order
// of their numbers; those of a patch begin at Samples::first_row. Where the ring has all vertices of the
// border, the row lies in the outer table.
inline const uint16_t* coarse_row(const OverlayIndex& index, uint32_t patch, uint32_t row) {
    const Samples& samples = index.pairs.samples;
    const uint32_t places = samples.rings.size(patch);
    if (places < index.rings.size(patch))
        return samples.tables.data() + samples.table_begin[patch] + size_t{row} * places;
    const uint32_t first = samples.row_begin[index.numbering.parent[patch]];
    return index.hops.outer.data() + index.outer_row(patch, samples.row_position[first + row]);
}

// Asks the processor to load memory that is going to be read soon.
template <class T>
void prefetch(const T* first, size_t count) {
    constexpr size_t LINE = 64;
    const char* end = reinterpret_cast<const char*>(first + count);
    for (const char* at = reinterpret_cast<const char*>(first); at < end; at += LINE) __builtin_prefetch(at);
}

}
