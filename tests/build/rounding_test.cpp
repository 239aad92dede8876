// To what distances of tables are rounded.
#include <cmath>
#include <random>

#include <doctest/doctest.h>

#include "src/overlay/tables/codes.h"
#include "src/tables/rounding.h"
#include "tests/support/meshes.h"

using namespace geodesic;
using namespace geodesic::test;

namespace {

void check_rounded(float longest, float wanted, std::mt19937_64& random) {
    CAPTURE(longest);
    CAPTURE(wanted);
    const Steps steps = choose_steps(longest, wanted);
    const double step = std::ldexp(double{steps.quantum}, steps.shift);
    CHECK(step >= double{wanted});
    CHECK(step <= std::max(double{wanted}, double{longest} / TableCode::LARGEST) * (1 + 1e-6));
    for (int i = 0; i < 10; ++i) {
        const auto distance = i == 0 ? longest : static_cast<float>(uniform(random, step, double{longest}));
        const uint16_t code = TableCode::nearest_to(distance, steps.quantum, steps.shift);
        CHECK(code % (1 << steps.shift) == 0);
        CHECK(std::abs(code * double{steps.quantum} - double{distance}) <= step * (0.5 + 1e-6));
    }
}

}

TEST_CASE("rounding: each distance up to the longest is right to half a step") {
    std::mt19937_64 random(3);
    // A little less than a power of two is rounded to it.
    for (const float longest : {255.9f, 127.6f, 2047.7f, 1.9f, 3.6f, 32765.5f, 32766.0f, 32767.0f, 1e6f})
        check_rounded(longest, 1, random);
    for (int i = 0; i < 2000; ++i)
        check_rounded(static_cast<float>(std::exp(uniform(random, 0.0, 12.0))),
                      static_cast<float>(uniform(random, 0.0, 1.0)), random);
}
