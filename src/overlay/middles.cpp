#include "src/overlay/middles.h"

#include <algorithm>
#include <cmath>

#include "src/overlay/unfolding.h"

namespace geodesic {

namespace {

// Writes the codes of the middles beside one row of an inner table. segment_length is in steps of the
// quantum, NaN where there is a gap.
void add_middles(const uint16_t* row, std::span<const float> segment_length, uint16_t* middles) {
    for (size_t k = 0; k < segment_length.size(); ++k) {
        float square;
        middle_square(static_cast<float>(row[k]), static_cast<float>(row[k + 1]), segment_length[k], square);
        const bool is_reached = std::max(row[k], row[k + 1]) < TableCode::UNREACHED && !std::isnan(square);
        middles[k] = is_reached ? TableCode::of_steps(std::sqrt(square)) : TableCode::UNREACHED;
    }
}

}

void make_middle_tables(const OverlayIndex& index, std::span<uint16_t> middles) {
    std::ranges::fill(middles, TableCode::UNREACHED);
    std::vector<float> length;
    for (uint32_t p = 1; p < index.numbering.patch_count(); ++p) {
        length.assign(index.rings.size(p), 0);
        for (uint32_t k = 0; k < length.size(); ++k)
            length[k] = index.rings.segment_length[index.rings.begin[p] + k] / index.quantum[p];
        for (uint32_t i = 0; i < index.numbering.inner_size(p); ++i)
            add_middles(index.hops.inner.data() + index.inner_row(p, i), length,
                        middles.data() + index.inner_row(p, i));
    }
}

}
