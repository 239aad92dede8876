#include "src/overlay/sssd/border_range.h"

#include <algorithm>

#include "src/overlay/codes.h"
#include "src/overlay/kernels/dispatch.h"
#include "src/overlay/sssd/border_crossing.h"

namespace geodesic {

namespace {

constexpr uint32_t REACH = Rings::REACH;

// Copies codes to the places of a patch's coarse ring. code_of[k] is the index of the code of place k,
// counted over all coarse rings.
void spread_codes(const Rings& rings, uint32_t patch, const int16_t* codes, const uint32_t* code_of,
                  std::span<int16_t> out) {
    const uint32_t first = rings.begin[patch], places = rings.size(patch);
    for (uint32_t k = 0; k < places; ++k)
        out[k] = rings.is_own[first + k] ? codes[code_of[first + k]] : SourceCode::UNREACHED;
    std::ranges::fill(out.subspan(places, SourceCode::BLOCK), SourceCode::UNREACHED);
}

// Returns the places from the second sample before the given ones to the second one after them. Where samples
// repeat vertices at the ends of chains, these two need not enclose the given ones; then whole chains are
// returned.
BorderRange range_around(const OverlayIndex& index, uint32_t patch, SampleRange samples) {
    const uint32_t* place = index.pairs.samples.full_place.data() + index.pairs.samples.rings.begin[patch];
    const uint32_t first = place[samples.first - REACH], last = place[samples.last + REACH];
    if (first <= place[samples.first] && place[samples.last] <= last) return {first, last};
    const auto chain = [&](uint32_t k) {
        return *std::ranges::lower_bound(index.rings.chains_of(patch), place[k], {},
                                         &Rings::ChainPlaces::last);
    };
    return {chain(samples.first).first - REACH, chain(samples.last).last + REACH};
}

}

SampleRange range_of_winners(std::span<const uint16_t> winners) {
    SampleRange range;
    for (const uint16_t winner : winners)
        if (winner != BorderFromSource::NO_PLACE) range.add(winner);
    return range;
}

SampleRange samples_within(const OverlayIndex& index, const Ascent& ascent, float reach) {
    const Rings& rings = index.pairs.samples.rings;
    const uint32_t* sample = index.pairs.samples.sample_of_place.data() + rings.begin[ascent.last_patch()];
    const uint32_t places = rings.size(ascent.last_patch());
    SampleRange within;
    for (uint32_t k = REACH; k + REACH < places; ++k)
        if (ascent.sample_distances[sample[k]] <= reach) within.add(k);
    return within;
}

BorderRanges::BorderRanges(const OverlayIndex& index, std::pmr::memory_resource* memory)
    : index_(index), ranges_(memory), first_codes_(memory), codes_(memory), sample_distances_(memory),
      sample_codes_(memory), rows_(memory), winners_(memory) {
    const size_t places = index.pairs.samples.rings.largest_size();
    ranges_.reserve(index.numbering.level_count());
    first_codes_.resize(places + SourceCode::BLOCK);
    codes_.resize(places + SourceCode::BLOCK);
    sample_distances_.resize(largest_sample_count(index));
    sample_codes_.resize(sample_distances_.size());
    rows_.reserve(places);
    winners_.reserve(places);
}

void BorderRanges::begin(const Ascent& ascent) {
    if (ascent.patches.size() > 1) read_codes(ascent, ascent.patches.front(), first_codes_);
}

bool BorderRanges::find(const Ascent& ascent, SampleRange samples) {
    ranges_.resize(ascent.patches.size());
    for (size_t b = ranges_.size(); b-- > 0;) {
        if (samples.is_empty()) return false;
        ranges_[b] = range_around(index_, ascent.patches[b], samples);
        if (b > 0) samples = samples_before(ascent, b, samples);
    }
    for (size_t b = 0; b < ranges_.size(); ++b) prefetch_tables(ascent, b);
    return true;
}

bool BorderRanges::take_whole(const Ascent& ascent) {
    ranges_.clear();
    for (const uint32_t patch : ascent.patches) {
        const uint32_t first = index_.rings.begin[patch], end = index_.rings.begin[patch + 1];
        if (first == end) return false;
        ranges_.push_back({first, end - 1});
    }
    for (size_t b = 0; b < ranges_.size(); ++b) prefetch_tables(ascent, b);
    return true;
}

// Writes the codes of the distances from the end to the places of a patch's coarse ring, in steps of the
// parent's quantum.
void BorderRanges::read_codes(const Ascent& ascent, uint32_t patch, std::span<int16_t> out) {
    const Rings& rings = index_.pairs.samples.rings;
    const uint32_t* sample_of_place = index_.pairs.samples.sample_of_place.data();
    const bool is_innermost = patch == index_.numbering.innermost_patch(ascent.vertex);
    if (!is_innermost && index_.is_labelled(patch)) {
        const BorderLabel label = label_of(index_, ascent.vertex, patch);
        spread_codes(rings, patch, label.codes, label.is_whole ? rings.position.data() : sample_of_place,
                     out);
        return;
    }
    const auto distances = std::span(sample_distances_).first(index_.pairs.samples.of(patch).size());
    if (is_innermost)
        read_samples(index_, patch, inner_row_of(index_, ascent.vertex), distances);
    else
        std::ranges::copy(ascent.around_leaf.distance, distances.begin());
    const StepsOf steps(distances, index_.quantum[index_.numbering.parent[patch]]);
    for (size_t i = 0; i < distances.size(); ++i) sample_codes_[i] = steps.code(distances[i]);
    spread_codes(rings, patch, sample_codes_.data(), sample_of_place, out);
}

// Returns the samples of the border before that the shortest ways to the given samples and to their two
// neighbours come over. The number of a sample is its row, too: coarse tables begin with the samples of the
// parent's own border.
SampleRange BorderRanges::samples_before(const Ascent& ascent, size_t border, SampleRange samples) {
    const uint32_t patch = ascent.patches[border], before = ascent.patches[border - 1];
    const Rings& rings = index_.pairs.samples.rings;
    if (border > 1) read_codes(ascent, before, codes_);
    const uint32_t* sample = index_.pairs.samples.sample_of_place.data() + rings.begin[patch];
    rows_.clear();
    for (uint32_t k = samples.first - 1; k <= samples.last + 1; ++k)
        rows_.push_back(coarse_row(index_, before, sample[k]));
    BorderFromSource crossed{};
    crossed.places = rings.size(before);
    crossed.code = border > 1 ? codes_.data() : first_codes_.data();
    winners_.resize(rows_.size());
    runnable_kernels().back().choose(crossed, rows_, winners_.data());
    return range_of_winners(winners_);
}

// Asks for the segments of a border's range and for the codes from there to the range of the next border.
// A position in the next border is the overlay position, too: the overlay of a patch begins with its border.
void BorderRanges::prefetch_tables(const Ascent& ascent, size_t border) const {
    const uint32_t patch = ascent.patches[border];
    const BorderRange range = ranges_[border];
    const Rings& rings = index_.rings;
    prefetch(rings.segment_length.data() + range.first, range.size());
    prefetch(rings.half_inverse.data() + range.first, range.size());
    prefetch(rings.is_own.data() + range.first, range.size());
    if (border + 1 == ranges_.size()) return;
    const BorderRange next = ranges_[border + 1];
    const uint16_t* rows =
        index_.hops.outer.data() + index_.outer_row(patch, 0) + (range.first - rings.begin[patch]);
    for (uint32_t k = next.first; k <= next.last; ++k)
        prefetch(rows + size_t{rings.position[k]} * rings.size(patch), range.size());
}

}
