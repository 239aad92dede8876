#include "src/overlay/sssd/coarse_hop.h"

#include <algorithm>

namespace geodesic {

namespace {

// Gathers `count` rows of a patch's coarse table.
void gather_rows(const OverlayIndex& index, uint32_t patch, uint32_t first_row, size_t count,
                 Array<const uint16_t*>& rows) {
    rows.resize(count);
    for (uint32_t i = 0; i < count; ++i) {
        rows[i] = coarse_row(index, patch, first_row + i);
        prefetch(rows[i], index.pairs.samples.rings.size(patch));
    }
}

void hop(const OverlayIndex& index, uint32_t patch, std::span<const float> distances, uint32_t first_row,
         size_t count, BorderCrossing& crossing, ReachedSamples& out) {
    const Samples& samples = index.pairs.samples;
    out.distance.resize(count);
    out.winner.resize(count);
    gather_rows(index, patch, first_row, count, crossing.rows);
    const uint32_t* sample = samples.sample_of_place.data() + samples.rings.begin[patch];
    for (float& d : crossing.field.begin(samples.rings, samples.rings.begin[patch], samples.rings.size(patch),
                                         index.quantum[index.numbering.parent[patch]]))
        d = distances[*sample++];
    if (crossing.field.finish()) {
        crossing.field.cross(crossing.rows, out.distance.data(), out.winner.data());
    } else {
        std::ranges::fill(out.distance, INFINITE);
        std::ranges::fill(out.winner, BorderFromSource::NO_PLACE);
    }
}

}

size_t largest_sample_count(const OverlayIndex& index) {
    size_t largest = 0;
    for (uint32_t p = 0; p < index.numbering.patch_count(); ++p)
        largest = std::max(largest, index.pairs.samples.of(p).size());
    return largest;
}

ReachedSamples::ReachedSamples(const OverlayIndex& index, std::pmr::memory_resource* memory)
    : distance(memory), winner(memory) {
    distance.reserve(largest_sample_count(index));
    winner.reserve(largest_sample_count(index));
}

void hop_to_sibling(const OverlayIndex& index, uint32_t patch, std::span<const float> distances,
                    uint32_t sibling, BorderCrossing& crossing, ReachedSamples& out) {
    const Samples& samples = index.pairs.samples;
    hop(index, patch, distances, samples.first_row[sibling], samples.of(sibling).size(), crossing, out);
}

// A coarse table begins with the rows of the parent's own samples.
void hop_to_parent(const OverlayIndex& index, uint32_t patch, std::span<const float> distances,
                   BorderCrossing& crossing, ReachedSamples& out) {
    hop(index, patch, distances, 0, index.pairs.samples.of(index.numbering.parent[patch]).size(), crossing,
        out);
}

}
