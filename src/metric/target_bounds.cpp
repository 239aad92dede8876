#include "src/metric/target_bounds.h"

#include <algorithm>
#include <utility>

namespace geodesic {

namespace {

// By as much as this share of its length, rounding never makes a way longer or shorter.
constexpr double LENGTH_SLACK = 1e-6;

// The vertices whose distances along edges tell those of the targets, some several times.
std::vector<uint32_t> needed_vertices(const IntrinsicMesh& mesh, const FieldRequest& request) {
    std::vector<uint32_t> needed(request.targets.begin(), request.targets.end());
    for (const SurfacePoint& point : request.target_points)
        for (uint32_t k = 0; k < 3; ++k) needed.push_back(corner_vertex(mesh, 3 * point.face + k));
    return needed;
}

// Sums of differences: far from the origin, those of positions would be rounded more.
Eigen::Vector3d position_of(const IntrinsicMesh& mesh, const SurfacePoint& point) {
    const auto corner = [&](uint32_t k) { return mesh.positions[corner_vertex(mesh, 3 * point.face + k)]; };
    const Eigen::Vector3d first = corner(0);
    return first + (point.weights[1] * (corner(1) - first) + point.weights[2] * (corner(2) - first));
}

}

void TargetBounds::begin(const IntrinsicMesh& mesh, const FieldRequest& request, const FieldSolver& solver,
                         double front) {
    forget();
    along_edges_.resize(mesh.positions.size(), UNREACHABLE);
    for (const uint32_t vertex : solver.reached()) {
        touched_.push_back(vertex);
        along_edges_[vertex] = solver.distance(vertex);
        if (solver.distance(vertex) >= front) queue_.push(solver.distance(vertex), vertex);
    }
    std::vector<uint32_t> ends = needed_vertices(mesh, request);
    std::erase_if(ends,
                  [&](uint32_t end) { return along_edges_[end] < front; }); // which are not in the queue
    go_along_edges(mesh, std::move(ends));
    const auto add = [&](const Eigen::Vector3d& position, double along_edges) {
        targets_.push_back({position, along_edges * (1 + LENGTH_SLACK)});
    };
    for (const uint32_t target : request.targets)
        if (along_edges_[target] >= front) add(mesh.positions[target], along_edges_[target]);
    for (const SurfacePoint& point : request.target_points) {
        const Eigen::Vector3d position = position_of(mesh, point);
        double along_edges = UNREACHABLE;
        for (uint32_t k = 0; k < 3; ++k) {
            const uint32_t corner = corner_vertex(mesh, 3 * point.face + k);
            along_edges =
                std::min(along_edges, along_edges_[corner] + (mesh.positions[corner] - position).norm());
        }
        add(position, along_edges);
    }
}

// What the solve before has left, also where a lack of memory has ended it.
void TargetBounds::forget() {
    for (const uint32_t vertex : touched_) along_edges_[vertex] = UNREACHABLE;
    touched_.clear();
    queue_.clear();
    targets_.clear();
    latest_ = 0;
}

void TargetBounds::reach(uint32_t vertex, double distance) {
    double& known = along_edges_[vertex];
    if (!(distance < known)) return;
    if (known == UNREACHABLE) touched_.push_back(vertex);
    known = distance;
    queue_.push(distance, vertex);
}

// Until all `ends` are final that can be reached.
void TargetBounds::go_along_edges(const IntrinsicMesh& mesh, std::vector<uint32_t> ends) {
    std::ranges::sort(ends);
    size_t missing = static_cast<size_t>(std::unique(ends.begin(), ends.end()) - ends.begin());
    ends.resize(missing);
    while (missing > 0 && !queue_.empty()) {
        const auto [distance, vertex] = queue_.pop();
        if (distance != along_edges_[vertex]) continue;
        if (std::ranges::binary_search(ends, vertex)) --missing;
        for (const Spoke& spoke : mesh.spokes[vertex]) reach(spoke.other, distance + spoke.length);
    }
}

// The target that the way before may have helped is mostly one that this way may help, too.
bool TargetBounds::may_help(const Eigen::Vector3d& position, double radius, double length) {
    const auto helps = [&](const Target& target) {
        const double rest = target.farthest + radius - length;
        return rest >= 0 && (target.position - position).squaredNorm() <= rest * rest;
    };
    if (latest_ < targets_.size() && helps(targets_[latest_])) return true;
    latest_ = static_cast<size_t>(std::ranges::find_if(targets_, helps) - targets_.begin());
    return latest_ < targets_.size();
}

}
