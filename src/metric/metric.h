#pragma once

#include <cstdint>
#include <limits>
#include <memory>
#include <span>
#include <vector>

namespace geodesic {

inline constexpr double UNREACHABLE = std::numeric_limits<double>::infinity();

// Computes distance fields; one thread's scratch, kept from source to source.
class FieldSolver {
public:
    explicit FieldSolver(uint32_t vertex_count);
    virtual ~FieldSolver() = default;

    // Distances from the nearest of `sources`, until all `targets` are final or the front is farther than
    // `radius`. No targets: every vertex is one.
    void solve(std::span<const uint32_t> sources, std::span<const uint32_t> targets,
               double radius = UNREACHABLE);

    // Of the latest solve. Final for targets up to `radius`; for other vertices an upper bound.
    double distance(uint32_t vertex) const { return distance_[vertex]; }
    // Position in `sources` of the source that distance(vertex) was measured from; NONE if there is none.
    uint32_t nearest(uint32_t vertex) const { return nearest_[vertex]; }

protected:
    virtual void run(std::span<const uint32_t> sources, std::span<const uint32_t> targets, double radius) = 0;

    // Lowers the distance of a vertex; false if it was that low already.
    bool improve(uint32_t vertex, double distance, uint32_t nearest) {
        if (!(distance < distance_[vertex])) return false;
        if (distance_[vertex] == UNREACHABLE) touched_.push_back(vertex);
        distance_[vertex] = distance;
        nearest_[vertex] = nearest;
        return true;
    }

    uint32_t vertex_count() const { return static_cast<uint32_t>(distance_.size()); }

private:
    std::vector<double> distance_;
    std::vector<uint32_t> nearest_;
    std::vector<uint32_t> touched_;
};

// Counts down the targets of one solve as their distances become final.
class PendingTargets {
public:
    explicit PendingTargets(uint32_t vertex_count) : epoch_of_(vertex_count, 0) {}

    void begin(std::span<const uint32_t> targets) {
        if (++epoch_ == 0) {
            epoch_of_.assign(epoch_of_.size(), 0);
            epoch_ = 1;
        }
        every_vertex_ = targets.empty();
        remaining_ = 0;
        for (uint32_t target : targets)
            if (epoch_of_[target] != epoch_) {
                epoch_of_[target] = epoch_;
                ++remaining_;
            }
    }

    // Called when the distance of a vertex is final; true when no target remains.
    bool settle(uint32_t vertex) {
        if (every_vertex_ || epoch_of_[vertex] != epoch_) return false;
        epoch_of_[vertex] = epoch_ - 1;
        return --remaining_ == 0;
    }

private:
    std::vector<uint32_t> epoch_of_;
    uint32_t epoch_ = 0;
    uint32_t remaining_ = 0;
    bool every_vertex_ = false;
};

// What a distance is. Immutable; solvers of one metric may run on different threads at once.
class Metric {
public:
    virtual ~Metric() = default;
    virtual std::unique_ptr<FieldSolver> make_solver() const = 0;
};

}
