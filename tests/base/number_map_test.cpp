#include "src/base/number_map.h"

#include <doctest/doctest.h>

#include <map>
#include <random>

using namespace geodesic;

TEST_CASE("number map: has the values that std::map has, however many there are") {
    std::mt19937 random(3);
    NumberMap<int> map;
    for (const uint32_t numbers : {10u, 1000u, 100000u}) {
        std::map<uint32_t, int> expected;
        for (int i = 0; i < 3000; ++i) {
            const auto number = static_cast<uint32_t>(random() % numbers) * 7;
            map[number] = expected[number] = i;
        }
        for (const auto& [number, value] : expected) CHECK(map[number] == value);
        CHECK(map[1] == 0); // a number that is new
        map.clear();
        CHECK(map[expected.begin()->first] == 0);
        map.clear();
    }
}
