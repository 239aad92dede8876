// What is near to points of a surface: sources, vertices within a radius, targets that are points.
#include <algorithm>
#include <cmath>

#include "tests/capi/refusals.h"
#include "tests/path/path_cases.h"

using namespace geodesic::test;

namespace {

using Points = std::vector<geoidx_surface_point>;
using NearFirst = std::vector<std::pair<float, uint32_t>>; // in ascending order

constexpr float NOT_REACHED = std::numeric_limits<float>::infinity();

uint32_t count_of(const Points& points) { return static_cast<uint32_t>(points.size()); }

Points random_points(const PathCase& on, std::mt19937_64& random, size_t count) {
    Points points;
    for (size_t i = 0; i < count; ++i) points.push_back(random_point(on.soup, random, i));
    return points;
}

const float* pointer_to(const std::vector<float>& offsets) {
    return offsets.empty() ? nullptr : offsets.data();
}

std::vector<float> field_of(const PathCase& on, const Points& sources, const std::vector<float>& offsets) {
    std::vector<float> distances(on.soup.vertex_count());
    require_success(geoidx_query_point_msad(on.query.get(), on.surface.get(), sources.data(),
                                            count_of(sources), pointer_to(offsets), distances.data(),
                                            on.soup.vertex_count()));
    return distances;
}

// The fields of single sources.
std::vector<std::vector<float>> fields_of_each(const PathCase& on, const Points& sources,
                                               const std::vector<float>& offsets) {
    std::vector<std::vector<float>> fields;
    for (size_t i = 0; i < sources.size(); ++i)
        fields.push_back(field_of(on, {sources[i]}, offsets.empty() ? offsets : std::vector{offsets[i]}));
    return fields;
}

NearFirst within(const PathCase& on, const Points& sources, const std::vector<float>& offsets, float radius) {
    uint32_t count = 0, again = 0;
    require_success(geoidx_query_point_within(on.query.get(), on.surface.get(), sources.data(),
                                              count_of(sources), pointer_to(offsets), radius, nullptr,
                                              nullptr, 0, &count));
    std::vector<uint32_t> vertices(count, 7);
    std::vector<float> distances(count, -1);
    require_success(geoidx_query_point_within(on.query.get(), on.surface.get(), sources.data(),
                                              count_of(sources), pointer_to(offsets), radius, vertices.data(),
                                              distances.data(), count, &again));
    REQUIRE(again == count);
    NearFirst found;
    for (uint32_t i = 0; i < count; ++i) found.push_back({distances[i], vertices[i]});
    return found;
}

NearFirst nearest_points(const PathCase& on, const geoidx_surface_point& source, const Points& targets,
                         uint32_t wanted) {
    std::vector<uint32_t> positions(wanted, 7);
    std::vector<float> distances(wanted, -1);
    uint32_t count = 0;
    require_success(geoidx_query_point_nearest_targets(on.query.get(), on.surface.get(), &source,
                                                       targets.data(), count_of(targets), positions.data(),
                                                       distances.data(), wanted, &count));
    REQUIRE(count <= wanted);
    NearFirst found;
    for (uint32_t i = 0; i < count; ++i) found.push_back({distances[i], positions[i]});
    return found;
}

void check_within(const PathCase& on, const Points& sources, const std::vector<float>& offsets) {
    std::vector<float> least(on.soup.vertex_count(), NOT_REACHED);
    for (const auto& field : fields_of_each(on, sources, offsets))
        for (size_t v = 0; v < least.size(); ++v) least[v] = std::min(least[v], field[v]);
    NearFirst all;
    for (uint32_t v = 0; v < least.size(); ++v)
        if (least[v] < NOT_REACHED) all.push_back({least[v], v});
    std::ranges::sort(all);
    for (const float radius : {0.0f, all[all.size() / 20].first, all[all.size() / 3].first, NOT_REACHED}) {
        CAPTURE(radius);
        NearFirst expected;
        for (const auto& found : all)
            if (found.first <= radius) expected.push_back(found);
        CHECK(within(on, sources, offsets, radius) == expected);
    }
}

// The source that is named is as near as any, by the fields of single ones, up to `error`.
void check_nearest_sources(const PathCase& on, const Points& sources, const std::vector<float>& offsets,
                           double error) {
    const uint32_t count = on.soup.vertex_count();
    std::vector<uint32_t> nearest(count, 7);
    std::vector<float> distances(count, -1);
    require_success(geoidx_query_point_nearest_sources(on.query.get(), on.surface.get(), sources.data(),
                                                       count_of(sources), pointer_to(offsets), nearest.data(),
                                                       distances.data(), count));
    CHECK(distances == field_of(on, sources, offsets));
    const auto fields = fields_of_each(on, sources, offsets);
    for (uint32_t v = 0; v < count; ++v) {
        CAPTURE(v);
        REQUIRE((nearest[v] == GEOIDX_NO_SOURCE) == (distances[v] == NOT_REACHED));
        if (nearest[v] == GEOIDX_NO_SOURCE) continue;
        REQUIRE(nearest[v] < sources.size());
        double least = INFINITE;
        for (const auto& field : fields) least = std::min(least, double{field[v]});
        CHECK(double{fields[nearest[v]][v]} <= least * (1 + error) + 1e-6);
    }
}

// Exact distances in their order, and how far an answer may be off each.
struct ExactTargets {
    ExactTargets(const PathCase& on, const geoidx_surface_point& source, const Points& targets)
        : distance(targets.size()) {
        require_success(geoidx_solver_point_distances(on.solver.get(), &source, 1, targets.data(),
                                                      count_of(targets), distance.data()));
        for (size_t i = 0; i < targets.size(); ++i) {
            double width = 0;
            for (const auto* point : {&source, &targets[i]}) {
                const auto& t = on.soup.triangles[point->triangle];
                for (size_t k = 0; k < 3; ++k)
                    width =
                        std::max(width, (on.soup.positions[t[k]] - on.soup.positions[t[(k + 1) % 3]]).norm());
            }
            error.push_back(0.05 * distance[i] + 0.4 * width);
        }
    }

