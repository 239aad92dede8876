// What an index states of its errors by distance and of several sources, against all pairs or a sample of
// them that the builder did not choose.
#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstring>
#include <limits>

#include "src/build/errors_by_distance.h"
#include "tests/capi/calls.h"
#include "tests/support/sanitized.h"

using namespace geodesic::test;

namespace {

constexpr uint32_t ENGINES[] = {GEOIDX_ENGINE_GRAPH, GEOIDX_ENGINE_OVERLAY};
constexpr double ANSWER_ROUNDING = 1e-6; // of answers, which are floats

geoidx_build_options options_for(uint32_t engine, uint32_t metric = GEOIDX_METRIC_EXACT) {
    auto options = build_options(metric);
    options.engine = engine;
    return options;
}

struct Class {
    uint64_t answers = 0, worse_than_stated = 0;
    double sum = 0, max = 0; // of MSAD; of MSAD and SSSD
};

// The errors of every step-th source, near, middle and far. Of the graph engine, whose pairs take long, an
// eighth of them is asked for.
std::array<Class, 3> errors_of(const geoidx* index, const TestMesh& mesh, uint32_t step) {
    const uint32_t count = mesh.vertex_count();
    const double edge = average_edge(mesh);
    const geoidx_info info = info_of(index);
    const double stated[] = {info.error_near_max, info.error_middle_max, info.error_far_max};
    const auto metric = solver(mesh, build_options());
    std::array<Class, 3> classes;
    for (uint32_t source = step / 2; source < count; source += step) {
        const auto exact = metric_distances(metric.get(), source, count);
        const auto field = msad(index, source, count);
        for (uint32_t v = 0; v < count; ++v) {
            if (exact[v] == 0 || std::isinf(exact[v])) continue;
            const size_t i = exact[v] <= 10 * edge ? 0 : exact[v] <= 100 * edge ? 1 : 2;
            const double of_field = std::abs(double{field[v]} - exact[v]) / exact[v];
            classes[i].sum += of_field;
            ++classes[i].answers;
            const auto note = [&](double error) {
                classes[i].worse_than_stated += error > stated[i] + ANSWER_ROUNDING;
                classes[i].max = std::max(classes[i].max, error);
            };
            note(of_field);
            if (info.engine == GEOIDX_ENGINE_OVERLAY || (v + source / step) % 8 == 0)
                note(std::abs(double{sssd(index, source, v)} - exact[v]) / exact[v]);
        }
    }
    return classes;
}

void check_consistent(const geoidx_info& info) {
    const double largest = std::max({info.error_near_max, info.error_middle_max, info.error_far_max});
    CHECK(info.error_max == largest);
    const double means[] = {info.error_near_mean, info.error_middle_mean, info.error_far_mean};
    CHECK(info.error_mean <= *std::ranges::max_element(means) + 1e-12);
    CHECK(info.error_near_mean <= info.error_near_max);
    CHECK(info.error_middle_mean <= info.error_middle_max);
    CHECK(info.error_far_mean <= info.error_far_max);
    CHECK(info.error_several_mean <= info.error_several_max);
    for (const double error : {info.error_near_max, info.error_middle_max, info.error_far_max,
                               info.error_several_mean, info.error_several_max})
        CHECK((error >= 0 && error < 1e3));
}

}

TEST_CASE("stated errors: of few vertices, the largest near error is nearly that of all pairs") {
    for (const TestMesh& mesh : {grid(11, 10), hills(12, 13)}) {
        const auto index = shared_index(mesh, options_for(GEOIDX_ENGINE_OVERLAY));
        const geoidx_info info = info_of(index.get());
        check_consistent(info);
        const auto classes = errors_of(index.get(), mesh, 1);
        CHECK(info.error_near_max <= classes[0].max * (1 + 1e-5));
        CHECK(info.error_near_max > classes[0].max / 2);
        CHECK(info.error_near_mean ==
              doctest::Approx(classes[0].sum / double(classes[0].answers)).epsilon(0.5));
    }
}

