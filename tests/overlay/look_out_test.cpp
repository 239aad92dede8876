// Distances of a point over its polygon, from many vertices at once.
#include <cmath>
#include <cstring>
#include <random>
#include <vector>

#include <doctest/doctest.h>

#include "src/overlay/kernels/dispatch.h"

using namespace geodesic;

namespace {

constexpr size_t VERTICES = 5 * NearRange::PART;

double between(std::mt19937& random, double low, double high) {
    return low + (high - low) * double(random()) / 4294967296.0;
}

// A regular polygon around a point in its middle, of whose edges only a part is seen here and there.
FacePoint regular_polygon(std::mt19937& random, uint32_t sides) {
    FacePoint point;
    point.vertex_count = point.edge_count = sides;
    const double radius = between(random, 0.5, 2), half = std::acos(-1.0) / sides;
    for (uint32_t k = 0; k < sides; ++k) {
        const double length = 2 * radius * std::sin(half);
        const bool is_whole = random() % 4 != 0;
        point.numbers[k] = k;
        point.straight[k] = k >= 3 && random() % 4 == 0 ? INFINITE : radius;
        point.edges[k] = {k,
                          (k + 1) % sides,
                          length,
                          length / 2,
                          radius * std::cos(half),
                          is_whole ? 0 : 0.3 * length,
                          is_whole ? length : 0.6 * length};
    }
    return point;
}

// Of vertices beyond the polygon in its plane, but for some that cannot be reached, and noise.
std::vector<float> rows_of(std::mt19937& random, const FacePoint& point, double noise) {
    std::vector<float> rows(point.vertex_count * VERTICES);
    const double side = 2 * std::acos(-1.0) / point.vertex_count, radius = point.straight[0];
    for (size_t v = 0; v < VERTICES; ++v) {
        const double far = between(random, 1.1, 8) * radius, turned = between(random, 0, 6.28);
        const bool is_reached = random() % 8 != 0;
        for (size_t k = 0; k < point.vertex_count; ++k) {
            const double angle = turned - side * static_cast<double>(k);
            const double distance =
                std::sqrt(far * far + radius * radius - 2 * far * radius * std::cos(angle));
            rows[k * VERTICES + v] =
                is_reached ? static_cast<float>(distance + between(random, 0, noise)) : INFINITE;
        }
    }
    return rows;
}

}

TEST_CASE("look out: from all vertices as from each, and with the same bits on every processor") {
    std::mt19937 random(1);
    for (int round = 0; round < 200; ++round) {
        CAPTURE(round);
        const FacePoint point = regular_polygon(random, static_cast<uint32_t>(3 + random() % 14));
        const auto rows = rows_of(random, point, round % 2 ? 0.2 : 0);
        std::vector<float> first(VERTICES), others(VERTICES);
        runnable_kernels().front().look_out(point, rows.data(), VERTICES, first.data());
        for (const Kernels& kernels : runnable_kernels()) {
            kernels.look_out(point, rows.data(), VERTICES, others.data());
            CHECK(std::memcmp(first.data(), others.data(), VERTICES * sizeof(float)) == 0);
        }
        for (size_t v = 0; v < VERTICES; ++v) {
            std::vector<double> from;
            for (size_t k = 0; k < point.vertex_count; ++k) from.push_back(double{rows[k * VERTICES + v]});
            const double distance = distance_over(point, from);
            if (distance == double{INFINITE})
                CHECK(first[v] == INFINITE);
            else
                CHECK(double{first[v]} == doctest::Approx(distance).epsilon(1e-3));
        }
    }
}
