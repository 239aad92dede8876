#include "src/metric/window_propagation.h"

#include <cmath>
#include <numbers>

#include "src/base/plane.h"
#include "src/metric/envelope.h"
#include "src/metric/event_queue.h"
#include "src/metric/target_bounds.h"
#include "src/metric/target_points.h"
#include "src/metric/window_lists.h"

namespace geodesic {

namespace {

// Shares of a length or an angle below which a difference is rounding.
constexpr double TIE = 1e-12;
constexpr double TOUCH = 1e-5;         // thin faces magnify rounding along their edges
constexpr double FAR_ROUNDING = 1e-14; // short edges by that of where far sources are
constexpr double ANGLE_SLACK = 1e-6;

// The same where windows are joined: distances are off by some tolerances, and the rays of windows beside
// each other, which have different sources, may diverge a little. TOUCH is a share of an edge: windows reach
// apexes that lie no farther beside their light.
constexpr double TIE_TOLERANCES = 10, TOUCH_OF_JOINED = 0.1;

// Windows are joined on edges that are longer than so many times the tolerance, as a share of the distance.
// On shorter ones, ways around the faces there would be within the tolerance of each other, so that none
// would be left out.
constexpr double JOINED_TOLERANCES = 100;

// Where more windows than this are carried into faces for each settled vertex, joining them has made ever
// more of them: on surfaces of all kinds there are 40 at most. FIRST_VERTICES, and as many as there are
// sources, count as settled from the start.
constexpr uint64_t MOST_WINDOWS = 256, FIRST_VERTICES = 64;

// Below which share of a distance a difference says nothing.
double tie_with(double tolerance) { return std::max(TIE, TIE_TOLERANCES * tolerance); }

// Windows on their way to an edge, in the order of that edge.
struct Run {
    Window *begin, *end;
    bool grows_at_end; // else they come in the opposite order
};

// The way through a face from its entry edge to one of the other two, seen from the end of the entry edge
// that the exit edge starts at: that end is the origin, the entry edge lies on the x axis, the apex at length
// * (along_x, -along_y).
struct Exit {
    double length, along_x, along_y;
    uint32_t near_vertex, apex;
    uint32_t edge, face;
    double tie;    // see tie_with()
    bool reversed; // the exit edge's own first vertex is the apex
    Run run;
};

// Where a window and the two rays that leave through an exit are, in the frame of that exit.
struct Beam {
    double x, y;      // the source
    double near, far; // where the rays cross the entry edge; near is closer to the origin
    bool far_is_apex; // the far ray passes through the apex
};

class WindowPropagation final : public WindowSolver {
public:
    // What becomes of windows that the front has passed, which no path of the solve needs any more.
    enum class PassedWindows { GIVEN_BACK, KEPT };

    WindowPropagation(std::shared_ptr<const IntrinsicMesh> mesh, double tolerance, PassedWindows passed)
        : WindowSolver(static_cast<uint32_t>(mesh->total_angle.size())), mesh_(std::move(mesh)),
          asked_tolerance_(tolerance), passed_(passed), lists_(edge_count()),
          queued_distance_(edge_count(), UNREACHABLE), arrival_(vertex_count()), pending_(vertex_count()) {}

    std::span<const Window> windows(uint32_t edge) const override { return lists_.at(edge); }

private:
    // From where the path to a vertex comes: along an edge, in a direction, or from a source that it is or
    // that lies in a face around it. Paths may leave such a vertex any way: next to it rounding hides what
    // the source itself sees.
    static constexpr uint32_t FROM_SOURCE = NONE - 1;
    struct Arrival {
        uint32_t edge = NONE;
        double angle = NO_ANGLE; // around the vertex, as in IntrinsicMesh
    };
    static constexpr double NO_ANGLE = std::numeric_limits<double>::quiet_NaN();
    struct EdgeWindow {
        uint32_t edge;
        Window window;
    };

