#pragma once

#include <algorithm>
#include <cstdint>
#include <memory_resource>

#include "src/overlay/tables/tables.h"

namespace geodesic {

// Ways over samples are longer than the true ones by up to about so many spacings, which are averages. Where
// samples lie farther apart than that, Samples::excess says by how much.
constexpr float MOST_LONGER = 1.5f;

// The number of codes in the tables of all samples. Needs the rings of the index.
uint64_t count_sample_codes(const OverlayIndex& index);

// A hop that looks at no more pairs of places than this leads from all of one border to all of another: that
// takes less time than finding the part of them that a path may cross.
constexpr size_t FEW_PAIRS = size_t{1} << 12;

// The rows of a table across, which lead to all samples of one patch.
class RowsAcross {
public:
    explicit RowsAcross(std::pmr::memory_resource* memory) : targets_(memory) {}

    // Chooses the patch. What is given must stay valid until the last row is filled.
    void begin(const OverlayIndex& index, const Samples& samples, uint32_t patch);
    // Fills the row of a sample of a sibling, given by its place.
    void fill(uint32_t sibling, uint16_t from, uint16_t* row) const;

private:
    struct Target {
        uint32_t vertex;
        OverlayColumn column; // of the parent's overlay
    };
    const OverlayIndex* index_ = nullptr;
    uint32_t patch_ = 0;
    Array<Target> targets_;
};

// The first sample of a border, counted from the border's first one, that comes at a place or behind it; the
// number of the border's samples if there is none. Places are counted over all rings.
inline uint32_t first_sample_from(const Rings& rings, const Samples& samples, uint32_t patch,
                                  uint32_t place) {
    const auto places = samples.of(patch);
    const auto found = std::ranges::lower_bound(places, place - rings.begin[patch]);
    return static_cast<uint32_t>(found - places.begin());
}

// Calls use(chain, first, last) for each chain of a border, with its first and its last sample, counted from
// the first sample of the border. Each chain has a sample.
template <class Use>
void for_each_chain_of_samples(const Rings& rings, const Samples& samples, uint32_t patch, const Use& use) {
    uint32_t first = 0;
    for (const Rings::Chain& chain : rings.chains_of(patch)) {
        const uint32_t end = first_sample_from(rings, samples, patch, chain.last + 1);
        use(chain, first, end - 1);
        first = end;
    }
}

// The samples on each side of one along its chain, around it if it is closed; NONE where an open one ends.
struct NeighbouringSamples {
    uint32_t previous, next;
};
NeighbouringSamples neighbouring_samples(const OverlayIndex& index, uint32_t patch, uint32_t sample);

// Fills empty `samples` of an index that has its rings and overlay tables.
void make_samples(const OverlayIndex& index, Samples& samples);

}
