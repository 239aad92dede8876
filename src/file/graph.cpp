// Sections of the graph engine.
#include "src/file/sections.h"
#include "src/file/tables.h"

namespace geodesic {

namespace {

TableSection border_section(const StoredIndex& stored) {
    TableSection section(TAG_BORDER_TABLES);
    for (const uint32_t size : stored.border_size) section.add_below_diagonal(size);
    return section;
}

}

void write_graph(const StoredIndex& stored, format::ContainerWriter& writer) {
    border_section(stored).write(stored.border_tables, writer);
    border_internal_section(stored).write(stored.border_internal_tables, writer);
    internal_section(stored).write(stored.internal_tables, writer);
}

void read_graph(const format::Container& container, uint32_t threads, StoredIndex& stored) {
    stored.border_tables = border_section(stored).read(container, threads);
    stored.border_internal_tables = border_internal_section(stored).read(container, threads);
    stored.internal_tables = internal_section(stored).read(container, threads);
}

}
