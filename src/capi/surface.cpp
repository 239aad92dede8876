// The handle of a surface, and the points of it.
#include <cmath>
#include <memory>

#include "geoidx.h"
#include "src/capi/handles.h"
#include "src/capi/points.h"
#include "src/capi/status.h"
#include "src/capi/structs.h"

using namespace geodesic;

geoidx_status geoidx_surface_create(const geoidx_mesh* mesh, const geoidx_surface_options* options,
                                    geoidx_surface** out) {
    if (out) *out = nullptr;
    return guarded([&] {
        require(out, "out is NULL");
        require(mesh, "mesh is NULL");
        const auto all_options = whole_or_default(options, geoidx_surface_options_init);
        *out = std::make_unique<geoidx_surface>(
                   take_in(whole(*mesh, geoidx_mesh_init), {.weld_tolerance = all_options.weld_tolerance}))
                   .release();
    });
}

void geoidx_surface_close(geoidx_surface* surface) { delete surface; }

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
