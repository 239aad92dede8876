#include "src/build/measure.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "src/partition/random.h"
#include "src/query/query.h"

namespace geodesic {

namespace {

constexpr uint32_t SOURCES = 20;

std::vector<double> relative_errors(const Index& index, std::span<const uint32_t> vertex_of_number,
                                    std::span<const uint32_t> id_of_vertex, uint32_t source,
                                    FieldSolver& solver) {
    Query query(index, std::pmr::get_default_resource());
    std::vector<float> answered(index.id_count);
    query.msad({&id_of_vertex[source], 1}, std::numeric_limits<float>::infinity(), answered);
    solver.solve({&source, 1}, {});
    std::vector<double> errors;
    for (uint32_t vertex : vertex_of_number) {
        const double exact = solver.distance(vertex);
        const double d = double{answered[id_of_vertex[vertex]]};
        if (exact > 0 && exact < UNREACHABLE) errors.push_back((d - exact) / exact);
    }
    return errors;
}

}

MeasuredError measure_error(const Index& index, std::span<const uint32_t> vertex_of_number,
                            std::span<const uint32_t> id_of_vertex, Workers& workers) {
    Random random(index.seed ^ 0x6572726F72u);
    std::vector<uint32_t> sources(SOURCES);
    for (uint32_t& source : sources) source = random.below(index.vertex_count());
    std::vector<std::vector<double>> errors(SOURCES);
    workers.run(SOURCES, [&](FieldSolver& solver, size_t i) {
        errors[i] = relative_errors(index, vertex_of_number, id_of_vertex, sources[i], solver);
    });

    std::vector<double> all;
    MeasuredError result;
    result.sources = SOURCES;
    for (const auto& of_source : errors)
        for (double error : of_source) {
            result.signed_mean += error;
            all.push_back(std::abs(error));
        }
    if (all.empty()) return result;
    std::sort(all.begin(), all.end());
    const auto count = static_cast<double>(all.size());
    const auto quantile = [&](double q) { return all[static_cast<size_t>(q * (count - 1))]; };
    for (double error : all) result.mean += error;
    result.mean /= count;
    result.signed_mean /= count;
    result.p99 = quantile(0.99);
    result.p999 = quantile(0.999);
    result.max = all.back();
    return result;
}

}
