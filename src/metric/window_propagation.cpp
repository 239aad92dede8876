#include "src/metric/window_propagation.h"

#include <cmath>
#include <numbers>

#include "src/metric/event_queue.h"
#include "src/metric/window_lists.h"

namespace geodesic {

namespace {

// Shares of a length or an angle below which a difference is rounding.
constexpr double TIE = 1e-12;
constexpr double TOUCH = 1e-5; // thin faces magnify rounding along their edges
constexpr double ANGLE_SLACK = 1e-6;

double norm(double x, double y) { return std::sqrt(x * x + y * y); }

// A window on its way through a face, seen from the end of the entry edge that the exit edge starts at: that
// end is the origin, the other end of the entry edge at (length, 0), the apex at (apex_x, -apex_depth).
struct Passage {
    double length, apex_x, apex_depth;
    double x, y; // the source
    double near,
        far; // the part of the entry edge whose rays leave through the exit edge; near is closer to 0
    bool far_is_apex; // the far ray passes through the apex
    uint32_t near_vertex, far_vertex, apex;
    uint32_t tagged_exit;
    uint32_t face;
};

class WindowPropagation final : public FieldSolver {
public:
    explicit WindowPropagation(std::shared_ptr<const IntrinsicMesh> mesh)
        : FieldSolver(static_cast<uint32_t>(mesh->total_angle.size())), mesh_(std::move(mesh)),
          lists_(edge_count()), queued_distance_(edge_count(), UNREACHABLE), arrival_(vertex_count()),
          pending_(vertex_count()) {}

private:
    // From where the path to a vertex comes: along an edge, or in a direction. A source has neither.
    struct Arrival {
        uint32_t edge = NONE;
        double angle = NO_ANGLE; // around the vertex, as in IntrinsicMesh
    };
    static constexpr double NO_ANGLE = std::numeric_limits<double>::quiet_NaN();

    void run(std::span<const uint32_t> sources, std::span<const uint32_t> targets, double radius) override;
    void clear();
    void reach(uint32_t vertex, double distance, uint32_t nearest, Arrival arrival);
    void settle(uint32_t vertex);
    double arrival_angle(uint32_t vertex) const;
    void spawn(uint32_t vertex);
    void spawn_into(uint32_t corner, uint32_t vertex);
    void propagate_edge(uint32_t edge);
    void propagate(const Window& window, const Side& side, uint32_t edge);
    void reach_apex(const Window& window, const Side& side, double split, double crossing);
    void pass(const Window& window, const Passage& passage);
    void insert(uint32_t edge, const Window& window);

    uint32_t edge_count() const { return static_cast<uint32_t>(mesh_->edge_length.size()); }

