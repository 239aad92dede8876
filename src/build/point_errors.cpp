#include "src/build/point_errors.h"

#include <algorithm>
#include <memory_resource>
#include <optional>
#include <utility>

#include <Eigen/Geometry>

#include "src/base/array.h"
#include "src/build/errors_by_distance.h"
#include "src/build/relative_errors.h"
#include "src/mesh/components.h"
#include "src/partition/random.h"
#include "src/points/point_queries.h"
#include "src/surface/indexed_faces.h"

namespace geodesic {

namespace {

double area_of(const Mesh& mesh, uint32_t face) {
    const auto& [a, b, c] = mesh.faces[face];
    const Eigen::Vector3d to_b = mesh.positions[b] - mesh.positions[a],
                          to_c = mesh.positions[c] - mesh.positions[a];
    return to_b.cross(to_c).norm() / 2;
}

double longest_edge(const Mesh& mesh, uint32_t face) {
    double longest = 0;
    for (const uint32_t edge : mesh.face_edges[face]) longest = std::max(longest, mesh.edge_length(edge));
    return longest;
}

// Per face, the area of all faces up to it, of those where edges are long.
std::vector<double> areas_up_to(const Mesh& mesh) {
    const Components components = components_of(mesh);
    std::vector<double> areas;
    double sum = 0;
    for (uint32_t f = 0; f < mesh.face_count(); ++f) {
        const double across = components.of(mesh.faces[f][0]).edges_across(longest_edge(mesh, f));
        if (are_long_edges(across)) sum += area_of(mesh, f);
        areas.push_back(sum);
    }
    return areas;
}

// As likely in one place of these faces as in another.
SurfacePoint random_point(const std::vector<double>& areas, Random& random) {
    const auto after = std::ranges::upper_bound(areas, random.share() * areas.back());
    const auto face = std::min<ptrdiff_t>(after - areas.begin(), std::ssize(areas) - 1);
    double second = random.share(), third = random.share();
    if (second + third > 1) {
        second = 1 - second;
        third = 1 - third;
    }
    return {static_cast<uint32_t>(face), {1 - second - third, second, third}};
}

}

bool have_long_edges(const Mesh& mesh) {
    constexpr double WORTHWHILE = 1.0 / 16; // of the area
    double area = 0;
    for (uint32_t f = 0; f < mesh.face_count(); ++f) area += area_of(mesh, f);
    return areas_up_to(mesh).back() > WORTHWHILE * area;
}

PointErrors::PointErrors(const Intake& intake, const std::optional<FlippedEdges>& flipped, uint64_t seed,
                         Workers& workers)
    : surface_(Intake(intake), {}, FlatFaces(flipped)) {
    choose_points(areas_up_to(intake.mesh), seed);
    distances_.resize(points_.size());
    workers.run(points_.size(), [&](FieldSolver& solver, size_t i) {
        const SurfacePoint of_index = *indexed_point(surface_, points_[i]);
        solver.solve({{}, {}, {&of_index, 1}, {}});
        distances_[i].resize(surface_.vertex_count());
        for (uint32_t v = 0; v < distances_[i].size(); ++v) distances_[i][v] = solver.distance(v);
    });
}

// Leaves out points that rounding puts outside of every face of the index near them.
void PointErrors::choose_points(const std::vector<double>& areas, uint64_t seed) {
    if (!(areas.back() > 0)) return;
    Random random(seed);
    for (uint32_t left = source_count_of_rounds(surface_.vertex_count()); left > 0; --left)
        if (const SurfacePoint point = random_point(areas, random); indexed_point(surface_, point))
            points_.push_back(point);
}

MeasuredError PointErrors::measure(const Index& index, Workers& workers) const {
    const ShortDistances too_short(surface_.components);
    std::vector<std::vector<double>> of_point(points_.size());
    workers.run(points_.size(), [&](FieldSolver&, size_t i) {
        Query query(index, global_heap());
        std::vector<float> answers(index.description.id_count);
        PointQueries(index, query, surface_).msad({&points_[i], 1}, {}, answers);
        for_each_comparison(
            answers, surface_.id_of_vertex, too_short, [&](uint32_t v) { return distances_[i][v]; },
            [&](double exact, double answer) { of_point[i].push_back(relative_error(exact, answer)); });
    });
    std::vector<double> errors;
    errors.reserve(points_.size() * surface_.vertex_count());
    for (const auto& of_one : of_point) errors.insert(errors.end(), of_one.begin(), of_one.end());
    return summary(std::move(errors), points_.size());
}

}
