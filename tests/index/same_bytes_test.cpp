// The same input gives the same bytes.

#include <filesystem>

#include "tests/capi/calls.h"

using namespace geodesic::test;

TEST_CASE("a file is what save_memory gives") {
    const auto path = std::filesystem::temp_directory_path() / "geoidx_same_bytes_test.gidx";
    const auto index = build(hills(9, 9), build_options());
    require_success(geoidx_save(index.get(), path.c_str(), nullptr));
    geoidx* made = nullptr;
    require_success(geoidx_open(path.c_str(), nullptr, &made));
    const IndexHandle opened(made);
    CHECK(std::filesystem::file_size(path) == save(index.get()).size());
    CHECK(save(opened.get()) == save(index.get()));
    std::filesystem::remove(path);
}

TEST_CASE("the seed decides: the same one gives the same bytes, another one other patches") {
    auto options = build_options(GEOIDX_METRIC_EXACT, 2);
    options.seed = 1;
    const auto first = build(hills(20, 19), options);
    CHECK(save(build(hills(20, 19), options).get()) == save(first.get()));
    options.seed = 2;
    const auto second = build(hills(20, 19), options);
    CHECK(info_of(second.get()).seed == 2);
    // Not only the seed in the file differs, but also what was built.
    CHECK(msad(second.get(), 0, 380) != msad(first.get(), 0, 380));
}

TEST_CASE("pruning takes vertices off the borders and is not free of error") {
    const TestMesh mesh = hills(22, 21);
    const auto whole = build(mesh, build_options(GEOIDX_METRIC_EXACT, 2));
    const auto pruned = build(mesh, build_options(GEOIDX_METRIC_EXACT, 2, 5));
    const geoidx_info before = info_of(whole.get()), after = info_of(pruned.get());
    CHECK(after.border_vertex_count < before.border_vertex_count);
    CHECK(after.delta == 5);
    CHECK(after.error_mean > before.error_mean);
    // A crossing at a vertex that was merged goes out of its way by at most 2 delta.
    const auto distances = msad(pruned.get(), 0, mesh.vertex_count());
    const auto metric = solver(mesh, build_options());
    const auto exact = metric_distances(metric.get(), 0, mesh.vertex_count());
    for (uint32_t v = 0; v < mesh.vertex_count(); ++v)
        CHECK(double{distances[v]} <= 1.3 * exact[v] + 4 * 0.05 * after.bounding_box_diagonal);
}
