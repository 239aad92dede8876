#include "src/path/detours.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <span>

#include "src/path/slide.h"
#include "src/path/straighten.h"
#include "src/path/turn.h"
#include "src/surface/costs.h"
#include "src/surface/nearby.h"

namespace geodesic {

namespace {

using Eigen::Vector3d;

constexpr double SHORTER_DETOUR = 1e-11; // as a share: less is rounding

// A part of a way with other faces and portals.
struct Change {
    Replaced faces;
    std::vector<uint32_t> new_faces;
    Replaced portals;
    std::vector<Portal> new_portals;
    std::vector<double> new_shares;
};

void apply(const Change& change, Strip& strip, StripPath& path) {
    replace(strip.faces, change.faces, change.new_faces);
    replace(strip.portals, change.portals, change.new_portals);
    replace(path.shares, change.portals, change.new_shares);
}

class Detours {
public:
    Detours(const Surface& surface, StripWay& way) : surface_(surface), strip_(way.strip), path_(way.path) {}

    void run();

private:
    double cost(uint32_t face) const { return surface_.costs.of_face[face]; }
    uint32_t vertex_close_to(size_t portal) const;
    Vector3d begin_of(size_t face) const { return position_before(surface_, strip_, path_, face); }
    Vector3d end_of(size_t face) const {
        return face == strip_.portals.size() ? position_of(surface_, strip_.target) : begin_of(face + 1);
    }
    double length_of_piece(size_t face) const {
        return cost(strip_.faces[face]) * (end_of(face) - begin_of(face)).norm();
    }
    Pass pass_from(size_t portal) const;
    PointRange around(size_t first, size_t last) const;
    PointRange around_face(size_t face) const;
    bool take(const Change& change, PointRange range);
    std::optional<Turn::Fan> fan_around(const Pass& pass, const std::vector<uint32_t>& forbidden) const;
    bool leads_through(const Pass& pass, const std::vector<uint32_t>& spokes) const;
    bool try_vertex(const Pass& pass);
    bool may_help(uint32_t beside, size_t face, uint32_t a, uint32_t b) const;
    Change through(uint32_t beside, size_t face, uint32_t a, uint32_t b) const;
    bool try_beside(size_t face);
    bool go_straight_on(size_t face);
    bool sweep();

