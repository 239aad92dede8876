// Vertices are added to borders where the index would be less exact than asked for, and nowhere else.
#include <algorithm>
#include <cmath>
#include <limits>

#include "tests/build/errors.h"
#include "tests/build/test_mesh_of.h"
#include "tests/capi/refusals.h"
#include "tests/support/edge_lengths.h"
#include "tests/support/sanitized.h"

using namespace geodesic::test;

namespace {

geoidx_build_options options_with(double target_error) {
    auto options = build_options(GEOIDX_METRIC_EXACT, 0);
    options.engine = GEOIDX_ENGINE_OVERLAY;
    options.target_error = target_error;
    return options;
}

// Few large triangles on a strongly curved surface.
TestMesh rough() { return hills(smaller(26, 17), smaller(24, 16)); }

// Several parts, vertices at the same place, triangles that are degenerate or there twice, unused vertices,
// and a fin, where three triangles meet at an edge.
TestMesh dirty_hills() {
    TestMesh mesh;
    mesh.add_vertex(-50, 0, 0);
    append(mesh, rough(), 0);
    append(mesh, seam(15, 11), 100);
    append(mesh, sphere(7, 12), 200);
    mesh.add_vertex(300, 0, 0);
    for (size_t t = 0; t < 30; t += 3) {
        const std::vector<uint32_t> corners(mesh.triangles.begin() + 90, mesh.triangles.begin() + 120);
        mesh.add_triangle(corners[t], corners[t + 1], corners[t + 2]);
        mesh.add_triangle(corners[t], corners[t + 1], corners[t]);
        const uint32_t tip = mesh.add_vertex(4 + static_cast<double>(t), 3, 5);
        mesh.add_triangle(corners[t], corners[t + 1], tip);
    }
    return mesh;
}

struct Told {
    size_t cancel_at = SIZE_MAX; // the number of the call that returns 0
    std::vector<float> fractions;
    std::vector<std::string> stages;

    static int32_t tell(void* user, float fraction, const char* stage) {
        auto& told = *static_cast<Told*>(user);
        told.fractions.push_back(fraction);
        told.stages.push_back(stage);
        return told.fractions.size() <= told.cancel_at;
    }
};

// From sources that the builder did not choose.
Errors errors_of_others(const geoidx* index, const TestMesh& mesh) {
    return errors_of(index, mesh, build_options(), {.first_source = 5, .step = mesh.vertex_count() / 30});
}

}

TEST_CASE("target error: is reached, or the index is as large as it may be" * doctest::skip(SANITIZED)) {
    for (const TestMesh& mesh : {rough(), torus(20, 10), sphere(12, 18), dirty_hills()}) {
        const auto plain = shared_index(mesh, options_with(0));
        const geoidx_info before = info_of(plain.get());
        CHECK(before.added_vertex_count == 0);
        for (const double share : {0.9, 0.5, 0.1}) {
            const double target = share * before.error_mean;
            const auto index = shared_index(mesh, options_with(target));
            const geoidx_info info = info_of(index.get());
            CAPTURE(target);
            CHECK(info.added_vertex_count > 0);
            CHECK(info.error_mean < before.error_mean);
            CHECK(info.table_entries > before.table_entries);
            constexpr uint64_t FEW = 1 << 17; // that an index may always have
            CHECK(2 * info.table_entries <= std::max(2 * FEW, 5 * before.table_entries));
            if (share > 0.5) CHECK(info.error_mean <= target);
            // What the mesh is has not changed.
            CHECK(info.vertex_count == before.vertex_count);
            CHECK(info.welded_vertex_count == before.welded_vertex_count);
            CHECK(info.triangle_count == before.triangle_count);
            CHECK(info.mesh_fingerprint == before.mesh_fingerprint);
            CHECK(info.border_vertex_count == before.border_vertex_count + info.added_vertex_count);
        }
    }
}

TEST_CASE("target error: errors become smaller from sources that the builder did not choose, too" *
          doctest::skip(SANITIZED)) {
    for (const TestMesh& mesh : {rough(), dirty_hills()}) {
        const Errors before = errors_of_others(build(mesh, options_with(0)).get(), mesh);
        const Errors after = errors_of_others(build(mesh, options_with(1e-6)).get(), mesh);
        CHECK(after.mean < 0.5 * before.mean);
        CHECK(after.max < before.max);
    }
}

// Its two faces are cut by chords as long as the coin is wide, and its rim has short edges.
TEST_CASE("target error: is reached on a coin" * doctest::skip(SANITIZED)) {
    const TestMesh coin = test_mesh_of(closed_cylinder(250, 0.02));
    const geoidx_info before = info_of(build(coin, options_with(0)).get());
    const geoidx_info after = info_of(build(coin, options_with(0.0005)).get());
    REQUIRE(before.error_mean > 0.0007);
    CHECK(after.added_vertex_count > 0);
    CHECK(after.error_mean <= 0.0005);
}

TEST_CASE("target error: what is exact enough stays as it is" * doctest::skip(SANITIZED)) {
    const TestMesh plane = grid(40, 40, 0.25);
    const auto plain = shared_index(plane, options_with(0));
    REQUIRE(info_of(plain.get()).error_mean < 0.0005);
    geoidx_build_options defaults;
    geoidx_build_options_init(&defaults);
    CHECK(save(build(plane, options_with(defaults.target_error)).get()) == save(plain.get()));
    CHECK(save(build(rough(), options_with(1)).get()) == save(build(rough(), options_with(0)).get()));
}

