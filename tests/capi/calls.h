#pragma once

#include <cstddef>
#include <cstdlib>
#include <span>
#include <string>
#include <vector>

#include <doctest/doctest.h>

#include "geoidx.h"
#include "tests/capi/meshes.h"
#include "tests/capi/shared_index.h"
#include "tests/support/handles.h"

// The C API with owning handles and vectors. Each call is required to succeed.
namespace geodesic::test {

using Bytes = std::vector<std::byte>;

// Two threads, whatever the machine, the given levels, and the graph engine, whose distances are known to
// float precision.
inline geoidx_build_options build_options(uint32_t metric = GEOIDX_METRIC_EXACT, uint32_t levels = 0,
                                          double delta = 0) {
    geoidx_build_options options;
    geoidx_build_options_init(&options);
    options.metric = metric;
    options.level_count = levels;
    options.delta = delta;
    options.threads = 2;
    options.engine = GEOIDX_ENGINE_GRAPH;
    for (uint32_t l = 0; l < levels; ++l) options.patches[l] = levels == 1 ? 9 : levels == 2 ? 4 : 3;
    return options;
}

// The metric of a plane without holes, the straight line, quick to build with however many vertices a border
// has. The mesh must outlive the build.
inline geoidx_build_options options_of_plane(const TestMesh& mesh, std::initializer_list<uint32_t> patches) {
    auto options = build_options(GEOIDX_METRIC_CALLBACK, static_cast<uint32_t>(patches.size()));
    std::copy(patches.begin(), patches.end(), options.patches);
    options.metric_flags = GEOIDX_METRIC_UNFOLDABLE;
    options.metric_user = const_cast<TestMesh*>(&mesh);
    options.metric_callback = [](void* user, uint32_t source, const uint32_t* targets, uint32_t count,
                                 double* distances) {
        for (uint32_t i = 0; i < count; ++i)
            distances[i] = static_cast<const TestMesh*>(user)->straight(source, targets[i]);
        return geoidx_status{GEOIDX_OK};
    };
    return options;
}

// Those of a user, on two threads or so many.
inline geoidx_build_options default_options(uint32_t threads = 2) {
    geoidx_build_options options;
    geoidx_build_options_init(&options);
    options.threads = threads;
    return options;
}

inline void require_success(geoidx_status status) {
    INFO("status: ", std::string(geoidx_status_string(status)),
         ", detail: ", std::string(geoidx_last_error()));
    REQUIRE(status == GEOIDX_OK);
}

inline IndexHandle build(const TestMesh& mesh, const geoidx_build_options& options) {
    const geoidx_mesh view = mesh.view();
    geoidx* index = nullptr;
    require_success(geoidx_build(&view, &options, &index));
    REQUIRE(index != nullptr);
    return IndexHandle(index);
}

inline std::shared_ptr<const geoidx> shared_index(const TestMesh& mesh, const geoidx_build_options& options) {
    return shared_index(mesh.view(), options);
}

inline Bytes save(const geoidx* index, const geoidx_save_options* options) {
    uint64_t size = 0;
    require_success(geoidx_save_memory(index, options, nullptr, 0, &size));
    Bytes bytes(size);
    require_success(geoidx_save_memory(index, options, bytes.data(), bytes.size(), &size));
    REQUIRE(size == bytes.size());
    return bytes;
}

inline Bytes save(const geoidx* index, uint32_t codec, uint32_t flags = 0) {
    geoidx_save_options options;
    geoidx_save_options_init(&options);
    options.codec = codec;
    options.flags = flags;
    return save(index, &options);
}

inline Bytes save(const geoidx* index) { return save(index, GEOIDX_CODEC_PACKED); }

inline IndexHandle open(std::span<const std::byte> bytes) {
    geoidx* index = nullptr;
    require_success(geoidx_open_memory(bytes.data(), bytes.size(), nullptr, &index));
    return IndexHandle(index);
}

// Options that expect a mesh, which must outlive them.
inline geoidx_open_options expecting(const geoidx_mesh& mesh) {
    geoidx_open_options options;
    geoidx_open_options_init(&options);
    options.expected_mesh = &mesh;
    return options;
}

inline IndexHandle open(std::span<const std::byte> bytes, const TestMesh& expected) {
    const geoidx_mesh view = expected.view();
    const auto options = expecting(view);
    geoidx* index = nullptr;
    require_success(geoidx_open_memory(bytes.data(), bytes.size(), &options, &index));
    return IndexHandle(index);
}

inline geoidx_status open_status(std::span<const std::byte> bytes, const geoidx_open_options* options) {
    geoidx* index = nullptr;
    const geoidx_status status = geoidx_open_memory(bytes.data(), bytes.size(), options, &index);
    const IndexHandle owned(index);
    CHECK((status == GEOIDX_OK) == (index != nullptr));
    return status;
}

inline geoidx_status open_status(std::span<const std::byte> bytes) { return open_status(bytes, nullptr); }

inline geoidx_status open_status(std::span<const std::byte> bytes, const geoidx_mesh& expected) {
    const auto options = expecting(expected);
    return open_status(bytes, &options);
}

inline QueryHandle query_of(const geoidx* index) {
    geoidx_query* query = nullptr;
    require_success(geoidx_query_create(index, &query));
    return QueryHandle(query);
}

inline float sssd(const geoidx* index, uint32_t source, uint32_t target) {
    float distance = -1;
    require_success(geoidx_sssd(index, source, target, &distance));
    return distance;
}

inline std::vector<float> msad(const geoidx* index, std::span<const uint32_t> sources, uint32_t count) {
    std::vector<float> distances(count, -1.0f);
    require_success(
        geoidx_msad(index, sources.data(), static_cast<uint32_t>(sources.size()), distances.data(), count));
    return distances;
}

inline std::vector<float> msad(const geoidx* index, uint32_t source, uint32_t count) {
    return msad(index, std::span(&source, 1), count);
}

inline SolverHandle solver(const TestMesh& mesh, const geoidx_build_options& options) {
    const geoidx_mesh view = mesh.view();
    geoidx_solver* made = nullptr;
    require_success(geoidx_solver_create(&view, &options, &made));
    return SolverHandle(made);
}

// The metric itself, to every vertex.
inline std::vector<double> metric_distances(geoidx_solver* solver, std::span<const uint32_t> sources,
                                            uint32_t count) {
    std::vector<double> distances(count, -1.0);
    require_success(geoidx_solver_distances(solver, sources.data(), static_cast<uint32_t>(sources.size()),
                                            nullptr, count, distances.data()));
    return distances;
}

inline std::vector<double> metric_distances(geoidx_solver* solver, uint32_t source, uint32_t count) {
    return metric_distances(solver, std::span(&source, 1), count);
}

inline geoidx_info info_of(const geoidx* index) {
    geoidx_info info{};
    info.struct_size = sizeof info;
    require_success(geoidx_get_info(index, &info));
    return info;
}

}
