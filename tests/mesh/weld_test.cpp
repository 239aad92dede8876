#include "src/mesh/weld.h"

#include <cmath>
#include <limits>
#include <numeric>
#include <random>
#include <string>

#include <doctest/doctest.h>

#include "tests/support/meshes.h"

using namespace geodesic;
using namespace geodesic::test;

namespace {

using Positions = std::vector<Eigen::Vector3d>;

// The contract, word by word: each position joins the first representative at most the tolerance away.
std::vector<uint32_t> weld_by_brute_force(const Positions& positions, double tolerance) {
    std::vector<uint32_t> representative(positions.size());
    for (uint32_t i = 0; i < positions.size(); ++i) {
        representative[i] = i;
        for (uint32_t j = 0; j < i && representative[i] == i; ++j)
            if (representative[j] == j && (positions[j] - positions[i]).norm() <= tolerance)
                representative[i] = j;
    }
    return representative;
}

Positions random_positions(size_t count, double low, double high, uint64_t seed) {
    std::mt19937_64 random(seed);
    Positions positions(count);
    for (auto& p : positions)
        for (int k = 0; k < 3; ++k) p[k] = uniform(random, low, high);
    return positions;
}

}

TEST_CASE("weld: random positions, as brute force has it") {
    for (const double tolerance : {0.02, 0.1, 0.3, 5.0})
        for (uint64_t seed = 1; seed <= 4; ++seed) {
            const auto positions = random_positions(500, -1, 1, seed);
            CHECK(weld(positions, tolerance) == weld_by_brute_force(positions, tolerance));
        }
}

TEST_CASE("weld: positions exactly a tolerance apart and on the borders of cells") {
    // Quarters of a power of two are exact, so "at most" is decided without rounding.
    std::mt19937_64 random(5);
    for (const double tolerance : {0.25, 1.0, 1024.0}) {
        Positions positions(600);
        for (auto& p : positions)
            for (int k = 0; k < 3; ++k) p[k] = tolerance / 4 * (static_cast<double>(random() % 33) - 16);
        CHECK(weld(positions, tolerance) == weld_by_brute_force(positions, tolerance));
    }
}

TEST_CASE("weld: positions on both sides of a cell's border, by one rounding") {
    for (const double tolerance : {0.1, 0.3, 1e-7, 3.0}) {
        Positions positions;
        for (int i = -20; i <= 20; ++i) {
            const double border = i * tolerance;
            // Three in a cluster within half a tolerance, so that rounding cannot decide.
            for (const double x : {std::nextafter(border, -1e9), border, std::nextafter(border, 1e9),
                                   border + 0.4 * tolerance, border - 0.4 * tolerance})
                positions.push_back({x, -x, x});
        }
        CHECK(weld(positions, 0.45 * tolerance) == weld_by_brute_force(positions, 0.45 * tolerance));
    }
}

TEST_CASE("weld: a chain does not collapse into one vertex") {
    // Each is within the tolerance of the next one only.
    Positions positions;
    for (int i = 0; i < 6; ++i) positions.push_back({0.75 * i, 0, 0});
    CHECK(weld(positions, 1) == std::vector<uint32_t>{0, 0, 2, 2, 4, 4});
    // The first representative, not the nearest one.
    CHECK(weld({{0, 0, 0}, {1.5, 0, 0}, {0.9, 0, 0}}, 1) == std::vector<uint32_t>{0, 1, 0});
    CHECK(weld({{1.5, 0, 0}, {0, 0, 0}, {0.9, 0, 0}}, 1) == std::vector<uint32_t>{0, 1, 0});
}

TEST_CASE("weld: without a tolerance only equal positions are one") {
    const double next = std::nextafter(1.0, 2.0);
    CHECK(weld({{1, 1, 1}, {next, 1, 1}, {1, 1, 1}, {1, next, 1}, {1, 1, next}, {next, 1, 1}}, 0) ==
          std::vector<uint32_t>{0, 1, 0, 3, 4, 1});
    CHECK(weld({{0.0, 0, 0}, {-0.0, 0, -0.0}}, 0) == std::vector<uint32_t>{0, 0});
    auto positions = random_positions(300, -1, 1, 9);
    for (size_t i = 0; i < 300; i += 3) positions.push_back(positions[i]);
    CHECK(weld(positions, 0) == weld_by_brute_force(positions, 0));
}

TEST_CASE("weld: a tolerance far below the rounding of the coordinates keeps the cells small") {
    std::vector<Eigen::Vector3d> positions;
    for (int i = 0; i < 30000; ++i) positions.emplace_back(i % 200, i / 200, 0.5);
    positions.push_back(positions[7]);
    auto expected = std::vector<uint32_t>(positions.size());
    std::iota(expected.begin(), expected.end(), 0u);
    expected.back() = 7;
    CHECK(weld(positions, 1e-300) == expected);
}

TEST_CASE("weld: minus zero with a tolerance") {
    CHECK(weld({{0.0, 0, 0}, {-0.0, -0.0, 0}, {-1e-12, 0, 0}}, 1e-9) == std::vector<uint32_t>{0, 0, 0});
}

TEST_CASE("weld: coordinates far beyond what the grid can number") {
    const double far = 1e300;
    CHECK(weld({{far, 0, 0}, {-far, 0, 0}, {far, 0, 0}, {far, 1, 0}}, 1e-9) ==
          std::vector<uint32_t>{0, 1, 0, 3});
}

// If the cells of others were wide, all would be compared with all.
TEST_CASE("weld: one position as far away as a float can be") {
    auto positions = random_positions(60000, -1, 1, 10);
    const double far = std::numeric_limits<float>::max();
    for (const double sign : {1.0, -1.0, 1.0}) positions.emplace_back(sign * far, far, -far);
    positions.push_back(positions[5]);
    auto expected = std::vector<uint32_t>(positions.size());
    std::iota(expected.begin(), expected.end(), 0u);
    expected[60002] = 60000;
    expected.back() = 5;
    CHECK(weld(positions, 1e-15) == expected);
}
