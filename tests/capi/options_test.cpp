// What geoidx.h promises about the sizes of structs, the options of a build, and the caller's own metric.

#include <cmath>
#include <cstdlib>
#include <cstring>

#include "tests/capi/refusals.h"

using namespace geodesic::test;

namespace {

// The first `size` bytes of a struct at the very end of a block of the heap, where the address sanitizer sees
// every byte read or written beyond.
template <class Struct>
class ShortStruct {
public:
    ShortStruct(const Struct& whole, size_t size) : block_(std::malloc(size)) {
        REQUIRE(block_ != nullptr);
        std::memcpy(block_, &whole, size);
        const auto stated = static_cast<uint32_t>(size);
        std::memcpy(block_, &stated, sizeof stated);
    }
    ~ShortStruct() { std::free(block_); }
    ShortStruct(const ShortStruct&) = delete;
    ShortStruct& operator=(const ShortStruct&) = delete;

    Struct* get() const { return static_cast<Struct*>(block_); }

private:
    void* block_;
};

// A caller from the future: our struct and bytes that we know nothing of.
template <class Struct>
struct LongStruct {
    Struct known;
    unsigned char unknown[24];

    explicit LongStruct(const Struct& whole) : known(whole) {
        known.struct_size = sizeof(LongStruct);
        std::memset(unknown, 0xAB, sizeof unknown);
    }
};

}

TEST_CASE("struct_size that cannot be is refused") {
    const TestMesh mesh = two_triangles();
    const Bytes bytes = save(build(mesh, build_options()).get());
    for (uint32_t size : {0u, 1u, 3u}) {
        CAPTURE(size);
        geoidx_mesh view = mesh.view();
        geoidx_build_options options = build_options();
        geoidx_open_options opening;
        geoidx_open_options_init(&opening);
        geoidx* index = not_null();

        options.struct_size = size;
        check_refused(geoidx_build(&view, &options, &index), GEOIDX_ERROR_INVALID_ARGUMENT, "struct_size");
        CHECK(index == nullptr);
        geoidx_solver* made = nullptr;
        check_refused(geoidx_solver_create(&view, &options, &made), GEOIDX_ERROR_INVALID_ARGUMENT,
                      "struct_size");
        view.struct_size = size;
        check_refused(geoidx_build(&view, nullptr, &index), GEOIDX_ERROR_INVALID_ARGUMENT, "struct_size");
        opening.expected_mesh = &view;
        check_refused(geoidx_open_memory(bytes.data(), bytes.size(), &opening, &index),
                      GEOIDX_ERROR_INVALID_ARGUMENT, "struct_size");
        opening.expected_mesh = nullptr;
        opening.struct_size = size;
        index = not_null();
        check_refused(geoidx_open_memory(bytes.data(), bytes.size(), &opening, &index),
                      GEOIDX_ERROR_INVALID_ARGUMENT, "struct_size");
        CHECK(index == nullptr);
        geoidx_info info{};
        info.struct_size = size;
        check_refused(geoidx_get_info(open(bytes).get(), &info), GEOIDX_ERROR_INVALID_ARGUMENT,
                      "struct_size");
    }
}

TEST_CASE("shorter structs of older callers: what they lack is defaulted, not read") {
    const TestMesh mesh = grid(6, 6);
    geoidx_build_options options;
    geoidx_build_options_init(&options);
    options.metric = GEOIDX_METRIC_EDGES;
    options.delta = NOT_A_NUMBER; // whoever reads it fails
    options.level_count = 99;
    const geoidx_mesh view = mesh.view();
    {
        // Ends before weld_tolerance: the metric counts, the rest is default.
        const ShortStruct short_options(options, offsetof(geoidx_build_options, weld_tolerance));
        const ShortStruct short_mesh(view, offsetof(geoidx_mesh, position_stride));
        geoidx* made = nullptr;
        require_success(geoidx_build(short_mesh.get(), short_options.get(), &made));
        const IndexHandle index(made);
        CHECK(info_of(index.get()).metric == GEOIDX_METRIC_EDGES);
        CHECK(info_of(index.get()).delta == 0);

        geoidx_build_options same;
        geoidx_build_options_init(&same);
        same.metric = GEOIDX_METRIC_EDGES;
        CHECK(save(index.get()) == save(build(mesh, same).get()));

        geoidx_solver* made_solver = nullptr;
        require_success(geoidx_solver_create(short_mesh.get(), short_options.get(), &made_solver));
        const SolverHandle solver_handle(made_solver);
        CHECK(metric_distances(solver_handle.get(), 5, 36)[30] ==
              doctest::Approx(10)); // against the diagonals
    }
    const ShortStruct only_size(options, sizeof(uint32_t));
    geoidx* made = nullptr;
    require_success(geoidx_build(&view, only_size.get(), &made));
    const IndexHandle index(made);
    CHECK(info_of(index.get()).metric == GEOIDX_METRIC_EXACT);

    const Bytes bytes = save(index.get());
    geoidx_open_options opening;
    geoidx_open_options_init(&opening);
    const ShortStruct short_opening(opening, offsetof(geoidx_open_options, expected_mesh));
    geoidx* opened = nullptr;
    require_success(geoidx_open_memory(bytes.data(), bytes.size(), short_opening.get(), &opened));
    geoidx_close(opened);
}

