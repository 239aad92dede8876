#pragma once

#include <algorithm>
#include <cmath>
#include <map>

#include "tests/capi/calls.h"
#include "tests/support/sanitized.h"

namespace geodesic::test {

struct QueryCase {
    std::string name;
    TestMesh mesh;
    geoidx_build_options options;
};

// Named after the mesh and what the options may differ in.
inline QueryCase query_case(const NamedMesh& named, const geoidx_build_options& options) {
    return {named.name + (options.metric == GEOIDX_METRIC_EXACT ? ", exact" : ", edges") + ", engine " +
                std::to_string(options.engine) + ", " + std::to_string(options.level_count) +
                " levels, delta " + std::to_string(options.delta),
            named.mesh, options};
}

// Every mesh of the zoo with both metrics, 1 to 3 levels, without and with pruning.
inline std::vector<QueryCase> query_cases() {
    std::vector<QueryCase> cases;
    for (const NamedMesh& named : mesh_zoo())
        for (uint32_t metric : {GEOIDX_METRIC_EXACT, GEOIDX_METRIC_EDGES})
            for (uint32_t levels : {1u, 2u, 3u}) {
                if (SANITIZED && levels == 2) continue; // three have all that two have
                for (double delta : {0.0, 2.0})
                    cases.push_back(query_case(named, build_options(metric, levels, delta)));
            }
    return cases;
}

// Every mesh of the zoo with exact distances, by both engines, with each of these numbers of levels.
inline std::vector<QueryCase> exact_cases(std::initializer_list<uint32_t> level_counts) {
    std::vector<QueryCase> cases;
    for (const NamedMesh& named : mesh_zoo())
        for (uint32_t engine : {GEOIDX_ENGINE_GRAPH, GEOIDX_ENGINE_OVERLAY})
            for (uint32_t levels : level_counts) {
                auto options = build_options(GEOIDX_METRIC_EXACT, levels);
                options.engine = engine;
                cases.push_back(query_case(named, options));
            }
    return cases;
}

// A bumpy mesh of some size.
inline QueryCase case_of_some_size(const geoidx_build_options& options) {
    return query_case({"bumpy grid", grid(smaller(60, 45), smaller(50, 30), 0.4)}, options);
}

// Meshes of some size of different shapes, by the overlay engine with three levels: hills, a torus and a
// bumpy grid.
inline std::vector<QueryCase> overlays_of_some_size() {
    auto options = build_options(GEOIDX_METRIC_EXACT, 3);
    options.engine = GEOIDX_ENGINE_OVERLAY;
    const uint32_t side = smaller(40, 26);
    return {query_case({"large hills", hills(side, side)}, options),
            query_case({"large torus", torus(smaller(60, 36), smaller(30, 18))}, options),
            query_case({"large grid", grid(side, side, 0.25)}, options)};
}

// The index of a case, built once for all tests that ask for a case of its name.
inline const geoidx* index_of(const QueryCase& test) {
    static std::map<std::string, std::shared_ptr<const geoidx>> built;
    std::shared_ptr<const geoidx>& index = built[test.name];
    if (!index) index = shared_index(test.mesh, test.options);
    return index.get();
}

struct Differences {
    double sum = 0, signed_sum = 0, largest = 0;
    uint64_t count = 0, reached_wrongly = 0;

    // Relative to the right answer; at 0 both must be.
    void add(double answer, double expected) {
        if (std::isfinite(answer) != std::isfinite(expected) || (expected == 0 && answer != 0))
            ++reached_wrongly;
        else if (std::isfinite(expected) && expected > 0) {
            const double difference = (answer - expected) / expected;
            sum += std::abs(difference);
            signed_sum += difference;
            largest = std::max(largest, std::abs(difference));
            ++count;
        }
    }
    double mean() const { return count ? sum / static_cast<double>(count) : 0; }
};

inline geoidx_build_options overlay_options(uint32_t metric, uint32_t levels, uint32_t exact_vertices) {
    geoidx_build_options options = build_options(metric, levels);
    options.engine = GEOIDX_ENGINE_OVERLAY;
    options.exact_vertices = exact_vertices;
    return options;
}

// The same index, saved and opened without labels.
inline IndexHandle without_labels(const geoidx* index) {
    geoidx_open_options options;
    geoidx_open_options_init(&options);
    options.flags = GEOIDX_OPEN_NO_LABELS;
    const Bytes bytes = save(index);
    geoidx* opened = nullptr;
    require_success(geoidx_open_memory(bytes.data(), bytes.size(), &options, &opened));
    return IndexHandle(opened);
}

// Relative rounding of the float sums of a query.
inline constexpr double ROUNDING = 1e-6;

}
