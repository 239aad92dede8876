#include "src/mesh/spatial_order.h"

#include <algorithm>

namespace geodesic {

namespace {

constexpr uint32_t BITS = 21; // an axis; three fit a 64-bit code

// Moves bit i to bit 3 i.
uint64_t spread(uint64_t x) {
    x = (x | x << 32) & 0x001F00000000FFFF;
    x = (x | x << 16) & 0x001F0000FF0000FF;
    x = (x | x << 8) & 0x100F00F00F00F00F;
    x = (x | x << 4) & 0x10C30C30C30C30C3;
    return (x | x << 2) & 0x1249249249249249;
}

}

std::vector<uint32_t> spatial_order(std::span<const Eigen::Vector3d> positions,
                                    std::vector<uint32_t> points) {
    if (points.empty()) return points;
    Eigen::Vector3d low = positions[points[0]], high = low;
    for (uint32_t point : points) {
        low = low.cwiseMin(positions[point]);
        high = high.cwiseMax(positions[point]);
    }
    // Halves keep the difference of huge coordinates finite.
    const double extent = (0.5 * high - 0.5 * low).maxCoeff();
    const double cells = static_cast<double>((uint64_t{1} << BITS) - 1);
    struct Keyed {
        uint64_t code;
        uint32_t point;
    };
    std::vector<Keyed> keyed;
    keyed.reserve(points.size());
    for (uint32_t point : points) {
        uint64_t code = 0;
        for (int axis = 0; extent > 0 && axis < 3; ++axis) {
            const double share = (0.5 * positions[point][axis] - 0.5 * low[axis]) / extent;
            code |= spread(static_cast<uint64_t>(share * cells)) << axis;
        }
        keyed.push_back({code, point});
    }
    std::ranges::stable_sort(keyed, {}, &Keyed::code);
    for (size_t i = 0; i < points.size(); ++i) points[i] = keyed[i].point;
    return points;
}

}
