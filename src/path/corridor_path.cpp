#include "src/path/corridor_path.h"

#include <algorithm>
#include <optional>
#include <utility>

#include "src/metric/window_propagation.h"
#include "src/path/straighten.h"
#include "src/path/window_trace.h"

namespace geodesic {

namespace {

// A point of the surface as one of the corridor.
SurfacePoint local(const Corridor& corridor, const SurfacePoint& point) {
    const auto found = std::ranges::find(corridor.surface_face, point.face);
    return {static_cast<uint32_t>(found - corridor.surface_face.begin()), point.weights};
}

// A strip of the corridor as one of the surface.
void take_to_surface(const Surface& surface, const Corridor& corridor, Strip& strip) {
    const auto vertex_of_surface = [&](uint32_t face, uint32_t vertex) {
        const auto& corners = corridor.mesh.faces[face];
        const auto k = static_cast<size_t>(std::ranges::find(corners, vertex) - corners.begin());
        return surface.faces[corridor.surface_face[face]][k];
    };
    for (size_t i = 0; i < strip.portals.size(); ++i)
        for (uint32_t* end : {&strip.portals[i].a, &strip.portals[i].b})
            *end = vertex_of_surface(strip.faces[i], *end);
    for (uint32_t& face : strip.faces) face = corridor.surface_face[face];
    strip.source.face = strip.faces.front();
    strip.target.face = strip.faces.back();
}

}

void make_shortest_in_corridor(const Surface& surface, const Corridor& corridor, Strip& strip,
                               StripPath& path) {
    constexpr double SAME = 1e-9;
    const ExactMetric metric(corridor.mesh);
    const auto solver = metric.make_window_solver();
    const SurfacePoint source = local(corridor, strip.source), target = local(corridor, strip.target);
    // From the target, so that the strip that leads back to it begins at the source.
    solver->solve({{}, {}, {&target, 1}, {&source, 1}});
    if (path.length <= solver->point_distance(0) * (1 + SAME)) return;
    std::optional<Strip> traced = trace_back(metric.mesh(), *solver, source, target);
    if (!traced) return;
    take_to_surface(surface, corridor, *traced);
    StripWay way = straighten(surface, std::move(*traced));
    if (!(way.path.length < path.length)) return;
    strip = std::move(way.strip);
    path = std::move(way.path);
}

double shortest_length_in_corridor(const Corridor& corridor, const Strip& strip) {
    const auto solver = ExactMetric(corridor.mesh).make_solver();
    const SurfacePoint source = local(corridor, strip.source), target = local(corridor, strip.target);
    solver->solve({{}, {}, {&source, 1}, {&target, 1}});
    return solver->point_distance(0);
}

}
