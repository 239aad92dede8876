#pragma once

#include <cstdint>
#include <vector>

#include "bench/model.h"
#include "geoidx.h"

namespace geodesic::bench {

inline constexpr uint64_t SEED = 20150929;       // of random sources and pairs
inline constexpr uint32_t TIMED_QUERIES = 1000;  // medians are of so many
inline constexpr uint32_t BATCH = 16;            // sources at once
inline constexpr uint32_t MSAD_THREADS = 2;      // of MSAD on several threads
inline constexpr uint32_t PAIRS_PER_FIELD = 500; // SSSD errors are of so many a reference source

// Sources that a triangle uses and that reach a neighbour.
std::vector<uint32_t> random_sources(geoidx_solver& solver, const Model& model, uint32_t count,
                                     uint64_t seed);

// The distances from one source to every vertex under the metric itself.
std::vector<double> exact_field(geoidx_solver& solver, const Model& model, uint32_t source);

// Two vertices with a path between them.
struct Pair {
    uint32_t source;
    uint32_t target;
    double exact;
};

// What every index of one mesh is asked, and the right answers.
struct Workload {
    std::vector<uint32_t> timed_sources, timed_targets;
    std::vector<uint32_t> error_sources;
    std::vector<std::vector<double>> exact_fields; // of each error source
    std::vector<Pair> pairs;                       // pairs[i] begins at error source i % error sources
};

Workload make_workload(geoidx_solver& solver, const Model& model, uint32_t error_source_count);

}
