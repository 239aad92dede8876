#pragma once

#include <array>
#include <atomic>
#include <cstdint>
#include <limits>
#include <memory>
#include <span>
#include <vector>

namespace geodesic {

inline constexpr double UNREACHABLE = std::numeric_limits<double>::infinity();

// A point of a face: weights of its three corners, not negative, 1 in sum.
struct SurfacePoint {
    uint32_t face;
    std::array<double, 3> weights;
};

// What a solve is asked for: distances from the nearest of the sources, vertices or points, to targets of
// both kinds. No targets at all: every vertex is one.
struct FieldRequest {
    std::span<const uint32_t> sources, targets;
    std::span<const SurfacePoint> source_points, target_points;
    double radius = UNREACHABLE; // targets farther than this need not be final
    // So many vertices are final, too, the nearest ones, of those up to `radius`. Only the exact metric and
    // that of weighted surfaces heed it.
    uint32_t final_count = 0;
};

// Throws Error CANCELLED.
[[noreturn]] void throw_cancelled();

// Computes distance fields; one thread's scratch, kept from source to source.
class FieldSolver {
public:
    explicit FieldSolver(uint32_t vertex_count);
    virtual ~FieldSolver() = default;

    // Every solve from now on, also one that runs, throws Error CANCELLED once the flag, which must outlive
    // the solver, is set. The solver can be used again.
    void cancel_when(const std::atomic<bool>& flag) { cancelled_ = &flag; }

    // Points only if the metric takes them.
    void solve(const FieldRequest& request);
    void solve(std::span<const uint32_t> sources, std::span<const uint32_t> targets,
               double radius = UNREACHABLE) {
        solve({sources, targets, {}, {}, radius});
    }

    // Of the latest solve. Final for targets up to `radius`; for other vertices an upper bound.
    double distance(uint32_t vertex) const { return distance_[vertex]; }
    // The vertices for which it found any distance, final or not.
    std::span<const uint32_t> reached() const { return touched_; }
    // Up to this distance, all of them are final. Only metrics that heed final_count say so, and the exact
    // one only as far as it was asked for more than targets; otherwise it may be 0.
    double final_up_to() const { return final_up_to_; }
    // Position in `sources` of the source that distance(vertex) was measured from, or past them in
    // `source_points`; NONE if there is none.
    uint32_t nearest(uint32_t vertex) const { return nearest_[vertex]; }
    // Of target_points[i].
    double point_distance(size_t i) const { return point_distance_[i]; }

protected:
    virtual void run(const FieldRequest& request) = 0;
    // Begins anew: no distance is known.
    void forget(const FieldRequest& request);
    void set_final_up_to(double distance) { final_up_to_ = distance; }
    void check_cancelled() const {
        if (cancelled_ && *cancelled_) throw_cancelled();
    }
    // To be called again and again while a solve runs: every 1,024th call looks at the flag.
    void check_cancelled_sometimes() {
        if ((++checks_ & 0x3FF) == 0) check_cancelled();
    }

    // Lowers the distance of a vertex; false if it was that low already.
    bool improve(uint32_t vertex, double distance, uint32_t nearest) {
        if (!(distance < distance_[vertex])) return false;
        if (distance_[vertex] == UNREACHABLE) touched_.push_back(vertex);
        distance_[vertex] = distance;
        nearest_[vertex] = nearest;
        return true;
    }

    // Lowers the distance of a target point; false if it was that low already.
    bool improve_point(size_t i, double distance) {
        if (!(distance < point_distance_[i])) return false;
        point_distance_[i] = distance;
        return true;
    }

    uint32_t vertex_count() const { return static_cast<uint32_t>(distance_.size()); }

private:
    std::vector<double> distance_;
    std::vector<uint32_t> nearest_;
    std::vector<uint32_t> touched_;
    std::vector<double> point_distance_;
    double final_up_to_ = 0;
    const std::atomic<bool>* cancelled_ = nullptr;
    uint32_t checks_ = 0; // calls of check_cancelled_sometimes()
};

// Counts down the targets of one solve as their distances become final.
class PendingTargets {
public:
    explicit PendingTargets(uint32_t vertex_count) : epoch_of_(vertex_count, 0) {}

    void begin(const FieldRequest& request) {
        if (++epoch_ == 0) {
            epoch_of_.assign(epoch_of_.size(), 0);
            epoch_ = 1;
        }
        every_vertex_ = request.targets.empty() && request.target_points.empty();
        point_pending_.assign(request.target_points.size(), 1);
        remaining_ = request.target_points.size();
        for (uint32_t target : request.targets)
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

    bool settle_point(size_t i) {
        if (!point_pending_[i]) return false;
        point_pending_[i] = 0;
        return --remaining_ == 0;
    }

private:
    std::vector<uint32_t> epoch_of_;
    std::vector<uint8_t> point_pending_;
    uint32_t epoch_ = 0;
    size_t remaining_ = 0;
    bool every_vertex_ = false;
};

// What a distance is. Immutable; solvers of one metric may run on different threads at once.
class Metric {
public:
    virtual ~Metric() = default;
    virtual std::unique_ptr<FieldSolver> make_solver() const = 0;
    // Whether sources and targets may be points of faces.
    virtual bool takes_points() const { return false; }
};

}
