#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "format/container.h"
#include "src/index/stored.h"

namespace geodesic {

// The tables of one section as matrices of float32. Values lie end to end as in StoredIndex. The file folds
// the entries below a diagonal into a rectangle.
class TableSection {
public:
    explicit TableSection(uint32_t tag) : tag_(tag) {}

    // Adds the next table: a full one, or one of so many rows of which the entries below the diagonal are
    // kept.
    void add(uint32_t rows, uint32_t cols);
    void add_below_diagonal(uint32_t size);

    void write(std::span<const float> values, format::ContainerWriter& writer) const;

    // Compares the size of the section with the tables before anything is allocated. Throws Error CORRUPT if
    // it differs, and if an entry is negative or NaN. Uses up to so many threads, fewer for few entries.
    std::vector<float> read(const format::Container& container, uint32_t threads) const;

private:
    std::vector<float> read_values(const format::Container& container, uint32_t threads) const;

    struct Table {
        uint32_t rows, cols; // of the matrix
        uint32_t size;       // of the triangle that it folds, or 0
    };

    uint32_t tag_;
    std::vector<Table> tables_;
    uint64_t entries_ = 0;
};

// The tables of leaves, which both engines have.
TableSection border_internal_section(const StoredIndex& stored);
TableSection internal_section(const StoredIndex& stored);

}
