#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "src/base/numbers.h"

namespace geodesic {

// Values of some of many numbers, such as those of the vertices that a search meets. Unlike a node of
// std::unordered_map, none is allocated by itself.
template <class T>
class NumberMap {
public:
    // The value of a number, T{} at first. The next call may move it.
    T& operator[](uint32_t number) {
        if (free_ == 0) grow();
        Cell& cell = cell_of(number);
        if (cell.number == NONE) {
            cell.number = number;
            --free_;
        }
        return cell.value;
    }

    void clear() {
        cells_.assign(cells_.size(), {});
        free_ = cells_.size() / 2;
    }

private:
    static constexpr size_t FEWEST_CELLS = 64;
    struct Cell {
        uint32_t number = NONE;
        T value{};
    };

    // The cell with the number, or the one where it belongs.
    Cell& cell_of(uint32_t number) {
        constexpr uint32_t GOLDEN = 0x9e3779b9; // spreads numbers that are close to each other
        size_t i = (number * GOLDEN) >> shift_;
        while (cells_[i].number != number && cells_[i].number != NONE) i = (i + 1) & last_;
        return cells_[i];
    }

    void grow() {
        std::vector<Cell> old(cells_.empty() ? FEWEST_CELLS : 2 * cells_.size());
        old.swap(cells_);
        free_ = cells_.size() / 2 - old.size() / 2;
        last_ = cells_.size() - 1;
        shift_ = 32 - std::countr_zero(cells_.size());
        for (Cell& cell : old)
            if (cell.number != NONE) cell_of(cell.number) = cell;
    }

    std::vector<Cell> cells_; // a power of two, at least half of them without a number
    size_t free_ = 0;         // numbers that there is room for without more cells
    size_t last_ = 0;         // the number of the last cell
    int shift_ = 0;
};

}
