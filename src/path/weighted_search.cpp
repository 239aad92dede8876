#include "src/path/weighted_search.h"

#include <algorithm>
#include <cmath>
#include <unordered_map>

#include "src/base/plane.h"
#include "src/path/open_nodes.h"
#include "src/surface/costs.h"
#include "src/surface/nearby.h"

namespace geodesic {

namespace {

using Eigen::Vector3d;

class SteinerWay {
public:
    SteinerWay(const Surface& surface, const WeightedSearchRequest& request);

    std::optional<StripWay> run();

private:
    static constexpr uint32_t SOURCE = 0, TARGET = 1; // nodes
    static constexpr uint32_t MOST_TIMES = 3;         // that a node is left
    struct Node {
        Vector3d at;
        double rest;            // to the target, as far as is known
        uint32_t edge = NONE;   // that it is a point of
        uint32_t on_edge = 0;   // which point of the edge, counted from 1 at its end a
        uint32_t vertex = NONE; // that it is at; NONE of points of edges, of source and target
        double length = UNREACHABLE;
        uint32_t before = NONE, face = NONE; // that the way arrives through
        double left_at = UNREACHABLE;        // its length when it was left
        uint32_t times_left = 0;
    };
    struct Edge {
        uint32_t a, b, cheapest_face, first_node;
        double step; // what it costs from point to point
    };

    double cost(uint32_t face) const { return surface_.costs.of_face[face]; }
    uint32_t node_of_vertex(uint32_t vertex);
    uint32_t edge_between(uint32_t face, uint32_t a, uint32_t b);
    uint32_t add_edge(uint32_t face, uint32_t a, uint32_t b);
    uint32_t node_at(uint32_t edge, uint32_t on_edge);
    double rest_on_edge(double from_a, double from_b, double length, double along) const;
    void reach(uint32_t node, double length, uint32_t before, uint32_t face);
    void reach_through(uint32_t face, uint32_t node, uint32_t from);
    void reach_inside_of(uint32_t face, uint32_t a, uint32_t b, uint32_t from);
    void reach_target(uint32_t face, uint32_t from);
    void leave_source();
    void leave_vertex(uint32_t from);
    void leave_edge(uint32_t from);
    void cross(uint32_t face, uint32_t from);
    StripWay way() const;

