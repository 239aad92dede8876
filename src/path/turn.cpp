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

ClosedFan::ClosedFan(const Surface& surface, uint32_t vertex) : surface_(surface), vertex_(vertex) {
    for (const uint32_t face : surface.vertex_faces[vertex]) {
        if (count_ == MOST_FACES) return;
        const auto [a, b, c] = surface.faces[face];
        sectors_[count_++] = {face, {a == vertex ? b : a, c == vertex ? b : c}};
    }
    is_closed_ = true;
    for (size_t i = 0; i < count_ && is_closed_; ++i)
        is_closed_ = joins_two(sectors_[i].ends[0]) && joins_two(sectors_[i].ends[1]);
}

bool ClosedFan::joins_two(uint32_t end) const {
    size_t faces = 0;
    for (size_t i = 0; i < count_; ++i) faces += sectors_[i].has(end);
    return faces == 2;
}

const ClosedFan::Sector& ClosedFan::beyond(const Sector& sector, uint32_t end) const {
    return *std::ranges::find_if(
        sectors_, [&](const Sector& other) { return other.face != sector.face && other.has(end); });
}

std::optional<Turn::Fan> ClosedFan::below(double limit, uint32_t from_face, const Vector3d& from,
                                          uint32_t to_face, const Vector3d& to) const {
    const Bend bend{sector_of(from_face), sector_of(to_face), from, to};
    const auto [first, second] = bend.from_sector.ends;
    const double over_first = angle_below(limit, bend, first),
                 over_second = angle_below(std::min(limit, over_first), bend, second);
    if (!(std::min(over_first, over_second) < limit)) return std::nullopt;
    Turn::Fan fan = fan_over(bend, over_second < over_first ? second : first);
    fan.angle = std::min(over_first, over_second);
    return fan;
}

// Around the side that the edge to `first_end` is on; infinite if it is not below the limit.
double ClosedFan::angle_below(double limit, const Bend& bend, uint32_t first_end) const {
    uint32_t end = first_end;
    Vector3d direction = direction_to(end);
    double angle = angle_between(bend.from, direction);
    for (const Sector* sector = &beyond(bend.from_sector, end); sector != &bend.to_sector;
         sector = &beyond(*sector, end)) {
        if (!(angle < limit)) return UNREACHABLE;
        end = sector->other_than(end);
        const Vector3d next = direction_to(end);
        angle += angle_between(direction, next);
        direction = next;
    }
    angle += angle_between(bend.to, direction);
    return angle < limit ? angle : UNREACHABLE;
}

Turn::Fan ClosedFan::fan_over(const Bend& bend, uint32_t first_end) const {
    Turn::Fan fan;
    fan.faces.reserve(count_);
    fan.spokes.reserve(count_);
    uint32_t end = first_end;
    fan.spokes.push_back(end);
    for (const Sector* sector = &beyond(bend.from_sector, end); sector != &bend.to_sector;
         sector = &beyond(*sector, end)) {
        end = sector->other_than(end);
        fan.faces.push_back(sector->face);
        fan.spokes.push_back(end);
    }
    return fan;
}

}
