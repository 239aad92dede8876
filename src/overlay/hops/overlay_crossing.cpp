#include "src/overlay/hops/overlay_crossing.h"

#include <algorithm>

#include "src/base/prefetch.h"
#include "src/overlay/kernels/nearest_places.h"

namespace geodesic {

namespace {

// From so many near columns on, those of a block take less time together than one by one.
constexpr size_t MANY_NEAR = 5;

// Where a hop reads few rows, so many codes of each are asked for before the first row is read. Processors
// find those behind by themselves.
constexpr uint32_t FEW_ROWS = 128, CODES_AHEAD = 64;

}

OverlayCrossing::OverlayCrossing(const OverlayIndex& index, std::pmr::memory_resource* memory)
    : index_(index), field_(index, memory), of_part_(index.rings, memory), rows_(memory),
      near_row_(index.rings.room_for_places(), TableCode::UNREACHED, memory), from_(memory),
      from_ring_(memory), from_owned_(memory), columns_in_rows_(memory) {
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
    from_.clear();
    return field_.begin(part.size(), segments, is_own, index_.quantum[parent_]);
}

void OverlayCrossing::cross_to_ring(Columns places, float* distances, uint16_t* winners) {
    cross([&](uint32_t position) { return index_.row_to_ring(parent_, position); }, places, distances,
          winners);
}

void OverlayCrossing::cross_to_owned(Columns owned, float* distances, uint16_t* winners) {
    if (index_.is_large[parent_]) return cross_to_owned_of_large(owned, distances, winners);
    cross([&](uint32_t position) { return index_.row_to_owned(parent_, position); }, owned, distances,
          winners);
}

template <class RowAt>
void OverlayCrossing::cross(const RowAt& row_at, Columns columns, float* distances, uint16_t* winners) {
    if (columns.empty()) return;
    const uint32_t first = std::min(columns.front(), columns.back()),
                   last = std::max(columns.front(), columns.back());
    const uint32_t ahead = part_.size() <= FEW_ROWS ? std::min(last - first + 1, CODES_AHEAD) : 0;
    const uint16_t** row = rows_.data();
    part_.for_each_place([&](uint32_t place) {
        *row = row_at(index_.position_in_parent(patch_, place));
        prefetch(*row++ + first, ahead);
    });
    cross_rows(columns, distances, winners);
}

// Run by run, so that rows are turned as far as a run, into memory that stays near to the processor.
void OverlayCrossing::cross_to_owned_of_large(Columns owned, float* distances, uint16_t* winners) {
    if (owned.empty()) return;
    if (from_.empty()) find_places_in_parent();
    for (size_t done = 0; done < owned.size();) {
        const ColumnRun run = first_run(owned.subspan(done));
        turn_rows(run.first, run.last);
        const uint32_t first = TurnedRows::first_entry(run.first);
        columns_in_rows_.resize(run.columns.size());
        std::ranges::transform(run.columns, columns_in_rows_.begin(), [&](uint32_t c) { return c - first; });
        cross_rows(columns_in_rows_, distances + done, winners ? winners + done : nullptr);
        done += run.columns.size();
    }
}

void OverlayCrossing::find_places_in_parent() {
    from_.resize(part_.size());
    OverlayColumn* from = from_.data();
    part_.for_each_place([&](uint32_t place) {
        *from++ = index_.overlay_column(parent_, index_.position_in_parent(patch_, place));
    });
}

// Finds the entries from `first` to `last` of the rows of all places to owned vertices.
void OverlayCrossing::turn_rows(uint32_t first, uint32_t last) {
    const HopTables& hops = index_.hops;
    const uint32_t owned = index_.numbering.inner_size(parent_);
    from_ring_.begin({hops.inner.data() + hops.inner_begin[parent_], owned, index_.rings.size(parent_)},
                     first, last);
    from_owned_.begin({hops.owned.data() + hops.owned_begin[parent_], owned, 0, true}, first, last);
    for (const auto [is_owned, number] : from_) (is_owned ? from_owned_ : from_ring_).announce(number);
    from_ring_.turn();
    from_owned_.turn();
    const uint16_t** row = rows_.data();
    for (const auto [is_owned, number] : from_)
        *row++ = (is_owned ? from_owned_ : from_ring_).next_row(number);
}

void OverlayCrossing::cross_rows(Columns columns, float* distances, uint16_t* winners) {
    field_.cross(rows_, columns, distances, winners);
    if (field_.is_near()) cross_near(columns, distances);
}

// Near columns that follow each other lie side by side, mostly, up or down along a border. Where there are
// many of them, they are measured together.
void OverlayCrossing::cross_near(Columns columns, float* distances) {
    const float reach = field_.near_range().reach;
    const auto is_near = [reach](float distance) { return distance <= reach; };
    while (!columns.empty()) {
        const ColumnRun block = first_block(columns, Kernels::NEAR_COLUMNS);
        const size_t count = block.columns.size();
        const auto near = static_cast<size_t>(std::count_if(distances, distances + count, is_near));
        if (near >= MANY_NEAR)
            cross_near_block(block.columns, block.first, distances);
        else if (near > 0)
            for (size_t i = 0; i < count; ++i)
                if (is_near(distances[i])) cross_near_row(columns[i], distances[i]);
        columns = columns.subspan(count);
        distances += count;
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
