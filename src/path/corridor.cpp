#include "src/path/corridor.h"

#include <algorithm>
#include <numeric>
#include <unordered_map>
#include <unordered_set>

#include "src/metric/window_propagation.h"
#include "src/path/nearby.h"
#include "src/path/search.h"
#include "src/path/sides.h"
#include "src/path/straighten.h"

namespace geodesic {

namespace {

double longest_edge_at(const Surface& surface, uint32_t vertex) {
    double longest = 0;
    for (const uint32_t face : surface.vertex_faces[vertex])
        for (const uint32_t other : surface.faces[face])
            longest = std::max(longest, (surface.positions[other] - surface.positions[vertex]).norm());
    return longest;
}

// Vertices of a surface with numbers of their own.
class Renumbering {
public:
    uint32_t number(uint32_t vertex) {
        const auto [found, is_new] = numbers_.try_emplace(vertex, static_cast<uint32_t>(vertices_.size()));
        if (is_new) vertices_.push_back(vertex);
        return found->second;
    }
    const std::vector<uint32_t>& vertices() const { return vertices_; }

private:
    std::unordered_map<uint32_t, uint32_t> numbers_;
    std::vector<uint32_t> vertices_;
};

Intake intake_of(const Mesh& mesh) {
    Intake intake;
    intake.mesh = mesh;
    return intake;
}

// The corridor as a surface and as a metric, and the ends of the path in it.
class CorridorPath {
public:
    CorridorPath(const Surface& surface, const Corridor& corridor, const Strip& strip)
        : whole_(surface), corridor_(corridor), part_(intake_of(corridor.mesh)),
          solver_(ExactMetric(corridor.mesh).make_solver()), source_(local(strip.source)),
          target_(local(strip.target)) {}

