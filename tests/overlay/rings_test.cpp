// Borders laid out as rings, against the segments that they are made of.
#include "src/overlay/tables/rings.h"

#include <cmath>
#include <random>

#include <doctest/doctest.h>

#include "tests/support/oracles.h"

using namespace geodesic;
using namespace geodesic::test;

namespace {

std::pmr::memory_resource* memory() { return std::pmr::get_default_resource(); }

// A root and patches with borders of these sizes: as much of a numbering as rings are made from.
Numbering numbering_of(const std::vector<uint32_t>& border_sizes) {
    Numbering numbering(memory());
    numbering.parent = {NONE};
    numbering.border_begin = {0, 0};
    for (const uint32_t size : border_sizes) {
        const auto patch = static_cast<uint32_t>(numbering.parent.size());
        numbering.parent.push_back(0);
        for (uint32_t i = 0; i < size; ++i) numbering.border.push_back(1000 * patch + 7 * i);
        numbering.border_begin.push_back(static_cast<uint32_t>(numbering.border.size()));
    }
    return numbering;
}

// Between any two positions of each border, in order.
void add_random_bridges(const Numbering& numbering, std::mt19937& random, BorderSegments& segments) {
    for (uint32_t p = 0; p < numbering.patch_count(); ++p)
        for (uint32_t i = 0; i < numbering.border_size(p); ++i)
            for (uint32_t j = i + 1; j < numbering.border_size(p); ++j)
                if (random() % 50 == 0)
                    segments.bridges.push_back(
                        {numbering.border_begin[p] + i, j, 1 + static_cast<float>(random() % 1000)});
}

// Chains of random lengths, closed or open, a vertex alone among them; and bridges.
BorderSegments random_segments(const Numbering& numbering, std::mt19937& random) {
    BorderSegments segments(numbering.border.size());
    for (uint32_t p = 0; p < numbering.patch_count(); ++p)
        for (uint32_t i = 0; i < numbering.border_size(p);) {
            const uint32_t left = numbering.border_size(p) - i;
            const uint32_t count = 1 + static_cast<uint32_t>(random()) % std::min(left, 9u);
            for (uint32_t k = 0; k < count; ++k) {
                const bool closes = k + 1 == count;
                if (closes && (count == 1 || random() % 2)) continue;
                const uint32_t slot = numbering.border_begin[p] + i + k;
                segments.end[slot] = closes ? i : i + k + 1;
                segments.length[slot] = 1 + static_cast<float>(random() % 1000);
            }
            i += count;
        }
    add_random_bridges(numbering, random, segments);
    return segments;
}

// The bridges of a patch, by what its ring has behind all chains.
std::vector<Bridge> bridges_in_ring(const Rings& rings, const Numbering& numbering, uint32_t patch) {
    std::vector<Bridge> bridges;
    const uint32_t end = rings.begin[patch + 1];
    for (uint32_t k = rings.bridges_begin(patch); k < end; k += 2) {
        REQUIRE(k + 1 < end);
        CHECK(rings.half_inverse[k] == 0.5f / rings.segment_length[k]);
        CHECK(std::isnan(rings.segment_length[k + 1]));
        CHECK((rings.is_own[k] == 0 && rings.is_own[k + 1] == 0));
        const uint32_t slot = numbering.border_begin[patch] + rings.position[k];
        bridges.push_back({slot, rings.position[k + 1], rings.segment_length[k]});
    }
    return bridges;
}

// The segment that ends at a position of a border: its slot, or NONE.
uint32_t slot_before(const BorderSegments& segments, const Numbering& numbering, uint32_t patch,
                     uint32_t position) {
    for (uint32_t slot = numbering.border_begin[patch]; slot < numbering.border_begin[patch + 1]; ++slot)
        if (segments.end[slot] == position) return slot;
    return NONE;
}

// Whether around the place of a vertex there are two steps along segments to either side, or, where these
// end, gaps.
void check_neighbours(const Rings& rings, const BorderSegments& segments, const Numbering& numbering,
                      uint32_t patch, uint32_t place) {
    const uint32_t first_slot = numbering.border_begin[patch], begin = rings.begin[patch];
    REQUIRE(place >= begin + 2);
    REQUIRE(place + 2 < rings.begin[patch + 1]);
    uint32_t position = rings.position[place];
    for (uint32_t k = place; k < place + 2; ++k) {
        const uint32_t slot = first_slot + position;
        CHECK(std::isnan(rings.segment_length[k]) == (segments.end[slot] == NONE));
        if (segments.end[slot] == NONE) break;
        CHECK(rings.segment_length[k] == segments.length[slot]);
        CHECK(rings.half_inverse[k] == 0.5f / segments.length[slot]);
        position = segments.end[slot];
        CHECK(rings.position[k + 1] == position);
    }
    position = rings.position[place];
    for (uint32_t k = place; k > place - 2; --k) {
        const uint32_t slot = slot_before(segments, numbering, patch, position);
        CHECK(std::isnan(rings.segment_length[k - 1]) == (slot == NONE));
        if (slot == NONE) break;
        CHECK(rings.segment_length[k - 1] == segments.length[slot]);
        position = slot - first_slot;
        CHECK(rings.position[k - 1] == position);
    }
}

}