TEST_CASE("stated errors: hardly any pair that the builder did not choose is worse" *
          doctest::skip(SANITIZED)) {
    for (const uint32_t engine : ENGINES)
        for (const TestMesh& mesh : {torus(60, 30), hills(45, 40)}) {
            CAPTURE(engine);
            auto options = options_for(engine);
            options.target_error = 0;
            const auto index = shared_index(mesh, options);
            const geoidx_info info = info_of(index.get());
            check_consistent(info);
            const auto classes = errors_of(index.get(), mesh, 11);
            REQUIRE(classes[0].answers > 20000);
            CHECK(classes[0].worse_than_stated <= classes[0].answers / 10000);
            CHECK(classes[1].worse_than_stated <= classes[1].answers / 1000);
            // It is an error that there is: no pair is many times better than the stated one.
            CHECK(info.error_near_max < 3 * classes[0].max);
        }
}

TEST_CASE("stated errors: of all fields, one distance in a million is worse, and none of several sources" *
          doctest::skip(SANITIZED)) {
    for (const TestMesh& mesh : {hills(36, 32), sphere(24, 40)}) {
        const auto index = shared_index(mesh, options_for(GEOIDX_ENGINE_OVERLAY));
        const geoidx_info info = info_of(index.get());
        check_consistent(info);
        const double stated[] = {info.error_near_max, info.error_middle_max, info.error_far_max};
        const uint32_t count = mesh.vertex_count();
        const double edge = average_edge(mesh);
        const auto metric = solver(mesh, build_options());
        uint64_t answers = 0, worse = 0, worse_than_several = 0;
        for (uint32_t source = 0; source < count; ++source) {
            const auto exact = metric_distances(metric.get(), source, count);
            const auto field = msad(index.get(), source, count);
            for (uint32_t v = 0; v < count; ++v) {
                if (exact[v] == 0) continue;
                const double error = std::abs(double{field[v]} - exact[v]) / exact[v];
                const size_t i = exact[v] <= 10 * edge ? 0 : exact[v] <= 100 * edge ? 1 : 2;
                worse += error > stated[i] + ANSWER_ROUNDING;
                worse_than_several += error > info.error_several_max + ANSWER_ROUNDING;
                ++answers;
            }
        }
        CAPTURE(answers);
        CHECK(worse <= answers / 1000000 + 1);
        CHECK(worse_than_several <= answers / 1000000 + 1);
    }
}

// Leaves, gravel or bolts: each part lies in one leaf, whose tables are as right in both directions, so that
// no pair is worse than others. There are more vertices than are compared with all others.
TEST_CASE("stated errors: of many small parts, there are none but rounding") {
    TestMesh mesh;
    for (uint32_t part = 0; part < 60; ++part) append(mesh, grid(8, 8, 0.2), 10.0 * part);
    const auto index = shared_index(mesh, default_options());
    const geoidx_info info = info_of(index.get());
    check_consistent(info);
    CHECK(info.error_max < 0.01);
    const auto classes = errors_of(index.get(), mesh, 31);
    REQUIRE(classes[0].answers > 5000);
    CHECK(classes[0].worse_than_stated == 0);
    CHECK(classes[0].max < 0.01);
}

TEST_CASE("stated errors: the largest of a part lets expect a larger one, by how far large ones lie apart") {
    using geodesic::ErrorSum;
    ErrorSum all;
    CHECK(all.expected_largest() == 0);
    const auto add_part = [&all](double error) {
        ErrorSum part;
        part.add_to_max(error / 2);
        part.add_to_max(error);
        all.add(part);
    };
    add_part(3);
    CHECK(all.expected_largest() == 3);
    add_part(4);
    CHECK(all.expected_largest() == 4 + 1);
    add_part(5);
    CHECK(all.expected_largest() == 5 + (2 + 1) / 2.0);
    for (int i = 0; i < 20; ++i) add_part(5);
    CHECK(all.largest() == 5);
    CHECK(all.expected_largest() == 5);
    for (int i = 0; i < 9; ++i) add_part(6 + i);
    CHECK(all.expected_largest() == doctest::Approx(14 + (1 + 2 + 3 + 4 + 5 + 6 + 7 + 8 + 9) / 9.0));
    for (int i = 0; i < 2; ++i) add_part(std::numeric_limits<double>::infinity());
    CHECK(std::isinf(all.expected_largest()));
}