    const Surface& surface_;
    const WeightedSearchRequest& request_;
    const uint32_t count_;                              // points per edge
    const std::vector<SurfacePoint> sources_, targets_; // as aliases_of()
    std::vector<Node> nodes_;
    std::vector<Edge> edges_;
    std::unordered_map<uint32_t, uint32_t> vertex_nodes_;
    std::unordered_map<uint64_t, uint32_t> edge_numbers_; // by edge_key()
    OpenNodes<uint32_t> open_;
};

SteinerWay::SteinerWay(const Surface& surface, const WeightedSearchRequest& request)
    : surface_(surface), request_(request), count_(request.points_per_edge),
      sources_(aliases_of(surface, request.source)), targets_(aliases_of(surface, request.target)) {
    nodes_.push_back({position_of(surface, request.source), 0});
    nodes_.push_back({position_of(surface, request.target), 0});
}

uint32_t SteinerWay::node_of_vertex(uint32_t vertex) {
    const auto [found, is_new] = vertex_nodes_.try_emplace(vertex, static_cast<uint32_t>(nodes_.size()));
    if (is_new)
        nodes_.push_back({surface_.positions[vertex], request_.distance_to_target(vertex), NONE, 0, vertex});
    return found->second;
}

uint32_t SteinerWay::edge_between(uint32_t face, uint32_t a, uint32_t b) {
    const auto found = edge_numbers_.find(edge_key(a, b));
    return found != edge_numbers_.end() ? found->second : add_edge(face, std::min(a, b), std::max(a, b));
}

uint32_t SteinerWay::add_edge(uint32_t face, uint32_t a, uint32_t b) {
    const auto number = static_cast<uint32_t>(edges_.size());
    edge_numbers_[edge_key(a, b)] = number;
    const Vector3d begin = surface_.positions[a], along = surface_.positions[b] - begin;
    const double from_a = nodes_[node_of_vertex(a)].rest, from_b = nodes_[node_of_vertex(b)].rest;
    const uint32_t cheapest = cheapest_face_at(surface_, face, a, b);
    const double length = cost(cheapest) * along.norm();
    edges_.push_back({a, b, cheapest, static_cast<uint32_t>(nodes_.size()), length / (count_ + 1)});
    for (uint32_t i = 1; i <= count_; ++i) {
        const double share = double(i) / (count_ + 1);
        nodes_.push_back(
            {begin + share * along, rest_on_edge(from_a, from_b, length, share * length), number, i});
    }
    return number;
}

uint32_t SteinerWay::node_at(uint32_t edge, uint32_t on_edge) {
    if (on_edge == 0) return node_of_vertex(edges_[edge].a);
    if (on_edge == count_ + 1) return node_of_vertex(edges_[edge].b);
    return edges_[edge].first_node + on_edge - 1;
}

// By the distances of the edge's ends, all as costs: along the edge, or straight to where they place the
// target in a plane that costs as much.
double SteinerWay::rest_on_edge(double from_a, double from_b, double length, double along) const {
    const double over_end = std::min(from_a + along, from_b + length - along);
    if (!(over_end < UNREACHABLE) || !(length > 0)) return over_end;
    const double foot = foot_of(length, from_a, from_b);
    const double square = (from_a - foot) * (from_a + foot);
    return square >= 0 ? std::min(over_end, std::sqrt(square + (along - foot) * (along - foot))) : over_end;
}

void SteinerWay::reach(uint32_t node, double length, uint32_t before, uint32_t face) {
    Node& reached = nodes_[node];
    const double expected = length + std::max(0.0, reached.rest - request_.slack);
    if (reached.times_left == MOST_TIMES || !(length < reached.length) || !(expected < UNREACHABLE)) return;
    const bool is_limited = request_.limit < UNREACHABLE;
    if (is_limited && expected > request_.limit) return;
    reached.length = length;
    reached.before = before;
    reached.face = face;
    open_.push(is_limited ? length : expected, node);
}

void SteinerWay::reach_through(uint32_t face, uint32_t node, uint32_t from) {
    const double way = cost(face) * (nodes_[node].at - nodes_[from].at).norm();
    reach(node, nodes_[from].length + way, from, face);
}

void SteinerWay::reach_inside_of(uint32_t face, uint32_t a, uint32_t b, uint32_t from) {
    const uint32_t edge = edge_between(face, a, b);
    for (uint32_t i = 1; i <= count_; ++i) reach_through(face, node_at(edge, i), from);
}

void SteinerWay::reach_target(uint32_t face, uint32_t from) {
    if (alias_in(targets_, face)) reach_through(face, TARGET, from);
}

void SteinerWay::leave_source() {
    nodes_[SOURCE].length = 0;
    for (const auto& [face, weights] : sources_) {
        for (size_t k = 0; k < 3; ++k) {
            reach_through(face, node_of_vertex(surface_.faces[face][k]), SOURCE);
            reach_inside_of(face, surface_.faces[face][(k + 1) % 3], surface_.faces[face][(k + 2) % 3],
                            SOURCE);
        }
        reach_target(face, SOURCE);
    }
}

void SteinerWay::leave_vertex(uint32_t from) {
    const uint32_t vertex = nodes_[from].vertex;
    for (const uint32_t face : surface_.vertex_faces[vertex]) {
        const uint32_t k = corner_of(surface_, face, vertex);
        const uint32_t ends[] = {surface_.faces[face][(k + 1) % 3], surface_.faces[face][(k + 2) % 3]};
        reach_inside_of(face, ends[0], ends[1], from);
        for (const uint32_t end : ends) {
            const uint32_t number = edge_between(face, vertex, end);
            const Edge& edge = edges_[number];
            reach(node_at(number, edge.a == vertex ? 1 : count_), nodes_[from].length + edge.step, from,
                  edge.cheapest_face);
        }
        reach_target(face, from);
    }
}

// Not through the face that the way came through: all of that was reached straight from where it entered.
void SteinerWay::leave_edge(uint32_t from) {
    const Node node = nodes_[from];
    const Edge edge = edges_[node.edge];
    for (const uint32_t next : {node_at(node.edge, node.on_edge - 1), node_at(node.edge, node.on_edge + 1)})
        reach(next, node.length + edge.step, from, edge.cheapest_face);
    for_each_face_beyond(surface_, node.face, edge.a, edge.b, [&](uint32_t face) { cross(face, from); });
}

void SteinerWay::cross(uint32_t face, uint32_t from) {
    const auto [a, b] = std::pair(edges_[nodes_[from].edge].a, edges_[nodes_[from].edge].b);
    for (const uint32_t apex : surface_.faces[face]) {
        if (apex == a || apex == b) continue;
        reach_through(face, node_of_vertex(apex), from);
        reach_inside_of(face, a, apex, from);
        reach_inside_of(face, b, apex, from);
    }
    reach_target(face, from);
}

std::optional<StripWay> SteinerWay::run() {
    leave_source();
    while (!open_.empty()) {
        const uint32_t node = open_[open_.pop()];
        if (node == TARGET) return way();
        if (!(nodes_[node].length < nodes_[node].left_at)) continue;
        nodes_[node].left_at = nodes_[node].length;
        ++nodes_[node].times_left;
        if (nodes_[node].edge == NONE)
            leave_vertex(node);
        else
            leave_edge(node);
    }
    return std::nullopt;
}

// Of two pieces in one face the first is enough: straight on, the way is not longer.
StripWay SteinerWay::way() const {
    StripWay way;
    for (uint32_t node = TARGET; node != SOURCE; node = nodes_[node].before) {
        const Node& at = nodes_[node];
        if (node != TARGET) {
            if (way.strip.faces.back() == at.face) continue;
            const bool is_vertex = at.edge == NONE;
            way.strip.portals.push_back(is_vertex ? Portal{at.vertex, at.vertex}
                                                  : Portal{edges_[at.edge].a, edges_[at.edge].b});
            way.path.shares.push_back(is_vertex ? 0 : double(at.on_edge) / (count_ + 1));
        }
        way.strip.faces.push_back(at.face);
    }
    std::ranges::reverse(way.strip.faces);
    std::ranges::reverse(way.strip.portals);
    std::ranges::reverse(way.path.shares);
    way.strip.source = *alias_in(sources_, way.strip.faces.front());
    way.strip.target = *alias_in(targets_, way.strip.faces.back());
    way.path.length = nodes_[TARGET].length;
    return way;
}

}

std::optional<StripWay> search_weighted(const Surface& surface, const WeightedSearchRequest& request) {
    return SteinerWay(surface, request).run();
}

}