TEST_CASE("rings: every vertex has one place of its own, and its neighbours follow the segments") {
    std::mt19937 random(3);
    for (int repetition = 0; repetition < 20; ++repetition) {
        const Numbering numbering = numbering_of({1, 2, 0, 40, 3, 65});
        const BorderSegments segments = random_segments(numbering, random);
        Rings rings(memory());
        lay_out_rings(segments, numbering, rings);
        std::vector<Bridge> bridges;
        for (uint32_t p = 0; p < numbering.patch_count(); ++p) {
            std::vector<uint32_t> own_places(numbering.border_size(p), 0);
            for (uint32_t k = rings.begin[p]; k < rings.begin[p + 1]; ++k) {
                REQUIRE(rings.position[k] < numbering.border_size(p));
                CHECK(rings.vertex[k] == numbering.border_of(p)[rings.position[k]]);
                CHECK((rings.is_own[k] == 0 || rings.is_own[k] == -1));
                if (!rings.is_own[k]) continue;
                ++own_places[rings.position[k]];
                CHECK(rings.place_of_slot[numbering.border_begin[p] + rings.position[k]] ==
                      k - rings.begin[p]);
                check_neighbours(rings, segments, numbering, p, k);
            }
            for (const uint32_t count : own_places) CHECK(count == 1);
            const auto of_patch = bridges_in_ring(rings, numbering, p);
            bridges.insert(bridges.end(), of_patch.begin(), of_patch.end());
        }
        CHECK(bridges == segments.bridges);
        CHECK(rings.position.size() == rings.begin.back() + Rings::PADDING);
    }
}

TEST_CASE("rings: give back the segments that they were made of") {
    std::mt19937 random(4);
    for (int repetition = 0; repetition < 20; ++repetition) {
        const Numbering numbering = numbering_of({30, 0, 7, 100});
        const BorderSegments segments = random_segments(numbering, random);
        Rings rings(memory());
        lay_out_rings(segments, numbering, rings);
        const BorderSegments back = segments_of_rings(rings, numbering);
        CHECK(back.end == segments.end);
        CHECK(back.length == segments.length);
        CHECK(back.bridges == segments.bridges);
        uint32_t next = 0;
        for (const Rings::Chain& chain : rings.chains_of(4))
            for (uint32_t k = chain.first; k <= chain.last; ++k) CHECK(rings.position[k] == next++);
        CHECK(next == 100);
    }
}

