#include "src/overlay/hops/inner_sweep.h"

#include <algorithm>

#include "src/base/four_at_a_time.h"
#include "src/overlay/kernels/near.h"

namespace geodesic {

namespace {

constexpr size_t BLOCK = SourceCode::BLOCK;

}

InnerSweep::InnerSweep(const OverlayIndex& index, size_t sources, std::pmr::memory_resource* memory)
    : index_(index), numbering_(index.numbering), rings_(index.rings), kernels_(runnable_kernels().back()),
      sources_(sources), distance_(memory), middle_distance_(memory), code_(memory), middle_(memory),
      bound_(memory), result_(index.numbering.largest_inner_size() * sources, memory), field_(index, memory),
      rows_(memory), from_one_(memory) {
    const size_t room = rings_.room_for_places() * sources;
    for (Array<float>* distances : {&distance_, &middle_distance_}) distances->resize(room);
    for (Array<int16_t>* codes : {&code_, &middle_}) codes->resize(room);
    if (sources == 1) bound_.resize(InnerBounds::blocks(rings_.largest_size()));
    rows_.resize(index.numbering.largest_inner_size());
    from_one_.resize(rows_.size());
}

bool InnerSweep::begin(uint32_t patch, const float* distances, const RingSegments& segments, float radius) {
    if (numbering_.inner_size(patch) == 0) return false;
    patch_ = patch;
    segments_ = segments;
    const uint32_t places = rings_.size(patch);
    border_ = {places, distance_.data(), segments.length, index_.strides.of(patch), index_.quantum[patch]};
    const uint32_t* vertex = rings_.vertex.data() + rings_.begin[patch];
    if (sources_ == 1)
        four_at_a_time(places, [&](size_t k) { distance_[k] = distances[vertex[k]]; });
    else
        for (size_t k = 0; k < places; ++k)
            std::copy_n(distances + size_t{vertex[k]} * FIELDS_AT_ONCE, FIELDS_AT_ONCE,
                        distance_.data() + k * FIELDS_AT_ONCE);
    std::fill_n(distance_.data() + places * sources_, BLOCK * sources_, INFINITE);
    codes_ = {code_.data(), middle_.data(), nearest_.data(), bound_.data()};
    (sources_ == 1 ? kernels_.prepare_sweep : kernels_.prepare_sweep_each)(border_, codes_,
                                                                           middle_distance_.data());
    const float nearest = *std::ranges::min_element(std::span(nearest_).first(sources_));
    return nearest < INFINITE && nearest <= farthest_on_border(radius, index_.longest_segment[patch]);
}

void InnerSweep::cross_to(float* inside) {
    const uint64_t first_row = index_.inner_row(patch_, 0);
    const SweepRows rows{numbering_.inner_size(patch_), index_.hops.inner.data() + first_row,
                         index_.hops.inner_middles.data() + first_row,
                         index_.bounds.codes.data() + index_.bounds.begin[patch_]};
    const bool bounded = sources_ == 1 && InnerBounds::are_kept(border_.places);
    (bounded         ? kernels_.sweep_bounded
     : sources_ == 1 ? kernels_.sweep
                     : kernels_.sweep_each)(border_, codes_, rows, inside);
    const float near = near_segments(numbering_.vertex_count()) * index_.longest_segment[patch_];
    for (size_t i = 0; i < sources_; ++i)
        if (nearest_[i] <= near) cross_near(i, inside);
}

std::span<float> InnerSweep::cross() {
    cross_to(result_.data());
    return result();
}

std::span<float> InnerSweep::result() {
    return std::span(result_).first(numbering_.inner_size(patch_) * sources_);
}

// Prepares the border for one of the sources. Returns whether that source reaches it.
bool InnerSweep::begin_from(size_t source) {
    const uint32_t places = rings_.size(patch_);
    const auto border =
        field_.begin(places, segments_, rings_.is_own.data() + rings_.begin[patch_], border_.quantum);
    for (size_t k = 0; k < places; ++k) border[k] = distance_[k * sources_ + source];
    return field_.finish();
}

Rows InnerSweep::rows() {
    const uint32_t count = numbering_.inner_size(patch_), places = rings_.size(patch_);
    const uint16_t* row = index_.hops.inner.data() + index_.inner_row(patch_, 0);
    for (size_t r = 0; r < count; ++r) rows_[r] = row + r * places;
    return {rows_.data(), count};
}

void InnerSweep::cross_near(size_t source, float* inside) {
    if (!begin_from(source) || !field_.is_near()) return;
    const size_t count = numbering_.inner_size(patch_);
    for (size_t r = 0; r < count; ++r) from_one_[r] = inside[r * sources_ + source];
    field_.cross_near(rows(), from_one_.data());
    for (size_t r = 0; r < count; ++r) inside[r * sources_ + source] = from_one_[r];
}

}
