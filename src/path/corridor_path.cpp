#include "src/path/corridor_path.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <unordered_map>
#include <unordered_set>

#include "src/metric/window_propagation.h"
#include "src/path/least_excess.h"
#include "src/path/sides.h"
#include "src/path/straighten.h"
#include "src/path/strip_search.h"

namespace geodesic {

namespace {

Intake intake_of(const Mesh& mesh) {
    Intake intake;
    intake.mesh = mesh;
    return intake;
}

// A point of the surface as one of the corridor.
SurfacePoint local(const Corridor& corridor, const SurfacePoint& point) {
    const auto found = std::ranges::find(corridor.face_of_surface, point.face);
    return {static_cast<uint32_t>(found - corridor.face_of_surface.begin()), point.weights};
}

// The corridor as a surface and as a metric, and the ends of the path in it.
class CorridorPath {
public:
    CorridorPath(const Surface& surface, const Corridor& corridor, const Strip& strip)
        : whole_(surface), corridor_(corridor), part_(intake_of(corridor.mesh)),
          solver_(ExactMetric(corridor.mesh).make_solver()), source_(local(corridor, strip.source)),
          target_(local(corridor, strip.target)) {}

    void make_shortest(Effort effort, Strip& strip, StripPath& path);

private:
    std::vector<uint32_t> edges_near(const Strip& strip) const;
    std::vector<uint32_t> edges_of_shortest(const std::vector<double>& over_vertex, double shortest) const;
    template <class Share>
    void solve(const SurfacePoint& from, const SurfacePoint& to, const std::vector<uint32_t>& edges,
               uint32_t points_per_edge, const Share& share);
    void solve_from_target(const std::vector<uint32_t>& edges, uint32_t points_per_edge);
    std::vector<double> ways_over_vertices();
    std::vector<double> ways_over_edges(const std::vector<uint32_t>& edges);
    void take_to_surface(Strip& strip) const;
    std::optional<Strip> search();
    std::optional<Strip> search_by_excess(const std::vector<uint32_t>& edges,
                                          const std::vector<double>& over_vertex);
    bool is_shortest(const StripPath& path) const;
    void try_strip(Strip&& found, Strip& strip, StripPath& path) const;
    std::span<const double> inside(uint32_t a, uint32_t b) const;

