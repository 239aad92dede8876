// The handle of an index: built, saved, opened, verified, closed.
#include <cstring>

#include "format/file_io.h"
#include "geoidx.h"
#include "src/base/threads.h"
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

void list_sections(const format::Container& container, Array<geoidx_section>& sections) {
    for (const format::Section& section : container.sections()) {
        geoidx_section listed{};
        for (int i = 0; i < 4; ++i) listed.tag[i] = static_cast<char>(section.tag >> (8 * i));
        listed.coding = static_cast<uint32_t>(section.codec);
        listed.offset = section.offset;
        listed.stored_size = section.stored_size;
        listed.raw_size = section.raw_size;
        sections.push_back(listed);
    }
}

void open_bytes(std::span<const std::byte> file, const geoidx_open_options* given, geoidx** out) {
    const geoidx_open_options options = whole_or_default(given, geoidx_open_options_init);
    require((options.flags & ~uint32_t{GEOIDX_OPEN_PAIRS}) == 0, "flags has bits that mean nothing");
    OwnedIndex index = make_index(options.allocator);
    const auto container = format::Container::parse(file, INDEX_TAGS);
    prepare(read_index(container, thread_count(options.threads)), index->index);
    list_sections(container, index->sections);
    check_mesh_matches(options.expected_mesh, index->index.description);
    if (options.flags & GEOIDX_OPEN_PAIRS) prepare_pairs(index->index);
    *out = index.release();
}

// All problems that can be told apart: those of the container, then, if it has none, the first one of its
// content.
std::vector<format::Issue> issues_of(std::span<const std::byte> file) {
    auto issues = format::inspect(file, INDEX_TAGS);
    if (!issues.empty()) return issues;
    try {
        Index index(std::pmr::get_default_resource());
        prepare(read_index(format::Container::parse(file, INDEX_TAGS), thread_count(0)), index);
    } catch (const Error& error) {
        issues.push_back({error.status, 0, error.what()});
    }
    return issues;
}

// The bytes of a file of the index, with the codec that is asked for.
std::vector<std::byte> file_of(const geoidx& index, const geoidx_save_options* given) {
    StoredIndex stored = restore(index.index);
    if (given) {
        const uint32_t codec = whole(*given, geoidx_save_options_init).codec;
        require(codec <= GEOIDX_CODEC_LOSSLESS, "codec is not a GEOIDX_CODEC_*");
        if (stored.description.engine == GEOIDX_ENGINE_OVERLAY) stored.description.codec = codec;
    }
    return write_index(stored);
}

std::span<const std::byte> bytes_at(const void* data, uint64_t size) {
    require(data || size == 0, "data is NULL");
    return {static_cast<const std::byte*>(data), static_cast<size_t>(size)};
}

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

geoidx_status geoidx_save(const geoidx* index, const char* utf8_path, const geoidx_save_options* options) {
    return guarded([&] {
        require(index, "index is NULL");
        require(utf8_path, "utf8_path is NULL");
        format::write_file_atomically(utf8_path, file_of(*index, options));
    });
}

geoidx_status geoidx_save_memory(const geoidx* index, const geoidx_save_options* options, void* buffer,
                                 uint64_t capacity, uint64_t* needed) {
    return guarded([&] {
        require(index, "index is NULL");
        require(needed, "needed is NULL");
        require(buffer || capacity == 0, "buffer is NULL, but capacity is not 0");
        const auto bytes = file_of(*index, options);
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

geoidx_status geoidx_get_sections(const geoidx* index, geoidx_section* sections, uint32_t capacity,
                                  uint32_t* count) {
    return guarded([&] {
        require(index, "index is NULL");
        require(count, "count is NULL");
        require(sections || capacity == 0, "sections is NULL, but capacity is not 0");
        *count = static_cast<uint32_t>(index->sections.size());
        std::copy_n(index->sections.begin(), std::min(*count, capacity), sections);
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
