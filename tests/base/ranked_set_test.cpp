#include "src/base/ranked_set.h"

#include <doctest/doctest.h>

#include <random>
#include <set>

using namespace geodesic;

TEST_CASE("ranked set: has the numbers of a std::set, in its order") {
    std::mt19937 random(1);
    for (const uint32_t count : {1u, 63u, 64u, 65u, 128u, 1000u})
        for (const uint32_t of_ten : {0u, 1u, 5u, 10u}) {
            CAPTURE(count);
            CAPTURE(of_ten);
            std::set<uint32_t> expected;
            for (uint32_t i = 0; i < count; ++i)
                if (random() % 10 < of_ten) expected.insert(i);
            const RankedSet set(std::vector<uint32_t>(expected.begin(), expected.end()), count);
            for (uint32_t i = 0; i < count; ++i) CHECK(set.contains(i) == expected.contains(i));
            uint32_t rank = 0;
            for (const uint32_t number : expected) CHECK(set.rank(number) == rank++);
        }
    CHECK(!RankedSet().contains(0));
}
