// A point of a face and a vertex whose distances from the corners are given.
#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <vector>

#include <Eigen/Core>

#include "src/index/face_point.h"
#include "src/overlay/kernels/dispatch.h"

using namespace geodesic;

namespace {

using Eigen::Vector2d;

struct Flat {
    std::array<Vector2d, 3> corners;

    std::array<double, 3> edge_lengths() const {
        return {(corners[1] - corners[2]).norm(), (corners[2] - corners[0]).norm(),
                (corners[0] - corners[1]).norm()};
    }
    std::array<double, 3> distances_from(const Vector2d& at) const {
        return {(corners[0] - at).norm(), (corners[1] - at).norm(), (corners[2] - at).norm()};
    }
    Vector2d at(const std::array<double, 3>& weights) const {
        return weights[0] * corners[0] + weights[1] * corners[1] + weights[2] * corners[2];
    }
};

class Numbers {
public:
    double next(double low, double high) { return low + (high - low) * double(random_()) / 4294967296.0; }
    std::array<double, 3> weights() {
        const double a = next(0.02, 1), b = next(0.02, 1), c = next(0.02, 1), sum = a + b + c;
        return {a / sum, b / sum, c / sum};
    }

private:
    std::mt19937 random_{5};
};

}

TEST_CASE("face point: in the plane the distance is the straight line") {
    Numbers numbers;
    for (int i = 0; i < 2000; ++i) {
        const Flat face{{Vector2d(0, 0), Vector2d(numbers.next(0.5, 2), 0),
                         Vector2d(numbers.next(-1, 2), numbers.next(0.3, 2))}};
        const auto weights = numbers.weights();
        // On the far side of the first edge, so that the line crosses it.
        const Vector2d through =
            face.at({0, weights[1] / (weights[1] + weights[2]), weights[2] / (weights[1] + weights[2])});
        const Vector2d vertex = face.at(weights) + numbers.next(1.01, 30) * (through - face.at(weights));
        const FacePoint point = face_point({0, 1, 2}, face.edge_lengths(), weights, {true, true, true});
        const double straight = (face.at(weights) - vertex).norm();
        CHECK(distance_over(point, face.distances_from(vertex)) == doctest::Approx(straight).epsilon(1e-9));
    }
}

TEST_CASE("face point: of an edge, to vertices that cut the edge the distance is that along it") {
    Numbers numbers;
    for (int i = 0; i < 200; ++i) {
        const Flat face{{Vector2d(0, 0), Vector2d(numbers.next(0.5, 2), 0),
                         Vector2d(numbers.next(-1, 2), numbers.next(0.3, 2))}};
        const size_t k = static_cast<size_t>(i) % 3;
        const auto on_edge = [&](double share) {
            std::array<double, 3> weights{};
            weights[(k + 1) % 3] = 1 - share;
            weights[(k + 2) % 3] = share;
            return weights;
        };
        const auto weights = on_edge(numbers.next(0.02, 0.98));
        const FacePoint point = face_point({0, 1, 2}, face.edge_lengths(), weights, {true, true, true});
        const double side = face.edge_lengths()[k];
        std::array<std::vector<float>, 3> rows;
        std::vector<float> along;
        for (size_t v = 0; v < NearRange::PART; ++v) {
            // In halves, quarters and so on, as edges are cut, and anywhere.
            const double share = v < 7 ? double(v + 1) / 8 : numbers.next(0, 1);
            const Vector2d vertex = face.at(on_edge(share));
            const double straight = (face.at(weights) - vertex).norm();
            const auto distances = face.distances_from(vertex);
            CHECK(std::abs(distance_over(point, distances) - straight) < 1e-6 * side);
            for (size_t corner = 0; corner < 3; ++corner)
                rows[corner].push_back(static_cast<float>(distances[corner]));
            along.push_back(static_cast<float>(straight));
        }
        rows[0].insert(rows[0].end(), rows[1].begin(), rows[1].end());
        rows[0].insert(rows[0].end(), rows[2].begin(), rows[2].end());
        for (const Kernels& kernels : runnable_kernels()) {
            std::vector<float> found(along.size());
            kernels.look_out(point, rows[0].data(), along.size(), found.data());
            for (size_t v = 0; v < along.size(); ++v)
                CHECK(std::abs(double{found[v]} - double{along[v]}) < 1e-3 * side);
        }
    }
}

