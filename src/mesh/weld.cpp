#include "src/mesh/weld.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <unordered_map>

namespace geodesic {

namespace {

using Key = std::array<int64_t, 3>;

struct KeyHash {
    size_t operator()(const Key& key) const {
        uint64_t hash = 0;
        for (int64_t part : key) {
            hash = (hash ^ static_cast<uint64_t>(part)) * 0x9E3779B97F4A7C15u;
            hash ^= hash >> 29;
        }
        return hash;
    }
};

std::vector<uint32_t> weld_equal(const std::vector<Eigen::Vector3d>& positions) {
    std::unordered_map<Key, uint32_t, KeyHash> first;
    first.reserve(positions.size());
    std::vector<uint32_t> representative(positions.size());
    for (size_t i = 0; i < positions.size(); ++i) {
        Key key;
        // Adding 0 makes -0 and +0 the same bits.
        for (int k = 0; k < 3; ++k)
            key[static_cast<size_t>(k)] = std::bit_cast<int64_t>(positions[i][k] + 0.0);
        representative[i] = first.try_emplace(key, static_cast<uint32_t>(i)).first->second;
    }
    return representative;
}

// Representatives by the cell of a grid whose cells are one tolerance wide: a neighbour is at most one cell
// away. So far out that cells could not be counted, different coordinates differ by more than a tolerance,
// and each is a cell by itself.
class RepresentativeGrid {
public:
    RepresentativeGrid(const std::vector<Eigen::Vector3d>& positions, double tolerance)
        : positions_(positions), tolerance_(tolerance) {}

    uint32_t find_or_add(uint32_t i) {
        const Key cell = cell_of(positions_[i]);
        uint32_t best = i;
        for (int64_t x = -1; x <= 1; ++x)
            for (int64_t y = -1; y <= 1; ++y)
                for (int64_t z = -1; z <= 1; ++z)
                    best = std::min(best, first_near(i, {cell[0] + x, cell[1] + y, cell[2] + z}));
        if (best == i) cells_[cell].push_back(i);
        return best;
    }

private:
    int64_t cell_along_axis(double coordinate) const {
        const double cell = std::floor(coordinate / tolerance_);
        return std::abs(cell) < LARGEST_CELL ? static_cast<int64_t>(cell)
                                             : std::bit_cast<int64_t>(coordinate);
    }
    Key cell_of(const Eigen::Vector3d& p) const {
        return {cell_along_axis(p[0]), cell_along_axis(p[1]), cell_along_axis(p[2])};
    }

    uint32_t first_near(uint32_t i, const Key& cell) const {
        const auto found = cells_.find(cell);
        if (found == cells_.end()) return i;
        for (uint32_t other : found->second)
            if ((positions_[other] - positions_[i]).norm() <= tolerance_) return other;
        return i;
    }

    const std::vector<Eigen::Vector3d>& positions_;
    static constexpr double LARGEST_CELL = 4.0e18;
    const double tolerance_; // and the width of a cell
    std::unordered_map<Key, std::vector<uint32_t>, KeyHash> cells_;
};

}

std::vector<uint32_t> weld(const std::vector<Eigen::Vector3d>& positions, double tolerance) {
    if (tolerance <= 0) return weld_equal(positions);
    RepresentativeGrid grid(positions, tolerance);
    std::vector<uint32_t> representative(positions.size());
    for (size_t i = 0; i < positions.size(); ++i)
        representative[i] = grid.find_or_add(static_cast<uint32_t>(i));
    return representative;
}

}
