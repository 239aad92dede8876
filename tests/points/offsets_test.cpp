// Fields from points that begin with an offset, compared with the exact metric.
#include <algorithm>
#include <cmath>

#include "tests/capi/refusals.h"
#include "tests/path/path_cases.h"
#include "tests/points/point_cases.h"
#include "tests/support/sanitized.h"

using namespace geodesic;
using namespace geodesic::test;

TEST_CASE("points: fields from one and from several, with offsets" * doctest::skip(SANITIZED)) {
    for (const uint32_t engine : {GEOIDX_ENGINE_OVERLAY, GEOIDX_ENGINE_GRAPH})
        for (const Soup& soup : {bumpy_sphere(4, 3), joined(comb(1), torus(40, 22, 1, 0.4))}) {
            const PathCase on(soup, path_options(engine));
            std::mt19937_64 random(9);
            const geoidx_surface_point sources[] = {
                random_point(soup, random, 0), random_point(soup, random, 3), random_point(soup, random, 2)};
            const float offsets[] = {0.1f, 0, 0.25f};
            std::vector<double> nearest(soup.vertex_count(), INFINITE);
            for (size_t s = 0; s < 3; ++s) {
                const auto exact = on.exact_field(sources[s]);
                const auto one = field(on, {&sources[s], 1});
                MeanError error;
                for (uint32_t v = 0; v < soup.vertex_count(); ++v) {
                    nearest[v] = std::min(nearest[v], exact[v] + double{offsets[s]});
                    CHECK((exact[v] == INFINITE) == (double{one[v]} == INFINITE));
                    if (exact[v] < INFINITE) error.add(one[v], exact[v]);
                }
                CHECK(error.mean() < 2.5e-2);
            }
            const auto all = field(on, sources, offsets);
            MeanError error;
            for (uint32_t v = 0; v < soup.vertex_count(); ++v) {
                CHECK((nearest[v] == INFINITE) == (double{all[v]} == INFINITE));
                if (nearest[v] < INFINITE) error.add(all[v], nearest[v]);
            }
            CHECK(error.mean() < 2.5e-2);
        }
}

// Ways from each source are unfolded over borders without its offset: one that begins later is no farther
// away.
TEST_CASE("points: fields from sources with offsets are as exact as those without") {
    const PathCase on(prism(smaller(80, 40), 5, 8));
    std::mt19937_64 random(12);
    for (size_t i = 0; i < smaller(12, 3); ++i) {
        CAPTURE(i);
        std::vector<geoidx_surface_point> sources;
        std::vector<float> offsets;
        std::vector<double> nearest(on.soup.vertex_count(), INFINITE);
        for (size_t s = 0; s < 8; ++s) {
            sources.push_back(random_point(on.soup, random, s % 2 == 0 ? 0 : 3));
            offsets.push_back(static_cast<float>(uniform(random, 0, 2)));
            const auto exact = on.exact_field(sources.back());
            for (uint32_t v = 0; v < nearest.size(); ++v)
                nearest[v] = std::min(nearest[v], exact[v] + double{offsets.back()});
        }
        const auto answers = field(on, sources, offsets.data());
        for (uint32_t v = 0; v < nearest.size(); ++v)
            CHECK(double{answers[v]} == doctest::Approx(nearest[v]).epsilon(0.015));
        REQUIRE(geoidx_query_set_threads(on.query.get(), 2) == GEOIDX_OK);
        CHECK(field(on, sources, offsets.data()) == answers);
        REQUIRE(geoidx_query_set_threads(on.query.get(), 1) == GEOIDX_OK);
        // Of a source that is given again and begins later, nothing is seen.
        const auto count = static_cast<uint32_t>(sources.size());
        for (uint32_t s = 0; s < count; ++s) {
            sources.push_back(sources[s]);
            offsets.push_back(offsets[s] + 0.25f);
        }
        std::vector<uint32_t> named(nearest.size());
        std::vector<float> distances(nearest.size());
        require_success(geoidx_query_point_nearest_sources(on.query.get(), on.surface.get(), sources.data(),
                                                           2 * count, offsets.data(), named.data(),
                                                           distances.data(), on.soup.vertex_count()));
        CHECK(distances == answers);
        CHECK(std::ranges::max(named) < count);
    }
}

// Pairs of vertices that tables have wrong were measured.
TEST_CASE("points: vertices with offsets have their measured pairs") {
    const PathCase on(bumpy_sphere(smaller(4, 3), 3));
    std::mt19937_64 random(13);
    for (size_t i = 0; i < 20; ++i) {
        CAPTURE(i);
        const geoidx_surface_point sources[] = {random_point(on.soup, random, 3),
                                                random_point(on.soup, random, 3)};
        constexpr float LATER = 0.125f;
        const float offsets[] = {LATER, 0};
        const auto first = field(on, {&sources[0], 1}), second = field(on, {&sources[1], 1}),
                   both = field(on, sources, offsets);
        for (uint32_t v = 0; v < on.soup.vertex_count(); ++v)
            CHECK(double{both[v]} ==
                  doctest::Approx(double{std::min(first[v] + LATER, second[v])}).epsilon(2e-3));
    }
}

// Bit for bit: an offset that all sources have takes no part in how ways are unfolded over borders.
TEST_CASE("points: an offset that all sources have is added to their distances" * doctest::skip(SANITIZED)) {
    for (const uint32_t engine : {GEOIDX_ENGINE_OVERLAY, GEOIDX_ENGINE_GRAPH})
        for (const Soup& soup : {grid(20, 20, 1, 1), joined(comb(1), torus(40, 22, 1, 0.4))}) {
            const PathCase on(soup, path_options(engine));
            std::mt19937_64 random(11);
            for (const float offset : {0.01f, 0.3f, 1000.0f, 1e9f}) {
                const geoidx_surface_point sources[] = {random_point(soup, random, 3),
                                                        random_point(soup, random, 0),
                                                        random_point(soup, random, 2)};
                const float offsets[] = {offset, offset, offset};
                const std::span<const geoidx_surface_point> all(sources);
                for (const auto& some : {all.first(1), all.subspan(1, 1), all}) {
                    auto expected = field(on, some);
                    for (float& distance : expected) distance += offset;
                    CHECK(field(on, some, offsets) == expected);
                    std::vector<uint32_t> nearest(soup.vertex_count()), without = nearest;
                    std::vector<float> distances(soup.vertex_count());
                    const auto ask = [&](const float* begun, uint32_t* found, float* distance) {
                        require_success(geoidx_query_point_nearest_sources(
                            on.query.get(), on.surface.get(), some.data(), static_cast<uint32_t>(some.size()),
                            begun, found, distance, soup.vertex_count()));
                    };
                    ask(offsets, nearest.data(), distances.data());
                    ask(nullptr, without.data(), nullptr);
                    CHECK(distances == expected);
                    CHECK(nearest == without);
                }
            }
        }
}