// The point lies on one side of the edge and the vertex on the other, in line with it, but the way bends.
TEST_CASE("face point: no way runs along an edge that the point is beside") {
    const FacePoint::Edge edge{0, 1, 1.0, -0.5, 0, 0, 1.0};
    FacePoint point;
    point.vertex_count = 2;
    point.edge_count = 1;
    point.edges[0] = edge;
    point.straight[0] = 0.5;
    point.straight[1] = INFINITE;
    // By rounding, these put the vertex on the line, 0.5 beyond the first end.
    const std::array<double, 2> from{0.5, 1.5};
    CHECK(distance_over(point, from) == doctest::Approx(1));
    std::vector<float> rows(2 * NearRange::PART, 0.5f), found(NearRange::PART);
    std::fill(rows.begin() + NearRange::PART, rows.end(), 1.5f);
    for (const Kernels& kernels : runnable_kernels()) {
        kernels.look_out(point, rows.data(), found.size(), found.data());
        for (const float distance : found) CHECK(double{distance} == doctest::Approx(1));
    }
}

TEST_CASE("face point: whatever the distances from the corners, no side of a triangle is longer than the "
          "other two") {
    Numbers numbers;
    uint32_t wrong = 0, farther = 0;
    for (int i = 0; i < 20000; ++i) {
        const Flat face{{Vector2d(0, 0), Vector2d(numbers.next(0.5, 2), 0),
                         Vector2d(numbers.next(-1, 2), numbers.next(0.3, 2))}};
        const auto edges = face.edge_lengths();
        // Distances of any surface: they differ by an edge's length at most.
        std::array<double, 3> from{numbers.next(0, 4), 0, 0};
        from[1] = std::max(0.0, from[0] + numbers.next(-1, 1) * edges[2]);
        const double low =
            std::max({0.0, from[0] - edges[1], from[1] - edges[0], edges[1] - from[0], edges[0] - from[1]});
        const double high = std::min(from[0] + edges[1], from[1] + edges[0]);
        if (low > high || from[0] + from[1] < edges[2]) continue;
        from[2] = numbers.next(low, high);
        const FacePoint point = face_point({0, 1, 2}, edges, numbers.weights(), {true, true, true});
        const double distance = distance_over(point, from);
        for (size_t k = 0; k < 3; ++k) {
            wrong += distance > from[k] + point.straight[k] + 1e-12;
            wrong += distance < from[k] - point.straight[k] - 1e-12;
        }
        farther += distance > 0;
    }
    CHECK(wrong == 0);
    CHECK(farther > 5000);
}

TEST_CASE("face point: where the three distances agree on no place, it is right at all three corners") {
    const Flat face{{Vector2d(0, 0), Vector2d(1, 0), Vector2d(0.5, 0.9)}};
    // The straight way to the third corner over the first two is about 1.4 long.
    const std::array<double, 3> from{0.75, 0.75, 1.6};
    for (size_t k = 0; k < 3; ++k) {
        std::array<double, 3> weights{1e-9, 1e-9, 1e-9};
        weights[k] = 1 - 2e-9;
        const FacePoint point = face_point({0, 1, 2}, face.edge_lengths(), weights, {true, true, true});
        CHECK(distance_over(point, from) == doctest::Approx(from[k]).epsilon(1e-6));
    }
    // Without unfolding, a way leads over a corner.
    const FacePoint middle = face_point({0, 1, 2}, face.edge_lengths(), {0.5, 0.5, 0}, {});
    CHECK(distance_over(middle, from) == doctest::Approx(0.75 + 0.5));
}
