#include "src/overlay/sssd/few_crossing.h"

#include "src/base/prefetch.h"
#include "src/overlay/kernels/nearest_places.h"

namespace geodesic {

void FewCrossing::begin(uint32_t patch, const BorderPart& part, const float* distances) {
    patch_ = patch;
    parent_ = index_.numbering.parent[patch];
    part_ = &part;
    of_part_.take(part);
    const RingSegments segments = of_part_.segments();
    few_ = {part.size(),           distances,         segments.length,
            segments.half_inverse, of_part_.is_own(), index_.quantum[parent_]};
}

void FewCrossing::cross_to_ring(Columns places, float* distances, uint16_t* winners) const {
    cross([&](uint32_t position) { return index_.row_to_ring(parent_, position); }, places, distances,
          winners);
}

void FewCrossing::cross_to_owned(Columns owned, float* distances, uint16_t* winners) const {
    cross([&](uint32_t position) { return index_.row_to_owned(parent_, position); }, owned, distances,
          winners);
}

template <class RowAt>
void FewCrossing::cross(const RowAt& row_at, Columns columns, float* distances, uint16_t* winners) const {
    if (columns.empty()) return;
    const uint16_t* rows[FewPlaces::MOST];
    const uint16_t** row = rows;
    part_->for_each_place([&](uint32_t place) { *row++ = row_at(index_.position_in_parent(patch_, place)); });
    float ways[Kernels::FEW_COLUMNS];
    uint16_t over[Kernels::FEW_COLUMNS];
    while (!columns.empty()) {
        const auto [few, first, last] = first_block(columns, Kernels::FEW_COLUMNS);
        for (const uint16_t* const* r = rows; r < row; ++r) prefetch(*r + first, last + 1 - first);
        runnable_kernels().back().cross_few(few_, {rows, part_->size()}, first, last + 1 - first, ways, over);
        for (const uint32_t column : few) {
            *distances++ = ways[column - first];
            *winners++ = over[column - first];
        }
        columns = columns.subspan(few.size());
    }
}

}
