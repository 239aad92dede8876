#include <cstring>
#include <limits>
#include <new>

#include "format/file_io.h"
#include "geoidx.h"
#include "src/build/build.h"
#include "src/capi/handles.h"
#include "src/capi/status.h"
#include "src/capi/structs.h"
#include "src/file/index_file.h"
#include "src/file/sections.h"

using namespace geodesic;

namespace {

void check_allocator(const geoidx_allocator& allocator) {
    require(!allocator.allocate == !allocator.release, "an allocator needs both allocate and release");
}

struct CloseIndex {
    void operator()(geoidx* index) const { geoidx_close(index); }
};
using OwnedIndex = std::unique_ptr<geoidx, CloseIndex>;

// The handle itself lies in the caller's memory too, so it is made by a CallerMemory that lives only here;
// the one inside the handle then serves the rest and, in geoidx_close, a copy of it frees the handle.
OwnedIndex make_index(const geoidx_allocator& allocator) {
    check_allocator(allocator);
    CallerMemory memory(allocator);
    return OwnedIndex(std::pmr::polymorphic_allocator<>(&memory).new_object<geoidx>(allocator));
}

void check_mesh_matches(const geoidx_mesh* expected, const Description& about) {
    if (!expected) return;
    const geoidx_mesh mesh = whole(*expected, geoidx_mesh_init);
    if (mesh.vertex_count != about.id_count || mesh.triangle_count != about.triangle_count)
        throw Error(GEOIDX_ERROR_MESH_MISMATCH,
                    "the index was built from a mesh of " + std::to_string(about.id_count) +
                        " vertices and " + std::to_string(about.triangle_count) +
                        " triangles, this one has " + std::to_string(mesh.vertex_count) + " and " +
                        std::to_string(mesh.triangle_count));
    if (mesh_fingerprint(mesh) != about.mesh_fingerprint)
        throw Error(GEOIDX_ERROR_MESH_MISMATCH,
                    "the index was built from a mesh with other positions or triangles");
}

// Everything in the file is looked at before the index answers.
void prepare_from(std::span<const std::byte> file, Index& index) {
    prepare(read_index(file), index);
    prepare_pairs(index, [] {});
}

void open_bytes(std::span<const std::byte> file, const geoidx_open_options* given, geoidx** out) {
    const geoidx_open_options options = whole_or_default(given, geoidx_open_options_init);
    OwnedIndex index = make_index(options.allocator);
    prepare_from(file, index->index);
    check_mesh_matches(options.expected_mesh, index->index.description);
    *out = index.release();
}

// All problems that can be told apart: those of the container, then, if it has none, the first one of its
// content.
std::vector<format::Issue> issues_of(std::span<const std::byte> file) {
    auto issues = format::inspect(file, INDEX_TAGS);
    if (!issues.empty()) return issues;
    try {
        Index index(std::pmr::get_default_resource());
        prepare_from(file, index);
    } catch (const Error& error) {
        issues.push_back({error.status, 0, error.what()});
    }
    return issues;
}

std::span<const std::byte> bytes_at(const void* data, uint64_t size) {
    require(data || size == 0, "data is NULL");
    return {static_cast<const std::byte*>(data), static_cast<size_t>(size)};
}

// Borrows scratch of the index for one call.
class BorrowedQuery {
public:
    explicit BorrowedQuery(const geoidx& index) : pool_(index.queries), query_(pool_.take()) {}
    ~BorrowedQuery() { pool_.give_back(query_); }
    BorrowedQuery(const BorrowedQuery&) = delete;
    BorrowedQuery& operator=(const BorrowedQuery&) = delete;

    Query* operator->() const { return query_; }

private:
    QueryPool& pool_;
    Query* query_;
};

void check_msad(const uint32_t* sources, const float* distances) {
    require(sources, "sources is NULL");
    require(distances, "distances is NULL");
}

void fill_info(const Index& index, geoidx_info& info) {
    const Description& about = index.description;
    const Numbering& numbering = index.numbering();
    info.metric = about.metric;
    info.metric_flags = about.metric_flags;
    info.metric_fingerprint = about.metric_fingerprint;
    info.vertex_count = about.id_count;
    info.triangle_count = about.triangle_count;
    info.welded_vertex_count = numbering.vertex_count();
    info.mesh_fingerprint = about.mesh_fingerprint;
    info.engine = about.engine;
    info.table_entries = table_entries(index);
    info.border_vertex_count = numbering.border_vertex_count();
    info.bounding_box_diagonal = about.bounding_box_diagonal;
    info.delta = about.delta;
    info.seed = about.seed;
    info.format_major = format::FORMAT_MAJOR;
    info.format_minor = format::FORMAT_MINOR;
    info.level_count = numbering.level_count();
    for (uint32_t l = 1; l <= numbering.level_count(); ++l)
        info.patch_count[l - 1] = numbering.level_begin[l + 1] - numbering.level_begin[l];
    info.error_sources = about.error.sources;
    info.error_mean = about.error.mean;
    info.error_signed_mean = about.error.signed_mean;
    info.error_p99 = about.error.p99;
    info.error_p999 = about.error.p999;
    info.error_max = about.error.max;
    info.error_mean_at_vertices = about.error.mean_at_vertices;
}

}