TEST_CASE("rings: a segment to another vertex than the next one, or the chain's first one, is refused") {
    const Numbering numbering = numbering_of({6, 6});
    for (const auto& pair : {std::pair{0u, 0u}, {0u, 2u}, {3u, 3u}, {3u, 1u}, {5u, 6u}, {2u, 100u}}) {
        const uint32_t from = pair.first, to = pair.second;
        CAPTURE(from);
        CAPTURE(to);
        BorderSegments segments(12);
        for (uint32_t i = 0; i < from; ++i) segments.end[6 + i] = i + 1;
        segments.end[6 + from] = to;
        Rings rings(memory());
        CHECK(failure_of([&] { lay_out_rings(segments, numbering, rings); }) == GEOIDX_ERROR_CORRUPT);
    }
}

TEST_CASE("rings: a bridge that leaves its border, leads back or comes out of order is refused") {
    const Numbering numbering = numbering_of({6, 6});
    const auto status_of = [&](const std::vector<Bridge>& bridges) {
        BorderSegments segments(12);
        segments.bridges = bridges;
        Rings rings(memory());
        return failure_of([&] { lay_out_rings(segments, numbering, rings); });
    };
    CHECK(status_of({{0, 1, 1}, {0, 5, 1}, {4, 5, 1}, {6, 1, 1}, {10, 5, 1}}) == GEOIDX_OK);
    for (const Bridge& wrong : std::vector<Bridge>{
             {6, 0, 1}, {8, 2, 1}, {9, 2, 1}, {10, 6, 1}, {7, 100, 1}, {12, 1, 1}, {NONE, 1, 1}}) {
        CAPTURE(wrong.slot);
        CAPTURE(wrong.end);
        CHECK(status_of({wrong}) == GEOIDX_ERROR_CORRUPT);
        CHECK(status_of({{0, 3, 1}, wrong}) == GEOIDX_ERROR_CORRUPT);
    }
    for (const auto& [first, second] : std::vector<std::pair<Bridge, Bridge>>{
             {{6, 1, 1}, {0, 1, 1}}, {{8, 3, 1}, {7, 5, 1}}, {{7, 5, 1}, {7, 3, 1}}, {{7, 5, 1}, {7, 5, 2}}})
        CHECK(status_of({first, second}) == GEOIDX_ERROR_CORRUPT);
}

TEST_CASE("rings: what is joined to a vertex is so by a segment of its chain or by a bridge") {
    std::mt19937 random(5);
    const Numbering numbering = numbering_of({25, 1, 40});
    const BorderSegments segments = random_segments(numbering, random);
    Rings rings(memory());
    lay_out_rings(segments, numbering, rings);
    for (uint32_t p = 0; p < numbering.patch_count(); ++p) {
        const uint32_t first = numbering.border_begin[p], size = numbering.border_size(p);
        std::vector<std::vector<std::pair<uint32_t, float>>> expected(size), found(size);
        const auto join = [&](uint32_t i, uint32_t j, float length) {
            expected[i].push_back({j, length});
            expected[j].push_back({i, length});
        };
        for (uint32_t i = 0; i < size; ++i)
            if (segments.end[first + i] != NONE) join(i, segments.end[first + i], segments.length[first + i]);
        for (const Bridge& bridge : segments.bridges)
            if (bridge.slot >= first && bridge.slot < first + size)
                join(bridge.slot - first, bridge.end, bridge.length);
        for (uint32_t i = 0; i < size; ++i) {
            for_each_joined(rings, numbering, p, i, [&](uint32_t j, float length) {
                found[i].push_back({j, length});
            });
            std::ranges::sort(found[i]);
            std::ranges::sort(expected[i]);
            CHECK(found[i] == expected[i]);
        }
    }
}

TEST_CASE("rings: a border of more places than a winner's number can tell is refused") {
    const auto status_of = [](uint32_t vertices) {
        const Numbering numbering = numbering_of({vertices});
        BorderSegments segments(vertices);
        for (uint32_t i = 0; i + 1 < vertices; ++i) segments.end[i] = i + 1;
        Rings rings(memory());
        return failure_of([&] { lay_out_rings(segments, numbering, rings); });
    };
    CHECK(status_of(0x7fff - 4) == GEOIDX_OK); // two repetitions at each end
    CHECK(status_of(0x7fff - 3) == GEOIDX_ERROR_LIMIT);
}
