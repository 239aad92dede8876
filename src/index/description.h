#pragma once

#include <cstdint>

namespace geodesic {

// Accuracy of MSAD against the metric, relative, over all targets of some random sources.
struct MeasuredError {
    uint32_t sources = 0;
    double mean = 0, signed_mean = 0, p99 = 0, p999 = 0, max = 0;
    double mean_at_vertices = 0; // where paths cross borders at vertices only
};

// What the mesh and the options were, and what was measured: the fingerprint of the file's header and the
// section META.
struct Description {
    uint64_t mesh_fingerprint = 0;
    uint64_t id_count = 0, triangle_count = 0, seed = 0;
    uint32_t metric = 0;   // GEOIDX_METRIC_*
    float bound_scale = 0; // distance(a, b) >= bound_scale * |a - b|: what keeps A* admissible
    double delta = 0;      // % of the diagonal
    double bounding_box_diagonal = 0;
    MeasuredError error;
    uint64_t metric_fingerprint = 0; // of what decides the metric besides the mesh; 0: nothing
    uint32_t metric_flags = 0;       // GEOIDX_METRIC_UNFOLDABLE or 0
    uint32_t engine = 0;             // GEOIDX_ENGINE_*
};

}
