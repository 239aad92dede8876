// What is wrong with the bytes of an index, by numbers that stay the same.
#include <utility>

#include "geoidx.h"
#include "src/base/array.h"
#include "src/base/threads.h"
#include "src/capi/handles.h"
#include "src/capi/status.h"
#include "src/capi/structs.h"
#include "src/file/index_file.h"
#include "src/file/kept_mesh.h"
#include "src/index/section_tags.h"

using namespace geodesic;

namespace {

constexpr std::pair<uint32_t, uint32_t> NUMBER_OF_TAG[]{
    {TAG_META, GEOIDX_ISSUE_META},
    {TAG_HIERARCHY, GEOIDX_ISSUE_HIER},
    {TAG_VERTICES, GEOIDX_ISSUE_VERT},
    {TAG_POSITIONS, GEOIDX_ISSUE_POSI},
    {TAG_BORDERS, GEOIDX_ISSUE_BORD},
    {TAG_BORDER_TABLES, GEOIDX_ISSUE_BVBV},
    {TAG_BORDER_INTERNAL_TABLES, GEOIDX_ISSUE_BVIV},
    {TAG_INTERNAL_TABLES, GEOIDX_ISSUE_IVIV},
    {TAG_QUANTA, GEOIDX_ISSUE_QUAN},
    {TAG_SEGMENTS, GEOIDX_ISSUE_SEGM},
    {TAG_OVERLAY_TABLES, GEOIDX_ISSUE_OVOV},
    {TAG_HOP_CODES, GEOIDX_ISSUE_HOPS},
    {TAG_MESH, GEOIDX_ISSUE_MESH},
    {TAG_MEASURED_PAIRS, GEOIDX_ISSUE_PAIR},
    {TAG_STEEP_EDGES, GEOIDX_ISSUE_EDGE},
};

uint32_t number_of(const Error& error) {
    if (error.is_undecodable) return GEOIDX_ISSUE_DECODING;
    for (const auto& [tag, number] : NUMBER_OF_TAG)
        if (tag == error.section) return number;
    return GEOIDX_ISSUE_WHOLE_INDEX;
}

format::Issue issue_of(const Error& error, const format::Container& container) {
    const bool has_place = error.section != 0 && container.has(error.section);
    const uint64_t offset = has_place ? container.section(error.section).offset : 0;
    return {number_of(error), error.status, offset, error.what()};
}

// A copy of bytes that do not lie where a file's arrays can be read in place; otherwise empty.
std::vector<std::byte> aligned_copy(std::span<const std::byte> bytes) {
    if (reinterpret_cast<uintptr_t>(bytes.data()) % alignof(uint64_t) == 0) return {};
    return {bytes.begin(), bytes.end()};
}

// All problems that can be told apart: those of the container, then, if it has none, the first one of its
// content.
std::vector<format::Issue> issues_of(std::span<const std::byte> file) {
    auto issues = format::inspect(file, INDEX_TAGS);
    if (!issues.empty()) return issues;
    const auto container = format::Container::parse(file, INDEX_TAGS);
    try {
        Index index(global_heap());
        prepare(read_index(container, {.threads = thread_count(0), .may_lack_positions = true}), index);
        if (index.description.codec == GEOIDX_CODEC_MAPPED) require_hops_follow(index);
        if (index.keeps_mesh()) unpack_mesh(index.mesh, index.description, index.number_of_id);
    } catch (const Error& error) {
        issues.push_back(issue_of(error, container));
    }
    return issues;
}

}

geoidx_status geoidx_verify(const void* data, uint64_t size, geoidx_issue_fn issue, void* user) {
    geoidx_status first = GEOIDX_OK;
    const geoidx_status failure = guarded([&] {
        const auto bytes = bytes_at(data, size);
        const auto copy = aligned_copy(bytes);
        for (const auto& found : issues_of(copy.empty() ? bytes : copy)) {
            if (first == GEOIDX_OK) first = fail(found.status, found.message.c_str());
            const geoidx_issue told{found.number, found.status, found.offset, found.message.c_str()};
            if (issue && !issue(user, &told)) break;
        }
    });
    return failure == GEOIDX_OK ? first : failure;
}
