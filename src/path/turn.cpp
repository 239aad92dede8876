#include "src/path/turn.h"

#include <algorithm>

namespace geodesic {

using Eigen::Vector3d;

uint32_t Turn::spoke_of(uint32_t vertex) {
    const auto found = std::ranges::find(spokes_, vertex, &Spoke::vertex);
    if (found == spokes_.end()) {
        spokes_.push_back({vertex, surface_.positions[vertex] - surface_.positions[vertex_]});
        return static_cast<uint32_t>(spokes_.size() - 1);
    }
    return static_cast<uint32_t>(found - spokes_.begin());
}

void Turn::add_face(uint32_t face) {
    const uint32_t k = corner_of(surface_, face, vertex_);
    const uint32_t a = surface_.faces[face][(k + 1) % 3], b = surface_.faces[face][(k + 2) % 3];
    sectors_.push_back({face, {spoke_of(a), spoke_of(b)}});
}

// The one with the least angle below the limit whose neighbours have not been reached from it, or NONE.
uint32_t Turn::nearest_spoke(double limit) const {
    uint32_t nearest = NONE;
    for (uint32_t s = 0; s < spokes_.size(); ++s) {
        const Spoke& spoke = spokes_[s];
        if (spoke.is_done || spoke.is_forbidden || !(spoke.angle < limit)) continue;
        nearest = s;
        limit = spoke.angle;
    }
    return nearest;
}

// To its neighbours over the faces between the two.
void Turn::spread(uint32_t spoke, uint32_t from_face, uint32_t to_face) {
    spokes_[spoke].is_done = true;
    for (const Sector& sector : sectors_) {
        const auto [a, b] = sector.spokes;
        if ((a != spoke && b != spoke) || sector.face == from_face || sector.face == to_face) continue;
        Spoke& other = spokes_[a == spoke ? b : a];
        if (other.is_done) continue;
        const double angle = spokes_[spoke].angle + angle_of(sector);
        if (!(angle < other.angle)) continue;
        other.angle = angle;
        other.before = spoke;
        other.face = sector.face;
    }
}

Turn::Fan Turn::fan_to(uint32_t spoke) const {
    Fan fan;
    fan.spokes.reserve(spokes_.size());
    fan.faces.reserve(spokes_.size());
    for (; spoke != NONE; spoke = spokes_[spoke].before) {
        fan.spokes.push_back(spokes_[spoke].vertex);
        if (spokes_[spoke].before != NONE) fan.faces.push_back(spokes_[spoke].face);
    }
    std::ranges::reverse(fan.spokes);
    std::ranges::reverse(fan.faces);
    return fan;
}

// Dijkstra's algorithm over the few edges at a vertex.
std::optional<Turn::Fan> Turn::below(double limit, uint32_t from_face, const Vector3d& from, uint32_t to_face,
                                     const Vector3d& to) {
    for (const uint32_t s : sector_of(from_face).spokes)
        spokes_[s].angle = std::min(spokes_[s].angle, angle_between(from, spokes_[s].direction));
    uint32_t best = NONE;
    const auto ends = sector_of(to_face).spokes;
    for (uint32_t s; (s = nearest_spoke(limit)) != NONE; spread(s, from_face, to_face)) {
        if (s != ends[0] && s != ends[1]) continue;
        const double angle = spokes_[s].angle + angle_between(to, spokes_[s].direction);
        if (!(angle < limit)) continue;
        limit = angle;
        best = s;
    }
    if (best == NONE) return std::nullopt;
    Fan fan = fan_to(best);
    fan.angle = limit;
    return fan;
}

}