uint32_t geoidx_abi_version(void) { return GEOIDX_ABI_VERSION; }

uint32_t geoidx_version(void) {
    return GEOIDX_VERSION_MAJOR * 10000 + GEOIDX_VERSION_MINOR * 100 + GEOIDX_VERSION_PATCH;
}

void geoidx_mesh_init_sized(geoidx_mesh* mesh, uint32_t struct_size) { init_sized(mesh, struct_size, {}); }

void geoidx_build_options_init_sized(geoidx_build_options* options, uint32_t struct_size) {
    geoidx_build_options defaults{};
    defaults.lloyd_iterations = 4;
    defaults.points_per_edge = 12;
    defaults.engine = GEOIDX_ENGINE_OVERLAY;
    defaults.exact_vertices = 400;
    init_sized(options, struct_size, defaults);
}

void geoidx_open_options_init_sized(geoidx_open_options* options, uint32_t struct_size) {
    init_sized(options, struct_size, {});
}

geoidx_status geoidx_build(const geoidx_mesh* mesh, const geoidx_build_options* options, geoidx** out) {
    if (out) *out = nullptr;
    return guarded([&] {
        require(out, "out is NULL");
        require(mesh, "mesh is NULL");
        const auto all_options = whole_or_default(options, geoidx_build_options_init);
        OwnedIndex index = make_index(all_options.allocator);
        build_index(whole(*mesh, geoidx_mesh_init), all_options, index->index);
        *out = index.release();
    });
}

geoidx_status geoidx_save(const geoidx* index, const char* utf8_path) {
    return guarded([&] {
        require(index, "index is NULL");
        require(utf8_path, "utf8_path is NULL");
        format::write_file_atomically(utf8_path, write_index(restore(index->index)));
    });
}

geoidx_status geoidx_save_memory(const geoidx* index, void* buffer, uint64_t capacity, uint64_t* needed) {
    return guarded([&] {
        require(index, "index is NULL");
        require(needed, "needed is NULL");
        require(buffer || capacity == 0, "buffer is NULL, but capacity is not 0");
        const auto bytes = write_index(restore(index->index));
        *needed = bytes.size();
        if (!buffer) return;
        require(bytes.size() <= capacity, "the buffer is too small");
        std::memcpy(buffer, bytes.data(), bytes.size());
    });
}

geoidx_status geoidx_open(const char* utf8_path, const geoidx_open_options* options, geoidx** out) {
    if (out) *out = nullptr;
    return guarded([&] {
        require(out, "out is NULL");
        require(utf8_path, "utf8_path is NULL");
        open_bytes(format::read_file(utf8_path), options, out);
    });
}

geoidx_status geoidx_open_memory(const void* data, uint64_t size, const geoidx_open_options* options,
                                 geoidx** out) {
    if (out) *out = nullptr;
    return guarded([&] {
        require(out, "out is NULL");
        open_bytes(bytes_at(data, size), options, out);
    });
}

void geoidx_close(geoidx* index) {
    if (!index) return;
    CallerMemory memory = index->memory;
    std::pmr::polymorphic_allocator<>(&memory).delete_object(index);
}

geoidx_status geoidx_get_info(const geoidx* index, geoidx_info* info) {
    return guarded([&] {
        require(index, "index is NULL");
        require(info, "info is NULL");
        require(info->struct_size >= sizeof(uint32_t), "struct_size is not set");
        geoidx_info whole_info{};
        fill_info(index->index, whole_info);
        whole_info.struct_size = info->struct_size;
        std::memcpy(info, &whole_info, std::min<size_t>(info->struct_size, sizeof whole_info));
    });
}

