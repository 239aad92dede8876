#include "src/query/overlay_batch.h"

#include <algorithm>
#include <limits>

namespace geodesic {

namespace {

constexpr float INFINITE = std::numeric_limits<float>::infinity();

// The child of a patch that has `inside` in it; NONE from there on.
uint32_t next_inwards(const Index& index, uint32_t patch, uint32_t inside) {
    if (inside == patch) return NONE;
    while (index.parent[inside] != patch) inside = index.parent[inside];
    return inside;
}

}

OverlayBatch::OverlayBatch(const Index& index, std::pmr::memory_resource* memory)
    : index_(index), sweep_(index, SOURCES, memory), out_(memory) {
    uint32_t most = 0;
    for (uint32_t p = 0; p < index.patch_count(); ++p) most = std::max(most, index.inner_size(p));
    out_.resize(most * SOURCES);
}

void OverlayBatch::sweep(std::span<const uint32_t> sources, OverlayMsad& climber,
                         std::span<float> distances) {
    std::ranges::fill(distances, INFINITE);
    for (size_t i = 0; i < SOURCES; ++i) {
        source_[i] = sources[std::min(i, sources.size() - 1)];
        climber.climb({&source_[i], 1}, {distances.data() + i, SOURCES});
    }
    next_around_.fill(0);
    for (uint32_t p = 0; p < index_.patch_count(); ++p) {
        enter(p);
        if (p > 0) descend(p, distances);
    }
}

// Sources that lie in a patch have its distances already: they are met from the whole mesh inwards.
void OverlayBatch::enter(uint32_t patch) {
    for (size_t i = 0; i < SOURCES; ++i) {
        is_outside_[i] = next_around_[i] != patch;
        if (!is_outside_[i]) next_around_[i] = next_inwards(index_, patch, index_.entry(source_[i]));
    }
}

// To what lies inside.
void OverlayBatch::descend(uint32_t patch, std::span<float> distances) {
    const uint32_t count = index_.inner_size(patch);
    if (count == 0 || !(sweep_.see(patch, distances.data()) < INFINITE)) return;
    float* const inside = distances.data() + size_t{index_.first_inner(patch)} * SOURCES;
    if (std::ranges::find(is_outside_, false) == is_outside_.end()) {
        sweep_.cross(inside);
        return;
    }
    sweep_.cross(out_.data());
    for (size_t r = 0; r < count; ++r)
        for (size_t i = 0; i < SOURCES; ++i)
            if (is_outside_[i]) inside[r * SOURCES + i] = out_[r * SOURCES + i];
}

}