TEST_CASE("info is filled up to its struct_size and not beyond") {
    const auto index = build(grid(9, 9), build_options(GEOIDX_METRIC_EXACT, 2, 0.5));
    const geoidx_info whole = info_of(index.get());
    CHECK(whole.vertex_count == 81);
    CHECK(whole.triangle_count == 128);
    CHECK(whole.welded_vertex_count == 81);
    CHECK(whole.bounding_box_diagonal == doctest::Approx(8 * std::sqrt(2.0)));
    CHECK(whole.delta == 0.5);
    CHECK(whole.level_count == 2);
    CHECK(whole.patch_count[0] >= 4);
    CHECK(whole.patch_count[1] > whole.patch_count[0]);
    CHECK(whole.patch_count[2] == 0);
    CHECK(whole.error_sources > 0);
    CHECK(whole.error_mean <= whole.error_max);
    CHECK(whole.error_p99 <= whole.error_p999);

    for (size_t size :
         {sizeof(uint32_t), offsetof(geoidx_info, mesh_fingerprint),
          offsetof(geoidx_info, error_mean) + sizeof(double), offsetof(geoidx_info, error_near_mean)}) {
        const ShortStruct<geoidx_info> part(geoidx_info{}, size);
        require_success(geoidx_get_info(index.get(), part.get()));
        geoidx_info expected = whole;
        expected.struct_size = static_cast<uint32_t>(size);
        CHECK(std::memcmp(part.get(), &expected, size) == 0);
    }
    LongStruct<geoidx_info> longer{geoidx_info{}};
    require_success(geoidx_get_info(index.get(), &longer.known));
    CHECK(longer.known.vertex_count == 81);
    CHECK(longer.known.struct_size == sizeof(geoidx_info)); // what is behind it was not filled
    for (unsigned char byte : longer.unknown) CHECK(byte == 0xAB);
}

TEST_CASE("longer structs of newer callers are accepted") {
    const TestMesh mesh = grid(6, 6);
    const LongStruct<geoidx_mesh> view(mesh.view());
    const LongStruct<geoidx_build_options> options(build_options(GEOIDX_METRIC_EDGES, 1));
    geoidx* made = nullptr;
    require_success(geoidx_build(&view.known, &options.known, &made));
    const IndexHandle index(made);
    CHECK(info_of(index.get()).metric == GEOIDX_METRIC_EDGES);
    const Bytes bytes = save(index.get());
    geoidx_open_options plain;
    geoidx_open_options_init(&plain);
    plain.expected_mesh = &view.known;
    const LongStruct<geoidx_open_options> opening(plain);
    geoidx* opened = nullptr;
    require_success(geoidx_open_memory(bytes.data(), bytes.size(), &opening.known, &opened));
    geoidx_close(opened);
}

TEST_CASE("build options are validated") {
    const TestMesh mesh = grid(5, 5);
    const auto refused = [&](const geoidx_build_options& options, const char* detail) {
        check_build_refused(mesh, options, GEOIDX_ERROR_INVALID_ARGUMENT, detail);
    };
    for (double delta : {double{NOT_A_NUMBER}, -1e-300, 100.5, double{INFINITE}}) {
        auto options = build_options();
        options.delta = delta;
        refused(options, "delta");
    }
    for (double tolerance : {double{NOT_A_NUMBER}, -1e-300, double{INFINITE}}) {
        auto options = build_options();
        options.weld_tolerance = tolerance;
        refused(options, "weld_tolerance");
    }
    for (uint32_t levels : {9u, UINT32_MAX}) {
        auto options = build_options();
        options.level_count = levels;
        refused(options, "level_count");
    }
    for (uint32_t metric : {4u, UINT32_MAX}) refused(build_options(metric), "metric");
    refused(build_options(GEOIDX_METRIC_CALLBACK), "metric_callback");
    auto options = build_options();
    options.threads = UINT32_MAX;
    refused(options, "threads");
    options = build_options();
    options.lloyd_iterations = UINT32_MAX;
    refused(options, "lloyd_iterations");

    options = build_options();
    options.allocator.allocate = [](void*, uint64_t, uint64_t) -> void* { return nullptr; };
    refused(options, "allocator");
    options.allocator.allocate = nullptr;
    options.allocator.release = [](void*, void*, uint64_t, uint64_t) {};
    refused(options, "allocator");
    options.allocator = {};

    options = build_options(GEOIDX_METRIC_EXACT, 8);
    const auto deepest = build(mesh, options);
    CHECK(info_of(deepest.get()).level_count == 8);
}

