#include "tests/campaign/oracle.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <numeric>
#include <queue>

namespace geodesic::campaign {

namespace {

// A vertex goes to the first one that has gone to itself and is near enough.
std::vector<uint32_t> representatives(const std::vector<Eigen::Vector3d>& positions, double tolerance) {
    std::vector<uint32_t> result, own;
    for (uint32_t i = 0; i < positions.size(); ++i) {
        const auto near = [&](uint32_t other) {
            return positions[i] == positions[other] || (positions[i] - positions[other]).norm() <= tolerance;
        };
        const auto found = std::ranges::find_if(own, near);
        result.push_back(found == own.end() ? i : *found);
        if (found == own.end()) own.push_back(i);
    }
    return result;
}

}

Surface::Surface(const test::Soup& soup, double weld_tolerance)
    : representative_(representatives(soup.positions, weld_tolerance)), used_(soup.positions.size(), 0) {
    for (uint32_t t = 0; t < soup.triangles.size(); ++t) {
        std::array<uint32_t, 3> corners;
        for (size_t k = 0; k < 3; ++k) corners[k] = representative_[soup.triangles[t][k]];
        if (corners[0] == corners[1] || corners[1] == corners[2] || corners[2] == corners[0]) continue;
        triangles_.push_back({t, corners});
        for (uint32_t v : corners) used_[v] = 1;
    }
    find_edges();
    find_parts();
}

uint32_t Surface::welded_vertex_count() const {
    return static_cast<uint32_t>(std::count(used_.begin(), used_.end(), 1));
}

bool Surface::has_flat_edges(const test::Soup& soup) const {
    constexpr double FLAT = 1e-2;                                                 // radians
    std::vector<Eigen::Vector3d> normals(edges_.size(), Eigen::Vector3d::Zero()); // of one triangle at each
    std::vector<uint8_t> has_normal(edges_.size(), 0);
    for (const Triangle& triangle : triangles_) {
        const auto& v = triangle.vertices;
        const auto side = [&](size_t k) -> Eigen::Vector3d {
            return (soup.positions[v[k]] - soup.positions[v[0]]).normalized();
        };
        const Eigen::Vector3d cross = side(1).cross(side(2)), normal = cross.normalized();
        if (cross.norm() < FLAT) return true; // a sliver, of which this does not tell
        for (size_t k = 0; k < 3; ++k) {
            const Edge edge{std::min(v[k], v[(k + 1) % 3]), std::max(v[k], v[(k + 1) % 3])};
            const auto e = static_cast<size_t>(std::ranges::lower_bound(edges_, edge) - edges_.begin());
            if (has_normal[e] && normals[e].cross(normal).norm() < FLAT) return true;
            normals[e] = normal;
            has_normal[e] = 1;
        }
    }
    return false;
}

void Surface::find_edges() {
    for (const Triangle& triangle : triangles_)
        for (size_t k = 0; k < 3; ++k) {
            const uint32_t a = triangle.vertices[k], b = triangle.vertices[(k + 1) % 3];
            edges_.push_back({std::min(a, b), std::max(a, b)});
        }
    std::ranges::sort(edges_);
    edges_.erase(std::unique(edges_.begin(), edges_.end()), edges_.end());
    edges_at_.resize(representative_.size());
    for (uint32_t e = 0; e < edges_.size(); ++e) {
        edges_at_[edges_[e][0]].push_back({e, edges_[e][1]});
        edges_at_[edges_[e][1]].push_back({e, edges_[e][0]});
    }
}

void Surface::find_parts() {
    part_.resize(representative_.size());
    std::iota(part_.begin(), part_.end(), 0u);
    const auto root = [&](uint32_t v) {
        while (part_[v] != v) v = part_[v] = part_[part_[v]];
        return v;
    };
    for (const auto& [a, b] : edges_) part_[root(a)] = root(b);
    for (uint32_t v = 0; v < part_.size(); ++v) part_[v] = root(v);
}

std::vector<double> Surface::along_edges(std::span<const double> costs, uint32_t source) const {
    using Entry = std::pair<double, uint32_t>;
    std::vector<double> distance(representative_.size(), FAR), result(representative_.size(), FAR);
    std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue;
    if (is_used(source)) {
        distance[representative_[source]] = 0;
        queue.push({0, representative_[source]});
    }
    while (!queue.empty()) {
        const auto [d, v] = queue.top();
        queue.pop();
        if (d > distance[v]) continue;
        for (const auto& [edge, other] : edges_at_[v])
            if (d + costs[edge] < distance[other]) queue.push({distance[other] = d + costs[edge], other});
    }
    for (uint32_t id = 0; id < result.size(); ++id)
        if (is_used(id)) result[id] = distance[representative_[id]];
    result[source] = 0;
    return result;
}

}
