#include "src/path/straighten.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <unordered_set>

#include <Eigen/Geometry>

#include "src/path/funnel.h"

namespace geodesic {

namespace {

using Eigen::Vector3d;

double angle_between(const Vector3d& a, const Vector3d& b) { return std::atan2(a.cross(b).norm(), a.dot(b)); }

// A path passes a vertex: portals `first` to `last` all contain it.
struct Pass {
    size_t first, last;
    uint32_t vertex;
};

// The shortest way around a vertex between two directions in faces there, over the edges at the vertex, of
// which any number of faces may join.
class Turn {
public:
    Turn(const Surface& surface, uint32_t vertex) : surface_(surface), vertex_(vertex) {
        for (const uint32_t face : surface.vertex_faces[vertex]) add_face(face);
    }

    // The faces between the two, without them, and the other ends of the edges passed; nothing if the angle
    // is pi or more.
    struct Fan {
        std::vector<uint32_t> faces, spokes;
    };
    std::optional<Fan> below_pi(uint32_t from_face, const Vector3d& from, uint32_t to_face,
                                const Vector3d& to);

private:
    struct Spoke {
        uint32_t vertex;
        double angle = UNREACHABLE; // from the first direction
        uint32_t before = NONE, face = NONE;
        bool is_done = false;
    };
    struct Sector {
        uint32_t face;
        std::array<uint32_t, 2> spokes;
        double angle;
    };

    Vector3d direction(uint32_t vertex) const {
        return surface_.positions[vertex] - surface_.positions[vertex_];
    }
    void add_face(uint32_t face);
    uint32_t spoke_of(uint32_t vertex);
    const Sector& sector_of(uint32_t face) const { return *std::ranges::find(sectors_, face, &Sector::face); }
    void spread();
    Fan fan_to(uint32_t spoke) const;

    const Surface& surface_;
    const uint32_t vertex_;
    std::vector<Spoke> spokes_;
    std::vector<Sector> sectors_;
};

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

// Dijkstra's algorithm over the few edges at a vertex.
void Turn::spread() {
    for (;;) {
        uint32_t nearest = NONE;
        for (uint32_t s = 0; s < spokes_.size(); ++s)
            if (!spokes_[s].is_done && spokes_[s].angle < std::numbers::pi &&
                (nearest == NONE || spokes_[s].angle < spokes_[nearest].angle))
                nearest = s;
        if (nearest == NONE) return;
        spokes_[nearest].is_done = true;
        for (const auto& [face, ends, angle] : sectors_)
            for (size_t k = 0; k < 2; ++k) {
                Spoke& other = spokes_[ends[1 - k]];
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

std::optional<Turn::Fan> Turn::below_pi(uint32_t from_face, const Vector3d& from, uint32_t to_face,
                                        const Vector3d& to) {
    constexpr double ROUNDING = 1e-8;
    if (from_face == to_face) return Fan{};
    for (const uint32_t s : sector_of(from_face).spokes)
        spokes_[s].angle = std::min(spokes_[s].angle, angle_between(from, direction(spokes_[s].vertex)));
    spread();
    uint32_t best = NONE;
    double least = std::numbers::pi - ROUNDING;
    for (const uint32_t s : sector_of(to_face).spokes) {
        const double angle = spokes_[s].angle + angle_between(to, direction(spokes_[s].vertex));
        if (!(angle < least)) continue;
        least = angle;
        best = s;
    }
    if (best == NONE) return std::nullopt;
    return fan_to(best);
}

// The next vertex that a path passes, from a portal on, but for its ends.
std::optional<Pass> next_pass(const Strip& strip, const StripPath& path, size_t from) {
    for (size_t i = from; i < strip.portals.size(); ++i) {
        const uint32_t vertex = vertex_at(strip.portals[i], path.shares[i]);
        if (vertex == NONE) continue;
        size_t last = i;
        while (last + 1 < strip.portals.size() &&
               vertex_at(strip.portals[last + 1], path.shares[last + 1]) == vertex)
            ++last;
        return Pass{i, last, vertex};
    }
    return std::nullopt;
}

// The strip with another way around the vertex of a pass, or nothing if the path is straight enough there.
std::optional<Strip> turned(const Surface& surface, const Strip& strip, const StripPath& path,
                            const Pass& pass) {
    const Vector3d at = surface.positions[pass.vertex];
    const Vector3d from = position_before(surface, strip, path, pass.first) - at,
                   to = position_after(surface, strip, path, pass.last) - at;
    if (from.isZero(0) || to.isZero(0)) return std::nullopt;
    const auto fan =
        Turn(surface, pass.vertex).below_pi(strip.faces[pass.first], from, strip.faces[pass.last + 1], to);
    if (!fan) return std::nullopt;
    Strip result{strip.source, strip.target, {}, {}};
    const auto first = static_cast<std::ptrdiff_t>(pass.first), last = static_cast<std::ptrdiff_t>(pass.last);
    result.faces.assign(strip.faces.begin(), strip.faces.begin() + first + 1);
    result.portals.assign(strip.portals.begin(), strip.portals.begin() + first);
    result.faces.insert(result.faces.end(), fan->faces.begin(), fan->faces.end());
    for (const uint32_t spoke : fan->spokes) result.portals.push_back({pass.vertex, spoke});
    const bool is_one_face = fan->spokes.empty();
    result.faces.insert(result.faces.end(), strip.faces.begin() + last + (is_one_face ? 2 : 1),
                        strip.faces.end());
    result.portals.insert(result.portals.end(), strip.portals.begin() + last + 1, strip.portals.end());
    drop_returns(result);
    return result;
}

}

StripPath straighten(const Surface& surface, Strip& strip) {
    constexpr double SHORTER = 1e-13; // as a share: less is rounding
    StripPath path = shortest_in_strip(surface, strip);
    std::unordered_set<uint32_t> straight; // vertices where no turn has helped since the last one that did
    for (size_t from = 0;;) {
        const auto pass = next_pass(strip, path, from);
        if (!pass) return path;
        from = pass->last + 1;
        if (straight.contains(pass->vertex)) continue;
        straight.insert(pass->vertex);
        auto other = turned(surface, strip, path, *pass);
        if (!other) continue;
        StripPath shorter = shortest_in_strip(surface, *other);
        if (!(shorter.length < path.length * (1 - SHORTER))) continue;
        strip = std::move(*other);
        path = std::move(shorter);
        straight.clear();
        from = 0;
    }
}

}
