#include "src/base/rounded.h"

#include <cmath>
#include <limits>
#include <random>

#include <doctest/doctest.h>

using namespace geodesic;

TEST_CASE("rounded: off by no more than is said, finite, and with zeros at the end") {
    std::mt19937 random(1);
    constexpr uint32_t FIRST = std::bit_cast<uint32_t>(std::numeric_limits<float>::min()),
                       LAST = std::bit_cast<uint32_t>(std::numeric_limits<float>::max());
    std::uniform_int_distribution<uint32_t> any(FIRST, LAST);
    for (int i = 0; i < 20000; ++i) {
        const uint32_t bits = i < 5000 ? LAST - static_cast<uint32_t>(i) : any(random);
        const float number = std::bit_cast<float>(bits), result = rounded(number);
        CHECK(std::isfinite(result));
        CHECK(std::abs(double{result} - double{number}) <= double{number} / 4096);
        if (bits < LAST - 4096)
            CHECK(std::abs(double{result} - double{number}) <= double{LARGEST_ROUNDING} * double{number});
        CHECK((std::bit_cast<uint32_t>(result) & 0x7FF) == 0);
    }
    CHECK(rounded(1) == 1);
}
