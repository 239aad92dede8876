#include "src/overlay/overlay_crossing.h"

#include <algorithm>

namespace geodesic {

namespace {

// From so many near columns on, those of a block take less time together than one by one.
constexpr size_t MANY_NEAR = 5;

}

OverlayCrossing::OverlayCrossing(const OverlayIndex& index, std::pmr::memory_resource* memory)
    : index_(index), field_(index, memory), of_part_(index.rings, memory), rows_(memory),
      near_row_(SourceCode::whole_blocks(index.rings.largest_size()) + SourceCode::BLOCK,
                TableCode::UNREACHED, memory) {
    rows_.reserve(index.rings.largest_size());
}

std::span<float> OverlayCrossing::begin(uint32_t patch, const BorderPart& part) {
    of_part_.take(part);
    return begin(patch, part, of_part_.segments(), of_part_.is_own());
}

std::span<float> OverlayCrossing::begin(uint32_t patch, const RingSegments& segments) {
    const BorderRange whole = whole_border(index_.rings, patch);
    return begin(patch, BorderPart(whole), segments, index_.rings.is_own.data() + whole.first);
}

std::span<float> OverlayCrossing::begin(uint32_t patch, const BorderPart& part, const RingSegments& segments,
                                        const int8_t* is_own) {
    patch_ = patch;
    parent_ = index_.numbering.parent[patch];
    part_ = part;
    rows_.resize(part.size());
    return field_.begin(part.size(), segments, is_own, index_.quantum[parent_]);
}

void OverlayCrossing::cross_to_ring(Columns places, float* distances, uint16_t* winners) {
    cross([&](uint32_t position) { return index_.row_to_ring(parent_, position); }, places, distances,
          winners);
}

void OverlayCrossing::cross_to_owned(Columns owned, float* distances, uint16_t* winners) {
    cross([&](uint32_t position) { return index_.row_to_owned(parent_, position); }, owned, distances,
          winners);
}

template <class RowAt>
void OverlayCrossing::cross(const RowAt& row_at, Columns columns, float* distances, uint16_t* winners) {
    if (columns.empty()) return;
    const uint16_t** row = rows_.data();
    part_.for_each_place([&](uint32_t place) { *row++ = row_at(index_.position_in_parent(patch_, place)); });
    field_.cross(rows_, columns, distances, winners);
    if (field_.is_near()) cross_near(columns, distances);
}

// Near columns that follow each other lie side by side, mostly, up or down along a border. Where there are
// many of them, they are measured together.
void OverlayCrossing::cross_near(Columns columns, float* distances) {
    const float reach = field_.near_range().reach;
    for (size_t i = 0; i < columns.size();) {
        uint32_t first = columns[i], last = first;
        size_t end = i, near = 0;
        for (; end < columns.size(); ++end) {
            const auto [low, high] = std::minmax({first, last, columns[end]});
            if (high - low >= Kernels::NEAR_COLUMNS) break;
            first = low;
            last = high;
            near += distances[end] <= reach;
        }
        const auto block = columns.subspan(i, end - i);
        if (near >= MANY_NEAR)
            cross_near_block(block, first, distances + i);
        else if (near > 0)
            for (size_t j = 0; j < block.size(); ++j)
                if (distances[i + j] <= reach) cross_near_row(block[j], distances[i + j]);
        i = end;
    }
}

void OverlayCrossing::cross_near_block(Columns columns, size_t first, float* distances) const {
    float ways[Kernels::NEAR_COLUMNS];
    field_.cross_near_columns(rows_, first, ways);
    for (size_t i = 0; i < columns.size(); ++i)
        if (const float way = ways[columns[i] - first];
            distances[i] <= field_.near_range().reach && way < INFINITE)
            distances[i] = way;
}

void OverlayCrossing::cross_near_row(uint32_t column, float& distance) {
    const NearRange& range = field_.near_range();
    const size_t end = std::min(range.end(rows_.size()) + 1, rows_.size());
    for (size_t k = range.begin(); k < end; ++k) near_row_[k] = rows_[k][column];
    const uint16_t* const row = near_row_.data();
    field_.cross_near({&row, 1}, &distance);
}

}
