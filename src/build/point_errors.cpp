#include "src/build/point_errors.h"

#include <algorithm>
#include <memory_resource>
#include <optional>
#include <utility>

#include <Eigen/Geometry>

#include "src/build/errors_by_distance.h"
#include "src/build/relative_errors.h"
#include "src/partition/random.h"
#include "src/points/point_queries.h"
#include "src/surface/indexed_faces.h"

namespace geodesic {

namespace {

// Per face, the area of all faces up to it, of those where edges are long.
std::vector<double> areas_up_to(const Surface& surface) {
    std::vector<double> areas;
    double sum = 0;
    for (uint32_t f = 0; f < surface.face_count(); ++f) {
        const auto& [a, b, c] = surface.faces[f];
        const Eigen::Vector3d to_b = surface.positions[b] - surface.positions[a],
                              to_c = surface.positions[c] - surface.positions[a];
        if (has_long_edges(surface, f)) sum += to_b.cross(to_c).norm() / 2;
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

PointErrors::PointErrors(const Intake& intake, const std::optional<FlippedEdges>& flipped, uint64_t seed,
                         Workers& workers)
    : surface_(Intake(intake), {}, FlatFaces(flipped)) {
    choose_points(seed);
    distances_.resize(points_.size());
    workers.run(points_.size(), [&](FieldSolver& solver, size_t i) {
        const SurfacePoint of_index = *indexed_point(surface_, points_[i]);
        solver.solve({{}, {}, {&of_index, 1}, {}});
        distances_[i].resize(surface_.vertex_count());
        for (uint32_t v = 0; v < distances_[i].size(); ++v) distances_[i][v] = solver.distance(v);
    });
}

// Leaves out those of which rounding hides where the index has them.
void PointErrors::choose_points(uint64_t seed) {
    const std::vector<double> areas = areas_up_to(surface_);
    if (!(areas.back() > 0)) return;
    Random random(seed);
    for (uint32_t left = source_count_of_rounds(surface_.vertex_count()); left > 0; --left)
        if (const SurfacePoint point = random_point(areas, random); indexed_point(surface_, point))
            points_.push_back(point);
}

MeasuredError PointErrors::measure(const Index& index, Workers& workers) const {
    const double too_short = too_short_beside(surface_.bounding_box_diagonal);
    std::vector<std::vector<double>> of_point(points_.size());
    workers.run(points_.size(), [&](FieldSolver&, size_t i) {
        Query query(index, std::pmr::get_default_resource());
        std::vector<float> answers(index.description.id_count);
        PointQueries(index, query, surface_).msad({&points_[i], 1}, {}, answers);
        for_each_comparison(
            answers, surface_.id_of_vertex, too_short, [&](uint32_t v) { return distances_[i][v]; },
            [&](double exact, double answer) { of_point[i].push_back(relative_error(exact, answer)); });
    });
    std::vector<double> errors;
    errors.reserve(points_.size() * surface_.vertex_count());
    for (const auto& of_one : of_point) errors.insert(errors.end(), of_one.begin(), of_one.end());
    return summary(std::move(errors));
}

}
