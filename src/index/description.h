#pragma once

#include <array>
#include <cstdint>

#include "format/container.h"

namespace geodesic {

struct MeanAndMax {
    double mean = 0, max = 0;

    bool operator==(const MeanAndMax&) const = default;
};

// How many classes of distances errors are stated for: near, middle and far, up to so many average edges of
// the mesh and beyond.
inline constexpr size_t DISTANCE_CLASSES = 3;
inline constexpr double NEAR_EDGES = 10, MIDDLE_EDGES = 100;

// The class of a distance in average edges.
inline size_t distance_class(double edges) { return edges <= NEAR_EDGES ? 0 : edges <= MIDDLE_EDGES ? 1 : 2; }

// The relative error of MSAD compared with the metric, over all targets of some random sources. Maxima are of
// pairs of vertices, too, and of other sources, where errors are large.
struct MeasuredError {
    uint32_t sources = 0;
    double mean = 0, signed_mean = 0, p99 = 0, p999 = 0, max = 0;
    double mean_at_vertices = 0; // if paths crossed borders at vertices only
    std::array<MeanAndMax, DISTANCE_CLASSES> by_distance{};
    MeanAndMax several; // of MSAD from more than one source

    bool operator==(const MeasuredError&) const = default;
};

// Describes the mesh and the options that an index was built with, and what was measured. A file
// has the fingerprint and the minor version in its header and the rest in the section META, but for
// file_flags, which follow from its other sections.
struct Description {
    uint64_t mesh_fingerprint = 0;
    uint64_t id_count = 0, triangle_count = 0, seed = 0;
    uint32_t metric = 0;   // GEOIDX_METRIC_*
    float bound_scale = 0; // every entry that a search crosses is >= bound_scale * |a - b|, as A* needs
    double delta = 0;      // in % of the diagonal
    double bounding_box_diagonal = 0;
    MeasuredError error;
    uint64_t metric_fingerprint = 0; // of what decides the metric besides the mesh, or 0
    uint32_t metric_flags = 0;       // GEOIDX_METRIC_UNFOLDABLE or 0
    uint32_t engine = 0;             // GEOIDX_ENGINE_*
    uint32_t codec = 0;              // GEOIDX_CODEC_*: the form of the tables in the file
    uint32_t file_flags = 0;         // GEOIDX_SAVE_NO_POSITIONS if the file leaves them out
    // Of the file that it was opened from, or that it would be saved as.
    uint32_t format_minor = format::FORMAT_MINOR;

    bool operator==(const Description&) const = default;
};

}
