#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include <Eigen/Core>

#include "src/metric/event_queue.h"
#include "src/metric/intrinsic_mesh.h"
#include "src/metric/metric.h"

namespace geodesic {

// Tells which ways may still become shortest ones to a few targets: no target is nearer than the straight
// line in space, and none is farther than a way along edges.
class TargetBounds {
public:
    // More targets would take longer to look at than they save.
    static constexpr size_t MOST_TARGETS = 512;

    // Whether there are bounds for a request: not without positions, and not for every vertex.
    static bool are_known(const IntrinsicMesh& mesh, const FieldRequest& request) {
        const size_t targets = request.targets.size() + request.target_points.size();
        return !mesh.positions.empty() && targets > 0 && targets <= MOST_TARGETS;
    }

    // Begins with what a solver knows: its distances are upper bounds, and final below `front`. Target
    // vertices below that need nothing more.
    void begin(const IntrinsicMesh& mesh, const FieldRequest& request, const FieldSolver& solver,
               double front);

    // Whether a way of this length to a point that is no farther than `radius` from `position`, or a longer
    // one, may be the beginning of a shortest way to a target.
    bool may_help(const Eigen::Vector3d& position, double radius, double length);

private:
    struct Target {
        Eigen::Vector3d position;
        double farthest; // along edges
    };

    void forget();
    void reach(uint32_t vertex, double distance);
    void go_along_edges(const IntrinsicMesh& mesh, std::vector<uint32_t> ends);

    std::vector<Target> targets_;
    size_t latest_ = 0;               // of the targets: which one a way may have helped
    std::vector<double> along_edges_; // per vertex; those of the latest solve
    std::vector<uint32_t> touched_;   // where they are not infinite
    EventQueue queue_;
};

}
