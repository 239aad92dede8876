#include "src/tables/near_distances.h"

#include <algorithm>
#include <utility>

namespace geodesic {

// Of those that are equally far, the ones with smaller numbers, so that each run keeps the same.
void NearDistances::take(uint32_t vertex, const FieldSolver& solver) {
    std::vector<Near> near;
    for (const uint32_t other : solver.reached())
        if (const auto distance = static_cast<float>(solver.distance(other));
            other < near_.size() && distance > 0 && solver.distance(other) <= solver.final_up_to())
            near.push_back({other, distance});
    if (near.size() > most_) {
        std::ranges::nth_element(near, near.begin() + most_, {},
                                 [](const Near& n) { return std::pair(n.distance, n.vertex); });
        near.resize(most_);
    }
    near_[vertex].assign(near.begin(), near.end());
}

}
