#pragma once

#include <cstddef>
#include <cstdint>
#include <memory_resource>

#include "src/base/array.h"
#include "src/overlay/kernels/dispatch.h"
#include "src/overlay/tables/half_table.h"

namespace geodesic {

// A table of which rows are wanted that it has only in part, or as columns.
struct TurnableTable {
    const uint16_t* codes;
    uint32_t rows;
    size_t columns;       // of a row of the table, if it is no half
    bool is_half = false; // a HalfTable, whose rows are wanted; otherwise its columns are

    const uint16_t* row(uint32_t number) const {
        return codes + (is_half ? HalfTable::row_begin(number) : number * columns);
    }
};

// Rows of such a table, from their first wanted entry to the last one. Where they do not lie in the table as
// they are, squares of the table are turned. The object is used for one table, or part of it, after the
// other.
class TurnedRows {
public:
    explicit TurnedRows(std::pmr::memory_resource* memory);

    // The first entry of rows that are wanted from `first` on.
    static uint32_t first_entry(uint32_t first) { return first / SIDE * SIDE; }

    // Begins with the entries that are wanted. Every row that is wanted is then announced, in any order. Rows
    // of one square are turned together where they follow each other, as they do along a border.
    void begin(const TurnableTable& table, uint32_t first, uint32_t last);
    void announce(uint32_t row) {
        if (lies_there(row) || row / SIDE == latest_block_) return;
        latest_block_ = row / SIDE;
        blocks_.push_back(latest_block_);
    }

    // Turns what was announced. Then returns each row that was, in the same order again, from first_entry()
    // on. Rows are readable up to whole blocks behind the last entry, and stay valid until begin().
    void turn();
    const uint16_t* next_row(uint32_t row) {
        if (lies_there(row)) return table_.row(row) + first_;
        if (row / SIDE != latest_block_) {
            latest_block_ = row / SIDE;
            latest_rows_ = latest_rows_ ? latest_rows_ + SIDE * row_size_ : codes_.data();
        }
        return latest_rows_ + row % SIDE * row_size_;
    }

private:
    static constexpr uint32_t SIDE = HalfTable::SIDE, GROUP = TurnedSquares::ROWS;

    bool lies_there(uint32_t row) const { return last_ < entries_there(row / SIDE); }
    // How many entries the rows of a block have in the table.
    uint32_t entries_there(uint32_t block) const { return table_.is_half ? (block + 1) * SIDE : 0; }
    uint16_t* row_of_block(size_t block) { return codes_.data() + block * SIDE * row_size_; }
    void turn_group(uint32_t first);
    void copy_entries(size_t block, uint32_t first);

    const Kernels& kernels_;
    TurnableTable table_{};
    uint32_t first_ = 0, last_ = 0; // entries
    size_t row_size_ = 0;
    uint32_t latest_block_ = NONE;
    const uint16_t* latest_rows_ = nullptr; // those of the latest block
    Array<uint32_t> blocks_;                // of SIDE rows each, as they were announced
    Array<TurnedSquares> squares_;          // of one group
    Array<uint16_t> codes_;                 // SIDE rows a block
};

}
