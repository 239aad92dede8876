// Angles between directions, and sums of them.
#include <numbers>
#include <random>

#include <doctest/doctest.h>

#include "src/mesh/angle.h"
#include "tests/support/meshes.h"

using namespace geodesic;

TEST_CASE("angles: a sum is that of the angles one by one, over several turns") {
    std::mt19937_64 random(3);
    const auto direction = [&] {
        const double x = test::uniform(random, -1, 1), y = test::uniform(random, -1, 1),
                     z = test::uniform(random, -1, 1);
        return Eigen::Vector3d(x, y, z);
    };
    for (int round = 0; round < 200; ++round) {
        CAPTURE(round);
        AngleSum sum;
        CHECK(sum.value() == 0);
        double expected = 0;
        for (int i = 0; i < 12; ++i) {
            const Eigen::Vector3d a = direction(), b = direction();
            sum.add(a * 1e-40, b * 1e30);
            expected += angle_between(a, b);
            CHECK(sum.value() == doctest::Approx(expected).epsilon(1e-13));
            CHECK(sum.is_half_turn() == (expected >= std::numbers::pi));
        }
    }
}

TEST_CASE("angles: a sum of straight, right and no angles") {
    const Eigen::Vector3d x(1, 0, 0), y(0, 2, 0);
    AngleSum sum;
    for (const auto& [to, angle] :
         {std::pair<Eigen::Vector3d, double>(x, 0), {-x, 1}, {-x, 2}, {y, 2.5}, {x, 2.5}, {y, 3}}) {
        sum.add(x, to);
        CHECK(sum.value() == doctest::Approx(angle * std::numbers::pi).epsilon(1e-14));
        CHECK(sum.is_half_turn() == (angle >= 1));
    }
}