    void run(const FieldRequest& request) override;
    bool run_with(double tolerance, const FieldRequest& request);
    bool windows_multiply(const FieldRequest& request) const;
    bool ends_at(const EventQueue::Event& event, const FieldRequest& request);
    void begin_bounds(const FieldRequest& request);
    void pass_vertex(const EventQueue::Event& event);
    void pass_edge(const EventQueue::Event& event);
    void start(const FieldRequest& request);
    double tolerance_on(uint32_t edge) const;
    bool edge_may_help(uint32_t edge, double distance);
    void prefetch(uint32_t item) const;
    void clear();
    void reach(uint32_t vertex, double distance, uint32_t nearest, Arrival arrival);
    void start_at(const SurfacePoint& point, uint32_t nearest, std::vector<EdgeWindow>& lit);
    std::span<Window> lower_envelope(std::vector<Window>& windows);
    void reach_point(uint32_t index, double distance);
    void settle(uint32_t vertex);
    void reach_points_around(uint32_t vertex);
    void reach_points_behind(const Window& window, const Side& side);
    double arrival_angle(uint32_t vertex) const;
    void spawn(uint32_t vertex);
    void spawn_into(uint32_t corner, uint32_t vertex);
    Window source_window(uint32_t edge, const PlanePoint& source, double sigma, uint32_t face,
                         uint32_t nearest) const;
    void propagate_edge(uint32_t edge);
    void cross(uint32_t edge, const Side& side);
    void propagate(const Window& window, double length, const Side& side, Exit (&exits)[2]);
    void reach_apex(const Window& window, const Side& side, double split, double crossing);
    void pass(const Window& window, const Beam& beam, Exit& exit);
    void deliver(uint32_t edge, std::span<Window> run);
    void sweep();

    uint32_t edge_count() const { return static_cast<uint32_t>(mesh_->edge_length.size()); }
    // Items of the queue: vertices by number, then edges, then target points.
    uint32_t edge_item(uint32_t edge) const { return vertex_count() + edge; }
    uint32_t point_item(uint32_t index) const { return vertex_count() + edge_count() + index; }

