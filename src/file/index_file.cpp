#include "src/file/index_file.h"

#include "format/error.h"
#include "src/file/sections.h"

namespace geodesic {

namespace {

bool is_overlay(const StoredIndex& stored) { return stored.description.engine == GEOIDX_ENGINE_OVERLAY; }

void check_tags(const format::Container& container, const StoredIndex& stored) {
    for (uint32_t tag : {TAG_QUANTA, TAG_SEGMENTS, TAG_OVERLAY_TABLES, TAG_BORDER_TABLES})
        if (container.has(tag) != (is_overlay(stored) == (tag != TAG_BORDER_TABLES)))
            refuse_as_corrupt("section " + format::tag_text(tag) + " does not go with the engine");
}

}

void refuse_as_corrupt(const std::string& detail) { throw Error(GEOIDX_ERROR_CORRUPT, detail); }

std::vector<std::byte> write_index(const StoredIndex& stored) {
    format::ContainerWriter writer(stored.description.mesh_fingerprint);
    write_common(stored, writer);
    is_overlay(stored) ? write_overlay(stored, writer) : write_graph(stored, writer);
    return writer.finish();
}

StoredIndex read_index(const format::Container& container, uint32_t threads) {
    StoredIndex stored;
    read_common(container, stored);
    check_tags(container, stored);
    is_overlay(stored) ? read_overlay(container, threads, stored) : read_graph(container, threads, stored);
    return stored;
}

}
