#pragma once

#include <string>

#include "geoidx.h"
#include "tests/campaign/dice.h"

namespace geodesic::campaign {

// What GEOIDX_METRIC_CALLBACK answers.
enum Callback : uint32_t { CALLBACK_EXACT, CALLBACK_UNFOLDABLE, CALLBACK_EDGES, CALLBACK_STRAIGHT };

// How a mesh is built and asked; no arrays, so that the same options go with a mesh that was changed.
struct CaseOptions {
    uint32_t metric = GEOIDX_METRIC_EXACT;
    uint32_t callback = CALLBACK_EXACT;
    uint32_t engine = GEOIDX_ENGINE_OVERLAY;
    uint32_t level_count = 0;
    uint32_t patches[8] = {};
    uint32_t lloyd_iterations = 4, exact_vertices = 400, points_per_edge = 3, threads = 1;
    double delta = 0, weld_tolerance = 0;
    double target_error = 0;
    uint64_t seed = 0;
    uint64_t cost_seed = 0;   // of costs of edges and triangles; 0: edges cost their length
    bool own_lengths = false; // the surface is given by lengths
    bool floats = false;      // positions are floats, and those of the mesh are rounded to them
    bool opened = false;      // an index that was saved and opened again is asked, too
    uint64_t query_seed = 0;
    bool store_mesh = false; // the index keeps the mesh
};

CaseOptions random_options(Dice& dice, const test::Soup& soup);

// A line for each, its name first.
std::string described(const CaseOptions& options);
// From such lines; others are passed over, what is missing takes its default.
CaseOptions read_options(const std::string& text);

}