    void make_shortest(Strip& strip, StripPath& path);

private:
    SurfacePoint local(const SurfacePoint& point) const;
    std::vector<uint32_t> edges_near(const Strip& strip) const;
    void solve(const std::vector<uint32_t>& edges, uint32_t points_per_edge);
    Strip search();
    bool is_shortest(const StripPath& path) const;
    void search_again(Strip& strip, StripPath& path);
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

SurfacePoint CorridorPath::local(const SurfacePoint& point) const {
    const auto found = std::ranges::find(corridor_.face_of_surface, point.face);
    return {static_cast<uint32_t>(found - corridor_.face_of_surface.begin()), point.weights};
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
    std::ranges::sort(edges);
    edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
    return edges;
}

// Distances from the path's target: to its source, to the vertices that are nearer than that, and to points
// of edges.
void CorridorPath::solve(const std::vector<uint32_t>& edges, uint32_t points_per_edge) {
    const Mesh& mesh = corridor_.mesh;
    std::vector<SurfacePoint> points{source_};
    first_point_.clear();
    for (const uint32_t e : edges) {
        first_point_[e] = points.size() - 1;
        for (uint32_t i = 1; i <= points_per_edge; ++i) {
            const uint32_t face = mesh.edge_faces[e][0];
            SurfacePoint& point = points.emplace_back(SurfacePoint{face, {}});
            const double share = double(i) / (points_per_edge + 1);
            point.weights[corner_of(part_, face, mesh.edges[e][0])] = 1 - share;
            point.weights[corner_of(part_, face, mesh.edges[e][1])] = share;
        }
    }
    solver_->solve({{}, {}, {&target_, 1}, points});
    points_per_edge_ = points_per_edge;
    on_edges_.clear();
    for (size_t i = 1; i < points.size(); ++i) on_edges_.push_back(solver_->point_distance(i));
}

std::span<const double> CorridorPath::inside(uint32_t a, uint32_t b) const {
    const auto found = first_point_.find(find_edge(corridor_.mesh, a, b));
    if (found == first_point_.end()) return {};
    return std::span(on_edges_).subspan(found->second, points_per_edge_);
}

// The strip's faces and vertices become those of the whole surface.
Strip CorridorPath::search() {
    TargetDistances distances{[this](uint32_t v) { return solver_->distance(v); }, {}};
    if (points_per_edge_ > 0) distances.inside_edge = [this](uint32_t a, uint32_t b) { return inside(a, b); };
    Strip strip = search_strip(part_, source_, target_, distances).value();
    const auto whole_vertex = [&](uint32_t face, uint32_t vertex) {
        return whole_.faces[corridor_.face_of_surface[face]][corner_of(part_, face, vertex)];
    };
    for (size_t i = 0; i < strip.portals.size(); ++i)
        for (uint32_t* end : {&strip.portals[i].a, &strip.portals[i].b})
            *end = whole_vertex(strip.faces[i], *end);
    for (uint32_t& face : strip.faces) face = corridor_.face_of_surface[face];
    strip.source.face = strip.faces.front();
    strip.target.face = strip.faces.back();
    return strip;
}

bool CorridorPath::is_shortest(const StripPath& path) const {
    constexpr double SAME = 1e-9;
    return path.length <= solver_->point_distance(0) * (1 + SAME);
}

// Takes the way that the distances show if it is shorter.
void CorridorPath::search_again(Strip& strip, StripPath& path) {
    Strip found = search();
    StripPath shorter = straighten(whole_, found);
    try_other_sides(whole_, found, shorter);
    if (!(shorter.length < path.length)) return;
    strip = std::move(found);
    path = std::move(shorter);
}

// The distances of its vertices place the target as seen over an edge, unless paths of different ways meet
// inside of it: then the search may take another way than the shortest. The distance of the source tells, and
// points on the edges help: on those near the best way so far, or else on all.
void CorridorPath::make_shortest(Strip& strip, StripPath& path) {
    solve({}, 0);
    if (is_shortest(path)) return;
    search_again(strip, path);
    for (const uint32_t points : {7u, 31u}) {
        if (is_shortest(path)) return;
        solve(edges_near(strip), points);
        search_again(strip, path);
    }
    if (is_shortest(path)) return;
    std::vector<uint32_t> all(corridor_.mesh.edge_count());
    std::iota(all.begin(), all.end(), 0);
    solve(all, 7);
    search_again(strip, path);
}

}

Corridor corridor_around(const Surface& surface, const Strip& strip,
                         const std::function<bool(uint32_t, double)>& belongs) {
    std::unordered_map<uint32_t, bool> known; // vertices, and whether they belong
    std::vector<uint32_t> waiting;
    const auto meet = [&](uint32_t vertex, bool for_sure) {
        const auto [found, is_new] = known.try_emplace(vertex, true);
        if (!is_new) return;
        found->second = for_sure || belongs(vertex, longest_edge_at(surface, vertex));
        if (found->second) waiting.push_back(vertex);
    };
    for (const uint32_t face : strip.faces)
        for (const uint32_t vertex : surface.faces[face]) meet(vertex, true);
    std::vector<uint32_t> faces;
    while (!waiting.empty()) {
        const uint32_t vertex = waiting.back();
        waiting.pop_back();
        for (const uint32_t face : surface.vertex_faces[vertex]) {
            faces.push_back(face);
            for (const uint32_t other : surface.faces[face]) meet(other, false);
        }
    }
    std::ranges::sort(faces);
    faces.erase(std::unique(faces.begin(), faces.end()), faces.end());
    Corridor corridor{{}, std::move(faces)};
    Renumbering renumbering;
    for (const uint32_t face : corridor.face_of_surface) {
        auto& local = corridor.mesh.faces.emplace_back();
        for (size_t k = 0; k < 3; ++k) local[k] = renumbering.number(surface.faces[face][k]);
    }
    for (const uint32_t vertex : renumbering.vertices())
        corridor.mesh.positions.push_back(surface.positions[vertex]);
    connect(corridor.mesh);
    return corridor;
}

void make_shortest_in_corridor(const Surface& surface, const Corridor& corridor, Strip& strip,
                               StripPath& path) {
    CorridorPath(surface, corridor, strip).make_shortest(strip, path);
}

}