    std::vector<double> distance, error;
};

void check_nearest_targets(const PathCase& on, const geoidx_surface_point& source, const Points& targets,
                           uint32_t wanted) {
    const ExactTargets exact(on, source, targets);
    const NearFirst found = nearest_points(on, source, targets, wanted);
    const auto reachable = static_cast<size_t>(
        std::ranges::count_if(exact.distance, [](double distance) { return distance < INFINITE; }));
    CHECK(found.size() == std::min<size_t>(wanted, reachable));
    CHECK(std::ranges::is_sorted(found));
    std::vector<bool> is_found(targets.size(), false);
    for (const auto& [distance, position] : found) {
        REQUIRE(position < targets.size());
        CHECK(!is_found[position]);
        is_found[position] = true;
        CHECK(std::abs(double{distance} - exact.distance[position]) <= exact.error[position]);
    }
    if (found.empty()) return;
    for (size_t i = 0; i < targets.size(); ++i)
        if (!is_found[i]) CHECK(exact.distance[i] + exact.error[i] >= double{found.back().first});
}

const PathCase& many_patches() {
    static const PathCase on = [] {
        geoidx_build_options options = path_options();
        options.level_count = 3;
        for (size_t level = 0; level < 3; ++level) options.patches[level] = 4;
        return PathCase(bumpy_sphere(4, 3), options);
    }();
    return on;
}

template <class Check>
void for_each_engine_and_soup(const Check& check) {
    for (const uint32_t engine : {GEOIDX_ENGINE_OVERLAY, GEOIDX_ENGINE_GRAPH}) {
        size_t number = 0;
        for (const Soup& soup : path_soups()) {
            CAPTURE(engine);
            CAPTURE(number);
            check(PathCase(soup, path_options(engine)), ++number);
        }
    }
}

}

TEST_CASE("near points: the vertices within a radius are those of fields, in their order") {
    for_each_engine_and_soup([](const PathCase& on, uint64_t seed) {
        std::mt19937_64 random(seed);
        for (const size_t count : {1u, 4u}) {
            const Points sources = random_points(on, random, count);
            check_within(on, sources, {});
            check_within(on, sources, std::vector<float>(count, 0.25f));
        }
    });
    for_each_stress_case([](const PathCase& on) {
        std::mt19937_64 random(5);
        check_within(on, random_points(on, random, 3), {0, 0.1f, 0.3f});
    });
}

TEST_CASE("near points: on a mesh of many patches, and only as far as the radius") {
    const PathCase& on = many_patches();
    std::mt19937_64 random(6);
    for (size_t i = 0; i < 4; ++i) check_within(on, random_points(on, random, 1 + i), {});
}

TEST_CASE("near points: the nearest source is one of the least field") {
    for_each_engine_and_soup([](const PathCase& on, uint64_t seed) {
        std::mt19937_64 random(seed);
        for (const size_t count : {1u, 2u, 7u}) {
            const Points sources = random_points(on, random, count);
            std::vector<float> offsets;
            for (size_t i = 0; i < count; ++i) offsets.push_back(static_cast<float>(uniform(random, 0, 0.3)));
            check_nearest_sources(on, sources, {}, 0.05);
            check_nearest_sources(on, sources, offsets, 0.05);
        }
    });
}

TEST_CASE("near points: of sources at one vertex the first is named") {
    const PathCase on(bumpy_sphere(3, 3));
    const geoidx_surface_point at{5, 0, {0, 1, 0}}, far{400, 0, {0.3, 0.3, 0.4}};
    const Points sources{at, at, far, at};
    check_nearest_sources(on, sources, {}, 0.02);
    std::vector<uint32_t> nearest(on.soup.vertex_count());
    require_success(geoidx_query_point_nearest_sources(on.query.get(), on.surface.get(), sources.data(), 4,
                                                       nullptr, nearest.data(), nullptr,
                                                       on.soup.vertex_count()));
    CHECK(nearest[on.soup.triangles[5][1]] == 0);
    CHECK(nearest[on.soup.triangles[400][0]] == 2);
    CHECK(std::ranges::count(nearest, 1u) + std::ranges::count(nearest, 3u) == 0);
}

