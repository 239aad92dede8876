#include "src/path/turn.h"

#include <algorithm>

#include "src/mesh/angle.h"

namespace geodesic {

using Eigen::Vector3d;

uint32_t Turn::spoke_of(uint32_t vertex) {
    const auto found = std::ranges::find(spokes_, vertex, &Spoke::vertex);
    if (found == spokes_.end()) {
        spokes_.push_back({vertex});
        return static_cast<uint32_t>(spokes_.size() - 1);
    }
    return static_cast<uint32_t>(found - spokes_.begin());
}

void Turn::add_face(uint32_t face) {
    const uint32_t k = corner_of(surface_, face, vertex_);
    const uint32_t a = surface_.faces[face][(k + 1) % 3], b = surface_.faces[face][(k + 2) % 3];
    sectors_.push_back({face, {spoke_of(a), spoke_of(b)}, angle_between(direction(a), direction(b))});
}

// Dijkstra's algorithm over the few edges at a vertex, between the two faces.
void Turn::spread(double limit, uint32_t from_face, uint32_t to_face) {
    for (;;) {
        uint32_t nearest = NONE;
        for (uint32_t s = 0; s < spokes_.size(); ++s)
            if (!spokes_[s].is_done && !spokes_[s].is_forbidden && spokes_[s].angle < limit &&
                (nearest == NONE || spokes_[s].angle < spokes_[nearest].angle))
                nearest = s;
        if (nearest == NONE) return;
        spokes_[nearest].is_done = true;
        for (const auto& [face, ends, angle] : sectors_)
            for (size_t k = 0; k < 2; ++k) {
                Spoke& other = spokes_[ends[1 - k]];
                if (face == from_face || face == to_face) continue;
                if (ends[k] != nearest || !(spokes_[nearest].angle + angle < other.angle)) continue;
                other.angle = spokes_[nearest].angle + angle;
                other.before = nearest;
                other.face = face;
            }
    }
}

Turn::Fan Turn::fan_to(uint32_t spoke) const {
    Fan fan;
    for (; spoke != NONE; spoke = spokes_[spoke].before) {
        fan.spokes.push_back(spokes_[spoke].vertex);
        if (spokes_[spoke].before != NONE) fan.faces.push_back(spokes_[spoke].face);
    }
    std::ranges::reverse(fan.spokes);
    std::ranges::reverse(fan.faces);
    return fan;
}

std::optional<Turn::Fan> Turn::below(double limit, uint32_t from_face, const Vector3d& from, uint32_t to_face,
                                     const Vector3d& to) {
    for (const uint32_t s : sector_of(from_face).spokes)
        spokes_[s].angle = std::min(spokes_[s].angle, angle_between(from, direction(spokes_[s].vertex)));
    spread(limit, from_face, to_face);
    uint32_t best = NONE;
    double least = limit;
    for (const uint32_t s : sector_of(to_face).spokes) {
        const double angle = spokes_[s].angle + angle_between(to, direction(spokes_[s].vertex));
        if (spokes_[s].is_forbidden || !(angle < least)) continue;
        least = angle;
        best = s;
    }
    if (best == NONE) return std::nullopt;
    Fan fan = fan_to(best);
    fan.angle = least;
    return fan;
}

}
