#pragma once

#include <cstddef>
#include <cstdint>

#include "src/overlay/sssd/samples.h"
#include "src/overlay/tables/tables.h"

namespace geodesic {

// Whether a border has segments, and consists of several chains with few places each on average.
bool has_short_chains(const OverlayIndex& index, uint32_t patch);

// How many pairs of places the hops of a path look at if each leads from a whole border to the whole next
// one. Pairs of borders of many short chains count less.
class WholeHops {
public:
    void add(const OverlayIndex& index, uint32_t first, uint32_t second);

    // Whether borders are crossed as a whole: that takes less time than finding out what the path may cross,
    // or a border has many short chains, of which parts would miss it.
    bool are_few() const { return pairs_ <= (hops_ > 1 ? FEW_PAIRS_OF_HOPS : FEW_PAIRS); }
    // Whether the parts of the borders that the shortest path may cross take little time to measure, whatever
    // their share of the borders.
    bool are_some() const { return pairs_ <= (hops_ > 1 ? SOME_PAIRS_OF_HOPS : SOME_PAIRS); }

private:
    // Over several borders, ways over samples take more time and lose more ways, so that these limits are
    // higher.
    static constexpr size_t FEW_PAIRS_OF_HOPS = 2 * FEW_PAIRS;
    static constexpr size_t SOME_PAIRS = 2 * FEW_PAIRS, SOME_PAIRS_OF_HOPS = 6 * FEW_PAIRS;

    size_t hops_ = 0, pairs_ = 0;
};

}
