#include "src/overlay/batch.h"

#include <algorithm>
#include <limits>

namespace geodesic {

OverlayBatch::OverlayBatch(const OverlayIndex& index, std::pmr::memory_resource* memory)
    : numbering_(index.numbering), sweep_(index, SOURCES, memory), out_(memory),
      sources_inside_(index.numbering.patch_count(), memory) {
    static_assert(SOURCES <= 8 * sizeof(sources_inside_[0]));
    out_.resize(index.numbering.largest_inner_size() * SOURCES);
}

void OverlayBatch::sweep(std::span<const uint32_t> sources, OverlaySsad& climber,
                         std::span<float> distances) {
    std::ranges::fill(distances, INFINITE);
    for (size_t i = 0; i < SOURCES; ++i)
        climber.climb(sources[std::min(i, sources.size() - 1)], {distances.data() + i, SOURCES});
    mark_patches_around(sources);
    for (uint32_t p = 1; p < numbering_.patch_count(); ++p) descend(p, distances);
}

// Notes which sources each patch contains: the sweep up has filled its distances from those.
void OverlayBatch::mark_patches_around(std::span<const uint32_t> sources) {
    std::ranges::fill(sources_inside_, uint16_t{0});
    for (size_t i = 0; i < SOURCES; ++i)
        for (uint32_t p = numbering_.entry(sources[std::min(i, sources.size() - 1)]); p != NONE;
             p = numbering_.parent[p])
            sources_inside_[p] = static_cast<uint16_t>(sources_inside_[p] | 1u << i);
}

// Hops to the inner vertices of a patch, from the sources outside of it.
void OverlayBatch::descend(uint32_t patch, std::span<float> distances) {
    const uint32_t count = numbering_.inner_size(patch);
    if (count == 0 || !(sweep_.begin(patch, distances.data()) < INFINITE)) return;
    float* const inside = distances.data() + size_t{numbering_.first_inner(patch)} * SOURCES;
    const uint32_t inside_sources = sources_inside_[patch];
    if (inside_sources == 0) {
        sweep_.cross(inside);
        return;
    }
    sweep_.cross(out_.data());
    for (size_t r = 0; r < count; ++r)
        for (size_t i = 0; i < SOURCES; ++i)
            if (!(inside_sources >> i & 1)) inside[r * SOURCES + i] = out_[r * SOURCES + i];
}

}
