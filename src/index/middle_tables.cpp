#include "src/index/middle_tables.h"

#include <algorithm>
#include <cmath>

#include "src/index/unfolding.h"

namespace geodesic {

namespace {

// segment_length: in steps of the quantum; NaN: a gap.
void add_middles(const uint16_t* row, std::span<const float> segment_length, uint16_t* middles) {
    for (size_t k = 0; k < segment_length.size(); ++k) {
        float square;
        middle_square(static_cast<float>(row[k]), static_cast<float>(row[k + 1]), segment_length[k], square);
        const bool is_reached = std::max(row[k], row[k + 1]) < OverlayTables::UNREACHED && square >= 0;
        middles[k] = is_reached ? static_cast<uint16_t>(std::sqrt(square) + 0.5f) : OverlayTables::UNREACHED;
    }
}

}

void make_middle_tables(Index& index) {
    OverlayTables& tables = index.overlay_tables;
    tables.inner_middles.assign(tables.inner_tables.size(), OverlayTables::UNREACHED);
    std::vector<float> length;
    for (uint32_t p = 1; p < index.patch_count(); ++p) {
        length.assign(index.ring_size(p), 0);
        for (uint32_t k = 0; k < length.size(); ++k)
            length[k] = tables.rings.segment_length[tables.rings.begin[p] + k] / tables.quantum[p];
        for (uint32_t i = 0; i < index.inner_size(p); ++i)
            add_middles(tables.inner_tables.data() + index.inner_row(p, i), length,
                        tables.inner_middles.data() + index.inner_row(p, i));
    }
}

}
