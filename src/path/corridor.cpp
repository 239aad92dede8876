#include "src/path/corridor.h"

#include <algorithm>
#include <unordered_map>

#include "src/metric/window_propagation.h"
#include "src/path/nearby.h"
#include "src/path/search.h"
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

    StripPath find(Strip& strip);

private:
    static constexpr uint32_t MOST_POINTS = 31;

    SurfacePoint local(const SurfacePoint& point) const;
    void solve(uint32_t points_per_edge);
    Strip search();
    std::span<const double> inside(uint32_t a, uint32_t b) const;

    const Surface& whole_;
    const Corridor& corridor_;
    const Surface part_;
    std::unique_ptr<FieldSolver> solver_;
    const SurfacePoint source_, target_;
    uint32_t points_per_edge_ = 0;
    std::vector<double> on_edges_; // points_per_edge_ of each edge, from its first vertex on
};

SurfacePoint CorridorPath::local(const SurfacePoint& point) const {
    const auto found = std::ranges::find(corridor_.face_of_surface, point.face);
    return {static_cast<uint32_t>(found - corridor_.face_of_surface.begin()), point.weights};
}

// Distances from the path's target: to its source, to the vertices that are nearer than that, and with points
// to all that the corridor has.
void CorridorPath::solve(uint32_t points_per_edge) {
    const Mesh& mesh = corridor_.mesh;
    std::vector<SurfacePoint> points{source_};
    for (uint32_t e = 0; e < mesh.edge_count(); ++e)
        for (uint32_t i = 1; i <= points_per_edge; ++i) {
            const uint32_t face = mesh.edge_faces[e][0];
            SurfacePoint& point = points.emplace_back(SurfacePoint{face, {}});
            const double share = double(i) / (points_per_edge + 1);
            point.weights[corner_of(part_, face, mesh.edges[e][0])] = 1 - share;
            point.weights[corner_of(part_, face, mesh.edges[e][1])] = share;
        }
    solver_->solve({{}, {}, {&target_, 1}, points});
    points_per_edge_ = points_per_edge;
    on_edges_.clear();
    for (size_t i = 1; i < points.size(); ++i) on_edges_.push_back(solver_->point_distance(i));
}

std::span<const double> CorridorPath::inside(uint32_t a, uint32_t b) const {
    return std::span(on_edges_).subspan(size_t{find_edge(corridor_.mesh, a, b)} * points_per_edge_,
                                        points_per_edge_);
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

// The distances of its vertices place the target as seen over an edge, unless paths of different ways meet
// inside of it: then the search may take another way than the shortest. The sum of the pieces tells, and more
// points on the edges help.
StripPath CorridorPath::find(Strip& strip) {
    constexpr double ROUNDING = 1e-10;
    StripPath best;
    best.length = UNREACHABLE;
    for (uint32_t points = 0; points <= MOST_POINTS; points = points == 0 ? 3 : 3 * points + 1) {
        solve(points);
        Strip found = search();
        StripPath path = straighten(whole_, found);
        if (path.length < best.length) {
            best = std::move(path);
            strip = std::move(found);
        }
        if (best.length <= solver_->point_distance(0) * (1 + ROUNDING)) break;
    }
    return best;
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

StripPath shortest_in_corridor(const Surface& surface, const Corridor& corridor, Strip& strip) {
    return CorridorPath(surface, corridor, strip).find(strip);
}

}
