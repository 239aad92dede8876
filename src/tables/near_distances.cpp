#include "src/tables/near_distances.h"

#include <algorithm>

namespace geodesic {

void NearDistances::take(uint32_t vertex, const FieldSolver& solver) {
    const auto is_near = [&](uint32_t other) {
        const double distance = solver.distance(other);
        return other < near_.size() && distance > 0 && distance <= radius_;
    };
    std::vector<Near>& near = near_[vertex];
    near.clear();
    near.reserve(static_cast<size_t>(std::ranges::count_if(solver.reached(), is_near)));
    for (const uint32_t other : solver.reached())
        if (is_near(other)) near.push_back({other, static_cast<float>(solver.distance(other))});
}

}
