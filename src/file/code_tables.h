#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "src/index/stored.h"

namespace geodesic {

// The vertices of the rows or columns of a table: a border, or numbers that follow each other.
struct TableVertices {
    const uint32_t* border = nullptr;
    uint32_t first = 0;
    uint32_t count = 0;

    uint32_t number(uint32_t i) const { return border ? border[i] : first + i; }
};

// One table of the overlay engine: a row for each vertex of `rows`, in which there is an entry for each
// vertex of `cols`, or for those before the row's own vertex where only what is below the diagonal is stored.
struct CodeTable {
    uint32_t patch;
    TableVertices rows, cols;
    bool below_diagonal;
    uint64_t begin, size; // its codes in the array of the section

    uint32_t row_size(uint32_t row) const { return below_diagonal ? row : cols.count; }
};

// The tables of OVOV, BVIV and IVIV, in their order in the file, but for those without entries. What is
// returned refers to `stored`.
std::vector<CodeTable> overlay_tables(const StoredIndex& stored);
std::vector<CodeTable> border_internal_tables(const StoredIndex& stored);
std::vector<CodeTable> internal_tables(const StoredIndex& stored);

// Says which of the codes of some tables is the first that is no multiple of 2^shift of its patch, so that it
// could not be saved packed; nothing if there is none.
std::optional<std::string> code_between_steps(std::span<const uint16_t> codes, std::span<const uint8_t> shift,
                                              std::span<const CodeTable> tables);

// The same of OVOV, BVIV and IVIV.
std::optional<std::string> code_between_steps(const StoredIndex& stored);

uint64_t entry_count(std::span<const CodeTable> tables);

}
