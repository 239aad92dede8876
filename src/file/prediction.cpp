#include "src/file/prediction.h"

#include <algorithm>
#include <cmath>

#include "src/overlay/tables/codes.h"

namespace geodesic {

namespace {

// The straight line between vertices is no longer than the longest distance where distances are lengths.
// Other metrics have other units.
constexpr double LONGEST_LINE = 16 * TableCode::UNREACHED;

double scale_of(float position_step, float quantum) {
    constexpr double LARGEST_SCALE = 1e9;
    return quantum > 0 ? std::min(16 * double{position_step} / double{quantum}, LARGEST_SCALE) : 0;
}

}

TablePrediction::TablePrediction(const StoredIndex& stored, const CodeTable& table)
    : stored_(stored), table_(table), shift_(stored.shift[table.patch]),
      scale_(scale_of(stored.position_step, stored.quantum[table.patch])), line_(table.cols.count),
      excess_(size_t{table.cols.count} + 1), above_(size_t{table.cols.count} + 1) {
    for (uint32_t i = 0; i < table.cols.count; ++i) {
        const auto& position = stored.positions[table.cols.number(i)];
        x_.push_back(position[0]);
        y_.push_back(position[1]);
        z_.push_back(position[2]);
    }
}

int32_t TablePrediction::most_steps() const { return TableCode::LARGEST >> shift_; }

void TablePrediction::measure_lines(uint32_t row, uint32_t count) {
    const auto& position = stored_.positions[table_.rows.number(row)];
    const double x = position[0], y = position[1], z = position[2], scale = scale_;
    const double *xs = x_.data(), *ys = y_.data(), *zs = z_.data();
    int32_t* line = line_.data();
    for (uint32_t i = 0; i < count; ++i) {
        const double dx = xs[i] - x, dy = ys[i] - y, dz = zs[i] - z;
        const double square = dx * dx + dy * dy + dz * dz; // whole, and exact
        line[i] = static_cast<int32_t>(std::min(std::sqrt(square) * scale + 0.5, LONGEST_LINE));
    }
}

}