    const Surface& surface_;
    Strip& strip_;
    StripPath& path_;
};

// The vertex that the path passes a portal at or close to, or NONE.
uint32_t Detours::vertex_close_to(size_t portal) const {
    constexpr double CLOSE = 0.03;
    const double share = path_.shares[portal];
    const auto& [a, b] = strip_.portals[portal];
    return share < CLOSE ? a : share > 1 - CLOSE ? b : NONE;
}

// All portals that the path passes at the vertex of this one.
Pass Detours::pass_from(size_t portal) const {
    Pass pass{portal, portal, vertex_close_to(portal)};
    while (pass.last + 1 < strip_.portals.size() && vertex_close_to(pass.last + 1) == pass.vertex)
        ++pass.last;
    return pass;
}

// The points from a few before a portal to a few behind another one.
PointRange Detours::around(size_t first, size_t last) const {
    constexpr size_t MOST = 8;
    return {first - std::min(first, MOST), std::min(last + 2 + MOST, strip_.portals.size() + 1)};
}

PointRange Detours::around_face(size_t face) const {
    const size_t portals = strip_.portals.size();
    return portals == 0 ? PointRange{0, 1} : around(face > 0 ? face - 1 : 0, std::min(face, portals - 1));
}

// Makes a change if that makes the path shorter when points slide within the range only.
bool Detours::take(const Change& change, PointRange range) {
    StripWay part;
    copy_part(surface_, strip_, path_, range, part.strip);
    const auto share = [&](size_t point) {
        return path_.shares.begin() + static_cast<std::ptrdiff_t>(point);
    };
    part.path.shares.assign(share(range.first), share(range.last - 1));
    const double before = weighted_length(surface_, part.strip, part.path.shares);
    Change local = change;
    for (size_t* i : {&local.faces.begin, &local.faces.end, &local.portals.begin, &local.portals.end})
        *i -= range.first;
    apply(local, part.strip, part.path);
    slide(surface_, part.strip, part.path);
    if (!(part.path.length < before - path_.length * SHORTER_DETOUR)) return false;
    path_.length += part.path.length - before;
    apply({{range.first, range.last},
           part.strip.faces,
           {range.first, range.last - 1},
           part.strip.portals,
           part.path.shares},
          strip_, path_);
    return true;
}

// The faces around a vertex over the least angle, without passing the edges to some others.
std::optional<Turn::Fan> Detours::fan_around(const Pass& pass, const std::vector<uint32_t>& forbidden) const {
    const Vector3d at = surface_.positions[pass.vertex];
    Turn turn(surface_, pass.vertex);
    for (const uint32_t other_end : forbidden) turn.forbid(other_end);
    return turn.below(UNREACHABLE, strip_.faces[pass.first], begin_of(pass.first) - at,
                      strip_.faces[pass.last + 1], end_of(pass.last + 1) - at);
}

// Whether the path passes the edges from the vertex to these others already.
bool Detours::leads_through(const Pass& pass, const std::vector<uint32_t>& spokes) const {
    const auto portals = std::span(strip_.portals).subspan(pass.first, pass.last + 1 - pass.first);
    return std::ranges::equal(portals, spokes, [&](const Portal& portal, uint32_t spoke) {
        return !portal.is_vertex() && portal.covers({pass.vertex, spoke});
    });
}

// Where it comes back into the face that it came from, straight on, or else on either side.
bool Detours::try_vertex(const Pass& pass) {
    const Vector3d at = surface_.positions[pass.vertex];
    if (begin_of(pass.first) == at || end_of(pass.last + 1) == at) return false;
    const PointRange range = around(pass.first, pass.last);
    const Replaced portals{pass.first, pass.last + 1};
    if (strip_.faces[pass.first] == strip_.faces[pass.last + 1])
        return take({{pass.first + 1, pass.last + 2}, {}, portals, {}, {}}, range);
    std::vector<uint32_t> forbidden;
    for (size_t side = 0; side < 2; ++side) {
        const auto fan = fan_around(pass, forbidden);
        if (!fan) return false;
        forbidden = fan->spokes;
        if (leads_through(pass, fan->spokes)) continue;
        Change change{{pass.first + 1, pass.last + 1}, fan->faces, portals, {}, {}};
        for (const uint32_t spoke : fan->spokes) change.new_portals.push_back({pass.vertex, spoke});
        change.new_shares.resize(fan->spokes.size(), 0);
        if (take(change, range)) return true;
    }
    return false;
}

// Whether a way along the line of an edge, in a face that costs less, can be shorter than the piece in its
// face: it meets the line at the critical angle, whose sine is the ratio of the costs.
bool Detours::may_help(uint32_t beside, size_t face, uint32_t a, uint32_t b) const {
    constexpr double LEAST_GAIN = 1e-6;
    const double own = cost(strip_.faces[face]), sine = cost(beside) / own;
    if (!(sine < 1)) return false;
    const Vector3d along = surface_.positions[b] - surface_.positions[a];
    const Place from = place_beside(surface_.positions[a], along.normalized(), begin_of(face)),
                to = place_beside(surface_.positions[a], along.normalized(), end_of(face));
    const double best =
        own * ((from.height + to.height) * std::sqrt(1 - sine * sine) + std::abs(from.foot - to.foot) * sine);
    return best < length_of_piece(face) - LEAST_GAIN * path_.length;
}

// From a face into the one beside an edge of it, along the edge, and back.
Change Detours::through(uint32_t beside, size_t face, uint32_t a, uint32_t b) const {
    const uint32_t own = strip_.faces[face];
    const Vector3d along = surface_.positions[b] - surface_.positions[a];
    const auto share = [&](const Vector3d& point) {
        return std::clamp((point - surface_.positions[a]).dot(along) / along.squaredNorm(), 0.0, 1.0);
    };
    return {{face, face + 1},
            {own, beside, own},
            {face, face},
            {{a, b}, {a, b}},
            {share(begin_of(face)), share(end_of(face))}};
}

bool Detours::try_beside(size_t face) {
    const uint32_t own = strip_.faces[face];
    for (size_t k = 0; k < 3; ++k) {
        const uint32_t a = surface_.faces[own][(k + 1) % 3], b = surface_.faces[own][(k + 2) % 3];
        const uint32_t beside = cheapest_face_at(surface_, own, a, b);
        if ((face > 0 && strip_.faces[face - 1] == beside) ||
            (face + 1 < strip_.faces.size() && strip_.faces[face + 1] == beside))
            continue;
        if (!may_help(beside, face, a, b)) continue;
        if (take(through(beside, face, a, b), around_face(face))) return true;
    }
    return false;
}

// Where the path comes back into a face, the straight way in that face may be shorter.
bool Detours::go_straight_on(size_t face) {
    if (face + 2 >= strip_.faces.size() || strip_.faces[face] != strip_.faces[face + 2]) return false;
    const double straight = cost(strip_.faces[face]) * (end_of(face + 2) - begin_of(face)).norm();
    const double length = length_of_piece(face) + length_of_piece(face + 1) + length_of_piece(face + 2);
    if (!(straight <= length)) return false;
    path_.length += straight - length;
    apply({{face + 1, face + 3}, {}, {face, face + 2}, {}, {}}, strip_, path_);
    return true;
}

// Once along the strip. Returns whether anything has changed.
bool Detours::sweep() {
    bool has_changed = false;
    for (size_t i = 0; i < strip_.faces.size(); ++i) {
        has_changed |= go_straight_on(i);
        has_changed |= try_beside(i);
    }
    for (size_t i = 0; i < strip_.portals.size(); ++i) {
        if (vertex_close_to(i) == NONE) continue;
        const Pass pass = pass_from(i);
        has_changed |= try_vertex(pass);
        i = pass.last;
    }
    return has_changed;
}

void Detours::run() {
    constexpr int MOST_SWEEPS = 8;
    for (int i = 0; i < MOST_SWEEPS && sweep(); ++i) slide(surface_, strip_, path_);
}

}

void try_detours(const Surface& surface, StripWay& way) { Detours(surface, way).run(); }

}