    std::shared_ptr<const IntrinsicMesh> mesh_;
    const double asked_tolerance_;
    const PassedWindows passed_;
    double tolerance_ = 0;
    uint64_t carried_on_ = 0; // windows, into faces, since the run began
    Envelope envelope_;
    WindowLists lists_;
    EventQueue queue_;                    // of vertices, edges and target points
    std::vector<double> queued_distance_; // of the edge's live event
    std::vector<uint32_t> queued_edges_;
    std::vector<Arrival> arrival_;
    PendingTargets pending_;
    TargetPoints targets_;
    TargetBounds bounds_;         // once `is_bounded_`
    std::vector<Window> runs_[2]; // room for the windows on their way to the two exits of a face
    double front_ = 0;            // distance of the latest event
    uint32_t settled_ = 0;        // vertices, in this run
    bool is_done_ = false;        // with the targets
    bool is_bounded_ = false;     // all that is asked for, besides targets, is final
};

void WindowPropagation::clear() {
    lists_.clear();
    queue_.clear();
    for (uint32_t edge : queued_edges_) queued_distance_[edge] = UNREACHABLE;
    queued_edges_.clear();
    carried_on_ = 0;
    front_ = 0;
    settled_ = 0;
    is_done_ = is_bounded_ = false;
}

// Where edges are tiny or triangles are needles, joined windows can multiply without end.
void WindowPropagation::run(const FieldRequest& request) {
    if (run_with(asked_tolerance_, request)) return;
    forget(request);
    run_with(0, request);
}

// Returns false, and gives up, where joining makes ever more windows.
bool WindowPropagation::run_with(double tolerance, const FieldRequest& request) {
    clear();
    tolerance_ = tolerance;
    start(request);
    const bool has_bounds = TargetBounds::are_known(*mesh_, request);
    set_final_up_to(UNREACHABLE);
    while (!queue_.empty()) {
        check_cancelled_sometimes();
        if (tolerance > 0 && windows_multiply(request)) return false;
        const EventQueue::Event event = queue_.pop();
        if (ends_at(event, request)) break;
        if (has_bounds && settled_ >= request.final_count && !is_bounded_) begin_bounds(request);
        front_ = event.distance;
        if (!queue_.empty()) prefetch(queue_.top().item);
        if (event.item < edge_item(0))
            pass_vertex(event);
        else if (event.item < point_item(0))
            pass_edge(event);
        else
            is_done_ |= pending_.settle_point(event.item - point_item(0));
    }
    return true;
}

bool WindowPropagation::windows_multiply(const FieldRequest& request) const {
    const uint64_t in_any_case = FIRST_VERTICES + request.sources.size() + request.source_points.size();
    return carried_on_ > MOST_WINDOWS * (settled_ + in_any_case);
}

// Whether the solve ends before this event: it is beyond the radius, or all that is asked for is final. If
// so, distances are final up to the event before, unless bounds have left something out since.
bool WindowPropagation::ends_at(const EventQueue::Event& event, const FieldRequest& request) {
    const bool is_all = is_done_ && settled_ >= request.final_count;
    if (event.distance <= request.radius && !is_all) return false;
    if (!is_bounded_) set_final_up_to(front_);
    return true;
}

// From now on, what leads to no target is left out.
void WindowPropagation::begin_bounds(const FieldRequest& request) {
    bounds_.begin(*mesh_, request, *this, front_);
    set_final_up_to(front_);
    is_bounded_ = true;
}

void WindowPropagation::pass_vertex(const EventQueue::Event& event) {
    const uint32_t vertex = event.item;
    if (event.distance != distance(vertex)) return;
    if (!is_bounded_ || bounds_.may_help(mesh_->positions[vertex], 0, event.distance)) settle(vertex);
    ++settled_;
    is_done_ |= pending_.settle(vertex);
}

void WindowPropagation::pass_edge(const EventQueue::Event& event) {
    const uint32_t edge = event.item - edge_item(0);
    if (event.distance == queued_distance_[edge] && (!is_bounded_ || edge_may_help(edge, event.distance)))
        propagate_edge(edge);
    if (passed_ == PassedWindows::GIVEN_BACK && lists_.crowded()) sweep();
}

// The tolerance with which windows are put down on an edge that the front has come to.
double WindowPropagation::tolerance_on(uint32_t edge) const {
    return mesh_->edge_length[edge] > JOINED_TOLERANCES * tolerance_ * front_ ? tolerance_ : 0;
}

// No more windows come to an edge that does not help: all of them are longer.
bool WindowPropagation::edge_may_help(uint32_t edge, double distance) {
    const auto [first, second] = mesh_->edge_vertices[edge];
    const Eigen::Vector3d middle = 0.5 * (mesh_->positions[first] + mesh_->positions[second]);
    return bounds_.may_help(middle, 0.5 * mesh_->edge_length[edge], distance);
}

// Asks for the memory of an event while the one before it is worked on: a tenth of the time is waiting for
// it.
void WindowPropagation::prefetch(uint32_t item) const {
    if (item < vertex_count()) {
        __builtin_prefetch(mesh_->spokes[item].data());
    } else if (item < point_item(0)) {
        const uint32_t edge = item - edge_item(0);
        lists_.prefetch_windows(edge);
        __builtin_prefetch(mesh_->sides[edge].data());
        __builtin_prefetch(&mesh_->edge_length[edge]);
    }
}

void WindowPropagation::start(const FieldRequest& request) {
    pending_.begin(request);
    targets_.place(*mesh_, request.target_points);
    for (uint32_t i = 0; i < request.sources.size(); ++i)
        reach(request.sources[i], 0, i, {FROM_SOURCE, NO_ANGLE});
    auto nearest = static_cast<uint32_t>(request.sources.size());
    std::vector<EdgeWindow> lit;
    for (const SurfacePoint& point : request.source_points) start_at(point, nearest++, lit);
    std::ranges::stable_sort(lit, {}, &EdgeWindow::edge);
    std::vector<Window> windows;
    for (size_t i = 0; i < lit.size(); ++i) {
        windows.push_back(lit[i].window);
        if (i + 1 < lit.size() && lit[i + 1].edge == lit[i].edge) continue;
        deliver(lit[i].edge, lower_envelope(windows));
        windows.clear();
    }
}

// Halves first: put in one by one, each of many sources in a face would be compared with all before it.
std::span<Window> WindowPropagation::lower_envelope(std::vector<Window>& windows) {
    if (windows.size() < 2) return windows;
    const auto middle = windows.begin() + static_cast<std::ptrdiff_t>(windows.size() / 2);
    std::vector<Window> first(windows.begin(), middle), second(middle, windows.end());
    const auto merged = envelope_.merge(lower_envelope(first), lower_envelope(second));
    windows.assign(merged.begin(), merged.end());
    return windows;
}

// A source inside a face lights its three edges and is seen by its corners and by the targets there.
void WindowPropagation::start_at(const SurfacePoint& point, uint32_t nearest, std::vector<EdgeWindow>& lit) {
    for (uint32_t corner = 3 * point.face; corner < 3 * point.face + 3; ++corner) {
        const Side& side = mesh_->sides.items[mesh_->side_of_corner[corner]];
        const uint32_t edge = mesh_->edge_of_corner[corner];
        const PlanePoint p = place_on_side(*mesh_, corner, point);
        reach(side.apex, hypotenuse(p.x - side.apex_x, p.depth - side.apex_depth), nearest,
              {FROM_SOURCE, NO_ANGLE});
        lit.push_back({edge, source_window(edge, p, 0, side.face, nearest)});
    }
    for (const TargetPoint& target : targets_.of_face(point.face)) {
        const PlanePoint from = place_on_side(*mesh_, 3 * point.face, point);
        const PlanePoint& to = target.on_side[0];
        reach_point(target.index, hypotenuse(from.x - to.x, from.depth - to.depth));
    }
}

// What a source in a face, or at its corner, lights of an edge of the face: all of it.
Window WindowPropagation::source_window(uint32_t edge, const PlanePoint& source, double sigma, uint32_t face,
                                        uint32_t nearest) const {
    const double length = mesh_->edge_length[edge];
    Window window{0, length, source.x, source.depth, sigma, 0, 0, face, nearest & MAX_NEAREST, 1};
    window.begin_distance = window.distance_at(0);
    window.end_distance = window.distance_at(length);
    return window;
}

void WindowPropagation::reach_point(uint32_t index, double distance) {
    if (improve_point(index, distance)) queue_.push(distance, point_item(index));
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
    if (arrival_[vertex].edge == FROM_SOURCE || mesh_->can_bend[vertex]) spawn(vertex);
    if (!targets_.empty()) reach_points_around(vertex);
}

void WindowPropagation::reach_points_around(uint32_t vertex) {
    for (uint32_t corner : mesh_->corners[vertex]) {
        const Side& side = mesh_->sides.items[mesh_->side_of_corner[corner]];
        for (const TargetPoint& target : targets_.of_face(side.face)) {
            const PlanePoint& p = target.on_side[corner % 3];
            reach_point(target.index,
                        distance(vertex) + hypotenuse(p.x - side.apex_x, p.depth - side.apex_depth));
        }
    }
}

void WindowPropagation::reach_points_behind(const Window& window, const Side& side) {
    const uint32_t corner = mesh_->corner_of_side[static_cast<size_t>(&side - mesh_->sides.items.data())];
    for (const TargetPoint& target : targets_.of_face(side.face)) {
        const PlanePoint& p = target.on_side[corner % 3];
        const double crossing = window.crossing_to(p.x, p.depth);
        reach_point(target.index, window.distance_at(crossing) + hypotenuse(crossing - p.x, p.depth));
    }
}

double WindowPropagation::arrival_angle(uint32_t vertex) const {
    const Arrival& arrival = arrival_[vertex];
    if (arrival.edge >= FROM_SOURCE) return arrival.angle;
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
    Window window =
        source_window(edge, {side.apex_x, side.apex_depth}, distance(vertex), side.face, nearest(vertex));
    deliver(edge, {&window, 1});
}

void WindowPropagation::propagate_edge(uint32_t edge) {
    queued_distance_[edge] = UNREACHABLE;
    for (const Side& side : mesh_->sides[edge]) cross(edge, side);
    for (Window& window : lists_.at(edge)) window.pending = 0;
}

// No point of an edge is farther than half of its length and the distances of its vertices together. Windows
// that are not propagated yet are at the front, but for rounding and the tolerance.
void WindowPropagation::sweep() {
    lists_.sweep([this](uint32_t edge) {
        const auto [first, second] = mesh_->edge_vertices[edge];
        const double farthest = 0.5 * (distance(first) + distance(second) + mesh_->edge_length[edge]);
        return farthest * (1 + tie_with(tolerance_)) < front_;
    });
}

// Carries the pending windows of an edge into a face, to both other edges.
void WindowPropagation::cross(uint32_t edge, const Side& side) {
    const double length = mesh_->edge_length[edge];
    const auto [first, second] = mesh_->edge_vertices[edge];
    const std::span<const Window> windows = lists_.at(edge);
    const auto exit_at = [&](size_t k, double apex_x, uint32_t near) {
        const uint32_t exit_edge = side.tagged_edge[k] >> 1;
        const bool reversed = (side.tagged_edge[k] & 1) != 0, grows_at_end = reversed == (k == 1);
        if (runs_[k].size() < windows.size()) runs_[k].resize(windows.size());
        Window* const begin = runs_[k].data() + (grows_at_end ? 0 : windows.size());
        const double exit_length = mesh_->edge_length[exit_edge];
        lists_.prefetch(exit_edge);
        return Exit{exit_length,
                    apex_x / exit_length,
                    side.apex_depth / exit_length,
                    near,
                    side.apex,
                    exit_edge,
                    side.face,
                    tie_with(tolerance_on(exit_edge)),
                    reversed,
                    {begin, begin, grows_at_end}};
    };
    Exit exits[2] = {exit_at(0, side.apex_x, first), exit_at(1, side.apex_back, second)};
    for (const Window& window : windows)
        if (window.pending && window.from_face != side.face) {
            ++carried_on_;
            propagate(window, length, side, exits);
            if (!targets_.empty()) reach_points_behind(window, side);
        }
    for (const Exit& exit : exits) deliver(exit.edge, {exit.run.begin, exit.run.end});
}

// The line to the apex crosses the edge at `split`. Where rounding has put that just outside of the window,
// the path bends at the window's end, `crossing`: longer by the square of the miss, but never too short.
void WindowPropagation::reach_apex(const Window& window, const Side& side, double split, double crossing) {
    const bool straight = split == crossing;
    const double height = straight ? window.y + side.apex_depth : side.apex_depth;
    const double across = (straight ? window.x : crossing) - side.apex_x;
    const double d = (straight ? window.sigma : window.distance_at(crossing)) + hypotenuse(across, height);
    if (!(d < distance(side.apex))) return;
    Arrival arrival;
    if (straight && mesh_->can_bend[side.apex]) {
        // The angle between the way back and the edge to the entry edge's first vertex.
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
void WindowPropagation::propagate(const Window& window, double length, const Side& side, Exit (&exits)[2]) {
    // A source in line with the edge: its vertices carry that on, unless it lies on the edge.
    const bool on_edge = window.x > window.begin && window.x < window.end;
    if (!(window.y > 0) && !on_edge) return;
    const double split = window.split_to(side.apex_x, side.apex_depth);
    const double crossing = std::clamp(split, window.begin, window.end);
    const double touch = tolerance_ > 0 ? TOUCH_OF_JOINED : TOUCH;
    const double rounding = touch * length + FAR_ROUNDING * (std::abs(window.x) + window.y);
    if (std::abs(split - crossing) <= rounding) reach_apex(window, side, split, crossing);
    if (window.begin < split)
        pass(window, {window.x, window.y, window.begin, std::min(window.end, split), split <= window.end},
             exits[0]);
    if (window.end > split)
        pass(window,
             {length - window.x, window.y, length - window.end, length - std::max(window.begin, split),
              split >= window.begin},
             exits[1]);
}

// Appends the part of a window that leaves through an exit to the run of that exit.
void WindowPropagation::pass(const Window& window, const Beam& beam, Exit& exit) {
    // Where on the exit edge the ray through (t, 0) leaves.
    const auto leave = [&](double t) {
        const double denominator = beam.y * exit.along_x + exit.along_y * (beam.x - t);
        if (denominator > 0) return std::clamp(beam.y * t / denominator, 0.0, exit.length);
        // All in one line, or a ray that misses the exit edge.
        return beam.y == 0 && exit.along_y == 0 && exit.along_x > 0 ? std::clamp(t, 0.0, exit.length)
                                                                    : exit.length;
    };
    const double near = beam.near <= 0 ? 0 : leave(beam.near);
    const double far = beam.far_is_apex ? exit.length : leave(beam.far);
    if (!(far - near > TIE * exit.length)) return;
    const double x = beam.x * exit.along_x - beam.y * exit.along_y;
    const double y = std::max(0.0, exit.along_x * beam.y + exit.along_y * beam.x);
    const double near_distance = window.sigma + hypotenuse(near - x, y);
    const double far_distance = window.sigma + hypotenuse(far - x, y);

    // Of no use where a path through a vertex of the face is shorter all along.
    if (distance(exit.near_vertex) + far < far_distance * (1 - exit.tie)) return;
    if (distance(exit.apex) + (exit.length - near) < near_distance * (1 - exit.tie)) return;

    Window& passed = exit.run.grows_at_end ? *exit.run.end++ : *--exit.run.begin;
    if (exit.reversed)
        passed = {exit.length - far, exit.length - near, exit.length - x, y, window.sigma, far_distance,
                  near_distance,     exit.face,          window.nearest,  1};
    else
        passed = {near, far, x, y, window.sigma, near_distance, far_distance, exit.face, window.nearest, 1};
}

// Puts windows into the list of an edge.
void WindowPropagation::deliver(uint32_t edge, std::span<Window> run) {
    if (run.empty() || lists_.closed(edge)) return;
    const std::span<const Window> merged = envelope_.merge(lists_.at(edge), run, tolerance_on(edge));
    if (envelope_.lowest() == UNREACHABLE) return;
    lists_.assign(edge, merged);
    if (!(envelope_.lowest() < queued_distance_[edge])) return;
    if (queued_distance_[edge] == UNREACHABLE) queued_edges_.push_back(edge);
    queued_distance_[edge] = envelope_.lowest();
    queue_.push(envelope_.lowest(), edge_item(edge));
}

}

std::unique_ptr<FieldSolver> ExactMetric::make_solver() const {
    return std::make_unique<WindowPropagation>(mesh_, tolerance_,
                                               WindowPropagation::PassedWindows::GIVEN_BACK);
}

std::unique_ptr<WindowSolver> ExactMetric::make_window_solver() const {
    return std::make_unique<WindowPropagation>(mesh_, tolerance_, WindowPropagation::PassedWindows::KEPT);
}

}