    const Surface& whole_;
    const Corridor& corridor_;
    const Surface part_;
    std::unique_ptr<FieldSolver> solver_;
    const SurfacePoint source_, target_;
    uint32_t points_per_edge_ = 0;
    std::vector<double> on_edges_; // points_per_edge_ of an edge, from its first vertex on
    std::unordered_map<uint32_t, size_t> first_point_; // there, of the edges that have any
};

void make_unique(std::vector<uint32_t>& numbers) {
    std::ranges::sort(numbers);
    numbers.erase(std::unique(numbers.begin(), numbers.end()), numbers.end());
}

// Those of the faces around the vertices of a strip.
std::vector<uint32_t> CorridorPath::edges_near(const Strip& strip) const {
    std::unordered_set<uint32_t> vertices;
    for (const uint32_t face : strip.faces)
        vertices.insert(whole_.faces[face].begin(), whole_.faces[face].end());
    const Mesh& mesh = corridor_.mesh;
    std::vector<uint32_t> edges;
    for (uint32_t f = 0; f < mesh.faces.size(); ++f) {
        const auto& whole = whole_.faces[corridor_.face_of_surface[f]];
        if (std::ranges::none_of(whole, [&](uint32_t v) { return vertices.contains(v); })) continue;
        for (size_t k = 0; k < 3; ++k)
            edges.push_back(find_edge(mesh, mesh.faces[f][k], mesh.faces[f][(k + 1) % 3]));
    }
    make_unique(edges);
    return edges;
}

// How long the shortest way from end to end over each vertex is.
std::vector<double> CorridorPath::ways_over_vertices() {
    std::vector<uint32_t> all(part_.vertex_count());
    std::iota(all.begin(), all.end(), 0);
    std::vector<double> length(all.size(), 0);
    for (const SurfacePoint* end : {&source_, &target_}) {
        solver_->solve({{}, all, {end, 1}, {}});
        for (const uint32_t v : all) length[v] += solver_->distance(v);
    }
    return length;
}

// Those of the faces that a path of this length can cross. Any point of a face is at most 1 / sqrt(3) of its
// longest edge from a corner, which is so much farther from each end of the path than the point, at most.
std::vector<uint32_t> CorridorPath::edges_of_shortest(const std::vector<double>& over_vertex,
                                                      double shortest) const {
    constexpr double CORNER = 0.5774; // 1 / sqrt(3), rounded up
    const Mesh& mesh = corridor_.mesh;
    std::vector<uint32_t> edges;
    for (const auto& corners : mesh.faces) {
        double least = UNREACHABLE, longest_edge = 0;
        for (size_t k = 0; k < 3; ++k) {
            least = std::min(least, over_vertex[corners[k]]);
            const auto &a = mesh.positions[corners[k]], &b = mesh.positions[corners[(k + 1) % 3]];
            longest_edge = std::max(longest_edge, (a - b).norm());
        }
        if (least > shortest + 2 * CORNER * longest_edge) continue;
        for (size_t k = 0; k < 3; ++k) edges.push_back(find_edge(mesh, corners[k], corners[(k + 1) % 3]));
    }
    make_unique(edges);
    return edges;
}

// Distances from one end of the path: to the other one, to vertices (an upper bound where these are farther),
// and to points of edges. share(i, k) tells how far along edges[i] its k-th point is. The searches below go
// by the latest distances from the target.
template <class Share>
void CorridorPath::solve(const SurfacePoint& from, const SurfacePoint& to, const std::vector<uint32_t>& edges,
                         uint32_t points_per_edge, const Share& share) {
    const Mesh& mesh = corridor_.mesh;
    std::vector<SurfacePoint> points{to};
    first_point_.clear();
    for (size_t i = 0; i < edges.size(); ++i) {
        const uint32_t e = edges[i], face = mesh.edge_faces[e][0];
        first_point_[e] = points.size() - 1;
        for (uint32_t k = 0; k < points_per_edge; ++k) {
            SurfacePoint& point = points.emplace_back(SurfacePoint{face, {}});
            point.weights[corner_of(part_, face, mesh.edges[e][0])] = 1 - share(i, k);
            point.weights[corner_of(part_, face, mesh.edges[e][1])] = share(i, k);
        }
    }
    solver_->solve({{}, {}, {&from, 1}, points});
    points_per_edge_ = points_per_edge;
    on_edges_.clear();
    for (size_t i = 1; i < points.size(); ++i) on_edges_.push_back(solver_->point_distance(i));
}

// From the target, with evenly spaced points.
void CorridorPath::solve_from_target(const std::vector<uint32_t>& edges, uint32_t points_per_edge) {
    solve(target_, source_, edges, points_per_edge,
          [&](size_t, uint32_t k) { return double(k + 1) / (points_per_edge + 1); });
}

std::span<const double> CorridorPath::inside(uint32_t a, uint32_t b) const {
    const auto found = first_point_.find(find_edge(corridor_.mesh, a, b));
    if (found == first_point_.end()) return {};
    return std::span(on_edges_).subspan(found->second, points_per_edge_);
}

// The faces and vertices of a strip become those of the whole surface.
void CorridorPath::take_to_surface(Strip& strip) const {
    const auto whole_vertex = [&](uint32_t face, uint32_t vertex) {
        return whole_.faces[corridor_.face_of_surface[face]][corner_of(part_, face, vertex)];
    };
    for (size_t i = 0; i < strip.portals.size(); ++i)
        for (uint32_t* end : {&strip.portals[i].a, &strip.portals[i].b})
            *end = whole_vertex(strip.faces[i], *end);
    for (uint32_t& face : strip.faces) face = corridor_.face_of_surface[face];
    strip.source.face = strip.faces.front();
    strip.target.face = strip.faces.back();
}

// Nothing if the search does not reach the target.
std::optional<Strip> CorridorPath::search() {
    TargetDistances distances{[this](uint32_t v) { return solver_->distance(v); }, {}};
    if (points_per_edge_ > 0) distances.inside_edge = [this](uint32_t a, uint32_t b) { return inside(a, b); };
    return search_strip(part_, source_, target_, distances);
}

bool CorridorPath::is_shortest(const StripPath& path) const {
    constexpr double SAME = 1e-9;
    return path.length <= solver_->point_distance(0) * (1 + SAME);
}

// Takes a strip of the corridor if its path is shorter.
void CorridorPath::try_strip(Strip&& found, Strip& strip, StripPath& path) const {
    take_to_surface(found);
    StripWay way = straighten(whole_, std::move(found));
    try_other_sides(whole_, {&way, 1});
    if (!(way.path.length < path.length)) return;
    strip = std::move(way.strip);
    path = std::move(way.path);
}

// How long the shortest ways over edges are: over their best points, which are looked for among some first
// and then between the neighbours of the best of these.
std::vector<double> CorridorPath::ways_over_edges(const std::vector<uint32_t>& edges) {
    constexpr uint32_t POINTS = 31, ROUNDS = 3;
    struct Piece {
        double low = 0, high = 1, least = UNREACHABLE;
        // Closer to each other at both ends.
        double share(int k) const {
            return low + (high - low) * 0.5 * (1 - std::cos((k + 1) * std::numbers::pi / (POINTS + 1)));
        }
    };
    std::vector<Piece> pieces(edges.size());
    const auto share = [&](size_t i, uint32_t k) { return pieces[i].share(static_cast<int>(k)); };
    for (uint32_t round = 0; round < ROUNDS; ++round) {
        solve(source_, target_, edges, POINTS, share);
        const std::vector<double> from_source = on_edges_;
        solve(target_, source_, edges, POINTS, share);
        for (size_t i = 0; i < edges.size(); ++i) {
            Piece best = pieces[i];
            for (int k = 0; k < int{POINTS}; ++k) {
                const size_t at = i * POINTS + static_cast<size_t>(k);
                if (const double way = from_source[at] + on_edges_[at]; way < best.least)
                    best = {pieces[i].share(k - 1), pieces[i].share(k + 1), way};
            }
            pieces[i] = best;
        }
    }
    std::vector<double> ways(edges.size());
    std::ranges::transform(pieces, ways.begin(), &Piece::least);
    return ways;
}

// A shortest path crosses edges without excess only, so that it is the strip with the least sum of them.
std::optional<Strip> CorridorPath::search_by_excess(const std::vector<uint32_t>& edges,
                                                    const std::vector<double>& over_vertex) {
    const std::vector<double> over_edge = ways_over_edges(edges);
    const double shortest = solver_->point_distance(0);
    return strip_of_least_excess(part_, source_, target_, [&](uint32_t a, uint32_t b) {
        const auto found = std::ranges::lower_bound(edges, find_edge(corridor_.mesh, a, b));
        if (found == edges.end() || *found != find_edge(corridor_.mesh, a, b)) return UNREACHABLE;
        const double way =
            std::min({over_edge[static_cast<size_t>(found - edges.begin())], over_vertex[a], over_vertex[b]});
        constexpr double ROUNDING = 1e-12; // keeps strips short where several have no excess
        return std::max(way - shortest, ROUNDING * shortest);
    });
}

// The search places the target beyond an edge by the distances of the edge's ends. That fails where shortest
// paths of different ways meet inside of the edge. Then the path is longer than the distance of the source,
// and is searched again with distances of points inside of edges: of those around the strip, then of all that
// a shortest path can cross. At last it is searched by the shortest ways over these edges from both ends. The
// path stays as it is where no search finds a shorter one. The last one takes up to some seconds.
void CorridorPath::make_shortest(Effort effort, Strip& strip, StripPath& path) {
    constexpr uint32_t FEW_POINTS = 7, MANY_POINTS = 31;
    // Returns whether the path is the shortest.
    const auto search_with = [&](const std::vector<uint32_t>& edges, uint32_t points_per_edge) {
        solve_from_target(edges, points_per_edge);
        if (is_shortest(path)) return true;
        if (auto found = search()) try_strip(std::move(*found), strip, path);
        return is_shortest(path);
    };
    if (search_with({}, 0)) return;
    for (const uint32_t points : {FEW_POINTS, MANY_POINTS})
        if (search_with(edges_near(strip), points)) return;
    const double shortest = solver_->point_distance(0);
    const std::vector<double> over_vertex = ways_over_vertices();
    const std::vector<uint32_t> edges = edges_of_shortest(over_vertex, shortest);
    for (const uint32_t points : {FEW_POINTS, MANY_POINTS})
        if (search_with(edges, points)) return;
    if (effort == Effort::NEARLY_ALWAYS) return;
    if (auto found = search_by_excess(edges, over_vertex)) try_strip(std::move(*found), strip, path);
}

}

void make_shortest_in_corridor(const Surface& surface, const Corridor& corridor, Effort effort, Strip& strip,
                               StripPath& path) {
    CorridorPath(surface, corridor, strip).make_shortest(effort, strip, path);
}

double shortest_length_in_corridor(const Corridor& corridor, const Strip& strip) {
    const auto solver = ExactMetric(corridor.mesh).make_solver();
    const SurfacePoint source = local(corridor, strip.source), target = local(corridor, strip.target);
    solver->solve({{}, {}, {&source, 1}, {&target, 1}});
    return solver->point_distance(0);
}

}
