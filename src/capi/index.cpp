// The handle of an index: built, saved, opened, closed.
#include <cstring>
#include <optional>

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

void check_limits(const format::Container& container, const geoidx_open_options& options) {
    if (options.max_memory == 0) return;
    uint64_t decoded = 0;
    for (const format::Section& section : container.sections()) {
        if (section.raw_size > options.max_memory - decoded)
            throw Error(GEOIDX_ERROR_LIMIT, "the sections of the file hold more than the " +
                                                std::to_string(options.max_memory) +
                                                " bytes that max_memory allows");
        decoded += section.raw_size;
    }
}

bool is_mapped_file(const format::FileStart& start) {
    return format::has_valid_header(start.bytes, start.size) &&
           format::names_section(start.bytes, TAG_HOP_CODES);
}

uint64_t index_size(const format::FileStart& start) {
    return format::checked_file_size(start.bytes, start.size);
}

// An index that is being opened.
class Opening {
public:
    explicit Opening(const geoidx_open_options* given)
        : options_(whole_or_default(given, geoidx_open_options_init)),
          index_(make_index(options_.allocator)) {
        constexpr uint32_t FLAGS = GEOIDX_OPEN_PAIRS | GEOIDX_OPEN_BORROW | GEOIDX_OPEN_NO_LABELS;
        require((options_.flags & ~FLAGS) == 0, "flags has bits that mean nothing");
        if (options_.max_memory != 0) index_->memory.set_limit(options_.max_memory);
        if (options_.expected_mesh) mesh_ = whole(*options_.expected_mesh, geoidx_mesh_init);
    }

    geoidx* file(const std::string& utf8_path) {
        index_->mapping = format::FileMapping::of_file(utf8_path, is_mapped_file);
        return index_->mapping ? kept(index_->mapping->bytes())
                               : passing(format::read_file(utf8_path, index_size));
    }

    geoidx* memory(std::span<const std::byte> data) {
        if (!(options_.flags & GEOIDX_OPEN_BORROW)) return passing(data);
        require(reinterpret_cast<uintptr_t>(data.data()) % alignof(uint64_t) == 0,
                "data is borrowed, but not aligned to 8 bytes");
        return kept(data);
    }

private:
    // From bytes that are gone after the call.
    geoidx* passing(std::span<const std::byte> file) {
        if (!is_mapped_file({file, file.size()})) return kept(file);
        auto& copy = index_->file_copy;
        copy.resize((file.size() + sizeof(uint64_t) - 1) / sizeof(uint64_t));
        std::memcpy(copy.data(), file.data(), file.size());
        return kept(std::as_bytes(std::span(copy)).first(file.size()));
    }

    // From bytes that stay as long as the index, if it is a mapped file.
    geoidx* kept(std::span<const std::byte> file) {
        Index& index = index_->index;
        const auto container = format::Container::parse(file, INDEX_TAGS);
        check_limits(container, options_);
        prepare(read_index(container, read_options()), index);
        list_sections(container, index_->sections);
        if (options_.flags & GEOIDX_OPEN_NO_LABELS) leave_out_labels(index);
        if (options_.flags & GEOIDX_OPEN_PAIRS) prepare_pairs(index);
        return index_.release();
    }

    ReadOptions read_options() const {
        return {.threads = thread_count(options_.threads),
                .max_vertices = options_.max_vertices,
                .mesh = mesh_ ? &*mesh_ : nullptr};
    }

    const geoidx_open_options options_;
    std::optional<geoidx_mesh> mesh_; // that the index must be of
    OwnedIndex index_;
};

void apply(const geoidx_save_options& options, StoredIndex& stored) {
    constexpr uint32_t FLAGS = GEOIDX_SAVE_NO_POSITIONS | GEOIDX_SAVE_NO_MESH;
    require(options.codec <= GEOIDX_CODEC_MAPPED, "codec is not a GEOIDX_CODEC_*");
    require((options.flags & ~FLAGS) == 0, "flags has bits that mean nothing");
    Description& about = stored.description;
    if (about.engine == GEOIDX_ENGINE_OVERLAY) about.codec = options.codec;
    about.file_flags = options.flags & GEOIDX_SAVE_NO_POSITIONS;
    if (options.flags & GEOIDX_SAVE_NO_MESH) stored.mesh = {};
}

// The bytes of a file of the index, as it is asked for.
std::vector<std::byte> file_of(const geoidx& index, const geoidx_save_options* given) {
    StoredIndex stored = restore(index.index);
    if (given) apply(whole(*given, geoidx_save_options_init), stored);
    // Other forms hold fewer tables, from which the others must follow.
    if (index.index.description.codec == GEOIDX_CODEC_MAPPED &&
        stored.description.codec != GEOIDX_CODEC_MAPPED)
        require_hops_follow(index.index);
    return write_index(stored);
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
    if (needed) *needed = 0;
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
        *out = Opening(options).file(utf8_path);
    });
}

geoidx_status geoidx_open_memory(const void* data, uint64_t size, const geoidx_open_options* options,
                                 geoidx** out) {
    if (out) *out = nullptr;
    return guarded([&] {
        require(out, "out is NULL");
        *out = Opening(options).memory(bytes_at(data, size));
    });
}

void geoidx_close(geoidx* index) {
    if (!index) return;
    CallerMemory memory(index->memory.allocator());
    std::pmr::polymorphic_allocator<>(&memory).delete_object(index);
}

geoidx_status geoidx_get_sections(const geoidx* index, geoidx_section* sections, uint32_t capacity,
                                  uint32_t* count) {
    if (count) *count = 0;
    return guarded([&] {
        require(index, "index is NULL");
        require(count, "count is NULL");
        require(sections || capacity == 0, "sections is NULL, but capacity is not 0");
        *count = static_cast<uint32_t>(index->sections.size());
        std::copy_n(index->sections.begin(), std::min(*count, capacity), sections);
    });
}
