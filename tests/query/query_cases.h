#pragma once

#include <map>

#include "tests/capi/calls.h"

namespace geodesic::test {

struct QueryCase {
    std::string name;
    TestMesh mesh;
    geoidx_build_options options;
};

// Every mesh of the zoo with both metrics, 1 to 3 levels, without and with pruning.
inline std::vector<QueryCase> query_cases() {
    std::vector<QueryCase> cases;
    for (const auto& [name, mesh] : mesh_zoo())
        for (uint32_t metric : {GEOIDX_METRIC_EXACT, GEOIDX_METRIC_EDGES})
            for (uint32_t levels : {1u, 2u, 3u})
                for (double delta : {0.0, 2.0})
                    cases.push_back({name + (metric == GEOIDX_METRIC_EXACT ? ", exact" : ", edges") + ", " +
                                         std::to_string(levels) + " levels, delta " + std::to_string(delta),
                                     mesh, build_options(metric, levels, delta)});
    return cases;
}

// The index of a case, built once for all tests.
inline const geoidx* index_of(const QueryCase& test) {
    static std::map<std::string, IndexHandle> built;
    IndexHandle& index = built[test.name];
    if (!index) index = build(test.mesh, test.options);
    return index.get();
}

// Relative rounding of the float sums of a query.
inline constexpr double ROUNDING = 1e-6;

}
