// What geoidx.h promises about arguments, statuses, structs and errors.

#include <array>
#include <cmath>
#include <cstring>
#include <set>
#include <thread>

#include "tests/capi/refusals.h"

using namespace geodesic::test;

namespace {

std::string dotted(uint32_t version) {
    return std::to_string(version / 10000) + "." + std::to_string(version / 100 % 100) + "." +
           std::to_string(version % 100);
}

}

TEST_CASE("version and status strings") {
    CHECK(dotted(geoidx_version()) == GEOIDX_VERSION_OF_PROJECT);
    std::set<std::string> phrases;
    for (geoidx_status status = GEOIDX_ERROR_NO_PATH; status <= GEOIDX_OK; ++status) {
        REQUIRE(geoidx_status_string(status) != nullptr);
        CHECK(std::strlen(geoidx_status_string(status)) > 0);
        phrases.insert(geoidx_status_string(status));
    }
    CHECK(phrases.size() == 16);
    const std::string unknown = geoidx_status_string(GEOIDX_ERROR_NO_PATH - 1);
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
                                                 GEOIDX_ERROR_INTERNAL,
                                                 GEOIDX_ERROR_NO_PATH};
    for (size_t i = 0; i < statuses.size(); ++i) CHECK(statuses[i] == -static_cast<geoidx_status>(i));
    CHECK(GEOIDX_METRIC_EXACT == 0);
    CHECK(GEOIDX_METRIC_EDGES == 1);
    CHECK(GEOIDX_METRIC_CALLBACK == 2);
    CHECK(GEOIDX_METRIC_WEIGHTED == 3);
    CHECK(GEOIDX_METRIC_UNFOLDABLE == 1);
    CHECK(GEOIDX_ENGINE_GRAPH == 0);
    CHECK(GEOIDX_ENGINE_OVERLAY == 1);
    CHECK(GEOIDX_PATH_STRAIGHT == 0);
    CHECK(GEOIDX_PATH_EXACT == 1);
    CHECK(GEOIDX_POSITION_FLOAT == 0);
    CHECK(GEOIDX_POSITION_DOUBLE == 1);
}

