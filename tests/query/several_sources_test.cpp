// MSAD of several sources, whose distances meet between the vertices of borders.
#include <algorithm>
#include <cmath>
#include <random>

#include "tests/query/query_cases.h"
#include "tests/support/sanitized.h"

using namespace geodesic::test;

namespace {

geoidx_build_options overlay_options() {
    auto options = build_options(GEOIDX_METRIC_EXACT, 3);
    options.engine = GEOIDX_ENGINE_OVERLAY;
    return options;
}

// So many vertices around a random one.
std::vector<uint32_t> cluster(const TestMesh& mesh, uint32_t count, std::mt19937& random) {
    const uint32_t center = static_cast<uint32_t>(random() % mesh.vertex_count());
    std::vector<uint32_t> vertices(mesh.vertex_count());
    for (uint32_t v = 0; v < vertices.size(); ++v) vertices[v] = v;
    std::ranges::sort(vertices, {}, [&](uint32_t v) { return mesh.straight(center, v); });
    vertices.resize(8 * count);
    std::ranges::shuffle(vertices, random);
    vertices.resize(count);
    return vertices;
}

// A hub with long spokes to a rim, which has another ring of vertices around it.
TestMesh wheel(uint32_t spokes) {
    constexpr double TURN = 6.283185307179586;
    TestMesh mesh;
    mesh.add_vertex(0, 0, 0.2);
    for (uint32_t i = 0; i < spokes; ++i)
        mesh.add_vertex(std::cos(TURN * i / spokes), std::sin(TURN * i / spokes), 0);
    for (uint32_t i = 0; i < spokes; ++i)
        mesh.add_vertex(1.02 * std::cos(TURN * (i + 0.5) / spokes),
                        1.02 * std::sin(TURN * (i + 0.5) / spokes), -0.02);
    for (uint32_t i = 0; i < spokes; ++i) {
        const uint32_t next = (i + 1) % spokes;
        mesh.add_triangle(0, 1 + i, 1 + next);
        mesh.add_triangle(1 + i, 1 + spokes + i, 1 + next);
        mesh.add_triangle(1 + next, 1 + spokes + i, 1 + spokes + next);
    }
    return mesh;
}

std::vector<float> least_of_single_answers(const geoidx* index, const std::vector<uint32_t>& sources,
                                           uint32_t count) {
    std::vector<float> least(count, INFINITY);
    for (const uint32_t source : sources) {
        const auto alone = msad(index, source, count);
        for (uint32_t v = 0; v < count; ++v) least[v] = std::min(least[v], alone[v]);
    }
    return least;
}

struct Errors {
    double sum = 0, least = 0, largest = 0;
    uint64_t count = 0;
    void add(double answer, double expected) {
        if (expected == 0 && answer == 0) return;
        const double error = (answer - expected) / expected;
        sum += std::abs(error);
        least = std::min(least, error);
        largest = std::max(largest, error);
        ++count;
    }
    double mean() const { return sum / static_cast<double>(count); }
};

}

TEST_CASE("several sources: the nearest straight line on a plane" * doctest::skip(SANITIZED)) {
    const TestMesh mesh = grid(61, 51, 0.25);
    const uint32_t count = mesh.vertex_count();
    const auto index = shared_index(mesh, overlay_options());
    std::mt19937 random(5);
    for (uint32_t source_count : {2u, 5u, 20u, 100u}) {
        CAPTURE(source_count);
        Errors errors;
        for (int round = 0; round < 20; ++round) {
            const auto sources = cluster(mesh, source_count, random);
            const auto field = msad(index.get(), sources, count);
            for (uint32_t v = 0; v < count; ++v) {
                double nearest = INFINITY;
                for (uint32_t source : sources) nearest = std::min(nearest, mesh.straight(source, v));
                errors.add(double{field[v]}, nearest);
            }
        }
        CHECK(errors.mean() < 1e-3);
        CHECK(errors.least > -0.01);
        CHECK(errors.largest < 0.03);
    }
}

TEST_CASE("several sources: as exact as the nearest of them alone" * doctest::skip(SANITIZED)) {
    for (const auto& [name, made] : mesh_zoo()) {
        const TestMesh& mesh = made;
        CAPTURE(mesh.vertex_count());
        const uint32_t count = mesh.vertex_count();
        const auto index = shared_index(mesh, overlay_options());
        std::mt19937 random(7);
        for (const uint32_t source_count : {2u, 6u, 30u}) {
            CAPTURE(source_count);
            std::vector<uint32_t> sources;
            for (uint32_t i = 0; i < source_count; ++i)
                sources.push_back(static_cast<uint32_t>(random() % count));
            const auto least = least_of_single_answers(index.get(), sources, count);
            const auto field = msad(index.get(), sources, count);
            for (uint32_t v = 0; v < count; ++v) {
                CAPTURE(v);
                if (std::isinf(least[v]))
                    CHECK(field[v] == least[v]);
                else
                    CHECK(std::abs(field[v] - least[v]) <= 1e-3f * least[v]);
            }
        }
    }
}

TEST_CASE("several sources: many that are as near to the ends of a long segment") {
    const TestMesh mesh = wheel(400);
    const uint32_t count = mesh.vertex_count();
    const auto index = shared_index(mesh, default_options());
    std::mt19937 random(9);
    for (const uint32_t source_count : {40u, 40u, 40u, 64u, 64u, 64u, 200u}) {
        std::vector<uint32_t> sources;
        const uint32_t first = static_cast<uint32_t>(random() % count);
        for (uint32_t i = 0; i < source_count; ++i)
            sources.push_back(static_cast<uint32_t>((first + random() % (4 * source_count)) % count));
        const auto least = least_of_single_answers(index.get(), sources, count);
        const auto field = msad(index.get(), sources, count);
        size_t worse = 0;
        for (uint32_t v = 0; v < count; ++v) worse += field[v] > 1.001f * least[v];
        CHECK(worse == 0);
        std::ranges::reverse(sources);
        sources.insert(sources.end(), sources.begin(), sources.begin() + 20);
        std::ranges::shuffle(sources, random);
        CHECK(msad(index.get(), sources, count) == field);
    }
}

TEST_CASE("several sources: order and repetition change no bit") {
    for (const auto& [name, made] : mesh_zoo()) {
        const TestMesh& mesh = made;
        CAPTURE(mesh.vertex_count());
        const uint32_t count = mesh.vertex_count();
        const auto index = shared_index(mesh, overlay_options());
        const std::vector<uint32_t> sources{count / 2, 0, count - 1, count / 3};
        const auto field = msad(index.get(), sources, count);
        const std::vector<uint32_t> shuffled{count / 3, 0, 0, count - 1, count / 2, 0, count / 3};
        CHECK(field == msad(index.get(), shuffled, count));
        const std::vector<uint32_t> thrice{0, 0, 0};
        CHECK(msad(index.get(), thrice, count) == msad(index.get(), 0, count));
    }
}
