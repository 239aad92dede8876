#include "src/metric/weighted_surface.h"

#include <algorithm>

#include "format/error.h"
#include "src/base/plane.h"
#include "src/metric/event_queue.h"
#include "src/metric/target_points.h"

namespace geodesic {

namespace {

using Graph = WeightedMetric::Graph;

// Dijkstra. Nodes are the vertices by number, then the Steiner points of edge 0, of edge 1 .., each from the
// edge's first vertex to its second.
class SteinerSearch final : public FieldSolver {
public:
    explicit SteinerSearch(std::shared_ptr<const Graph> graph)
        : FieldSolver(static_cast<uint32_t>(graph->mesh.total_angle.size())), graph_(std::move(graph)),
          nodes_(vertex_count() + graph_->mesh.edge_length.size() * graph_->points_per_edge),
          pending_(vertex_count()) {}

private:
    struct Node {
        double distance = UNREACHABLE;
        uint32_t nearest = NONE;
        uint32_t from_face = NONE; // that the path arrives through
    };

    void run(const FieldRequest& request) override;
    void clear();
    void start(const FieldRequest& request);
    void start_at(const SurfacePoint& point, uint32_t nearest);
    void reach(uint32_t node, double distance, uint32_t nearest, uint32_t from_face);
    void reach_point(uint32_t index, double distance);
    void settle_vertex(uint32_t vertex);
    void settle_edge_point(uint32_t edge, uint32_t position);
    void cross(const Side& side, uint32_t edge, double t, const Node& node);
    void reach_exit(uint32_t tagged_edge, double apex_x, double apex_depth, double t, double cost,
                    const Node& node, uint32_t face);

    const IntrinsicMesh& mesh() const { return graph_->mesh; }
    uint32_t points_per_edge() const { return graph_->points_per_edge; }
    uint32_t first_of_edge(uint32_t edge) const { return vertex_count() + edge * points_per_edge(); }
    double spacing(uint32_t edge) const { return mesh().edge_length[edge] / (points_per_edge() + 1); }
    // The node of an edge at a position 0 .. points_per_edge + 1, from vertex to vertex.
    uint32_t node_at(uint32_t edge, uint32_t position) const {
        if (position == 0) return mesh().edge_vertices[edge][0];
        if (position == points_per_edge() + 1) return mesh().edge_vertices[edge][1];
        return first_of_edge(edge) + position - 1;
    }

