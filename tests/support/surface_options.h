#pragma once

#include "geoidx.h"

namespace geodesic::test {

// Of a surface for an index that is built with these, which has the same costs; these must outlive it.
inline geoidx_surface_options surface_options(const geoidx_build_options& build) {
    geoidx_surface_options options;
    geoidx_surface_options_init(&options);
    options.weld_tolerance = build.weld_tolerance;
    options.edge_cost_count = build.edge_cost_count;
    options.edge_cost_vertices = build.edge_cost_vertices;
    options.edge_costs = build.edge_costs;
    options.face_costs = build.face_costs;
    options.face_cost_count = build.face_cost_count;
    options.points_per_edge = build.points_per_edge;
    return options;
}

}
