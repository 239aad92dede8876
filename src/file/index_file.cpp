#include "src/file/index_file.h"

#include <initializer_list>

#include "format/error.h"
#include "src/file/sections.h"

namespace geodesic {

namespace {

bool is_overlay(const StoredIndex& stored) { return stored.description.engine == GEOIDX_ENGINE_OVERLAY; }
bool is_mapped(const StoredIndex& stored) { return stored.description.codec == GEOIDX_CODEC_MAPPED; }

void check_tags(const format::Container& container, const StoredIndex& stored) {
    const bool overlay = is_overlay(stored), mapped = is_mapped(stored);
    const auto expect = [&](std::initializer_list<uint32_t> tags, bool expected) {
        for (const uint32_t tag : tags)
            if (container.has(tag) != expected)
                throw Error(GEOIDX_ERROR_CORRUPT,
                            "section " + format::tag_text(tag) +
                                (expected ? " is missing" : " does not go with the engine and the codec"),
                            tag);
    };
    expect({TAG_BORDER_TABLES}, !overlay);
    expect({TAG_QUANTA, TAG_SEGMENTS}, overlay);
    expect({TAG_OVERLAY_TABLES}, overlay && !mapped);
    expect({TAG_BORDER_INTERNAL_TABLES, TAG_INTERNAL_TABLES}, !mapped);
    expect({TAG_HOP_CODES}, mapped);
    if (!overlay) expect({TAG_MEASURED_PAIRS, TAG_STEEP_EDGES}, false);
}

}

void refuse_as_corrupt(const std::string& detail) { throw Error(GEOIDX_ERROR_CORRUPT, detail); }

std::vector<std::byte> write_index(const StoredIndex& stored) {
    format::ContainerWriter writer(stored.description.mesh_fingerprint,
                                   is_mapped(stored) ? format::Packing::None : format::Packing::Zstd);
    write_common(stored, writer);
    is_overlay(stored) ? write_overlay(stored, writer) : write_graph(stored, writer);
    write_mesh(stored, writer);
    return writer.finish();
}

StoredIndex read_index(const format::Container& container, const ReadOptions& options) {
    StoredIndex stored;
    read_common(container, options, stored);
    check_tags(container, stored);
    is_overlay(stored) ? read_overlay(container, options, stored)
                       : read_graph(container, options.threads, stored);
    about_section(TAG_MESH, [&] { read_mesh(container, stored); });
    return stored;
}

}
