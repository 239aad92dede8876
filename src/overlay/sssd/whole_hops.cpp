#include "src/overlay/sssd/whole_hops.h"

namespace geodesic {

namespace {

// In a border of many short chains, as patches of a lattice of tubes have, places that are near in space are
// far apart in the ring, so that a range of places would miss them. It is crossed as a whole even where that
// takes long: so many of its pairs count as one.
constexpr size_t PAIRS_OF_CHAINS_AS_ONE = 128, PLACES_OF_SHORT_CHAIN = 48;

}

bool has_short_chains(const OverlayIndex& index, uint32_t patch) {
    const size_t chains = index.rings.chains_of(patch).size();
    return chains > 1 && index.rings.size(patch) < chains * PLACES_OF_SHORT_CHAIN &&
           index.longest_segment[patch] > 0;
}

void WholeHops::add(const OverlayIndex& index, uint32_t first, uint32_t second) {
    const bool have_short_chains = has_short_chains(index, first) || has_short_chains(index, second);
    ++hops_;
    pairs_ += size_t{index.rings.size(first)} * index.rings.size(second) /
              (have_short_chains ? PAIRS_OF_CHAINS_AS_ONE : 1);
}

}