TEST_CASE("edge costs are validated") {
    const TestMesh mesh = grid(5, 5);
    auto options = build_options(GEOIDX_METRIC_EDGES);
    const auto refused = [&](std::vector<uint32_t> vertices, double cost, const char* detail) {
        options.edge_cost_count = 1;
        options.edge_cost_vertices = vertices.data();
        options.edge_costs = &cost;
        check_build_refused(mesh, options, GEOIDX_ERROR_INVALID_ARGUMENT, detail);
    };
    refused({0, 1}, NOT_A_NUMBER, "cost");
    refused({0, 1}, -1, "cost -1");
    refused({0, 1}, -1e-300, "cost -1e-300");
    refused({0, 1}, INFINITE, "cost");
    refused({0, 2}, 1, "no edge");
    refused({0, 0}, 1, "no edge");
    refused({0, 25}, 1, "25");
    refused({UINT32_MAX, 0}, 1, "4294967295");
    const uint32_t vertices[] = {0, 1};
    const double cost = 1;
    options.edge_cost_vertices = nullptr;
    options.edge_costs = &cost;
    check_build_refused(mesh, options, GEOIDX_ERROR_INVALID_ARGUMENT, "edge_cost_count");
    options.edge_cost_vertices = vertices;
    options.edge_costs = nullptr;
    check_build_refused(mesh, options, GEOIDX_ERROR_INVALID_ARGUMENT, "edge_cost_count");
}

TEST_CASE("edge costs count, the smaller of two, whichever way the edge is named") {
    const TestMesh mesh = two_triangles(); // 0-1-2-3 around, diagonal 0-2
    auto options = build_options(GEOIDX_METRIC_EDGES);
    const uint32_t vertices[] = {2, 0, 0, 2, 0, 1};
    const double costs[] = {5, 0.25, 0};
    options.edge_cost_count = 3;
    options.edge_cost_vertices = vertices;
    options.edge_costs = costs;
    const auto index = build(mesh, options);
    CHECK(sssd(index.get(), 0, 2) == 0.25f);
    CHECK(sssd(index.get(), 0, 1) == 0.0f);
    CHECK(sssd(index.get(), 1, 2) == 0.25f); // by 0, cheaper than the edge
    CHECK(sssd(index.get(), 1, 3) == 1.0f);
    CHECK(msad(index.get(), 1, 4) == std::vector<float>{0, 0, 0.25f, 1});
}

namespace {

struct CallbackScript {
    geoidx_status status = GEOIDX_OK;
    double distance = 1;
};

geoidx_status scripted(void* user, uint32_t source, const uint32_t* targets, uint32_t target_count,
                       double* distances) {
    const auto* script = static_cast<CallbackScript*>(user);
    for (uint32_t i = 0; i < target_count; ++i) distances[i] = targets[i] == source ? 0 : script->distance;
    return script->status;
}

}

TEST_CASE("a metric callback that fails or answers nonsense stops the build") {
    const TestMesh mesh = grid(5, 5);
    auto options = build_options(GEOIDX_METRIC_CALLBACK);
    options.metric_callback = scripted;
    CallbackScript script;
    options.metric_user = &script;
    const auto index = build(mesh, options);
    CHECK(sssd(index.get(), 3, 17) == 1.0f);
    script.status = GEOIDX_ERROR_IO;
    check_build_refused(mesh, options, GEOIDX_ERROR_CALLBACK, "-2");
    script.status = 77;
    check_build_refused(mesh, options, GEOIDX_ERROR_CALLBACK, "77");
    script.status = GEOIDX_OK;
    for (double distance : {double{NOT_A_NUMBER}, -1.0, -double{INFINITE}}) {
        script.distance = distance;
        check_build_refused(mesh, options, GEOIDX_ERROR_CALLBACK, "distance");
    }
    script.distance = 1e300;
    check_build_refused(mesh, options, GEOIDX_ERROR_LIMIT,
                        "the distance 1e+300, too large for a 32-bit float");
}
