// What geoidx.h promises about arguments, statuses, structs and errors.

#include <cmath>
#include <cstring>
#include <limits>
#include <set>
#include <thread>

#include "tests/capi/calls.h"

using namespace geodesic::test;

namespace {

constexpr double NOT_A_NUMBER = std::numeric_limits<double>::quiet_NaN();
constexpr double INFINITE = std::numeric_limits<double>::infinity();

bool last_error_contains(const char* text) { return std::strstr(geoidx_last_error(), text) != nullptr; }

// A status with a detail that names what is wrong.
void check_refused(geoidx_status actual, geoidx_status expected, const char* detail) {
    INFO("wanted in the detail: ", std::string(detail), ", found: ", std::string(geoidx_last_error()));
    CHECK(actual == expected);
    CHECK(last_error_contains(detail));
}

// A pointer that no handle is at, so that a call that leaves it alone is seen.
geoidx* not_null() {
    static int somewhere;
    return reinterpret_cast<geoidx*>(&somewhere);
}

void check_build_refused(const TestMesh& mesh, const geoidx_build_options& options, geoidx_status expected,
                         const char* detail) {
    const geoidx_mesh view = mesh.view();
    geoidx* index = not_null();
    check_refused(geoidx_build(&view, &options, &index), expected, detail);
    CHECK(index == nullptr);
}

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

TEST_CASE("version and status strings") {
    CHECK(geoidx_version() ==
          GEOIDX_VERSION_MAJOR * 10000 + GEOIDX_VERSION_MINOR * 100 + GEOIDX_VERSION_PATCH);
    std::set<std::string> phrases;
    for (geoidx_status status = GEOIDX_ERROR_INTERNAL; status <= GEOIDX_OK; ++status) {
        REQUIRE(geoidx_status_string(status) != nullptr);
        CHECK(std::strlen(geoidx_status_string(status)) > 0);
        phrases.insert(geoidx_status_string(status));
    }
    CHECK(phrases.size() == 15);
    const std::string unknown = geoidx_status_string(GEOIDX_ERROR_INTERNAL - 1);
    CHECK(!phrases.contains(unknown));
    for (geoidx_status status : {1, INT32_MIN, INT32_MAX}) CHECK(geoidx_status_string(status) == unknown);
}

TEST_CASE("the numbers of statuses and enumerations stay as released") {
    const std::vector<geoidx_status> statuses = {GEOIDX_OK,
                                                 GEOIDX_ERROR_INVALID_ARGUMENT,
                                                 GEOIDX_ERROR_IO,
                                                 GEOIDX_ERROR_NOT_AN_INDEX,
                                                 GEOIDX_ERROR_TRUNCATED,
                                                 GEOIDX_ERROR_CORRUPT,
                                                 GEOIDX_ERROR_CHECKSUM,
                                                 GEOIDX_ERROR_UNSUPPORTED_VERSION,
                                                 GEOIDX_ERROR_MESH_MISMATCH,
                                                 GEOIDX_ERROR_LIMIT,
                                                 GEOIDX_ERROR_OUT_OF_MEMORY,
                                                 GEOIDX_ERROR_CANCELLED,
                                                 GEOIDX_ERROR_BAD_MESH,
                                                 GEOIDX_ERROR_CALLBACK,
                                                 GEOIDX_ERROR_INTERNAL};
    for (size_t i = 0; i < statuses.size(); ++i) CHECK(statuses[i] == -static_cast<geoidx_status>(i));
    CHECK(GEOIDX_METRIC_EXACT == 0);
    CHECK(GEOIDX_METRIC_EDGES == 1);
    CHECK(GEOIDX_METRIC_CALLBACK == 2);
}

TEST_CASE("init functions set struct_size and defaults, and bear NULL") {
    geoidx_mesh_init(nullptr);
    geoidx_build_options_init(nullptr);
    geoidx_open_options_init(nullptr);

    geoidx_mesh mesh;
    geoidx_build_options build_options;
    geoidx_open_options open_options;
    std::memset(&mesh, 0xAB, sizeof mesh);
    std::memset(&build_options, 0xAB, sizeof build_options);
    std::memset(&open_options, 0xAB, sizeof open_options);
    geoidx_mesh_init(&mesh);
    geoidx_build_options_init(&build_options);
    geoidx_open_options_init(&open_options);
    CHECK(mesh.struct_size == sizeof mesh);
    CHECK(mesh.position_type == GEOIDX_POSITION_FLOAT);
    CHECK(mesh.position_stride == 0);
    CHECK(mesh.reserved == 0);
    CHECK(build_options.struct_size == sizeof build_options);
    CHECK(build_options.metric == GEOIDX_METRIC_EXACT);
    CHECK(build_options.weld_tolerance == 0);
    CHECK(build_options.delta == 0);
    CHECK(build_options.threads == 0);
    CHECK(build_options.level_count == 0);
    for (uint32_t count : build_options.patches) CHECK(count == 0);
    CHECK(build_options.lloyd_iterations == 4);
    CHECK(build_options.edge_cost_count == 0);
    CHECK(!build_options.progress);
    CHECK(!build_options.allocator.allocate);
    CHECK(open_options.struct_size == sizeof open_options);
    CHECK(open_options.expected_mesh == nullptr);
    CHECK(!open_options.allocator.release);
}

TEST_CASE("closing NULL is fine") {
    geoidx_close(nullptr);
    geoidx_query_close(nullptr);
    geoidx_solver_close(nullptr);
}

TEST_CASE("every NULL that is not allowed is named") {
    const TestMesh mesh = two_triangles();
    const geoidx_mesh view = mesh.view();
    const auto index = build(mesh, build_options());
    const Bytes bytes = save(index.get());
    geoidx_query* made = nullptr;
    require_success(geoidx_query_create(index.get(), &made));
    const QueryHandle query(made);
    const auto solver_handle = solver(mesh, build_options());
    const uint32_t ids[] = {0, 1};
    float distances[4];
    double wide[4];
    uint64_t size = 0;
    geoidx_info info{};
    info.struct_size = sizeof info;
    const auto refused = [](geoidx_status status, const char* what) {
        check_refused(status, GEOIDX_ERROR_INVALID_ARGUMENT, what);
    };

    refused(geoidx_build(&view, nullptr, nullptr), "out");
    geoidx* out = not_null();
    refused(geoidx_build(nullptr, nullptr, &out), "mesh");
    CHECK(out == nullptr);
    refused(geoidx_save(nullptr, "/tmp/never-written.gidx"), "index");
    refused(geoidx_save(index.get(), nullptr), "path");
    refused(geoidx_save_memory(nullptr, nullptr, 0, &size), "index");
    refused(geoidx_save_memory(index.get(), nullptr, 0, nullptr), "needed");
    refused(geoidx_save_memory(index.get(), nullptr, 1, &size), "buffer");
    refused(geoidx_open("/tmp/never-read.gidx", nullptr, nullptr), "out");
    out = not_null();
    refused(geoidx_open(nullptr, nullptr, &out), "path");
    CHECK(out == nullptr);
    refused(geoidx_open_memory(bytes.data(), bytes.size(), nullptr, nullptr), "out");
    out = not_null();
    refused(geoidx_open_memory(nullptr, 1, nullptr, &out), "data");
    CHECK(out == nullptr);
    refused(geoidx_verify(nullptr, 1, nullptr, nullptr), "data");
    refused(geoidx_get_info(nullptr, &info), "index");
    refused(geoidx_get_info(index.get(), nullptr), "info");

    refused(geoidx_sssd(nullptr, 0, 1, distances), "index");
    refused(geoidx_sssd(index.get(), 0, 1, nullptr), "distance");
    refused(geoidx_sssd_batch(nullptr, ids, 1, distances), "index");
    refused(geoidx_sssd_batch(index.get(), nullptr, 1, distances), "source_target_pairs");
    refused(geoidx_sssd_batch(index.get(), ids, 1, nullptr), "distances");
    refused(geoidx_msad(nullptr, ids, 1, distances, 4), "index");
    refused(geoidx_msad(index.get(), nullptr, 1, distances, 4), "sources");
    refused(geoidx_msad(index.get(), ids, 1, nullptr, 4), "distances");

    geoidx_query* no_query = query.get();
    refused(geoidx_query_create(nullptr, &no_query), "index");
    CHECK(no_query == nullptr);
    refused(geoidx_query_create(index.get(), nullptr), "out");
    refused(geoidx_query_sssd(nullptr, 0, 1, distances), "query");
    refused(geoidx_query_sssd(query.get(), 0, 1, nullptr), "distance");
    refused(geoidx_query_msad(nullptr, ids, 1, distances, 4), "query");
    refused(geoidx_query_msad(query.get(), nullptr, 1, distances, 4), "sources");
    refused(geoidx_query_msad(query.get(), ids, 1, nullptr, 4), "distances");

    geoidx_solver* no_solver = solver_handle.get();
    refused(geoidx_solver_create(nullptr, nullptr, &no_solver), "mesh");
    CHECK(no_solver == nullptr);
    refused(geoidx_solver_create(&view, nullptr, nullptr), "out");
    refused(geoidx_solver_distances(nullptr, ids, 1, ids, 1, wide), "solver");
    refused(geoidx_solver_distances(solver_handle.get(), nullptr, 1, ids, 1, wide), "sources");
    refused(geoidx_solver_distances(solver_handle.get(), ids, 1, ids, 1, nullptr), "distances");
    refused(geoidx_solver_distances(solver_handle.get(), ids, 1, nullptr, 3, wide), "targets");
}

TEST_CASE("NULLs that are allowed") {
    const TestMesh mesh = two_triangles();
    const geoidx_mesh view = mesh.view();
    geoidx* made = nullptr;
    require_success(geoidx_build(&view, nullptr, &made));
    const IndexHandle index(made);
    require_success(geoidx_sssd_batch(index.get(), nullptr, 0, nullptr));
    const Bytes bytes = save(index.get());
    require_success(geoidx_verify(bytes.data(), bytes.size(), nullptr, nullptr));
    geoidx_solver* made_solver = nullptr;
    require_success(geoidx_solver_create(&view, nullptr, &made_solver));
    const SolverHandle solver_handle(made_solver);
    double distances[4];
    const uint32_t source = 1;
    require_success(geoidx_solver_distances(solver_handle.get(), &source, 1, nullptr, 4, distances));
    CHECK(distances[3] == doctest::Approx(std::sqrt(2.0)));
    require_success(geoidx_solver_distances(solver_handle.get(), &source, 1, nullptr, 4, distances));
    const geoidx_status empty = geoidx_verify(nullptr, 0, nullptr, nullptr);
    CHECK(empty == GEOIDX_ERROR_TRUNCATED);
}

TEST_CASE("counts and ids out of range are refused and named") {
    const TestMesh mesh = grid(5, 4);
    const auto index = build(mesh, build_options());
    geoidx_query* made = nullptr;
    require_success(geoidx_query_create(index.get(), &made));
    const QueryHandle query(made);
    std::vector<float> distances(21);
    std::vector<double> wide(21);
    for (uint32_t bad : {20u, 21u, UINT32_MAX - 1, UINT32_MAX}) {
        const std::string number = std::to_string(bad);
        const uint32_t sources[] = {0, bad}, pairs[] = {0, 1, 2, bad};
        const auto refused = [&](geoidx_status status) {
            check_refused(status, GEOIDX_ERROR_INVALID_ARGUMENT, number.c_str());
        };
        refused(geoidx_sssd(index.get(), bad, 1, distances.data()));
        refused(geoidx_sssd(index.get(), 1, bad, distances.data()));
        refused(geoidx_sssd(index.get(), bad, bad, distances.data()));
        refused(geoidx_sssd_batch(index.get(), pairs, 2, distances.data()));
        refused(geoidx_msad(index.get(), sources, 2, distances.data(), 20));
        refused(geoidx_query_sssd(query.get(), 1, bad, distances.data()));
        refused(geoidx_query_msad(query.get(), sources, 2, distances.data(), 20));
        // A call that was refused half way leaves nothing behind in the scratch.
        require_success(geoidx_query_msad(query.get(), &sources[0], 1, distances.data(), 20));
        for (uint32_t v = 0; v < 20; ++v)
            CHECK(distances[v] == doctest::Approx(mesh.straight(0, v)).epsilon(0.2));
        const auto solver_handle = solver(mesh, build_options());
        refused(geoidx_solver_distances(solver_handle.get(), sources, 2, sources, 1, wide.data()));
        refused(geoidx_solver_distances(solver_handle.get(), sources, 1, sources, 2, wide.data()));
    }
    const uint32_t source = 3;
    for (uint32_t count : {0u, 19u, 21u})
        check_refused(geoidx_msad(index.get(), &source, 1, distances.data(), count),
                      GEOIDX_ERROR_INVALID_ARGUMENT, "distance_count");
    check_refused(geoidx_msad(index.get(), &source, 0, distances.data(), 20), GEOIDX_ERROR_INVALID_ARGUMENT,
                  "no source");
    const auto solver_handle = solver(mesh, build_options());
    check_refused(geoidx_solver_distances(solver_handle.get(), &source, 0, nullptr, 20, wide.data()),
                  GEOIDX_ERROR_INVALID_ARGUMENT, "no source");
}

TEST_CASE("the last error is per thread and stays until the next one") {
    geoidx* index = nullptr;
    CHECK(geoidx_open("/nonexistent/first.gidx", nullptr, &index) == GEOIDX_ERROR_IO);
    CHECK(last_error_contains("/nonexistent/first.gidx"));
    std::string before, after;
    std::thread([&] {
        before = geoidx_last_error();
        geoidx* none = nullptr;
        geoidx_open("/nonexistent/second.gidx", nullptr, &none);
        after = geoidx_last_error();
    }).join();
    CHECK(before == "");
    CHECK(after.find("/nonexistent/second.gidx") != std::string::npos);
    CHECK(last_error_contains("/nonexistent/first.gidx"));
}

TEST_CASE("a detail longer than its buffer ends cleanly") {
    const std::string path = "/nonexistent/" + std::string(5000, 'x');
    geoidx* index = nullptr;
    CHECK(geoidx_open(path.c_str(), nullptr, &index) == GEOIDX_ERROR_IO);
    const std::string detail = geoidx_last_error();
    CHECK(detail.size() > 500);
    CHECK(detail.size() < 5000);
    geoidx_open("/nonexistent/short", nullptr, &index);
    CHECK(std::string(geoidx_last_error()).size() < 200);
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

    for (size_t size : {sizeof(uint32_t), offsetof(geoidx_info, mesh_fingerprint),
                        offsetof(geoidx_info, error_mean) + sizeof(double)}) {
        const ShortStruct<geoidx_info> part(geoidx_info{}, size);
        require_success(geoidx_get_info(index.get(), part.get()));
        geoidx_info expected = whole;
        expected.struct_size = static_cast<uint32_t>(size);
        CHECK(std::memcmp(part.get(), &expected, size) == 0);
    }
    LongStruct<geoidx_info> longer{geoidx_info{}};
    require_success(geoidx_get_info(index.get(), &longer.known));
    CHECK(longer.known.vertex_count == 81);
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
    for (double delta : {NOT_A_NUMBER, -1e-300, 100.5, INFINITE}) {
        auto options = build_options();
        options.delta = delta;
        refused(options, "delta");
    }
    for (double tolerance : {NOT_A_NUMBER, -1e-300, INFINITE}) {
        auto options = build_options();
        options.weld_tolerance = tolerance;
        refused(options, "weld_tolerance");
    }
    for (uint32_t levels : {9u, UINT32_MAX}) {
        auto options = build_options();
        options.level_count = levels;
        refused(options, "level_count");
    }
    for (uint32_t metric : {3u, UINT32_MAX}) refused(build_options(metric), "metric");
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
    refused({0, 1}, -1, "cost");
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
    for (double distance : {NOT_A_NUMBER, -1.0, -INFINITE}) {
        script.distance = distance;
        check_build_refused(mesh, options, GEOIDX_ERROR_CALLBACK, "distance");
    }
}

TEST_CASE("bad meshes are refused and the element is named") {
    const auto refused = [](const TestMesh& mesh, const char* detail) {
        check_build_refused(mesh, build_options(), GEOIDX_ERROR_BAD_MESH, detail);
    };
    TestMesh mesh = two_triangles();
    mesh.positions[3 * 2 + 1] = NOT_A_NUMBER;
    refused(mesh, "vertex 2");
    mesh.positions[3 * 2 + 1] = -INFINITE;
    refused(mesh, "vertex 2");
    mesh = two_triangles();
    mesh.triangles[4] = 4;
    refused(mesh, "triangle 1");
    mesh = two_triangles();
    mesh.add_triangle(0, 2, mesh.add_vertex(0, 0, 5));
    refused(mesh, "more than two");
    refused({{0, 0, 0, 1, 0, 0, 0, 1, 0}, {}}, "triangles");
    refused({{}, {0, 1, 2}}, "vertices");
    refused({{0, 0, 0, 1, 0, 0, 1, 0, 0}, {0, 1, 2}}, "");

    mesh = two_triangles();
    geoidx_mesh view = mesh.view();
    geoidx* index = not_null();
    view.vertex_count = UINT32_MAX;
    check_refused(geoidx_build(&view, nullptr, &index), GEOIDX_ERROR_LIMIT, "vertices");
    CHECK(index == nullptr);
    view = mesh.view();
    view.triangle_count = UINT64_MAX;
    check_refused(geoidx_build(&view, nullptr, &index), GEOIDX_ERROR_LIMIT, "triangles");
    view = mesh.view();
    view.position_stride = 23;
    check_refused(geoidx_build(&view, nullptr, &index), GEOIDX_ERROR_INVALID_ARGUMENT, "position_stride");
    view = mesh.view();
    view.position_type = 2;
    check_refused(geoidx_build(&view, nullptr, &index), GEOIDX_ERROR_INVALID_ARGUMENT, "position_type");
    view = mesh.view();
    view.positions = nullptr;
    check_refused(geoidx_build(&view, nullptr, &index), GEOIDX_ERROR_INVALID_ARGUMENT, "positions");
    view = mesh.view();
    view.triangles = nullptr;
    check_refused(geoidx_build(&view, nullptr, &index), GEOIDX_ERROR_INVALID_ARGUMENT, "triangles");
}

TEST_CASE("float and strided positions are the same mesh") {
    const TestMesh mesh = grid(8, 7);
    std::vector<unsigned char> strided(17 * size_t{mesh.vertex_count()}, 0xFF); // three floats, five bytes
    for (uint32_t v = 0; v < mesh.vertex_count(); ++v)
        for (size_t k = 0; k < 3; ++k) {
            const auto coordinate = static_cast<float>(mesh.positions[3 * v + k]);
            std::memcpy(&strided[17 * v + 4 * k], &coordinate, 4);
        }
    geoidx_mesh view = mesh.view();
    view.position_type = GEOIDX_POSITION_FLOAT;
    view.positions = strided.data();
    view.position_stride = 17;
    const auto options = build_options();
    geoidx* made = nullptr;
    require_success(geoidx_build(&view, &options, &made));
    const IndexHandle index(made);
    CHECK(save(index.get()) == save(build(mesh, options).get()));
}

TEST_CASE("save_memory tells the size and never writes a part") {
    const auto index = build(grid(6, 5), build_options());
    uint64_t needed = 0;
    require_success(geoidx_save_memory(index.get(), nullptr, 0, &needed));
    REQUIRE(needed > 0);
    const std::byte filler{0xAB};
    for (uint64_t capacity : {uint64_t{0}, uint64_t{1}, needed - 1}) {
        Bytes buffer(needed, filler);
        uint64_t told = 0;
        check_refused(geoidx_save_memory(index.get(), buffer.data(), capacity, &told),
                      GEOIDX_ERROR_INVALID_ARGUMENT, "buffer");
        CHECK(told == needed);
        CHECK(buffer == Bytes(needed, filler));
    }
    Bytes buffer(needed + 10, filler);
    uint64_t told = 0;
    require_success(geoidx_save_memory(index.get(), buffer.data(), buffer.size(), &told));
    CHECK(told == needed);
    for (size_t i = needed; i < buffer.size(); ++i) CHECK(buffer[i] == filler);
    buffer.resize(needed);
    CHECK(buffer == save(index.get()));
}

TEST_CASE("the data of open_memory is not needed after the call") {
    const TestMesh mesh = grid(9, 8);
    const auto original = build(mesh, build_options());
    auto bytes = std::make_unique<Bytes>(save(original.get()));
    const auto index = open(*bytes);
    std::fill(bytes->begin(), bytes->end(), std::byte{0xCD});
    bytes.reset();
    CHECK(msad(index.get(), 0, 72) == msad(original.get(), 0, 72));
    CHECK(save(index.get()) == save(original.get()));
}

TEST_CASE("expected_mesh must be the very mesh") {
    const TestMesh mesh = grid(6, 5, 0.2);
    const Bytes bytes = save(build(mesh, build_options()).get());
    const auto status_with = [&](const TestMesh& expected) {
        const geoidx_mesh view = expected.view();
        geoidx_open_options options;
        geoidx_open_options_init(&options);
        options.expected_mesh = &view;
        geoidx* index = not_null();
        const geoidx_status status = geoidx_open_memory(bytes.data(), bytes.size(), &options, &index);
        CHECK((index == nullptr) == (status != GEOIDX_OK));
        geoidx_close(index);
        return status;
    };
    CHECK(status_with(mesh) == GEOIDX_OK);
    TestMesh other = mesh;
    other.positions[31] = std::nextafter(other.positions[31], 100.0);
    CHECK(status_with(other) == GEOIDX_ERROR_MESH_MISMATCH);
    other = mesh;
    std::swap(other.triangles[0], other.triangles[1]);
    CHECK(status_with(other) == GEOIDX_ERROR_MESH_MISMATCH);
    other = mesh;
    other.add_vertex(0, 0, 0);
    CHECK(status_with(other) == GEOIDX_ERROR_MESH_MISMATCH);
    CHECK(last_error_contains("31"));
    other = mesh;
    other.triangles.resize(other.triangles.size() - 3);
    CHECK(status_with(other) == GEOIDX_ERROR_MESH_MISMATCH);
    other = mesh;
    other.triangles[0] = 30;
    CHECK(status_with(other) == GEOIDX_ERROR_BAD_MESH);
}

TEST_CASE("a failed open sets the handle to NULL") {
    const unsigned char text[] = "solid cube\n  facet normal 0 0 1\n";
    geoidx* index = not_null();
    CHECK(geoidx_open_memory(text, sizeof text, nullptr, &index) == GEOIDX_ERROR_NOT_AN_INDEX);
    CHECK(index == nullptr);
    index = not_null();
    CHECK(geoidx_open_memory(nullptr, 0, nullptr, &index) == GEOIDX_ERROR_TRUNCATED);
    CHECK(index == nullptr);
    index = not_null();
    CHECK(geoidx_open("/nonexistent/index.gidx", nullptr, &index) == GEOIDX_ERROR_IO);
    CHECK(index == nullptr);
}
