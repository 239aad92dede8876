#pragma once

#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

#include "src/file/code_tables.h"

namespace geodesic {

// Predicts the entries of a table one after the other, from the straight line between the two vertices and
// from how much the entries beside and above are longer than theirs. Writing and reading go through the same
// entries with the same whole numbers, whatever the processor: of what is not whole, all operations are
// exactly rounded. The rule is in format/SPEC.md.
class TablePrediction {
public:
    static constexpr int32_t NO_PATH = std::numeric_limits<int32_t>::max();

    TablePrediction(const StoredIndex& stored, const CodeTable& table);

    // Calls next(predicted) for each entry, both in steps of the table, row by row. It returns the entry, 0
    // .. most_steps(), or NO_PATH.
    template <class Next>
    void walk(const Next& next);

    int32_t most_steps() const;

private:
    // Predictions are made in sixteenths of a code.
    static constexpr int FRACTION_BITS = 4;

    // The straight lines from a row's vertex to the vertices of the first `count` columns.
    void measure_lines(uint32_t row, uint32_t count);
    // How much the entry to the right of `left` is longer than the straight line, as far as can be told.
    int32_t excess(uint32_t row, uint32_t col, int32_t left) const {
        if (row == 0) return left;
        return col == 0 ? above_[0] : left + above_[col] - above_[col - 1];
    }

    const StoredIndex& stored_;
    const CodeTable& table_;
    int shift_;
    double scale_;                  // from steps of positions to sixteenths of a code
    std::vector<double> x_, y_, z_; // of the columns
    std::vector<int32_t> line_;     // of the row
    // By how much the entries of the row, and of the row above, are longer than the straight line. Below a
    // diagonal, that with the vertex itself follows: 0.
    std::vector<int32_t> excess_, above_;
};

template <class Next>
void TablePrediction::walk(const Next& next) {
    const int bits = FRACTION_BITS + shift_;
    const int32_t half = 1 << (bits - 1);
    for (uint32_t row = 0; row < table_.rows.count; ++row) {
        const uint32_t count = table_.row_size(row);
        measure_lines(row, count);
        int32_t left = 0;
        for (uint32_t col = 0; col < count; ++col) {
            const int32_t more = excess(row, col, left);
            const int32_t entry = next((line_[col] + more + half) >> bits);
            excess_[col] = left = entry == NO_PATH ? 0 : (entry << bits) - line_[col];
        }
        if (table_.below_diagonal) excess_[count] = 0;
        std::swap(excess_, above_);
    }
}

}
