#include "src/graph/prepare.h"

namespace geodesic {

namespace {

void place_border_tables(GraphIndex& index) {
    const Numbering& numbering = index.numbering;
    index.border_table_begin.assign(1, 0);
    for (uint32_t p = 0; p < numbering.patch_count(); ++p) {
        const uint64_t size = numbering.border_size(p);
        index.border_table_begin.push_back(index.border_table_begin.back() + size * size);
        require_room_for(index.border_table_begin.back());
    }
    index.border_tables.resize(index.border_table_begin.back());
}

}

void prepare_graph(const StoredIndex& stored, GraphIndex& index) {
    number_vertices(stored, index.numbering);
    find_slots(index.numbering, index.slots);
    index.bound_scale = stored.description.bound_scale;
    place_border_tables(index);
    const float* entry = stored.border_tables.data();
    for (uint32_t p = 1; p < index.numbering.patch_count(); ++p) {
        const size_t size = index.numbering.border_size(p);
        float* table = index.border_tables.data() + index.border_table_begin[p];
        for (size_t i = 0; i < size; ++i)
            for (size_t j = 0; j < i; ++j) table[i * size + j] = table[j * size + i] = *entry++;
    }
    index.border_internal_tables.assign(stored.border_internal_tables.begin(),
                                        stored.border_internal_tables.end());
    index.internal_tables.assign(stored.internal_tables.begin(), stored.internal_tables.end());
}

void restore_graph(const GraphIndex& index, StoredIndex& stored) {
    restore_numbering(index.numbering, stored);
    for (uint32_t p = 1; p < index.numbering.patch_count(); ++p)
        for (uint32_t i = 0; i < index.numbering.border_size(p); ++i)
            stored.border_tables.insert(stored.border_tables.end(), index.border_row(p, i),
                                        index.border_row(p, i) + i);
    stored.border_internal_tables.assign(index.border_internal_tables.begin(),
                                         index.border_internal_tables.end());
    stored.internal_tables.assign(index.internal_tables.begin(), index.internal_tables.end());
}

}