// Of an older caller, whose struct ends earlier, only that much may be written.
TEST_CASE("init functions write no more than the caller's struct") {
    const auto check = [](auto init_sized, auto whole) {
        init_sized(nullptr, sizeof whole);
        init_sized(&whole, sizeof whole);
        for (uint32_t size = 0; size <= sizeof whole + 8; ++size) {
            CAPTURE(size);
            std::array<unsigned char, sizeof whole + 8> room, expected;
            room.fill(0xAB);
            expected.fill(0xAB);
            if (const uint32_t filled = std::min<uint32_t>(size, sizeof whole); filled >= 4) {
                std::memcpy(expected.data(), &whole, filled);
                std::memcpy(expected.data(), &filled, sizeof filled);
            }
            init_sized(reinterpret_cast<decltype(whole)*>(room.data()), size);
            CHECK(room == expected);
        }
    };
    check(geoidx_mesh_init_sized, geoidx_mesh{});
    check(geoidx_build_options_init_sized, geoidx_build_options{});
    check(geoidx_open_options_init_sized, geoidx_open_options{});
    check(geoidx_save_options_init_sized, geoidx_save_options{});
    check(geoidx_surface_options_init_sized, geoidx_surface_options{});
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
    CHECK(build_options.engine == GEOIDX_ENGINE_OVERLAY);
    CHECK(build_options.exact_vertices == 400);
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
    refused(geoidx_save(nullptr, "/tmp/never-written.gidx", nullptr), "index");
    refused(geoidx_save(index.get(), nullptr, nullptr), "path");
    refused(geoidx_save_memory(nullptr, nullptr, nullptr, 0, &size), "index");
    refused(geoidx_save_memory(index.get(), nullptr, nullptr, 0, nullptr), "needed");
    refused(geoidx_save_memory(index.get(), nullptr, nullptr, 1, &size), "buffer");
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
    uint32_t nearest[20], count = 0;
    const auto without_source = [](geoidx_status status) {
        check_refused(status, GEOIDX_ERROR_INVALID_ARGUMENT, "no source");
    };
    without_source(geoidx_msad(index.get(), nullptr, 0, distances.data(), 20));
    without_source(geoidx_query_msad(query.get(), nullptr, 0, distances.data(), 20));
    without_source(geoidx_query_msad_within(query.get(), nullptr, 0, 1, distances.data(), 20));
    without_source(geoidx_query_nearest_sources(query.get(), nullptr, 0, nearest, nullptr, 20));
    without_source(geoidx_query_within(query.get(), nullptr, 0, 1, nearest, nullptr, 20, &count));
    without_source(geoidx_query_farthest_points(query.get(), nullptr, 0, 20, nearest, nullptr, &count));
    without_source(geoidx_solver_distances(solver_handle.get(), nullptr, 0, nullptr, 20, wide.data()));
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

TEST_CASE("a detail longer than its buffer ends with a whole character") {
    for (const std::string character : {"x", "é", "測", "\U0001D11E"})
        for (size_t shift = 0; shift < character.size(); ++shift) {
            CAPTURE(character);
            CAPTURE(shift);
            std::string path = "/nonexistent/" + std::string(shift, 'x');
            while (path.size() < 5000) path += character;
            geoidx* index = nullptr;
            CHECK(geoidx_open(path.c_str(), nullptr, &index) == GEOIDX_ERROR_IO);
            const std::string detail = geoidx_last_error();
            CHECK(detail.size() > 1000);
            CHECK(detail.ends_with(character));
        }
}

TEST_CASE("an edge with three triangles is refused only where the options say so") {
    TestMesh mesh = two_triangles();
    mesh.add_triangle(0, 2, mesh.add_vertex(0, 0, 5));
    geoidx_build_options options = build_options();
    options.refuse_edges_of_many = 1;
    check_build_refused(mesh, options, GEOIDX_ERROR_BAD_MESH, "more than two");
    options.refuse_edges_of_many = 0;
    CHECK(build(mesh, options) != nullptr);
    options.refuse_edges_of_many = 2;
    check_build_refused(two_triangles(), options, GEOIDX_ERROR_INVALID_ARGUMENT, "not 0 or 1");
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
    require_success(geoidx_save_memory(index.get(), nullptr, nullptr, 0, &needed));
    REQUIRE(needed > 0);
    const std::byte filler{0xAB};
    for (uint64_t capacity : {uint64_t{0}, uint64_t{1}, needed - 1}) {
        Bytes buffer(needed, filler);
        uint64_t told = 0;
        check_refused(geoidx_save_memory(index.get(), nullptr, buffer.data(), capacity, &told),
                      GEOIDX_ERROR_INVALID_ARGUMENT, "buffer");
        CHECK(told == needed);
        CHECK(buffer == Bytes(needed, filler));
    }
    Bytes buffer(needed + 10, filler);
    uint64_t told = 0;
    require_success(geoidx_save_memory(index.get(), nullptr, buffer.data(), buffer.size(), &told));
    CHECK(told == needed);
    for (size_t i = needed; i < buffer.size(); ++i) CHECK(buffer[i] == filler);
    buffer.resize(needed);
    CHECK(buffer == save(index.get()));
    told = 7;
    CHECK(geoidx_save_memory(nullptr, nullptr, nullptr, 0, &told) == GEOIDX_ERROR_INVALID_ARGUMENT);
    CHECK(told == 0);
    uint32_t sections = 7;
    CHECK(geoidx_get_sections(nullptr, nullptr, 0, &sections) == GEOIDX_ERROR_INVALID_ARGUMENT);
    CHECK(sections == 0);
    told = 7;
    CHECK(geoidx_query_path_points(nullptr, nullptr, 0, &told) == GEOIDX_ERROR_INVALID_ARGUMENT);
    CHECK(told == 0);
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

namespace {

// Opens the file with that mesh as the expected one.
geoidx_status status_expecting(const geoidx_mesh& view, const Bytes& bytes) {
    geoidx_open_options options;
    geoidx_open_options_init(&options);
    options.expected_mesh = &view;
    geoidx* index = not_null();
    const geoidx_status status = geoidx_open_memory(bytes.data(), bytes.size(), &options, &index);
    CHECK((index == nullptr) == (status != GEOIDX_OK));
    geoidx_close(index);
    return status;
}

Bytes file_of(const geoidx_mesh& view, double weld_tolerance = 0) {
    geoidx_build_options options = build_options();
    options.weld_tolerance = weld_tolerance;
    geoidx* index = nullptr;
    REQUIRE(geoidx_build(&view, &options, &index) == GEOIDX_OK);
    return save(IndexHandle(index).get());
}

}

TEST_CASE("expected_mesh must be the very mesh") {
    const TestMesh mesh = grid(6, 5, 0.2);
    const Bytes bytes = save(build(mesh, build_options()).get());
    const auto status_with = [&](const TestMesh& expected) {
        return status_expecting(expected.view(), bytes);
    };
    CHECK(status_with(mesh) == GEOIDX_OK);
    TestMesh other = mesh;
    const float moved = std::nextafter(static_cast<float>(other.positions[31]), 100.0f);
    other.positions[31] = static_cast<double>(moved);
    CHECK(status_with(other) == GEOIDX_ERROR_MESH_MISMATCH);
    CHECK(status_expecting(FloatMesh(other).view(), bytes) == GEOIDX_ERROR_MESH_MISMATCH);
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

TEST_CASE("expected_mesh is the same mesh in single and in double precision") {
    for (const double offset : {0.0, 1.0 / 3, 1e5 / 7, 1e30 / 7}) {
        CAPTURE(offset);
        TestMesh mesh = grid(6, 5, 0.2); // whose jittered coordinates no float holds
        for (double& coordinate : mesh.positions)
            coordinate = offset + coordinate * std::max(1.0, offset / 1e3);
        mesh.add_vertex(1e-60, -1e-50, 1e-40); // below the smallest float, and not used
        const FloatMesh floats(mesh);
        const TestMesh widened{{floats.positions.begin(), floats.positions.end()}, mesh.triangles};
        for (const double weld_tolerance : {0.0, 1e-3})
            for (const geoidx_mesh& built : {mesh.view(), floats.view(), widened.view()}) {
                const Bytes bytes = file_of(built, weld_tolerance);
                for (const geoidx_mesh& expected : {mesh.view(), floats.view(), widened.view()})
                    CHECK(status_expecting(expected, bytes) == GEOIDX_OK);
            }
    }
}

TEST_CASE("expected_mesh does not tell -0 from 0") {
    TestMesh mesh = grid(4, 4);
    TestMesh negative = mesh;
    for (double& coordinate : negative.positions)
        if (coordinate == 0) coordinate = -0.0;
    REQUIRE(std::signbit(FloatMesh(negative).positions[0]));
    const Bytes bytes = save(build(mesh, build_options()).get());
    CHECK(status_expecting(negative.view(), bytes) == GEOIDX_OK);
    CHECK(status_expecting(FloatMesh(negative).view(), bytes) == GEOIDX_OK);
    CHECK(status_expecting(mesh.view(), file_of(FloatMesh(negative).view())) == GEOIDX_OK);
}

TEST_CASE("a mesh far from the origin is refused, or its file can be opened") {
    for (const double offset : {1e37, 3e38, 1e39, 1e300}) {
        CAPTURE(offset);
        TestMesh mesh = grid(6, 5);
        for (size_t i = 0; i < mesh.positions.size(); ++i)
            mesh.positions[i] = mesh.positions[i] * 1e36 + (i % 3 == 0 ? offset : 0);
        const geoidx_mesh view = mesh.view();
        const geoidx_build_options options = build_options();
        geoidx* made = nullptr;
        const geoidx_status status = geoidx_build(&view, &options, &made);
        const IndexHandle index(made);
        CHECK(status == (offset > 3.4e38 ? GEOIDX_ERROR_BAD_MESH : GEOIDX_OK));
        if (status == GEOIDX_OK) CHECK(status_expecting(view, save(index.get())) == GEOIDX_OK);
    }
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
