#include "src/index/positions.h"

#include <algorithm>
#include <cmath>

namespace geodesic {

std::array<int32_t, 3> in_steps(const Eigen::Vector3d& position, const StoredIndex& stored) {
    const double step = stored.position_step;
    std::array<int32_t, 3> steps;
    for (size_t k = 0; k < 3; ++k) {
        const double offset = position[static_cast<Eigen::Index>(k)] - stored.position_origin[k];
        steps[k] = static_cast<int32_t>(std::clamp(std::floor(offset / step + 0.5), 0.0, double{MOST_STEPS}));
    }
    return steps;
}

}