geoidx_status geoidx_verify(const void* data, uint64_t size, geoidx_issue_fn issue, void* user) {
    geoidx_status first = GEOIDX_OK;
    const geoidx_status failure = guarded([&] {
        for (const auto& found : issues_of(bytes_at(data, size))) {
            if (first == GEOIDX_OK) first = fail(found.status, found.message.c_str());
            if (issue && !issue(user, found.status, found.offset, found.message.c_str())) break;
        }
    });
    return failure == GEOIDX_OK ? first : failure;
}

geoidx_status geoidx_sssd(const geoidx* index, uint32_t source, uint32_t target, float* distance) {
    return guarded([&] {
        require(index, "index is NULL");
        require(distance, "distance is NULL");
        *distance = BorrowedQuery(*index)->sssd(source, target);
    });
}

geoidx_status geoidx_sssd_batch(const geoidx* index, const uint32_t* source_target_pairs, uint64_t pair_count,
                                float* distances) {
    return guarded([&] {
        require(index, "index is NULL");
        require(pair_count == 0 || source_target_pairs, "source_target_pairs is NULL");
        require(pair_count == 0 || distances, "distances is NULL");
        BorrowedQuery(*index)->sssd_each({source_target_pairs, 2 * pair_count}, {distances, pair_count});
    });
}

geoidx_status geoidx_msad(const geoidx* index, const uint32_t* sources, uint32_t source_count,
                          float* distances, uint32_t distance_count) {
    return guarded([&] {
        require(index, "index is NULL");
        check_msad(sources, distances);
        BorrowedQuery(*index)->msad({sources, source_count}, INFINITE, {distances, distance_count});
    });
}

geoidx_status geoidx_ssad_batch(const geoidx* index, const uint32_t* sources, uint32_t source_count,
                                float* distances, uint64_t distance_count) {
    return guarded([&] {
        require(index, "index is NULL");
        check_msad(sources, distances);
        BorrowedQuery(*index)->ssad_each({sources, source_count}, {distances, distance_count});
    });
}

geoidx_status geoidx_query_create(const geoidx* index, geoidx_query** out) {
    if (out) *out = nullptr;
    return guarded([&] {
        require(out, "out is NULL");
        require(index, "index is NULL");
        auto& memory =
            const_cast<geoidx*>(index)->memory; // a memory resource is not part of the index's value
        *out = std::pmr::polymorphic_allocator<>(&memory).new_object<geoidx_query>(*index, memory);
    });
}

void geoidx_query_close(geoidx_query* query) {
    if (query) std::pmr::polymorphic_allocator<>(&query->memory).delete_object(query);
}

geoidx_status geoidx_query_sssd(geoidx_query* query, uint32_t source, uint32_t target, float* distance) {
    return guarded([&] {
        require(query, "query is NULL");
        require(distance, "distance is NULL");
        *distance = query->query.sssd(source, target);
    });
}

geoidx_status geoidx_query_msad(geoidx_query* query, const uint32_t* sources, uint32_t source_count,
                                float* distances, uint32_t distance_count) {
    return guarded([&] {
        require(query, "query is NULL");
        check_msad(sources, distances);
        query->query.msad({sources, source_count}, INFINITE, {distances, distance_count});
    });
}

geoidx_status geoidx_query_msad_within(geoidx_query* query, const uint32_t* sources, uint32_t source_count,
                                       float radius, float* distances, uint32_t distance_count) {
    return guarded([&] {
        require(query, "query is NULL");
        check_msad(sources, distances);
        query->query.msad({sources, source_count}, radius, {distances, distance_count});
    });
}

geoidx_status geoidx_query_set_threads(geoidx_query* query, uint32_t threads) {
    return guarded([&] {
        require(query, "query is NULL");
        query->query.set_threads(threads);
    });
}

geoidx_status geoidx_query_ssad_batch(geoidx_query* query, const uint32_t* sources, uint32_t source_count,
                                      float* distances, uint64_t distance_count) {
    return guarded([&] {
        require(query, "query is NULL");
        check_msad(sources, distances);
        query->query.ssad_each({sources, source_count}, {distances, distance_count});
    });
}

geoidx_status geoidx_query_prepare(geoidx_query* query, uint32_t source) {
    return guarded([&] {
        require(query, "query is NULL");
        query->query.prepare(source);
    });
}

geoidx_status geoidx_query_prepared(geoidx_query* query, const uint32_t* targets, uint64_t target_count,
                                    float* distances) {
    return guarded([&] {
        require(query, "query is NULL");
        require(target_count == 0 || targets, "targets is NULL");
        require(target_count == 0 || distances, "distances is NULL");
        for (uint64_t i = 0; i < target_count; ++i) distances[i] = query->query.prepared_sssd(targets[i]);
    });
}
