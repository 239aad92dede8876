#include "src/path/turn.h"

#include <algorithm>
#include <functional>

namespace geodesic {

using Eigen::Vector3d;

Turn::Turn(const Surface& surface, uint32_t vertex) {
    const size_t faces = surface.vertex_faces.room_for(vertex);
    Array<uint32_t> ends(&memory_);
    ends.reserve(2 * faces);
    sectors_.reserve(faces);
    for (const uint32_t face : surface.vertex_faces[vertex]) {
        const uint32_t k = corner_of(surface, face, vertex);
        const uint32_t a = surface.faces[face][(k + 1) % 3], b = surface.faces[face][(k + 2) % 3];
        ends.insert(ends.end(), {a, b});
        sectors_.push_back({face, {a, b}}); // spokes have no numbers yet
    }
    std::ranges::sort(ends);
    ends.erase(std::unique(ends.begin(), ends.end()), ends.end());
    spokes_.reserve(ends.size());
    for (const uint32_t end : ends)
        spokes_.push_back({end, surface.positions[end] - surface.positions[vertex]});
    for (Sector& sector : sectors_)
        for (uint32_t& spoke : sector.spokes) spoke = spoke_of(spoke);
    list_sides();
    reached_.reserve(spokes_.size());
}

void Turn::list_sides() {
    for (const Sector& sector : sectors_)
        for (const uint32_t spoke : sector.spokes) ++spokes_[spoke].first_side;
    uint32_t end = 0;
    for (Spoke& spoke : spokes_) spoke.first_side = end += spoke.first_side;
    sides_.resize(end);
    for (size_t i = sectors_.size(); i-- > 0;)
        for (const uint32_t spoke : sectors_[i].spokes)
            sides_[--spokes_[spoke].first_side] = static_cast<uint32_t>(i);
}

uint32_t Turn::spoke_of(uint32_t other_end) const {
    return static_cast<uint32_t>(std::ranges::lower_bound(spokes_, other_end, {}, &Spoke::vertex) -
                                 spokes_.begin());
}

void Turn::reach(uint32_t spoke, double angle) {
    if (!(angle < spokes_[spoke].angle)) return;
    spokes_[spoke].angle = angle;
    reached_.push_back({angle, spoke});
    std::ranges::push_heap(reached_, std::ranges::greater{});
}

// The one with the least angle below the limit that ways may pass and whose neighbours have not been reached
// from it, or NONE.
uint32_t Turn::take_nearest(double limit) {
    while (!reached_.empty() && reached_.front().angle < limit) {
        const uint32_t spoke = reached_.front().spoke;
        std::ranges::pop_heap(reached_, std::ranges::greater{});
        reached_.pop_back();
        if (!spokes_[spoke].is_done && !spokes_[spoke].is_forbidden) return spoke;
    }
    return NONE;
}

// To its neighbours over the faces between the two.
void Turn::spread(uint32_t spoke, uint32_t from_face, uint32_t to_face) {
    spokes_[spoke].is_done = true;
    const size_t end = spoke + 1 < spokes_.size() ? spokes_[spoke + 1].first_side : sides_.size();
    for (size_t side = spokes_[spoke].first_side; side < end; ++side) {
        const Sector& sector = sectors_[sides_[side]];
        if (sector.face == from_face || sector.face == to_face) continue;
        const auto [a, b] = sector.spokes;
        const uint32_t other = a == spoke ? b : a;
        if (spokes_[other].is_done) continue;
        const double angle = spokes_[spoke].angle + angle_of(sector);
        if (!(angle < spokes_[other].angle)) continue;
        reach(other, angle);
        spokes_[other].before = spoke;
        spokes_[other].face = sector.face;
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

// Dijkstra's algorithm over the edges at the vertex.
std::optional<Turn::Fan> Turn::below(double limit, uint32_t from_face, const Vector3d& from, uint32_t to_face,
                                     const Vector3d& to) {
    for (const uint32_t s : sector_of(from_face).spokes) reach(s, angle_between(from, spokes_[s].direction));
    uint32_t best = NONE;
    const auto ends = sector_of(to_face).spokes;
    for (uint32_t s; (s = take_nearest(limit)) != NONE; spread(s, from_face, to_face)) {
        if (s != ends[0] && s != ends[1]) continue;
        const double angle = spokes_[s].angle + angle_between(to, spokes_[s].direction);
        if (!(angle < limit)) continue;
        limit = angle;
        best = s;
    }
    if (best == NONE) return std::nullopt;
    return fan_to(best);
}

ClosedFan::ClosedFan(const Surface& surface, uint32_t vertex, uint32_t first_face)
    : surface_(surface), vertex_(vertex), is_closed_(read_sectors(first_face) && put_in_order()) {}

// The first one comes first. Gives whether there is room for all of them.
bool ClosedFan::read_sectors(uint32_t first_face) {
    for (const uint32_t face : surface_.vertex_faces[vertex_]) {
        if (count_ == MOST_FACES) return false;
        const auto [a, b, c] = surface_.faces[face];
        sectors_[count_] = {face, {a == vertex_ ? b : a, c == vertex_ ? b : c}};
        if (face == first_face) std::swap(sectors_[0], sectors_[count_]);
        ++count_;
    }
    return true;
}

// Each one is followed by the only one, of those that are not in order yet, at the edge where it ends; the
// last one ends at the edge where the first one begins.
bool ClosedFan::put_in_order() {
    for (size_t i = 1; i < count_; ++i) {
        const uint32_t end = sectors_[i - 1].ends[1];
        size_t next = 0, found = 0;
        for (size_t k = i; k < count_; ++k) {
            const auto [a, b] = sectors_[k].ends;
            const bool is_next = (a == end) | (b == end); // without a branch
            next = is_next ? k : next;
            found += is_next;
        }
        if (found != 1) return false;
        std::swap(sectors_[i], sectors_[next]);
        if (sectors_[i].ends[0] != end) std::swap(sectors_[i].ends[0], sectors_[i].ends[1]);
    }
    return sectors_[count_ - 1].ends[1] == sectors_[0].ends[0];
}

std::optional<Turn::Fan> ClosedFan::below(double limit, const Vector3d& from, uint32_t to_face,
                                          const Vector3d& to) const {
    size_t place = 1;
    while (sectors_[place].face != to_face) ++place;
    std::optional<Side> best;
    for (const Side& side : {Side{true, place}, Side{false, count_ - place}}) {
        const double angle = angle_below_half_turn(side, from, to);
        if (!(angle < limit)) continue;
        limit = angle;
        best = side;
    }
    if (!best) return std::nullopt;
    return fan_over(*best);
}

// Around one side; infinite if it is half a turn or more.
double ClosedFan::angle_below_half_turn(const Side& side, const Vector3d& from, const Vector3d& to) const {
    AngleSum sum;
    Vector3d direction = from;
    for (size_t i = 0; i < side.edges; ++i) {
        const Vector3d next = direction_to(end(side, i));
        sum.add(direction, next);
        if (sum.is_half_turn()) return UNREACHABLE;
        direction = next;
    }
    sum.add(direction, to);
    return sum.is_half_turn() ? UNREACHABLE : sum.value();
}

Turn::Fan ClosedFan::fan_over(const Side& side) const {
    Turn::Fan fan;
    fan.spokes.reserve(side.edges);
    fan.faces.reserve(side.edges);
    for (size_t i = 0; i < side.edges; ++i) {
        fan.spokes.push_back(end(side, i));
        if (i + 1 < side.edges) fan.faces.push_back(face(side, i));
    }
    return fan;
}

}
