#pragma once

#include <algorithm>
#include <cmath>

#include "tests/capi/calls.h"

namespace geodesic::test {

inline constexpr double MEASURED_ROUNDING = 2e-4; // of measured distances, and of what they are compared with

// Relative errors beside the metric.
struct Errors {
    double mean = 0, max = 0; // of MSAD
    double pair_max = 0;      // of SSSD
};

// Which distances are asked for: from every step-th source, and of these, what is longer than `shortest` and
// at most `longest`.
struct Asked {
    uint32_t first_source = 0, step = 1;
    double shortest = 0, longest = 1e9;
};

inline Errors errors_of(const geoidx* index, const TestMesh& mesh, const geoidx_build_options& options,
                        const Asked& asked) {
    const uint32_t count = mesh.vertex_count();
    const auto metric = solver(mesh, options);
    Errors errors;
    double answers = 0;
    for (uint32_t source = asked.first_source; source < count; source += asked.step) {
        const auto exact = metric_distances(metric.get(), source, count);
        const auto field = msad(index, source, count);
        for (uint32_t v = 0; v < count; ++v) {
            if (!(exact[v] > asked.shortest && exact[v] <= asked.longest)) continue;
            const double error = std::abs(double{field[v]} / exact[v] - 1);
            const double pair_error = std::abs(double{sssd(index, source, v)} / exact[v] - 1);
            errors.mean += error;
            errors.max = std::max(errors.max, error);
            errors.pair_max = std::max(errors.pair_max, pair_error);
            ++answers;
        }
    }
    errors.mean /= answers;
    return errors;
}

}
