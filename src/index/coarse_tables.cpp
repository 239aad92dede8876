#include "src/index/coarse_tables.h"

#include <algorithm>
#include <cmath>
#include <span>

#include "src/index/rings.h"

namespace geodesic {

namespace {

// What a ring is sampled by: at least so many vertices, but at least every so manieth vertex.
constexpr uint32_t FEWEST = 64, LARGEST_STEP = 5;

// Samples tell the way to what is farther than so many times the distance of two of them.
constexpr float NEAR_SAMPLES = 8;

// Samples are about every so manieth vertex of a patch's border.
uint32_t step_of(const Index& index, uint32_t patch) {
    return std::clamp(index.border_size(patch) / FEWEST, 1u, LARGEST_STEP);
}

// Of a chain of so many vertices; the ends of an open one are among them.
uint32_t sample_count(uint32_t vertices, bool is_closed, uint32_t step) {
    if (step == 1 || vertices <= 3) return vertices;
    return std::max(3u, (vertices - !is_closed) / step) + !is_closed;
}

// Evenly.
std::vector<uint32_t> sample(const Chain& chain, uint32_t step) {
    const auto vertices = static_cast<uint32_t>(chain.positions.size());
    const uint32_t count = sample_count(vertices, chain.is_closed, step);
    if (count == vertices) return chain.positions;
    const uint32_t intervals = vertices - !chain.is_closed, pieces = count - !chain.is_closed;
    std::vector<uint32_t> samples;
    for (uint32_t i = 0; i < count; ++i) samples.push_back(chain.positions[uint64_t{i} * intervals / pieces]);
    return samples;
}

// The length of the segment between two samples; a gap where there is no way from one to the other.
float segment_between(const Index& index, uint32_t patch, uint32_t a, uint32_t b) {
    const uint32_t parent = index.parent[patch];
    const uint32_t* overlay_position = index.overlay_position.data() + index.border_begin[patch];
    const uint16_t code = index.overlay_code(parent, overlay_position[a], overlay_position[b]);
    return code == OverlayTables::UNREACHED ? Rings::GAP : index.overlay_tables.distance(code, parent);
}

void sample_ring(Index& index, uint32_t patch, RingWriter& writer) {
    const uint32_t step = step_of(index, patch);
    for (const Chain& chain : chains_of_ring(index.overlay_tables.rings, patch)) {
        Chain coarse{sample(chain, step), {}, chain.is_closed};
        const size_t count = coarse.positions.size();
        for (size_t i = 0; i < count; ++i)
            coarse.lengths.push_back(
                segment_between(index, patch, coarse.positions[i], coarse.positions[(i + 1) % count]));
        writer.add_chain(coarse, index.border_of(patch));
    }
    writer.end_ring();
}

// Of the segments of a ring; 0 if it has none.
struct Lengths {
    float average = 0, longest = 0;
};

Lengths segment_lengths(const Rings& rings, uint32_t patch) {
    Lengths lengths;
    float sum = 0;
    uint32_t segments = 0;
    for (uint32_t k = rings.begin[patch]; k < rings.begin[patch + 1]; ++k) {
        if (std::isnan(rings.segment_length[k])) continue;
        sum += rings.segment_length[k];
        lengths.longest = std::max(lengths.longest, rings.segment_length[k]);
        ++segments;
    }
    if (segments) lengths.average = sum / static_cast<float>(segments);
    return lengths;
}

void place_samples(Index& index, uint32_t patch) {
    OverlayTables& tables = index.overlay_tables;
    const Rings& rings = tables.coarse_rings;
    std::vector<uint32_t> sample(index.border_size(patch), 0); // per position
    uint32_t count = 0;
    for (uint32_t k = rings.begin[patch]; k < rings.begin[patch + 1]; ++k)
        if (rings.is_own[k]) {
            sample[rings.position[k]] = count++;
            tables.sample_positions.push_back(rings.position[k]);
        }
    for (uint32_t k = rings.begin[patch]; k < rings.begin[patch + 1]; ++k) {
        tables.coarse_places.push_back(tables.rings.begin[patch] +
                                       tables.place_of_slot[index.border_begin[patch] + rings.position[k]]);
        tables.coarse_samples.push_back(sample[rings.position[k]]);
    }
    const float spacing = segment_lengths(rings, patch).average;
    tables.sample_spacing.push_back(spacing);
    tables.near.push_back(
        std::max(NEAR_SAMPLES * spacing, OverlayTables::NEAR * segment_lengths(tables.rings, patch).longest));
    tables.sample_begin.push_back(static_cast<uint32_t>(tables.sample_positions.size()));
}

// The overlay positions, in a patch, of the samples of its child's ring, or of its own.
void add_samples(const Index& index, uint32_t ring_of, bool of_child, std::vector<uint32_t>& positions) {
    for (uint32_t position : index.overlay_tables.samples_of(ring_of))
        positions.push_back(of_child ? index.overlay_position[index.border_begin[ring_of] + position]
                                     : position);
}

void sample_table(Index& index, uint32_t patch, std::span<const uint32_t> rows) {
    OverlayTables& tables = index.overlay_tables;
    tables.coarse_begin[patch] = tables.coarse_tables.size();
    const uint32_t* place = tables.coarse_places.data() + tables.coarse_rings.begin[patch];
    const uint32_t first_place = tables.rings.begin[patch];
    const uint32_t places = tables.coarse_rings.size(patch);
    if (places == index.ring_size(patch)) return;
    for (uint32_t row : rows)
        for (uint32_t k = 0; k < places; ++k)
            tables.coarse_tables.push_back(
                tables.outer_tables[index.outer_row(patch, row) + place[k] - first_place]);
}

void sample_tables(Index& index, uint32_t patch) {
    OverlayTables& tables = index.overlay_tables;
    std::vector<uint32_t> rows;
    add_samples(index, patch, false, rows);
    for (uint32_t child = index.child_begin[patch]; child < index.child_begin[patch + 1]; ++child) {
        tables.coarse_rows[child] = static_cast<uint32_t>(rows.size());
        add_samples(index, child, true, rows);
    }
    for (uint32_t child = index.child_begin[patch]; child < index.child_begin[patch + 1]; ++child)
        sample_table(index, child, rows);
    tables.coarse_positions_begin.push_back(static_cast<uint32_t>(tables.coarse_positions.size()));
    tables.coarse_positions.insert(tables.coarse_positions.end(), rows.begin(), rows.end());
}

void clear(OverlayTables& tables) {
    tables.coarse_rings = Rings(tables.near.get_allocator().resource());
    for (Array<uint32_t>* numbers : {&tables.coarse_places, &tables.coarse_samples, &tables.sample_positions,
                                     &tables.coarse_positions_begin, &tables.coarse_positions})
        numbers->clear();
    for (Array<float>* lengths : {&tables.sample_spacing, &tables.near}) lengths->clear();
    tables.coarse_tables.clear();
}

}

SampleCount count_samples(const Index& index, uint32_t patch) {
    const Rings& rings = index.overlay_tables.rings;
    const uint32_t step = step_of(index, patch);
    SampleCount count;
    for (uint32_t k = rings.begin[patch]; k < rings.begin[patch + 1];) {
        const auto& [first, last, is_closed] = rings.chains[rings.chain[k]];
        const uint32_t samples = sample_count(last - first + 1, is_closed != 0, step);
        count.samples += samples;
        count.places += samples + 2 * Rings::REACH;
        k = last + Rings::REACH + 1;
    }
    return count;
}

void make_coarse_tables(Index& index) {
    OverlayTables& tables = index.overlay_tables;
    clear(tables);
    RingWriter writer(tables.coarse_rings);
    writer.begin();
    for (uint32_t p = 0; p < index.patch_count(); ++p) sample_ring(index, p, writer);
    tables.sample_begin.assign(1, 0);
    for (uint32_t p = 0; p < index.patch_count(); ++p) place_samples(index, p);
    writer.end();
    tables.coarse_rows.assign(index.patch_count(), 0);
    tables.coarse_begin.assign(index.patch_count(), 0);
    for (uint32_t p = 0; p < index.first_leaf(); ++p) sample_tables(index, p);
    tables.coarse_tables.resize(tables.coarse_tables.size() + OverlayTables::PADDING);
}

}