    std::shared_ptr<const Graph> graph_;
    std::vector<Node> nodes_;
    std::vector<uint32_t> touched_;
    EventQueue queue_; // nodes, then target points
    PendingTargets pending_;
    TargetPoints targets_;
};

void SteinerSearch::clear() {
    for (uint32_t node : touched_) nodes_[node] = {};
    touched_.clear();
    queue_.clear();
}

void SteinerSearch::run(const FieldRequest& request) {
    clear();
    start(request);
    bool is_done = false; // with the targets
    uint32_t settled = 0;
    set_final_up_to(UNREACHABLE);
    while (!queue_.empty()) {
        check_cancelled_sometimes();
        const auto event = queue_.pop();
        if (event.distance > request.radius || (is_done && settled >= request.final_count)) {
            set_final_up_to(event.distance); // it was the least of those that may still be lowered
            break;
        }
        if (event.item >= nodes_.size()) {
            is_done |= pending_.settle_point(event.item - nodes_.size());
        } else if (event.distance != nodes_[event.item].distance) {
            continue;
        } else if (event.item < vertex_count()) {
            settle_vertex(event.item);
            ++settled;
            is_done |= pending_.settle(event.item);
        } else {
            const uint32_t point = event.item - vertex_count();
            settle_edge_point(point / points_per_edge(), point % points_per_edge() + 1);
        }
    }
}

void SteinerSearch::start(const FieldRequest& request) {
    pending_.begin(request);
    targets_.place(mesh(), request.target_points);
    for (uint32_t i = 0; i < request.sources.size(); ++i) reach(request.sources[i], 0, i, NONE);
    auto nearest = static_cast<uint32_t>(request.sources.size());
    for (const SurfacePoint& point : request.source_points) {
        for (const SurfacePoint& alias : in_all_faces(mesh(), point)) start_at(alias, nearest);
        ++nearest;
    }
}

void SteinerSearch::start_at(const SurfacePoint& point, uint32_t nearest) {
    const double cost = graph_->face_cost[point.face];
    for (uint32_t corner = 3 * point.face; corner < 3 * point.face + 3; ++corner) {
        const uint32_t edge = mesh().edge_of_corner[corner];
        const PlanePoint p = place_on_side(mesh(), corner, point);
        for (uint32_t i = 0; i <= points_per_edge() + 1; ++i)
            reach(node_at(edge, i), cost * hypotenuse(i * spacing(edge) - p.x, p.depth), nearest, NONE);
    }
    const PlanePoint from = place_on_side(mesh(), 3 * point.face, point);
    for (const TargetPoint& target : targets_.of_face(point.face)) {
        const PlanePoint& to = target.on_side[0];
        reach_point(target.index, cost * hypotenuse(from.x - to.x, from.depth - to.depth));
    }
}

void SteinerSearch::reach(uint32_t node, double distance, uint32_t nearest, uint32_t from_face) {
    Node& reached = nodes_[node];
    if (!(distance < reached.distance)) return;
    if (reached.distance == UNREACHABLE) touched_.push_back(node);
    reached = {distance, nearest, from_face};
    if (node < vertex_count()) improve(node, distance, nearest);
    queue_.push(distance, node);
}

void SteinerSearch::reach_point(uint32_t index, double distance) {
    if (improve_point(index, distance)) queue_.push(distance, static_cast<uint32_t>(nodes_.size()) + index);
}

void SteinerSearch::settle_vertex(uint32_t vertex) {
    const Node node = nodes_[vertex];
    for (const Spoke& spoke : mesh().spokes[vertex]) {
        const bool is_first = mesh().edge_vertices[spoke.edge][0] == vertex;
        reach(node_at(spoke.edge, is_first ? 1 : points_per_edge()),
              node.distance + graph_->edge_cost[spoke.edge] * spacing(spoke.edge), node.nearest, NONE);
    }
    for (uint32_t corner : mesh().corners[vertex]) {
        const Side& side = mesh().sides.items[mesh().side_of_corner[corner]];
        const uint32_t edge = mesh().edge_of_corner[corner];
        const double cost = graph_->face_cost[side.face];
        for (uint32_t i = 1; i <= points_per_edge(); ++i)
            reach(node_at(edge, i),
                  node.distance + cost * hypotenuse(i * spacing(edge) - side.apex_x, side.apex_depth),
                  node.nearest, side.face);
        for (const TargetPoint& target : targets_.of_face(side.face)) {
            const PlanePoint& p = target.on_side[corner % 3];
            reach_point(target.index,
                        node.distance + cost * hypotenuse(p.x - side.apex_x, p.depth - side.apex_depth));
        }
    }
}

void SteinerSearch::settle_edge_point(uint32_t edge, uint32_t position) {
    const Node node = nodes_[node_at(edge, position)];
    const double step = graph_->edge_cost[edge] * spacing(edge);
    for (uint32_t neighbour : {node_at(edge, position - 1), node_at(edge, position + 1)})
        reach(neighbour, node.distance + step, node.nearest, NONE);
    // What lies in the face that the path came through was reached straight from where it entered.
    for (const Side& side : mesh().sides[edge])
        if (side.face != node.from_face) cross(side, edge, position * spacing(edge), node);
}

// From the point (t, 0) of an edge into a face.
void SteinerSearch::cross(const Side& side, uint32_t edge, double t, const Node& node) {
    const double cost = graph_->face_cost[side.face], length = mesh().edge_length[edge];
    reach(side.apex, node.distance + cost * hypotenuse(t - side.apex_x, side.apex_depth), node.nearest,
          side.face);
    reach_exit(side.tagged_edge[0], side.apex_x, side.apex_depth, t, cost, node, side.face);
    reach_exit(side.tagged_edge[1], side.apex_back, side.apex_depth, length - t, cost, node, side.face);
    if (targets_.empty()) return;
    const uint32_t corner = mesh().corner_of_side[static_cast<size_t>(&side - mesh().sides.items.data())];
    for (const TargetPoint& target : targets_.of_face(side.face)) {
        const PlanePoint& p = target.on_side[corner % 3];
        reach_point(target.index, node.distance + cost * hypotenuse(t - p.x, p.depth));
    }
}

// To the points of another edge of the face, which goes from the origin to the apex.
void SteinerSearch::reach_exit(uint32_t tagged_edge, double apex_x, double apex_depth, double t, double cost,
                               const Node& node, uint32_t face) {
    const uint32_t exit = tagged_edge >> 1, count = points_per_edge();
    const bool reversed = (tagged_edge & 1) != 0;
    const double step_x = apex_x / (count + 1), step_y = apex_depth / (count + 1);
    for (uint32_t i = 1; i <= count; ++i)
        reach(node_at(exit, reversed ? count + 1 - i : i),
              node.distance + cost * hypotenuse(t - i * step_x, i * step_y), node.nearest, face);
}

}

WeightedMetric::WeightedMetric(const Mesh& mesh, std::span<const double> face_cost, uint32_t points_per_edge,
                               std::span<const double> own_lengths) {
    const uint64_t node_count = mesh.vertex_count() + uint64_t{mesh.edge_count()} * points_per_edge;
    if (node_count > UINT32_MAX / 2)
        throw Error(GEOIDX_ERROR_LIMIT, std::to_string(points_per_edge) + " points on each of " +
                                            std::to_string(mesh.edge_count()) + " edges are too many");
    auto graph = std::make_shared<Graph>(
        Graph{IntrinsicMesh(mesh, own_lengths), {face_cost.begin(), face_cost.end()}, {}, points_per_edge});
    for (uint32_t e = 0; e < mesh.edge_count(); ++e) {
        const auto cost_of = [&](uint32_t face) { return face_cost[face]; };
        graph->edge_cost.push_back(cost_of(std::ranges::min(mesh.edge_faces[e], {}, cost_of)));
    }
    graph_ = std::move(graph);
}

std::unique_ptr<FieldSolver> WeightedMetric::make_solver() const {
    return std::make_unique<SteinerSearch>(graph_);
}

}