TEST_CASE("target error: is not used by other engines and metrics, nor with pruning or lengths" *
          doctest::skip(SANITIZED)) {
    const TestMesh mesh = rough();
    const std::vector<double> lengths = edge_lengths_of(mesh);
    std::vector<geoidx_build_options> others(4, options_with(0));
    others[0].engine = GEOIDX_ENGINE_GRAPH;
    others[1].metric = GEOIDX_METRIC_EDGES;
    others[2].delta = 5;
    others[3].edge_lengths = lengths.data();
    others[3].edge_length_count = lengths.size();
    for (geoidx_build_options& options : others) {
        const auto plain = save(build(mesh, options).get());
        options.target_error = 1e-9;
        CHECK(save(build(mesh, options).get()) == plain);
    }
}

TEST_CASE("target error: added vertices are in no answer") {
    const TestMesh mesh = dirty_hills();
    const uint32_t count = mesh.vertex_count();
    const auto index = shared_index(mesh, options_with(1e-6));
    REQUIRE(info_of(index.get()).added_vertex_count > 0);
    const auto metric = solver(mesh, build_options());
    uint64_t pairs = 0;
    for (uint32_t source = 0; source < count; source += 17) {
        const auto exact = metric_distances(metric.get(), source, count);
        const auto field = msad(index.get(), source, count);
        for (uint32_t v = 0; v < count; ++v) {
            CHECK(std::isinf(field[v]) == std::isinf(exact[v]));
            if (std::isinf(exact[v])) continue;
            CHECK(double{field[v]} == doctest::Approx(exact[v]).epsilon(0.2));
            if (v % 5 == 0)
                CHECK(double{sssd(index.get(), source, v)} == doctest::Approx(exact[v]).epsilon(0.2));
            ++pairs;
        }
    }
    CHECK(pairs > 1000);
    float distance = 0;
    check_refused(geoidx_sssd(index.get(), 0, count, &distance), GEOIDX_ERROR_INVALID_ARGUMENT,
                  "out of range");
}

TEST_CASE("target error: every form of file has added vertices, and gives the same answers") {
    const TestMesh mesh = dirty_hills();
    const uint32_t count = mesh.vertex_count();
    const auto built = shared_index(mesh, options_with(1e-6));
    const geoidx_info info = info_of(built.get());
    const auto expected = msad(built.get(), 9, count);
    for (const uint32_t codec : {GEOIDX_CODEC_PACKED, GEOIDX_CODEC_LOSSLESS, GEOIDX_CODEC_MAPPED}) {
        CAPTURE(codec);
        const Bytes bytes = save(built.get(), codec);
        CHECK(geoidx_verify(bytes.data(), bytes.size(), nullptr, nullptr) == GEOIDX_OK);
        const auto opened = open(bytes);
        const geoidx_info again = info_of(opened.get());
        CHECK(again.added_vertex_count == info.added_vertex_count);
        CHECK(again.welded_vertex_count == info.welded_vertex_count);
        CHECK(msad(opened.get(), 9, count) == expected);
        for (uint32_t v = 0; v < count; v += 3) CHECK(sssd(opened.get(), 9, v) == sssd(built.get(), 9, v));
        CHECK(save(opened.get(), codec) == bytes);
    }
}

TEST_CASE("target error: the same bytes whatever the threads" * doctest::skip(SANITIZED)) {
    Bytes first;
    for (const uint32_t threads : {1u, 2u, 5u}) {
        auto options = options_with(1e-6);
        options.threads = threads;
        const Bytes bytes = save(build(dirty_hills(), options).get());
        if (first.empty()) first = bytes;
        CHECK(bytes == first);
    }
}

TEST_CASE("target error: progress never falls, ends at 1 and can cancel in every round") {
    const TestMesh mesh = hills(11, 11);
    const geoidx_mesh view = mesh.view();
    const auto build_and_tell = [&](Told& told) {
        auto options = options_with(1e-9);
        options.progress = Told::tell;
        options.progress_user = &told;
        geoidx* index = not_null();
        const geoidx_status status = geoidx_build(&view, &options, &index);
        CHECK((status == GEOIDX_OK) == (index != nullptr));
        geoidx_close(index);
        return status;
    };
    Told whole;
    REQUIRE(build_and_tell(whole) == GEOIDX_OK);
    CHECK(std::ranges::is_sorted(whole.fractions));
    CHECK(whole.fractions.back() == 1);
    REQUIRE(std::ranges::count(whole.stages, "finer borders") >= 2);
    // How many calls there are depends on the time that a build takes.
    for (size_t k = 0; k < whole.fractions.size(); k += SANITIZED ? 5 : 1) {
        Told told{k, {}, {}};
        const geoidx_status status = build_and_tell(told);
        CHECK(status == (told.fractions.size() > k ? GEOIDX_ERROR_CANCELLED : GEOIDX_OK));
        CHECK(told.fractions.size() <= k + 1);
    }
}

TEST_CASE("target error: must be a share, and is the default in a shorter struct") {
    const TestMesh mesh = rough();
    const geoidx_mesh view = mesh.view();
    for (const double wrong : {-0.1, 1.1, std::nan(""), std::numeric_limits<double>::infinity()}) {
        geoidx_build_options options = options_with(wrong);
        geoidx* index = not_null();
        check_refused(geoidx_build(&view, &options, &index), GEOIDX_ERROR_INVALID_ARGUMENT, "target_error");
        CHECK(index == nullptr);
    }
    geoidx_build_options defaults, shorter = options_with(0);
    geoidx_build_options_init(&defaults);
    shorter.struct_size = offsetof(geoidx_build_options, target_error);
    const Bytes bytes = save(build(mesh, shorter).get());
    CHECK(bytes == save(build(mesh, options_with(defaults.target_error)).get()));
    CHECK(bytes != save(build(mesh, options_with(0)).get()));
}
