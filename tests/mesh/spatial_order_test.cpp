// The order of vertices in memory.
#include "src/mesh/spatial_order.h"

#include <algorithm>
#include <cfloat>
#include <numeric>

#include <doctest/doctest.h>

#include "tests/support/meshes.h"

using namespace geodesic;
using geodesic::test::uniform;

namespace {

std::vector<uint32_t> all(size_t count) {
    std::vector<uint32_t> points(count);
    std::iota(points.begin(), points.end(), 0u);
    return points;
}

}

TEST_CASE("spatial order: a power-of-two grid is visited quadrant by quadrant") {
    constexpr uint32_t SIDE = 16;
    std::vector<Eigen::Vector3d> positions;
    for (uint32_t i = 0; i < SIDE * SIDE; ++i) positions.emplace_back(i % SIDE, i / SIDE, 3);
    const auto order = spatial_order(positions, all(positions.size()));
    for (uint32_t size = SIDE; size > 1; size /= 2)
        for (uint32_t begin = 0; begin < order.size(); begin += size * size)
            for (uint32_t i = begin; i < begin + size * size; ++i) {
                CHECK(order[i] % SIDE / size == order[begin] % SIDE / size);
                CHECK(order[i] / SIDE / size == order[begin] / SIDE / size);
            }
}

TEST_CASE("spatial order: a permutation of the given points, the same for equal positions") {
    std::mt19937_64 random(1);
    std::vector<Eigen::Vector3d> positions;
    for (int i = 0; i < 1000; ++i)
        positions.push_back({uniform(random, -1, 1), uniform(random, 0, 1e-3), uniform(random, 5, 6)});
    std::vector<uint32_t> points;
    for (uint32_t i = 0; i < 1000; i += 3) points.push_back(i);
    auto order = spatial_order(positions, points);
    std::ranges::sort(order);
    CHECK(order == points);

    const std::vector<Eigen::Vector3d> equal(9, {1, 2, 3});
    CHECK(spatial_order(equal, all(9)) == all(9));
    CHECK(spatial_order(equal, {}).empty());
    const std::vector<Eigen::Vector3d> huge{{DBL_MAX, 0, 0}, {-DBL_MAX, 0, 0}, {0, DBL_MAX, 0}};
    order = spatial_order(huge, all(3));
    CHECK(order.front() == 1);
    std::ranges::sort(order);
    CHECK(order == all(3));
}
