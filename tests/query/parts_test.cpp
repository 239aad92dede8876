// Meshes of several parts, by both engines with default options: no path leads from one part to another.
#include <cmath>
#include <cstdlib>
#include <random>
#include <string>

#include "tests/query/query_cases.h"
#include "tests/support/meshes.h"
#include "tests/support/sanitized.h"

using namespace geodesic::test;

namespace {

constexpr uint64_t PAIRS = 20000 / sparse(1); // of each mesh

// Which part each vertex belongs to; parts are joined one after the other.
struct Parts {
    Soup soup;
    std::vector<uint32_t> part_of;

    void add(const Soup& part) {
        const uint32_t number = part_of.empty() ? 0 : part_of.back() + 1;
        soup = part_of.empty() ? part : joined(soup, part);
        part_of.resize(soup.vertex_count(), number);
    }
};

Soup scaled(Soup soup, double factor, double shift) {
    for (Eigen::Vector3d& p : soup.positions) p = p * factor + Eigen::Vector3d(shift, 0, 0);
    return soup;
}

Parts sphere_with_small_ones() {
    Parts parts;
    parts.add(sphere(4));
    parts.add(scaled(sphere(2), 0.1, 2));
    parts.add(scaled(sphere(1), 0.05, -2));
    return parts;
}

Parts random_terrains(uint64_t seed) {
    std::mt19937_64 random(seed);
    Parts parts;
    const uint32_t count = 2 + static_cast<uint32_t>(seed % 4);
    for (uint32_t i = 0; i < count; ++i) {
        const auto cells = static_cast<uint32_t>(uniform(random, 2, 26));
        parts.add(scaled(jittered_grid(cells, seed * 8 + i), uniform(random, 0.5, 4), 5.0 * i));
    }
    return parts;
}

// Answers of one query object one after the other, so that what an earlier pair left behind would show.
uint64_t wrongly_reached_pairs(const Parts& parts, uint32_t engine, uint64_t pairs) {
    geoidx_mesh mesh = view_of(parts.soup);
    geoidx_build_options options;
    geoidx_build_options_init(&options);
    options.engine = engine;
    geoidx* raw = nullptr;
    REQUIRE(geoidx_build(&mesh, &options, &raw) == GEOIDX_OK);
    const IndexHandle index(raw);
    std::mt19937_64 random(7);
    std::vector<uint32_t> ids(2 * pairs);
    for (uint32_t& id : ids) id = static_cast<uint32_t>(random() % parts.soup.vertex_count());
    std::vector<float> distances(pairs);
    REQUIRE(geoidx_sssd_batch(raw, ids.data(), pairs, distances.data()) == GEOIDX_OK);
    uint64_t wrong = 0;
    for (uint64_t i = 0; i < pairs; ++i) {
        const uint32_t a = ids[2 * i], b = ids[2 * i + 1];
        float alone = -1;
        REQUIRE(geoidx_sssd(raw, a, b, &alone) == GEOIDX_OK);
        const bool is_reached = parts.part_of[a] == parts.part_of[b];
        wrong += std::isfinite(distances[i]) != is_reached || alone != distances[i];
    }
    return wrong;
}

// So many sets of terrains, or as many as the environment asks for; docs/figures.md has a longer run.
uint64_t sets_of_terrains() {
    const char* asked = std::getenv("GEOIDX_PART_SETS");
    return asked ? std::stoull(asked) : smaller(8, 4);
}

}

TEST_CASE("several parts: pairs are infinitely far apart exactly if no path joins them") {
    for (const uint32_t engine : {GEOIDX_ENGINE_OVERLAY, GEOIDX_ENGINE_GRAPH}) {
        CAPTURE(engine);
        CHECK(wrongly_reached_pairs(sphere_with_small_ones(), engine, PAIRS) == 0);
        for (uint64_t seed = 0; seed < sets_of_terrains(); ++seed) {
            CAPTURE(seed);
            CHECK(wrongly_reached_pairs(random_terrains(seed), engine, PAIRS) == 0);
        }
    }
}
