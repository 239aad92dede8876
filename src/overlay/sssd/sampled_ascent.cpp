#include "src/overlay/sssd/sampled_ascent.h"

#include <algorithm>

#include "src/base/prefetch.h"
#include "src/overlay/kernels/dispatch.h"
#include "src/overlay/sssd/samples.h"

namespace geodesic {

namespace {

size_t largest_sample_count(const OverlayIndex& index) {
    size_t largest = 0;
    for (uint32_t p = 0; p < index.numbering.patch_count(); ++p)
        largest = std::max(largest, index.pairs.samples.of(p).size());
    return largest;
}

}

SampledAscent::SampledAscent(const OverlayIndex& index, std::pmr::memory_resource* memory)
    : index_(index), stride_(SourceCode::whole_blocks(largest_sample_count(index) + 1)), borders_(memory),
      distances_(memory), winners_(memory), ways_(memory), rows_across_(memory), across_(memory),
      codes_(stride_, memory), gaps_(stride_, Rings::GAP, memory), middles_(stride_, memory),
      middle_codes_(stride_, memory), no_strides_(stride_, memory) {
    const size_t borders = index.numbering.level_count() + 1;
    borders_.reserve(borders);
    distances_.resize(borders * stride_);
    winners_.resize(borders * stride_);
    ways_.resize(borders * stride_ + SourceCode::BLOCK);
}

void SampledAscent::climb(const Ascent& ascent) {
    const Samples& samples = index_.pairs.samples;
    for (size_t b = 0; b + 1 < ascent.patches.size(); ++b)
        prefetch(samples.codes.data() + samples.up_begin[ascent.patches[b]],
                 samples.of(ascent.patches[b]).size() * samples.of(ascent.patches[b + 1]).size());
    const auto innermost = samples.of(ascent.patches.front());
    const RingRow& row = ascent.first_row;
    for (size_t i = 0; i < innermost.size(); ++i) distances_[i] = row(row.first + innermost[i]);
    std::fill(distances_of(0) + innermost.size(),
              distances_of(0) + SourceCode::whole_blocks(innermost.size()), INFINITE);
    borders_.assign(1, {.patch = ascent.patches.front()});
    for (size_t b = 1; b < ascent.patches.size(); ++b)
        hop({.patch = ascent.patches[b],
             .quantum = index_.quantum[ascent.patches[b]],
             .table = samples.codes.data() + samples.up_begin[ascent.patches[b - 1]]});
}

void SampledAscent::hop_across(const Ascent& ascent, uint32_t sibling) {
    const Samples& samples = index_.pairs.samples;
    const uint32_t patch = ascent.last_patch();
    hop({.patch = sibling,
         .quantum = index_.quantum[index_.numbering.parent[patch]],
         .table = samples.has_table_across(sibling) ? samples.rows_across(index_.numbering, patch, sibling)
                                                    : make_rows_across(patch, sibling)});
}

// The kernel reads rows as far as whole blocks.
const uint16_t* SampledAscent::make_rows_across(uint32_t patch, uint32_t sibling) {
    const Samples& samples = index_.pairs.samples;
    const auto from = samples.of(patch);
    const size_t columns = samples.of(sibling).size();
    across_.resize(from.size() * columns + TableCode::PADDING);
    rows_across_.begin(index_, samples, sibling);
    for (size_t i = 0; i < from.size(); ++i) rows_across_.fill(patch, from[i], across_.data() + i * columns);
    return across_.data();
}

// Of a border, ways_ has what is left of the way to the other end until the hop back from it is done, and
// then the whole way.
void SampledAscent::go_back(std::span<const float> rest) {
    std::ranges::copy(rest, ways_.data() + (borders_.size() - 1) * stride_);
    for (size_t border = borders_.size(); border-- > 0;) {
        const auto distances = this->distances(border);
        float* const ways = ways_.data() + border * stride_;
        std::fill(ways + distances.size(), ways + stride_, INFINITE);
        if (border > 0) hop_back(border);
        for (size_t i = 0; i < distances.size(); ++i) ways[i] += distances[i];
    }
}

void SampledAscent::hop_back(size_t border) {
    const Kernels& kernels = runnable_kernels().back();
    const Border& from = borders_[border];
    float* const rest = ways_.data() + border * stride_;
    float nearest;
    const BorderDistances distances{samples_of(from).size(), rest, gaps_.data(), no_strides_.data(),
                                    from.quantum};
    const BorderCodes codes{codes_.data(), middle_codes_.data(), &nearest, nullptr};
    kernels.prepare_sweep(distances, codes, middles_.data());
    // Beside gaps, offsets of middles say nothing; these are any bytes that can be read.
    const auto* const offsets = reinterpret_cast<const uint8_t*>(from.table);
    kernels.sweep(distances, codes, {samples_of(borders_[border - 1]).size(), from.table, offsets, nullptr},
                  rest - stride_);
}

float SampledAscent::way_over(size_t border, uint32_t before, uint32_t sample) const {
    const Border& to = borders_[border];
    return distances_of(border - 1)[before] +
           TableCode::distance(to.table[before * samples_of(to).size() + sample], to.quantum);
}

void SampledAscent::hop(const Border& to) {
    const size_t border = borders_.size(), count = samples_of(borders_.back()).size();
    const size_t samples = samples_of(to).size();
    float* const distance = distances_of(border);
    const uint32_t before = borders_.back().patch;
    runnable_kernels().back().cross_samples(
        {distances_of(border - 1), to.quantum, index_.pairs.samples.long_segments_of(before), codes_.data()},
        {to.table, samples, count}, distance, winners_.data() + border * stride_);
    std::fill(distance + samples, distance + SourceCode::whole_blocks(samples), INFINITE);
    borders_.push_back(to);
    if (index_.longest_segment[before] > 0) return;
    measure_over_vertices();
    keep_common(before);
}

// Measures the ways to the samples of the last border again, each over the sample that its winner names: the
// kernel has them from rounded codes. The border before must have no segments.
void SampledAscent::measure_over_vertices() {
    const size_t border = borders_.size() - 1;
    for (uint32_t i = 0; i < samples_of(borders_.back()).size(); ++i)
        if (distances_of(border)[i] < INFINITE)
            distances_of(border)[i] = way_over(border, sample_before(border, i), i);
}

// Samples that lie on the border before, too, keep the distances that they have there. That border must have
// no segments, so that all of its vertices are samples.
void SampledAscent::keep_common(uint32_t before) {
    const size_t border = borders_.size() - 1;
    const auto samples = samples_of(borders_.back());
    for (uint32_t i = 0; i < samples.size(); ++i) {
        const uint32_t vertex = index_.rings.vertex[index_.rings.begin[borders_.back().patch] + samples[i]];
        const uint32_t position = index_.numbering.border_position(before, vertex);
        if (position == NONE) continue;
        const uint32_t place = own_place(index_.rings, index_.numbering, before, position);
        const uint32_t sample = first_sample_from(index_.rings, index_.pairs.samples, before, place);
        winners_[border * stride_ + i] = static_cast<uint16_t>(sample);
        distances_of(border)[i] = distances_of(border - 1)[sample];
    }
}

}
