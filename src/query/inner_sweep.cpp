#include "src/query/inner_sweep.h"

#include <algorithm>
#include <limits>

#include "src/query/four_at_a_time.h"

namespace geodesic {

namespace {

constexpr float INFINITE = std::numeric_limits<float>::infinity();
constexpr size_t BLOCK = SweptBorder::BLOCK;
static_assert(OverlayTables::PADDING >= BLOCK && Rings::PADDING >= BLOCK,
              "the last row of a table is read in whole blocks");

}

InnerSweep::InnerSweep(const Index& index, size_t sources, std::pmr::memory_resource* memory)
    : index_(index), rings_(index.overlay_tables.rings), kernel_(sweep_kernels().back()), sources_(sources),
      distance_(memory), middle_distance_(memory), code_(memory), middle_(memory), near_field_(index, memory),
      near_rows_(memory), near_inside_(memory) {
    const size_t room = (SweptBorder::whole_blocks(rings_.largest_size()) + BLOCK) * sources;
    for (Array<float>* distances : {&distance_, &middle_distance_}) distances->resize(room);
    for (Array<int16_t>* codes : {&code_, &middle_}) codes->resize(room);
    near_rows_.resize(index.largest_inner_size());
    near_inside_.resize(near_rows_.size());
}

float InnerSweep::see(uint32_t patch, const float* distances) {
    patch_ = patch;
    const uint32_t first = rings_.begin[patch], places = rings_.size(patch);
    border_ = {places, distance_.data(), rings_.segment_length.data() + first,
               index_.overlay_tables.quantum[patch]};
    const uint32_t* vertex = rings_.vertex.data() + first;
    if (sources_ == 1)
        four_at_a_time(places, [&](size_t k) { distance_[k] = distances[vertex[k]]; });
    else
        for (size_t k = 0; k < places; ++k)
            std::copy_n(distances + size_t{vertex[k]} * MOST_SOURCES, MOST_SOURCES,
                        distance_.data() + k * MOST_SOURCES);
    std::fill_n(distance_.data() + places * sources_, BLOCK * sources_, INFINITE);
    codes_ = {code_.data(), middle_.data(), nearest_.data()};
    (sources_ == 1 ? kernel_.see : kernel_.see_each)(border_, codes_, middle_distance_.data());
    return *std::min_element(nearest_.begin(), nearest_.begin() + static_cast<std::ptrdiff_t>(sources_));
}

void InnerSweep::cross(float* inside) {
    const OverlayTables& tables = index_.overlay_tables;
    const uint64_t first_row = index_.inner_row(patch_, 0);
    const SweptRows rows{index_.inner_size(patch_), tables.inner_tables.data() + first_row,
                         tables.inner_middles.data() + first_row};
    (sources_ == 1 ? kernel_.sweep : kernel_.sweep_each)(border_, codes_, rows, inside);
    for (size_t i = 0; i < sources_; ++i)
        if (nearest_[i] <= tables.near[patch_]) cross_near(i, inside);
}

void InnerSweep::cross_near(size_t source, float* inside) {
    const uint32_t count = index_.inner_size(patch_), places = rings_.size(patch_);
    const auto border = near_field_.begin(rings_, rings_.begin[patch_], places, border_.quantum);
    for (size_t k = 0; k < places; ++k) border[k] = distance_[k * sources_ + source];
    if (!near_field_.finish() || !near_field_.is_near()) return;
    const uint16_t* row = index_.overlay_tables.inner_tables.data() + index_.inner_row(patch_, 0);
    for (size_t r = 0; r < count; ++r) {
        near_rows_[r] = row + r * places;
        near_inside_[r] = inside[r * sources_ + source];
    }
    near_field_.cross_near({near_rows_.data(), count}, near_inside_.data());
    for (size_t r = 0; r < count; ++r) inside[r * sources_ + source] = near_inside_[r];
}

}
