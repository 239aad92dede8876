#include "src/tables/near_distances.h"

#include <algorithm>
#include <utility>

namespace geodesic {

// Of those that are equally far, the ones that come first in the mesh, so that each run keeps the same.
void NearDistances::take(uint32_t vertex, const FieldSolver& solver) {
    std::vector<Near> near;
    for (const uint32_t other : solver.reached())
        if (const auto distance = static_cast<float>(solver.distance(other));
            other < vertex_count() && distance > 0 && solver.distance(other) <= solver.final_up_to())
            near.push_back({other, distance});
    Around& around = around_[vertex];
    around.reach = solver.final_up_to();
    if (near.size() > around.count) {
        const auto last = near.begin() + around.count - 1;
        std::ranges::nth_element(near, last, {},
                                 [](const Near& n) { return std::pair(n.distance, n.vertex); });
        around.reach = double{last->distance};
        near.resize(around.count);
        // By vertex, since each library's nth_element leaves them in another order.
        std::ranges::sort(near, {}, &Near::vertex);
    }
    around.near.assign(near.begin(), near.end());
}

void NearDistances::widen(uint32_t vertex, FieldSolver& solver) {
    around_[vertex].count = wider_count(vertex);
    solver.solve(with_near(vertex, {&vertex, 1}));
    take(vertex, solver);
}

}
