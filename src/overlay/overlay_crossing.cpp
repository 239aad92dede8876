#include "src/overlay/overlay_crossing.h"

#include <algorithm>
#include <numeric>

namespace geodesic {

namespace {

// Where the columns that are wanted lie so far apart that the rows have more than so many times as many
// between them, these are not all read.
constexpr size_t MOST_READ_EACH = 8;

}

OverlayCrossing::OverlayCrossing(const OverlayIndex& index, std::pmr::memory_resource* memory)
    : index_(index), field_(index, memory), rows_(memory),
      numbers_(std::max(index.rings.largest_size(), index.numbering.largest_inner_size()), memory),
      sums_(SourceCode::whole_blocks(numbers_.size()), memory), places_(sums_.size(), memory),
      gathered_(memory), gathered_rows_(memory),
      near_row_(SourceCode::whole_blocks(index.rings.largest_size()) + SourceCode::BLOCK,
                TableCode::UNREACHED, memory) {
    std::iota(numbers_.begin(), numbers_.end(), 0u);
    rows_.reserve(index.rings.largest_size());
}

std::span<float> OverlayCrossing::begin(uint32_t patch, size_t first, size_t count,
                                        const RingSegments& segments) {
    patch_ = patch;
    parent_ = index_.numbering.parent[patch];
    first_ = first;
    rows_.resize(count);
    return field_.begin(index_.rings, first, count, index_.quantum[parent_], segments);
}

void OverlayCrossing::cross_to_ring(std::span<const uint32_t> places, float* distances, uint16_t* winners) {
    if (places.empty()) return;
    for (size_t k = 0; k < rows_.size(); ++k)
        rows_[k] = index_.row_to_ring(parent_, index_.position_in_parent(patch_, first_ + k));
    cross(places, distances, winners);
}

void OverlayCrossing::cross_to_owned(std::span<const uint32_t> owned, float* distances, uint16_t* winners) {
    if (owned.empty()) return;
    for (size_t k = 0; k < rows_.size(); ++k)
        rows_[k] = index_.row_to_owned(parent_, index_.position_in_parent(patch_, first_ + k));
    cross(owned, distances, winners);
}

void OverlayCrossing::cross(std::span<const uint32_t> columns, float* distances, uint16_t* winners) {
    field_.cross(columns_of_rows(columns), distances, winners);
    if (field_.is_near()) cross_near(columns, distances);
}

CrossedColumns OverlayCrossing::columns_of_rows(std::span<const uint32_t> columns) {
    const auto [first, last] = std::ranges::minmax(columns);
    if (last - first < MOST_READ_EACH * columns.size())
        return {rows_, first, last, columns, sums_.data(), places_.data()};
    gather(columns);
    return {gathered_rows_, 0, columns.size() - 1, std::span(numbers_).first(columns.size()), sums_.data(),
            places_.data()};
}

void OverlayCrossing::gather(std::span<const uint32_t> columns) {
    const size_t stride = SourceCode::whole_blocks(columns.size());
    gathered_.resize(rows_.size() * stride);
    gathered_rows_.resize(rows_.size());
    for (size_t k = 0; k < rows_.size(); ++k) {
        uint16_t* const row = gathered_.data() + k * stride;
        for (size_t i = 0; i < columns.size(); ++i) row[i] = rows_[k][columns[i]];
        gathered_rows_[k] = row;
    }
}

void OverlayCrossing::cross_near(std::span<const uint32_t> columns, float* distances) {
    const NearRange& range = field_.near_range();
    const size_t end = std::min(range.end + 1, rows_.size());
    for (size_t i = 0; i < columns.size(); ++i) {
        if (distances[i] > range.reach) continue;
        for (size_t k = range.begin; k < end; ++k) near_row_[k] = rows_[k][columns[i]];
        const uint16_t* const row = near_row_.data();
        field_.cross_near({&row, 1}, distances + i);
    }
}

}
