// The handle of a surface, and the points of it.
#include <cmath>
#include <memory>
#include <string>

#include "geoidx.h"
#include "src/capi/handles.h"
#include "src/capi/points.h"
#include "src/capi/status.h"
#include "src/capi/structs.h"
#include "src/file/kept_mesh.h"
#include "src/surface/costs.h"

using namespace geodesic;

namespace {

geoidx_surface* make_surface(Intake&& intake, const geoidx_surface_options& options) {
    SurfaceCosts costs = surface_costs(intake, options);
    FlatFaces flat(flip_flat_edges(intake.mesh));
    return std::make_unique<geoidx_surface>(std::move(intake), std::move(costs), std::move(flat)).release();
}

}

geoidx_status geoidx_surface_create(const geoidx_mesh* mesh, const geoidx_surface_options* options,
                                    geoidx_surface** out) {
    if (out) *out = nullptr;
    return guarded([&] {
        require(out, "out is NULL");
        require(mesh, "mesh is NULL");
        const auto all_options = whole_or_default(options, geoidx_surface_options_init);
        *out = make_surface(
            take_in(whole(*mesh, geoidx_mesh_init), {.weld_tolerance = all_options.weld_tolerance}),
            all_options);
    });
}

geoidx_status geoidx_surface_of_index(const geoidx* index, const geoidx_surface_options* options,
                                      geoidx_surface** out) {
    if (out) *out = nullptr;
    return guarded([&] {
        require(index, "index is NULL");
        require(out, "out is NULL");
        const Index& of = index->index;
        require(of.keeps_mesh(),
                "the index keeps no mesh: it was built without store_mesh, or saved without");
        *out = make_surface(unpack_mesh(of.mesh, of.description, of.number_of_id),
                            whole_or_default(options, geoidx_surface_options_init));
    });
}

void geoidx_surface_close(geoidx_surface* surface) { delete surface; }

geoidx_status geoidx_vertex_point(const geoidx_surface* surface, uint32_t vertex,
                                  geoidx_surface_point* point) {
    return guarded([&] {
        require(surface, "surface is NULL");
        require(point, "point is NULL");
        const Surface& of = surface->surface;
        if (vertex >= of.vertex_of_id.size())
            refuse_argument("vertex " + std::to_string(vertex) + " is out of range: the mesh has " +
                            std::to_string(of.vertex_of_id.size()) + " vertices");
        if (of.vertex_of_id[vertex] == NONE)
            refuse_argument("no triangle uses vertex " + std::to_string(vertex));
        *point = callers_point(of, point_at_vertex(of, of.vertex_of_id[vertex]));
    });
}

geoidx_status geoidx_closest_point(const geoidx_surface* surface, const double* position,
                                   geoidx_surface_point* point, double* distance) {
    return guarded([&] {
        require(surface, "surface is NULL");
        require(position, "position is NULL");
        require(point, "point is NULL");
        for (size_t k = 0; k < 3; ++k) require(std::isfinite(position[k]), "the position is not finite");
        const ClosestPoint closest =
            surface->boxes.closest(surface->surface, {position[0], position[1], position[2]});
        *point = callers_point(surface->surface, closest.point);
        if (distance) *distance = closest.distance;
    });
}