TEST_CASE("near points: the nearest targets, few and many, of all and of some") {
    for_each_engine_and_soup([](const PathCase& on, uint64_t seed) {
        std::mt19937_64 random(seed);
        for (const size_t count : {1u, 5u, 90u})
            for (const uint32_t wanted : {1u, 4u, 100u})
                check_nearest_targets(on, random_point(on.soup, random, seed),
                                      random_points(on, random, count), wanted);
    });
}

TEST_CASE("near points: a few of many targets on a mesh of many patches") {
    const PathCase& on = many_patches();
    std::mt19937_64 random(9);
    const Points targets = random_points(on, random, 700);
    for (size_t i = 0; i < 12; ++i)
        check_nearest_targets(on, random_point(on.soup, random, i), targets, 1 + static_cast<uint32_t>(i));
}

// What tells of a point beside a spike reaches to its far end.
TEST_CASE("near points: the nearest target beside a long triangle is found") {
    Soup soup = grid(6, 6, 6, 6);
    const auto spike = soup.vertex_count();
    soup.positions.emplace_back(-100, 0.5, 0);
    soup.triangles.push_back({0, spike, 7});
    const PathCase on(soup);
    std::mt19937_64 random(4);
    Points targets;
    for (uint32_t t = 0; t + 1 < soup.triangles.size(); ++t) targets.push_back({t, 0, {0.3, 0.3, 0.4}});
    for (uint32_t t = 0; t + 1 < soup.triangles.size(); t += 2) {
        CAPTURE(t);
        const geoidx_surface_point source{t, 0, {0.2, 0.2, 0.6}};
        const NearFirst found = nearest_points(on, source, targets, 1);
        REQUIRE(found.size() == 1);
        CHECK(found[0].second == t);
    }
}

// Sums that are no floats any more are no distances.
TEST_CASE("near points: what is farther than floats reach is not within any radius") {
    Soup soup = grid(3, 3, 6e37, 6e37);
    const PathCase on(std::move(soup));
    const Points source{{3, 0, {0.2, 0.3, 0.5}}};
    CHECK(within(on, source, {3.4e38f}, NOT_REACHED).empty());
}

TEST_CASE("near points: bad input is refused by name") {
    const PathCase on(jittered_grid(8, 5));
    geoidx_query* const query = on.query.get();
    const geoidx_surface* const surface = on.surface.get();
    const geoidx_surface_point good{0, 0, {0.5, 0.25, 0.25}}, outside{0, 0, {0.5, 0.75, -0.25}},
        none{1000000, 0, {1, 0, 0}};
    uint32_t which[4] = {}, count = 9;
    float distances[4] = {};
    const float negative = -1;
    const auto refused = [](geoidx_status status, const char* detail) {
        check_refused(status, GEOIDX_ERROR_INVALID_ARGUMENT, detail);
    };
    refused(geoidx_query_point_within(query, surface, &outside, 1, nullptr, 1, which, distances, 4, &count),
            "source 0 has the weight");
    CHECK(count == 0);
    refused(geoidx_query_point_within(query, surface, &good, 0, nullptr, 1, which, distances, 4, &count),
            "there is no source");
    refused(geoidx_query_point_within(query, surface, &good, 1, &negative, 1, which, distances, 4, &count),
            "an offset is negative");
    refused(geoidx_query_point_within(query, surface, &good, 1, nullptr, -1, which, distances, 4, &count),
            "the radius is negative");
    refused(geoidx_query_point_within(query, surface, &good, 1, nullptr, 1, nullptr, distances, 4, &count),
            "vertices is NULL");
    refused(geoidx_query_point_within(query, nullptr, &good, 1, nullptr, 1, which, distances, 4, &count),
            "surface is NULL");
    refused(geoidx_query_point_within(query, surface, &good, 1, nullptr, 1, which, distances, 4, nullptr),
            "count is NULL");
    refused(geoidx_query_point_nearest_sources(query, surface, &good, 1, nullptr, which, distances, 4),
            "vertex_count is 4");
    refused(geoidx_query_point_nearest_sources(query, surface, nullptr, 1, nullptr, which, distances, 4),
            "sources is NULL");
    refused(geoidx_query_point_nearest_targets(query, surface, &good, &none, 1, which, distances, 4, &count),
            "target 0 is on triangle 1000000");
    refused(geoidx_query_point_nearest_targets(query, surface, &none, &good, 1, which, distances, 4, &count),
            "source is on triangle 1000000");
    refused(
        geoidx_query_point_nearest_targets(query, surface, &good, nullptr, 1, which, distances, 4, &count),
        "targets is NULL");
    require_success(
        geoidx_query_point_nearest_targets(query, surface, &good, nullptr, 0, which, distances, 4, &count));
    CHECK(count == 0);
    const PathCase other(jittered_grid(9, 5));
    CHECK(geoidx_query_point_within(query, other.surface.get(), &good, 1, nullptr, 1, which, distances, 4,
                                    &count) == GEOIDX_ERROR_MESH_MISMATCH);
}
