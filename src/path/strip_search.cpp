#include "src/path/strip_search.h"

#include <algorithm>
#include <array>
#include <utility>

#include "src/path/edge_crossing.h"
#include "src/surface/nearby.h"

namespace geodesic {

using Eigen::Vector3d;

void StripSearch::begin(const SurfacePoint& source, const SurfacePoint& target) {
    open_.clear();
    faces_.clear();
    vertices_.clear();
    target_position_ = position_of(surface_, target);
    sources_ = aliases_of(surface_, source);
    targets_ = aliases_of(surface_, target);
    for (const SurfacePoint& alias : sources_)
        open(faces_[alias.face], 0, {Kind::FACE, alias.face, NONE, {{NONE, NONE}, 0, 0}, 0, 0});
}

// Of a face or a vertex.
Vector3d StripSearch::position(const Node& node) const {
    if (node.kind == Kind::VERTEX) return surface_.positions[node.item];
    if (node.entry.ends.a != NONE) return position_at(surface_, node.entry.ends, node.share);
    return position_of(surface_, *alias_in(sources_, node.item));
}

// Notes a way to a face or vertex, unless that is closed or a way is open there that is expected to be no
// longer.
void StripSearch::open(Expected& expected, double rest, const Node& node) {
    const double length = node.length + rest * (1 + distances_->error);
    if (!(length < expected.length)) return;
    expected.length = length;
    open_.push(length, node);
}

bool StripSearch::close(const Node& node) {
    return std::exchange(expected_at(node).length, CLOSED) != CLOSED;
}

void StripSearch::reach_target(const Leaving& leaving) {
    const double length = leaving.length + (target_position_ - leaving.at).norm();
    open_.push(length, {Kind::TARGET, leaving.face, leaving.node, {}, 0, length});
}

// What the edge leads to that the face was entered by was reached from the face before, in a shorter way.
void StripSearch::leave_face(uint32_t index) {
    const Node& node = open_[index];
    const Leaving leaving{index, node.item, position(node), node.length};
    const Edge entry = node.entry;
    if (alias_in(targets_, leaving.face)) reach_target(leaving);
    const auto& corners = surface_.faces[leaving.face];
    std::array<double, 3> rests;
    for (size_t k = 0; k < 3; ++k) rests[k] = rest_from(corners[k], entry);
    for (size_t k = 0; k < 3; ++k) {
        const size_t i = (k + 1) % 3, j = (k + 2) % 3;
        const bool is_of_entry = entry.ends.contains(corners[k]);
        if (!is_of_entry) pass_vertex(leaving, corners[k]);
        if (is_of_entry || entry.ends.is_vertex())
            pass_edge(leaving, edge_between(corners[i], rests[i], corners[j], rests[j]));
    }
}

double StripSearch::rest_from(uint32_t vertex, const Edge& entry) {
    if (vertex == entry.ends.a) return entry.rest_a;
    if (vertex == entry.ends.b) return entry.rest_b;
    double& rest = vertices_[vertex].rest;
    if (rest == UNKNOWN) rest = distances_->at_vertex(vertex);
    return rest;
}

void StripSearch::pass_vertex(const Leaving& leaving, uint32_t vertex) {
    auto& [expected, rest] = vertices_[vertex];
    if (expected.length == CLOSED) return;
    const double length = leaving.length + (surface_.positions[vertex] - leaving.at).norm();
    open(expected, rest, {Kind::VERTEX, vertex, leaving.node, {{vertex, vertex}, rest, rest}, 0, length});
}

void StripSearch::pass_edge(const Leaving& leaving, const Edge& edge) {
    Crossing crossing;
    for_each_face_beyond(surface_, leaving.face, edge.ends.a, edge.ends.b, [&](uint32_t face) {
        Expected& expected = faces_[face];
        if (expected.length == CLOSED) return;
        if (!crossing.is_known) crossing = cross(leaving, edge);
        open(expected, crossing.rest,
             {Kind::FACE, face, leaving.node, edge, crossing.share, crossing.length});
    });
}

StripSearch::Crossing StripSearch::cross(const Leaving& leaving, const Edge& edge) const {
    const auto [a, b] = edge.ends;
    const auto [share, rest] = cross_edge(surface_, a, b, leaving.at, edge.rest_a, edge.rest_b);
    const Vector3d at = position_at(surface_, edge.ends, share);
    return {true, share, rest, leaving.length + (at - leaving.at).norm()};
}

void StripSearch::leave_vertex(uint32_t index) {
    const auto [kind, vertex, before, entry, share, length] = open_[index];
    for (const uint32_t face : surface_.vertex_faces[vertex])
        open(faces_[face], entry.rest_a, {Kind::FACE, face, index, entry, 0, length});
}

std::optional<Strip> StripSearch::run(const SurfacePoint& source, const SurfacePoint& target,
                                      const TargetDistances& distances) {
    distances_ = &distances;
    begin(source, target);
    for (size_t steps = 0; !open_.empty();) {
        const uint32_t index = open_.pop();
        const Node& node = open_[index];
        if (node.kind == Kind::TARGET) return strip_to(index);
        if (!close(node)) continue;
        if (steps++ == distances.most_steps) break;
        if (node.kind == Kind::FACE)
            leave_face(index);
        else
            leave_vertex(index);
    }
    return std::nullopt;
}

Strip StripSearch::strip_to(uint32_t index) const {
    Strip strip;
    strip.target = *alias_in(targets_, open_[index].item);
    for (uint32_t i = open_[index].before; i != NONE; i = open_[i].before) {
        if (open_[i].kind == Kind::VERTEX) continue;
        strip.faces.push_back(open_[i].item);
        if (open_[i].entry.ends.a != NONE) strip.portals.push_back(open_[i].entry.ends);
    }
    std::ranges::reverse(strip.faces);
    std::ranges::reverse(strip.portals);
    strip.source = *alias_in(sources_, strip.faces.front());
    return strip;
}

std::optional<Strip> search_strip(const Surface& surface, const SurfacePoint& source,
                                  const SurfacePoint& target, const TargetDistances& distances) {
    return StripSearch(surface).run(source, target, distances);
}

}
