#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "src/metric/metric.h"

namespace geodesic {

// The metric's distances between each vertex of the caller's mesh and those that are near it: the nearest
// ones, a number of them. Solving for tables finds most of them anyway. The metric must be the exact one.
class NearDistances {
public:
    struct Near {
        uint32_t vertex;
        float distance;
    };

    NearDistances(uint32_t vertex_count, uint32_t most) : near_(vertex_count), most_(most) {}

    uint32_t vertex_count() const { return static_cast<uint32_t>(near_.size()); }

    // The request for these targets, and for what is near the only source.
    FieldRequest with_near(std::span<const uint32_t> source, std::span<const uint32_t> targets) const {
        return {source, targets, {}, {}, UNREACHABLE, most_};
    }

    // Takes what the latest solve, from this vertex alone, found near it. Different threads may take
    // different vertices at once.
    void take(uint32_t vertex, const FieldSolver& solver);

    // Whether anything has been taken for a vertex.
    bool has(uint32_t vertex) const { return !near_[vertex].empty(); }

    // The vertices that are near this one and not at the same place, in no particular order.
    std::span<const Near> of(uint32_t vertex) const { return near_[vertex]; }

private:
    std::vector<std::vector<Near>> near_;
    uint32_t most_;
};

}
