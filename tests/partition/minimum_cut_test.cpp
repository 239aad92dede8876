#include "src/partition/minimum_cut.h"

#include <algorithm>
#include <bit>
#include <limits>
#include <vector>

#include <doctest/doctest.h>

#include "src/partition/random.h"

using namespace geodesic;

namespace {

struct Link {
    uint32_t a, b;
    uint64_t cost;
};

// The cost of the links between nodes of which one is in a set, given by bits, and one is not.
uint64_t cost_of_cut(const std::vector<Link>& links, uint32_t with_source) {
    uint64_t cost = 0;
    for (const auto& [a, b, c] : links)
        if ((with_source >> a & 1) != (with_source >> b & 1)) cost += c;
    return cost;
}

struct Cheapest {
    uint64_t cost = std::numeric_limits<uint64_t>::max();
    uint32_t with_source = 0; // the fewest nodes with which this cost is reached
};

// Tries all sets of nodes with node 0 and without node 1.
Cheapest cheapest_of_all(const std::vector<Link>& links, uint32_t node_count) {
    Cheapest cheapest;
    for (uint32_t set = 0; set < 1u << node_count; ++set) {
        if ((set & 3) != 1) continue;
        const uint64_t cost = cost_of_cut(links, set);
        if (cost > cheapest.cost) continue;
        if (cost < cheapest.cost || std::popcount(set) < std::popcount(cheapest.with_source))
            cheapest = {cost, set};
    }
    return cheapest;
}

uint32_t cut(MinimumCut& network, const std::vector<Link>& links, uint32_t node_count) {
    network.begin(node_count);
    for (const auto& [a, b, cost] : links) network.link(a, b, cost);
    network.cut(0, 1);
    uint32_t with_source = 0;
    for (uint32_t node = 0; node < node_count; ++node)
        with_source |= uint32_t{network.is_with_source(node)} << node;
    return with_source;
}

}

TEST_CASE("minimum cut: as cheap as the cheapest of all cuts, and nearest to the source") {
    Random random(3);
    MinimumCut network;
    for (int trial = 0; trial < 400; ++trial) {
        const uint32_t node_count = 2 + random.below(9);
        std::vector<Link> links;
        for (uint32_t i = random.below(3 * node_count); i > 0; --i) {
            const uint32_t a = random.below(node_count), b = random.below(node_count);
            if (a != b) links.push_back({a, b, random.below(5)}); // some twice, some at no cost
        }
        CHECK(cut(network, links, node_count) == cheapest_of_all(links, node_count).with_source);
    }
}

TEST_CASE("minimum cut: costs of 40 bits") {
    const uint64_t large = uint64_t{1} << 40;
    MinimumCut network;
    // 0 - 2 - 1 and 0 - 3 - 1, with a link across.
    CHECK(cut(network, {{0, 2, large}, {2, 1, large + 1}, {0, 3, large + 2}, {3, 1, large}, {2, 3, 1}}, 4) ==
          0b1001);
}