    std::shared_ptr<const IntrinsicMesh> mesh_;
    WindowLists lists_;
    EventQueue queue_;                    // vertices by number, edges by vertex_count() + number
    std::vector<double> queued_distance_; // of the edge's live event
    std::vector<uint32_t> queued_edges_;
    std::vector<Arrival> arrival_;
    PendingTargets pending_;
    std::vector<Window> batch_;
};

void WindowPropagation::clear() {
    lists_.clear();
    queue_.clear();
    for (uint32_t edge : queued_edges_) queued_distance_[edge] = UNREACHABLE;
    queued_edges_.clear();
}

void WindowPropagation::run(std::span<const uint32_t> sources, std::span<const uint32_t> targets,
                            double radius) {
    clear();
    pending_.begin(targets);
    for (uint32_t i = 0; i < sources.size(); ++i) reach(sources[i], 0, i, {});
    while (!queue_.empty()) {
        const auto event = queue_.pop();
        if (event.distance > radius) break;
        if (event.item < vertex_count()) {
            if (event.distance != distance(event.item)) continue;
            settle(event.item);
            if (pending_.settle(event.item)) break;
        } else {
            const uint32_t edge = event.item - vertex_count();
            if (event.distance == queued_distance_[edge]) propagate_edge(edge);
        }
    }
}

void WindowPropagation::reach(uint32_t vertex, double distance, uint32_t nearest, Arrival arrival) {
    if (!improve(vertex, distance, nearest)) return;
    arrival_[vertex] = arrival;
    queue_.push(distance, vertex);
}

void WindowPropagation::settle(uint32_t vertex) {
    const double d = distance(vertex);
    for (const Spoke& spoke : mesh_->spokes[vertex])
        reach(spoke.other, d + spoke.length, nearest(vertex), {spoke.edge, NO_ANGLE});
    if (d == 0 || mesh_->can_bend[vertex]) spawn(vertex);
}

double WindowPropagation::arrival_angle(uint32_t vertex) const {
    const Arrival& arrival = arrival_[vertex];
    if (arrival.edge == NONE) return arrival.angle;
    for (uint32_t corner : mesh_->corners[vertex])
        if (mesh_->corner_first_edge[corner] == arrival.edge) return mesh_->corner_begin[corner];
    return mesh_->total_angle[vertex]; // the last edge of an open fan begins no corner
}

// A path that bends at a vertex has at least a straight angle on both sides; only the faces that such paths
// enter get windows.
void WindowPropagation::spawn(uint32_t vertex) {
    constexpr double STRAIGHT = std::numbers::pi - ANGLE_SLACK;
    const Fan fan = mesh_->fan[vertex];
    const double arrival = fan == Fan::Irregular ? NO_ANGLE : arrival_angle(vertex);
    const double total = mesh_->total_angle[vertex];
    for (uint32_t corner : mesh_->corners[vertex]) {
        double begin = mesh_->corner_begin[corner] - arrival;
        if (fan == Fan::Closed && begin < 0) begin += total;
        const double end = begin + mesh_->corner_angle[corner];
        const bool hidden = fan == Fan::Closed ? end < STRAIGHT || begin > total - STRAIGHT
                                               : end < STRAIGHT && begin > -STRAIGHT;
        if (!hidden) spawn_into(corner, vertex); // without an angle nothing is hidden
    }
}

void WindowPropagation::spawn_into(uint32_t corner, uint32_t vertex) {
    const Side& side = mesh_->sides.items[mesh_->side_of_corner[corner]];
    const uint32_t edge = mesh_->edge_of_corner[corner];
    const double length = mesh_->edge_length[edge];
    const double d = distance(vertex);
    Window window{0, length, side.apex_x, side.apex_depth, d, 0, 0, side.face, nearest(vertex) & MAX_NEAREST,
                  1};
    window.begin_distance = window.distance_at(0);
    window.end_distance = window.distance_at(length);
    insert(edge, window);
}

void WindowPropagation::propagate_edge(uint32_t edge) {
    queued_distance_[edge] = UNREACHABLE;
    batch_.clear();
    for (Window& window : lists_.at(edge))
        if (window.pending) {
            batch_.push_back(window);
            window.pending = 0;
        }
    for (const Side& side : mesh_->sides[edge])
        for (const Window& window : batch_)
            if (window.from_face != side.face) propagate(window, side, edge);
}

// The line to the apex crosses the edge at `split`. Where rounding has put that just outside of the window,
// the path bends at the window's end, `crossing`: longer by the square of the miss, but never too short.
void WindowPropagation::reach_apex(const Window& window, const Side& side, double split, double crossing) {
    const double height = window.y + side.apex_depth;
    const double across = window.x - side.apex_x;
    const double d = split == crossing
                         ? window.sigma + norm(across, height)
                         : window.distance_at(crossing) + norm(crossing - side.apex_x, side.apex_depth);
    if (!(d < distance(side.apex))) return;
    Arrival arrival;
    if (mesh_->can_bend[side.apex]) {
        // The angle between the way back to the source and the edge to the entry edge's first vertex.
        const double px = -side.apex_x, py = side.apex_depth;
        const double turn = std::atan2(std::abs(px * height - py * across), px * across + py * height);
        const uint32_t corner = mesh_->corner_of_side[static_cast<size_t>(&side - mesh_->sides.items.data())];
        const bool from_first = mesh_->corner_first_edge[corner] == side.tagged_edge[0] >> 1;
        const double begin = mesh_->corner_begin[corner];
        arrival.angle = from_first ? begin + turn : begin + mesh_->corner_angle[corner] - turn;
    }
    reach(side.apex, d, window.nearest, arrival);
}

// Carries a window over its edge into a face: to the apex if that is in its light, and to the two other
// edges.
void WindowPropagation::propagate(const Window& window, const Side& side, uint32_t edge) {
    const double height = window.y + side.apex_depth;
    // A source in line with the edge: its vertices carry that on, unless it lies on the edge, as the apex of
    // a face without area does.
    const bool on_edge = window.x > window.begin && window.x < window.end;
    if (!(window.y > 0) && !on_edge) return;
    const double length = mesh_->edge_length[edge];
    const double split = height > 0 ? window.x + (side.apex_x - window.x) * (window.y / height) : side.apex_x;
    const double crossing = std::clamp(split, window.begin, window.end);
    if (std::abs(split - crossing) <= TOUCH * length) reach_apex(window, side, split, crossing);
    const auto [first, second] = mesh_->edge_vertices[edge];
    if (window.begin < split)
        pass(window, {length, side.apex_x, side.apex_depth, window.x, window.y, window.begin,
                      std::min(window.end, split), split <= window.end, first, second, side.apex,
                      side.tagged_edge[0], side.face});
    if (window.end > split)
        pass(window, {length, length - side.apex_x, side.apex_depth, length - window.x, window.y,
                      length - window.end, length - std::max(window.begin, split), split >= window.begin,
                      second, first, side.apex, side.tagged_edge[1], side.face});
}

void WindowPropagation::pass(const Window& window, const Passage& p) {
    const uint32_t exit = p.tagged_exit >> 1;
    const double exit_length = mesh_->edge_length[exit];
    // The share of the exit edge at which the ray through (t, 0) leaves.
    const auto leave = [&](double t) {
        const double denominator = p.y * p.apex_x + p.apex_depth * (p.x - t);
        if (denominator > 0) return std::clamp(p.y * t / denominator, 0.0, 1.0);
        // All in one line, or a ray that misses the exit edge.
        return p.y == 0 && p.apex_depth == 0 && p.apex_x > 0 ? std::clamp(t / p.apex_x, 0.0, 1.0) : 1.0;
    };
    const double near_share = p.near <= 0 ? 0 : leave(p.near);
    const double far_share = p.far_is_apex ? 1 : leave(p.far);
    const double near = near_share * exit_length, far = far_share * exit_length;
    if (!(far - near > TIE * exit_length)) return;
    const double x = (p.x * p.apex_x - p.y * p.apex_depth) / exit_length;
    const double y = std::max(0.0, (p.apex_x * p.y + p.apex_depth * p.x) / exit_length);
    const double near_distance = window.sigma + norm(near - x, y);
    const double far_distance = window.sigma + norm(far - x, y);

    // Of no use where a path through a vertex of the face is shorter all along.
    if (distance(p.near_vertex) + far < far_distance * (1 - TIE)) return;
    if (distance(p.apex) + (exit_length - near) < near_distance * (1 - TIE)) return;
    const double across = norm(p.length - near_share * p.apex_x, near_share * p.apex_depth);
    if (distance(p.far_vertex) + across < near_distance * (1 - TIE)) return;

    if (p.tagged_exit & 1)
        insert(exit, {exit_length - far, exit_length - near, exit_length - x, y, window.sigma, far_distance,
                      near_distance, p.face, window.nearest, 1});
    else
        insert(exit, {near, far, x, y, window.sigma, near_distance, far_distance, p.face, window.nearest, 1});
}

void WindowPropagation::insert(uint32_t edge, const Window& window) {
    const double lowest = lists_.insert(edge, window);
    if (!(lowest < queued_distance_[edge])) return;
    if (queued_distance_[edge] == UNREACHABLE) queued_edges_.push_back(edge);
    queued_distance_[edge] = lowest;
    queue_.push(lowest, vertex_count() + edge);
}

}

std::unique_ptr<FieldSolver> ExactMetric::make_solver() const {
    return std::make_unique<WindowPropagation>(mesh_);
}

}
