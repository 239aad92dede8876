#include "src/index/derived_tables.h"

#include <algorithm>

#include "src/index/coarse_tables.h"
#include "src/index/middle_tables.h"

namespace geodesic {

namespace {

// The distance of two vertices on a patch's border stands in the file once, in the table of the patch's
// parent: parents come first.
void take_over_border_codes(Index& index) {
    OverlayTables& tables = index.overlay_tables;
    for (uint32_t patch = 1; patch < index.first_leaf(); ++patch)
        for (uint32_t child = index.child_begin[patch]; child < index.child_begin[patch + 1]; ++child) {
            const uint32_t* overlay_position = index.overlay_position.data() + index.border_begin[child];
            const uint32_t* ring = tables.rings.position.data() + tables.rings.begin[child];
            uint16_t* code = tables.outer_tables.data() + index.outer_row(child, 0);
            for (uint32_t i = 0; i < index.border_size(patch); ++i)
                for (uint32_t k = 0; k < index.ring_size(child); ++k, ++code)
                    if (const uint32_t j = overlay_position[ring[k]]; j < index.border_size(patch) && i != j)
                        *code = index.border_code(patch, std::max(i, j), std::min(i, j));
        }
}

}

void derive_tables(Index& index) {
    take_over_border_codes(index);
    make_coarse_tables(index);
    make_middle_tables(index);
}

}
