#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "src/metric/metric.h"

namespace geodesic {

// The metric's distances between vertices of the caller's mesh that are near each other. Solving for tables
// finds most of them anyway.
class NearDistances {
public:
    struct Near {
        uint32_t vertex;
        float distance;
    };

    NearDistances(uint32_t vertex_count, double radius) : near_(vertex_count), radius_(radius) {}

    // Up to this distance vertices are near.
    double radius() const { return radius_; }
    uint32_t vertex_count() const { return static_cast<uint32_t>(near_.size()); }

    // Takes what the latest solve, from this vertex alone, found up to the radius; all of it is final.
    // Different threads may take different vertices at once.
    void take(uint32_t vertex, const FieldSolver& solver);

    // The vertices that are near this one and not at the same place, in no particular order.
    std::span<const Near> of(uint32_t vertex) const { return near_[vertex]; }

private:
    std::vector<std::vector<Near>> near_;
    double radius_;
};

}