TEST_CASE("stated errors: three classes of distances, and nothing of those that a mesh does not have") {
    const TestMesh strip = grid(240, 3), small = grid(8, 8);
    for (const uint32_t engine : ENGINES) {
        CAPTURE(engine);
        const auto index = shared_index(strip, options_for(engine));
        const geoidx_info info = info_of(index.get());
        check_consistent(info);
        const auto classes = errors_of(index.get(), strip, 5);
        const double stated[] = {info.error_near_mean, info.error_middle_mean, info.error_far_mean};
        for (size_t i = 0; i < 3; ++i)
            CHECK(stated[i] == doctest::Approx(classes[i].sum / double(classes[i].answers)).epsilon(0.6));
        CHECK(info.error_far_max > 0);
        const geoidx_info few = info_of(build(small, options_for(engine)).get());
        CHECK(few.error_far_mean == 0);
        CHECK(few.error_far_max == 0);
        check_consistent(few);
    }
}

TEST_CASE("stated errors: several parts, vertices at the same place, unused ones, and a single triangle") {
    TestMesh parts = hills(14, 13);
    parts.add_vertex(70, 0, 0);
    append(parts, seam(9, 8), 100);
    append(parts, sphere(7, 12), 200);
    std::vector<double> costs(parts.triangle_count());
    for (size_t t = 0; t < costs.size(); ++t) costs[t] = 1 + static_cast<double>(t % 5);
    for (const uint32_t engine : ENGINES)
        for (const uint32_t metric : {GEOIDX_METRIC_EXACT, GEOIDX_METRIC_EDGES, GEOIDX_METRIC_WEIGHTED}) {
            CAPTURE(engine);
            CAPTURE(metric);
            auto options = options_for(engine, metric);
            const bool is_weighted = metric == GEOIDX_METRIC_WEIGHTED;
            options.face_costs = is_weighted ? costs.data() : nullptr;
            options.face_cost_count = is_weighted ? costs.size() : 0;
            const geoidx_info info = info_of(build(parts, options).get());
            check_consistent(info);
            CHECK(info.error_several_max > 0);
            options.face_cost_count = is_weighted ? 1 : 0;
            const geoidx_info least = info_of(build(one_triangle(), options).get());
            check_consistent(least);
            CHECK(least.error_near_max < 1e-4);
            CHECK(least.error_several_max < 1e-4);
            CHECK(least.error_middle_max == 0);
        }
}

TEST_CASE("stated errors: added vertices are not compared, and the index that is kept is measured") {
    const TestMesh mesh = hills(26, 24);
    auto options = options_for(GEOIDX_ENGINE_OVERLAY);
    options.target_error = 1e-6;
    const auto index = shared_index(mesh, options);
    const geoidx_info info = info_of(index.get());
    REQUIRE(info.added_vertex_count > 0);
    check_consistent(info);
    const auto classes = errors_of(index.get(), mesh, 3);
    CHECK(classes[0].worse_than_stated <= classes[0].answers / 10000);
    CHECK(info.error_near_max < 3 * classes[0].max);
}

