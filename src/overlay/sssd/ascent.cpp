#include "src/overlay/sssd/ascent.h"

#include <algorithm>
#include <bit>

namespace geodesic {

BorderLabel label_of(const OverlayIndex& index, uint32_t vertex, uint32_t patch) {
    const Numbering& numbering = index.numbering;
    const uint32_t innermost = numbering.innermost_patch(vertex);
    const int16_t* label =
        index.pairs.labels.codes.data() + index.pairs.labels.begin[innermost] +
        uint64_t{vertex - numbering.first_inner(innermost)} * index.pairs.labels.offset[innermost] +
        index.pairs.labels.offset[patch];
    const uint32_t nearest = static_cast<uint32_t>(static_cast<uint16_t>(label[0])) +
                             0x10000u * static_cast<uint32_t>(static_cast<uint16_t>(label[1]));
    return {std::bit_cast<float>(nearest), index.quantum[numbering.parent[patch]], label + Labels::HEAD,
            index.is_labelled_whole(patch)};
}

RingRow inner_row_of(const OverlayIndex& index, uint32_t vertex) {
    const Numbering& numbering = index.numbering;
    const uint32_t patch = numbering.innermost_patch(vertex);
    return {index.hops.inner.data() + index.inner_row(patch, vertex - numbering.first_inner(patch)),
            index.rings.begin[patch], index.quantum[patch]};
}

Ascent::Ascent(const OverlayIndex& index, std::pmr::memory_resource* memory)
    : patches(memory), sample_distances(memory), around_leaf(index, memory) {
    patches.reserve(index.numbering.level_count());
    sample_distances.reserve(largest_sample_count(index));
}

void climb(const OverlayIndex& index, uint32_t vertex, uint32_t top, Ascent& ascent) {
    const uint32_t innermost = index.numbering.innermost_patch(vertex);
    ascent.vertex = vertex;
    ascent.patches.clear();
    for (uint32_t patch = innermost; patch != top; patch = index.numbering.parent[patch]) {
        if (patch != innermost && index.is_labelled_whole(patch)) ascent.patches.clear();
        ascent.patches.push_back(patch);
    }
}

void read_samples(const OverlayIndex& index, BorderCrossing& crossing, Ascent& ascent) {
    const uint32_t vertex = ascent.vertex, patch = ascent.last_patch();
    const uint32_t innermost = index.numbering.innermost_patch(vertex);
    const auto read_innermost = [&](Array<float>& out) {
        out.resize(index.pairs.samples.of(innermost).size());
        read_samples(index, innermost, inner_row_of(index, vertex), out);
    };
    if (patch == innermost) return read_innermost(ascent.sample_distances);
    if (ascent.patches.front() == innermost && !index.is_labelled(ascent.patches[1])) {
        read_innermost(ascent.sample_distances);
        hop_to_parent(index, innermost, ascent.sample_distances, crossing, ascent.around_leaf);
    }
    if (!index.is_labelled(patch)) {
        ascent.sample_distances.assign(ascent.around_leaf.distance.begin(),
                                       ascent.around_leaf.distance.end());
        return;
    }
    const auto samples = index.pairs.samples.of(patch);
    ascent.sample_distances.resize(samples.size());
    const BorderLabel label = label_of(index, vertex, patch);
    for (uint32_t i = 0; i < samples.size(); ++i)
        ascent.sample_distances[i] = label.distance(label.is_whole ? samples[i] : i);
}

}
