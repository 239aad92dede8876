#include <algorithm>
#include <string>

#include "geoidx.h"
#include "src/build/metric_options.h"
#include "src/capi/handles.h"
#include "src/capi/points.h"
#include "src/capi/status.h"
#include "src/capi/structs.h"

// Distances without an index.

using namespace geodesic;

namespace {

uint32_t solver_vertex(const geoidx_solver& solver, uint32_t id) {
    if (id >= solver.intake.vertex_of_id.size())
        refuse_argument("vertex " + std::to_string(id) + " is out of range: the mesh has " +
                        std::to_string(solver.intake.vertex_of_id.size()) + " vertices");
    return solver.intake.vertex_of_id[id];
}

std::vector<uint32_t> used_vertices(const geoidx_solver& solver, std::span<const uint32_t> ids) {
    std::vector<uint32_t> vertices;
    for (uint32_t id : ids)
        if (const uint32_t vertex = solver_vertex(solver, id); vertex != NONE) vertices.push_back(vertex);
    return vertices;
}

// Those that no triangle uses, in ascending order.
std::vector<uint32_t> unused_ids(const geoidx_solver& solver, std::span<const uint32_t> ids) {
    std::vector<uint32_t> unused;
    for (const uint32_t id : ids)
        if (solver_vertex(solver, id) == NONE) unused.push_back(id);
    std::ranges::sort(unused);
    return unused;
}

void solve(geoidx_solver& solver, std::span<const uint32_t> sources, std::span<const uint32_t> targets,
           bool all_targets, double* distances) {
    const auto source_vertices = used_vertices(solver, sources);
    const auto target_vertices = used_vertices(solver, targets);
    if (!source_vertices.empty() && (all_targets || !target_vertices.empty()))
        solver.solver->solve(source_vertices, target_vertices);
    const auto unused_sources = unused_ids(solver, sources);
    const auto distance_of = [&](uint32_t id) {
        const uint32_t vertex = solver_vertex(solver, id);
        if (vertex != NONE) return source_vertices.empty() ? UNREACHABLE : solver.solver->distance(vertex);
        return std::ranges::binary_search(unused_sources, id) ? 0.0 : UNREACHABLE;
    };
    const size_t count = all_targets ? solver.intake.vertex_of_id.size() : targets.size();
    for (size_t i = 0; i < count; ++i) {
        const uint32_t id = all_targets ? static_cast<uint32_t>(i) : targets[i];
        distances[i] = distance_of(id);
    }
}

std::vector<SurfacePoint> surface_points(const Intake& intake, std::span<const geoidx_surface_point> points,
                                         const char* name) {
    std::vector<SurfacePoint> result;
    for (size_t i = 0; i < points.size(); ++i)
        result.push_back(checked_point(TriangleFaces{intake.face_of_triangle, intake.corners_of_duplicate},
                                       points[i], std::string(name) + " " + std::to_string(i)));
    return result;
}

}

geoidx_status geoidx_solver_create(const geoidx_mesh* mesh, const geoidx_build_options* options,
                                   geoidx_solver** out) {
    if (out) *out = nullptr;
    return guarded([&] {
        require(out, "out is NULL");
        require(mesh, "mesh is NULL");
        const auto all_options = whole_or_default(options, geoidx_build_options_init);
        check_metric_options(all_options);
        auto solver = std::make_unique<geoidx_solver>();
        const geoidx_mesh all_mesh = whole(*mesh, geoidx_mesh_init);
        solver->intake = take_in(all_mesh, intake_options(all_options));
        solver->metric = make_metric(all_mesh, solver->intake, all_options, all_options.solver_tolerance);
        solver->solver = solver->metric->make_solver();
        *out = solver.release();
    });
}

void geoidx_solver_close(geoidx_solver* solver) { delete solver; }

geoidx_status geoidx_solver_distances(geoidx_solver* solver, const uint32_t* sources, uint32_t source_count,
                                      const uint32_t* targets, uint32_t target_count, double* distances) {
    return guarded([&] {
        require(solver, "solver is NULL");
        require(source_count > 0, "there is no source");
        require(sources, "sources is NULL");
        require(distances || target_count == 0, "distances is NULL");
        require(targets || target_count == solver->intake.vertex_of_id.size(),
                "targets is NULL, but target_count is not the mesh's vertex_count");
        solve(*solver, {sources, source_count}, {targets, targets ? target_count : 0}, !targets, distances);
    });
}

geoidx_status geoidx_solver_point_distances(geoidx_solver* solver, const geoidx_surface_point* sources,
                                            uint32_t source_count, const geoidx_surface_point* targets,
                                            uint32_t target_count, double* distances) {
    return guarded([&] {
        require(solver, "solver is NULL");
        require(solver->metric->takes_points(), "the metric knows vertices only, no points of the surface");
        require(source_count > 0, "there is no source");
        require(sources, "sources is NULL");
        require((targets && distances) || target_count == 0, "targets or distances is NULL");
        if (target_count == 0) return;
        const auto source_points = surface_points(solver->intake, {sources, source_count}, "source");
        const auto target_points = surface_points(solver->intake, {targets, target_count}, "target");
        solver->solver->solve({{}, {}, source_points, target_points});
        for (uint32_t i = 0; i < target_count; ++i) distances[i] = solver->solver->point_distance(i);
    });
}