TEST_CASE("stated errors: of several sources, about those of random ones" * doctest::skip(SANITIZED)) {
    const TestMesh mesh = hills(30, 30);
    const uint32_t count = mesh.vertex_count();
    for (const uint32_t engine : ENGINES) {
        CAPTURE(engine);
        const auto index = shared_index(mesh, options_for(engine));
        const geoidx_info info = info_of(index.get());
        const auto metric = solver(mesh, build_options());
        double sum = 0, answers = 0;
        for (uint32_t round = 0; round < 30; ++round) {
            std::vector<uint32_t> sources;
            for (uint32_t i = 0; i < (round % 2 ? 2 : 16); ++i)
                sources.push_back((round * 7919 + i * 104729) % count);
            const auto exact = metric_distances(metric.get(), sources, count);
            const auto field = msad(index.get(), sources, count);
            for (uint32_t v = 0; v < count; ++v)
                if (exact[v] > 0) {
                    sum += std::abs(double{field[v]} - exact[v]) / exact[v];
                    ++answers;
                }
        }
        CHECK(info.error_several_mean > sum / answers / 3);
        CHECK(info.error_several_mean < sum / answers * 3);
        CHECK(info.error_several_max > info.error_several_mean);
    }
}

namespace {

// A plane's metric, which counts how often it is asked while errors are measured.
struct Plane {
    TestMesh mesh = grid(24, 23);
    std::atomic<bool> measures = false;
    std::atomic<uint32_t> fields = 0;

    static geoidx_status distances(void* user, uint32_t source, const uint32_t* targets, uint32_t count,
                                   double* distances) {
        auto& plane = *static_cast<Plane*>(user);
        plane.fields += plane.measures;
        for (uint32_t i = 0; i < count; ++i) distances[i] = plane.mesh.straight(source, targets[i]);
        return GEOIDX_OK;
    }
    static int32_t progress(void* user, float, const char* stage) {
        static_cast<Plane*>(user)->measures = std::string(stage) == "accuracy";
        return 1;
    }
};

}

TEST_CASE("stated errors: a callback is asked for few more fields") {
    for (const uint32_t engine : ENGINES) {
        CAPTURE(engine);
        Plane plane;
        auto options = options_for(engine, GEOIDX_METRIC_CALLBACK);
        options.metric_callback = Plane::distances;
        options.metric_user = options.progress_user = &plane;
        options.progress = Plane::progress;
        const auto index = build(plane.mesh, options);
        const geoidx_info info = info_of(index.get());
        check_consistent(info);
        CHECK(info.error_near_max > 0);
        CHECK(info.error_several_max > 0);
        CHECK(plane.fields.load() > info.error_sources);
        CHECK(plane.fields.load() <= info.error_sources + 40);
    }
}

TEST_CASE("stated errors: the same whatever the threads, and others with another seed" *
          doctest::skip(SANITIZED)) {
    const TestMesh mesh = hills(18, 17);
    for (const uint32_t engine : ENGINES)
        for (const uint32_t metric : {GEOIDX_METRIC_EXACT, GEOIDX_METRIC_EDGES}) {
            CAPTURE(engine);
            auto options = options_for(engine, metric);
            const geoidx_info first = info_of(build(mesh, options).get());
            for (const uint32_t threads : {1u, 5u}) {
                options.threads = threads;
                const geoidx_info again = info_of(build(mesh, options).get());
                CHECK(std::memcmp(&first, &again, sizeof first) == 0);
            }
            options.seed = 99;
            const geoidx_info other = info_of(build(mesh, options).get());
            CHECK(other.error_several_mean != first.error_several_mean);
        }
}

TEST_CASE("stated errors: every form of file keeps them") {
    for (const uint32_t engine : ENGINES) {
        const auto built = shared_index(hills(12, 12), options_for(engine));
        const geoidx_info before = info_of(built.get()), after = info_of(open(save(built.get())).get());
        constexpr size_t BEGIN = offsetof(geoidx_info, error_near_mean);
        CHECK(std::memcmp(&before.error_near_mean, &after.error_near_mean, sizeof before - BEGIN) == 0);
        CHECK(before.error_max == after.error_max);
    }
}
