#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "src/metric/metric.h"

namespace geodesic {

// The metric's distances between each vertex of the caller's mesh and those that are near it: the nearest
// ones, a number of them. Solving for tables finds most of them anyway. The metric must heed final_count.
class NearDistances {
public:
    struct Near {
        uint32_t vertex;
        float distance;
    };

    // `nearest`: how many vertices around each one, at first; at least 1.
    NearDistances(uint32_t vertex_count, uint32_t nearest)
        : around_(vertex_count, {{}, 0, nearest}), nearest_(nearest) {}

    uint32_t vertex_count() const { return static_cast<uint32_t>(around_.size()); }

    // The request for these targets, and for what is near the source, which counts among what is final. Both
    // must outlive the request.
    FieldRequest with_near(const uint32_t& source, std::span<const uint32_t> targets) const {
        return {{&source, 1}, targets, {}, {}, UNREACHABLE, around_[source].count + 1};
    }

    // Takes what the latest solve, from this vertex alone, found near it. Different threads may take
    // different vertices at once.
    void take(uint32_t vertex, const FieldSolver& solver);

    // The vertices that are near this one and not at the same place, in no particular order.
    std::span<const Near> of(uint32_t vertex) const { return around_[vertex].near; }
    // All vertices that are nearer than this, to the precision of a float, are among them.
    double reach(uint32_t vertex) const { return around_[vertex].reach; }

    // How many vertices around this one a wider look would find, 0 where it is wide enough already.
    uint32_t wider_count(uint32_t vertex) const {
        const uint32_t wider = 2 * around_[vertex].count;
        return wider <= WIDEST * nearest_ ? wider : 0;
    }
    // Finds that many, which must not be 0. Different threads may widen different vertices at once.
    void widen(uint32_t vertex, FieldSolver& solver);

private:
    static constexpr uint32_t WIDEST = 4; // times as many as at first

    struct Around {
        std::vector<Near> near;
        double reach;
        uint32_t count; // that `near` has, unless fewer can be reached
    };

    std::vector<Around> around_; // by vertex
    uint32_t nearest_;
};

}
