#include "src/overlay/samples.h"

#include <algorithm>
#include <cmath>
#include <span>

#include "src/overlay/near.h"
#include "src/overlay/rings.h"

namespace geodesic {

namespace {

// A border has about FEWEST samples or more, or all of its vertices if these are fewer. Between two
// neighbouring samples of a long border lie LARGEST_STEP edges, or up to two more, since a chain is divided
// evenly: 19 edges make three intervals of 6, 6 and 7.
constexpr uint32_t FEWEST = 64, LARGEST_STEP = 5;

// Samples tell where the shortest way crosses a border only if the distance is more than this many times
// their spacing.
constexpr float NEAR_SAMPLES = 8;

uint32_t step_of(const OverlayIndex& index, uint32_t patch) {
    return std::clamp(index.numbering.border_size(patch) / FEWEST, 1u, LARGEST_STEP);
}

// The number of samples of a chain with this many vertices. The two ends of an open chain are always samples.
uint32_t sample_count(uint32_t vertices, bool is_closed, uint32_t step) {
    if (step == 1 || vertices <= 3) return vertices;
    return std::max(3u, (vertices - !is_closed) / step) + !is_closed;
}

// Spreads the samples evenly along the chain.
std::vector<uint32_t> sample(const Chain& chain, uint32_t step) {
    const auto vertices = static_cast<uint32_t>(chain.positions.size());
    const uint32_t count = sample_count(vertices, chain.is_closed, step);
    if (count == vertices) return {chain.positions.begin(), chain.positions.end()};
    const uint32_t intervals = vertices - !chain.is_closed, pieces = count - !chain.is_closed;
    std::vector<uint32_t> samples;
    for (uint32_t i = 0; i < count; ++i) samples.push_back(chain.positions[uint64_t{i} * intervals / pieces]);
    return samples;
}

// The distance of two neighbouring samples, which is the length of the segment between them in the coarse
// ring. It is a gap if no path joins them.
float segment_between(const OverlayIndex& index, uint32_t patch, uint32_t a, uint32_t b) {
    const uint32_t parent = index.numbering.parent[patch];
    const uint32_t* overlay_position =
        index.numbering.overlay_position.data() + index.numbering.border_begin[patch];
    const uint16_t code = index.overlay_code(parent, overlay_position[a], overlay_position[b]);
    return code == TableCode::UNREACHED ? Rings::GAP : index.distance(code, parent);
}

void sample_ring(const OverlayIndex& index, uint32_t patch, RingWriter& writer) {
    const uint32_t step = step_of(index, patch);
    for (const Chain& chain : chains_of_ring(index.rings, patch)) {
        const std::vector<uint32_t> samples = sample(chain, step);
        std::vector<float> lengths;
        for (size_t i = 0; i < samples.size(); ++i)
            lengths.push_back(segment_between(index, patch, samples[i], samples[(i + 1) % samples.size()]));
        writer.add_chain({samples, lengths, chain.is_closed});
    }
    writer.end_ring();
}

// The mean length of the segments of a ring, or 0 if it has none.
float average_segment(const Rings& rings, uint32_t patch) {
    float sum = 0;
    uint32_t segments = 0;
    for (uint32_t k = rings.begin[patch]; k < rings.begin[patch + 1]; ++k) {
        if (std::isnan(rings.segment_length[k])) continue;
        sum += rings.segment_length[k];
        ++segments;
    }
    return segments ? sum / static_cast<float>(segments) : 0;
}

// How far it is along the border from a sample to the next one, at most. Vertices between two samples are no
// farther from either, which the distance of the two does not tell: the border may go out and back between
// them.
float longest_gap(const OverlayIndex& index, const Samples& samples, uint32_t patch) {
    const Rings& coarse = samples.rings;
    float longest = 0;
    for (uint32_t k = coarse.begin[patch]; k < coarse.begin[patch + 1]; ++k) {
        if (std::isnan(coarse.segment_length[k])) continue;
        float length = 0;
        for (uint32_t at = samples.full_place[k]; index.rings.position[at] != coarse.position[k + 1]; ++at)
            length += index.rings.segment_length[at];
        longest = std::max(longest, length);
    }
    return longest;
}

void lay_out_samples(const OverlayIndex& index, uint32_t patch, Samples& samples) {
    const Rings& rings = samples.rings;
    std::vector<uint32_t> sample(index.numbering.border_size(patch), 0); // per position
    uint32_t count = 0;
    for (uint32_t k = rings.begin[patch]; k < rings.begin[patch + 1]; ++k)
        if (rings.is_own[k]) {
            sample[rings.position[k]] = count++;
            samples.positions.push_back(rings.position[k]);
        }
    for (uint32_t k = rings.begin[patch]; k < rings.begin[patch + 1]; ++k) {
        samples.full_place.push_back(
            index.rings.begin[patch] +
            index.rings.place_of_slot[index.numbering.border_begin[patch] + rings.position[k]]);
        samples.sample_of_place.push_back(sample[rings.position[k]]);
    }
    const float spacing = average_segment(rings, patch);
    samples.spacing.push_back(spacing);
    samples.longest_gap.push_back(longest_gap(index, samples, patch));
    samples.shortest_told.push_back(
        std::max(NEAR_SAMPLES * spacing, near_radius(index.longest_segment[patch])));
    samples.begin.push_back(static_cast<uint32_t>(samples.positions.size()));
}

// Appends the positions, in the overlay of a patch, of the samples of a child's border or of the patch's own.
void add_samples(const OverlayIndex& index, const Samples& samples, uint32_t ring_of, bool of_child,
                 std::vector<uint32_t>& positions) {
    for (uint32_t position : samples.of(ring_of))
        positions.push_back(
            of_child ? index.numbering.overlay_position[index.numbering.border_begin[ring_of] + position]
                     : position);
}

void sample_table(const OverlayIndex& index, uint32_t patch, std::span<const uint32_t> rows,
                  Samples& samples) {
    samples.table_begin[patch] = samples.tables.size();
    const uint32_t* place = samples.full_place.data() + samples.rings.begin[patch];
    const uint32_t first_place = index.rings.begin[patch];
    const uint32_t places = samples.rings.size(patch);
    if (places == index.rings.size(patch)) return;
    for (uint32_t row : rows)
        for (uint32_t k = 0; k < places; ++k)
            samples.tables.push_back(index.hops.outer[index.outer_row(patch, row) + place[k] - first_place]);
}

// The number of codes that all coarse tables will have.
uint64_t count_coarse_codes(const OverlayIndex& index) {
    std::vector<SampleCount> samples;
    for (uint32_t p = 0; p < index.numbering.patch_count(); ++p) samples.push_back(count_samples(index, p));
    uint64_t codes = 0;
    for (uint32_t p = 0; p < index.numbering.first_leaf(); ++p)
        codes += count_coarse_codes(index, samples, p);
    return codes;
}

void sample_tables(const OverlayIndex& index, uint32_t patch, Samples& samples) {
    std::vector<uint32_t> rows;
    add_samples(index, samples, patch, false, rows);
    for (uint32_t child = index.numbering.child_begin[patch]; child < index.numbering.child_begin[patch + 1];
         ++child) {
        samples.first_row[child] = static_cast<uint32_t>(rows.size());
        add_samples(index, samples, child, true, rows);
    }
    for (uint32_t child = index.numbering.child_begin[patch]; child < index.numbering.child_begin[patch + 1];
         ++child)
        sample_table(index, child, rows, samples);
    samples.row_begin.push_back(static_cast<uint32_t>(samples.row_position.size()));
    samples.row_position.insert(samples.row_position.end(), rows.begin(), rows.end());
}

}

SampleCount count_samples(const OverlayIndex& index, uint32_t patch) {
    const Rings& rings = index.rings;
    const uint32_t step = step_of(index, patch);
    SampleCount count;
    for (const auto& [first, last, is_closed] : rings.chains_of(patch)) {
        const uint32_t samples = sample_count(last - first + 1, is_closed != 0, step);
        count.samples += samples;
        count.places += samples + 2 * Rings::REACH;
    }
    return count;
}

uint64_t count_coarse_codes(const OverlayIndex& index, std::span<const SampleCount> samples,
                            uint32_t parent) {
    const Numbering& numbering = index.numbering;
    uint64_t rows = samples[parent].samples, places = 0;
    for (uint32_t child = numbering.child_begin[parent]; child < numbering.child_begin[parent + 1]; ++child) {
        rows += samples[child].samples;
        if (samples[child].places < index.rings.size(child)) places += samples[child].places;
    }
    return rows * places;
}

void make_samples(const OverlayIndex& index, Samples& samples) {
    const uint32_t patch_count = index.numbering.patch_count();
    RingWriter writer(samples.rings);
    writer.begin();
    for (uint32_t p = 0; p < patch_count; ++p) sample_ring(index, p, writer);
    const size_t places = samples.rings.position.size();
    for (auto* per_place : {&samples.full_place, &samples.sample_of_place}) per_place->reserve(places);
    samples.begin.assign(1, 0);
    for (uint32_t p = 0; p < patch_count; ++p) lay_out_samples(index, p, samples);
    writer.end();
    samples.first_row.assign(patch_count, 0);
    samples.table_begin.assign(patch_count, 0);
    samples.tables.reserve(count_coarse_codes(index) + TableCode::PADDING);
    for (uint32_t p = 0; p < index.numbering.first_leaf(); ++p) sample_tables(index, p, samples);
    samples.tables.resize(samples.tables.size() + TableCode::PADDING);
}

}
