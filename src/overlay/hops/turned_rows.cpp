#include "src/overlay/hops/turned_rows.h"

#include <algorithm>

namespace geodesic {

TurnedRows::TurnedRows(std::pmr::memory_resource* memory)
    : kernels_(runnable_kernels().back()), blocks_(memory), squares_(memory), codes_(memory) {}

void TurnedRows::begin(const TurnableTable& table, uint32_t first, uint32_t last) {
    table_ = table;
    first_ = first_entry(first);
    last_ = last;
    row_size_ = SourceCode::whole_blocks(last + 1 - first_) + SourceCode::BLOCK;
    latest_block_ = NONE;
    blocks_.clear();
}

void TurnedRows::turn() {
    latest_block_ = NONE;
    latest_rows_ = nullptr;
    if (blocks_.empty()) return;
    codes_.resize(std::max(codes_.size(), blocks_.size() * SIDE * row_size_));
    for (uint32_t entry = first_; entry <= last_; entry += GROUP) turn_group(entry);
}

// GROUP entries of all rows. They lie in as many rows of the table, of which the last one that is wanted
// stands for those behind it.
void TurnedRows::turn_group(uint32_t first) {
    const uint16_t* rows[GROUP];
    for (uint32_t i = 0; i < GROUP; ++i) rows[i] = table_.row(std::min(first + i, last_));
    squares_.clear();
    for (size_t b = 0; b < blocks_.size(); ++b)
        if (first + GROUP > entries_there(blocks_[b]))
            squares_.push_back({size_t{blocks_[b]} * SIDE, row_of_block(b) + (first - first_)});
    kernels_.turn_squares(rows, squares_, row_size_);
    for (size_t b = 0; b < blocks_.size(); ++b)
        if (first < entries_there(blocks_[b])) copy_entries(b, first);
}

// Of a group, those that the rows of a block have in the table.
void TurnedRows::copy_entries(size_t block, uint32_t first) {
    const uint32_t begin = blocks_[block] * SIDE, end = std::min(begin + SIDE, table_.rows);
    const uint32_t count = std::min(GROUP, entries_there(blocks_[block]) - first);
    uint16_t* out = row_of_block(block) + (first - first_);
    for (uint32_t row = begin; row < end; ++row, out += row_size_)
        std::copy_n(table_.row(row) + first, count, out);
}

}
