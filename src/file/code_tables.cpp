#include "src/file/code_tables.h"

#include "src/index/numbering.h"
#include "src/overlay/tables/codes.h"

namespace geodesic {

namespace {

class TableList {
public:
    void add(uint32_t patch, TableVertices rows, TableVertices cols) {
        add({patch, rows, cols, false, 0, uint64_t{rows.count} * cols.count});
    }
    void add_below_diagonal(uint32_t patch, TableVertices vertices) {
        add({patch, vertices, vertices, true, 0, triangle_size(vertices.count)});
    }
    std::vector<CodeTable> take() { return std::move(tables_); }

private:
    void add(CodeTable table) {
        if (table.size == 0) return;
        table.begin = entry_count(tables_);
        tables_.push_back(table);
    }

    std::vector<CodeTable> tables_;
};

// The leaves one after the other: add(patch, border, internal).
template <class Add>
void for_each_leaf(const StoredIndex& stored, const Add& add) {
    uint32_t first = 0, patch = 1;
    for (const uint32_t count : stored.owned_count) first += count;
    const size_t inner = stored.owned_count.size();
    const uint32_t* border = stored.border.data();
    for (const uint32_t size : stored.border_size) {
        if (patch >= inner) {
            const uint32_t internal = stored.internal_count[patch - inner];
            add(patch, TableVertices{border, 0, size}, TableVertices{nullptr, first, internal});
            first += internal;
        }
        border += size;
        ++patch;
    }
}

}

std::vector<CodeTable> overlay_tables(const StoredIndex& stored) {
    TableList list;
    uint32_t first = 0;
    const uint32_t* border = stored.border.data();
    for (uint32_t p = 0; p < stored.owned_count.size(); ++p) {
        const TableVertices owned{nullptr, first, stored.owned_count[p]};
        const uint32_t size = p > 0 ? stored.border_size[p - 1] : 0; // the root has no border
        list.add(p, owned, {border, 0, size});
        list.add_below_diagonal(p, owned);
        border += size;
        first += owned.count;
    }
    return list.take();
}

std::vector<CodeTable> border_internal_tables(const StoredIndex& stored) {
    TableList list;
    for_each_leaf(stored, [&](uint32_t patch, TableVertices border, TableVertices internal) {
        list.add(patch, border, internal);
    });
    return list.take();
}

std::vector<CodeTable> internal_tables(const StoredIndex& stored) {
    TableList list;
    for_each_leaf(stored, [&](uint32_t patch, TableVertices, TableVertices internal) {
        list.add_below_diagonal(patch, internal);
    });
    return list.take();
}

std::optional<std::string> code_between_steps(std::span<const uint16_t> codes, std::span<const uint8_t> shift,
                                              std::span<const CodeTable> tables) {
    for (const CodeTable& table : tables) {
        const int step = 1 << shift[table.patch];
        for (const uint16_t code : codes.subspan(table.begin, table.size))
            if (code != TableCode::UNREACHED && (code & (step - 1)) != 0)
                return "the code " + std::to_string(code) + " of patch " + std::to_string(table.patch) +
                       ", which is no multiple of " + std::to_string(step);
    }
    return std::nullopt;
}

std::optional<std::string> code_between_steps(const StoredIndex& stored) {
    auto found = code_between_steps(stored.overlay_codes, stored.shift, overlay_tables(stored));
    if (!found)
        found =
            code_between_steps(stored.border_internal_codes, stored.shift, border_internal_tables(stored));
    if (!found) found = code_between_steps(stored.internal_codes, stored.shift, internal_tables(stored));
    return found;
}

uint64_t entry_count(std::span<const CodeTable> tables) {
    return tables.empty() ? 0 : tables.back().begin + tables.back().size;
}

}
