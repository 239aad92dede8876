#include "src/build/measure.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "geoidx.h"
#include "src/graph/query.h"
#include "src/overlay/ssad.h"
#include "src/partition/random.h"

namespace geodesic {

namespace {

constexpr uint32_t SOURCES = 20;
constexpr uint64_t MEASURING_SEED = 0x6572726F72, CALIBRATION_SEED = 0x7363616C65;

// Distances under the metric from random sources, by number.
struct ExactFields {
    std::vector<uint32_t> sources; // mesh vertices
    std::vector<std::vector<double>> distances;
};

ExactFields exact_fields(const Description& about, std::span<const uint32_t> vertex_of_number, uint64_t seed,
                         Workers& workers) {
    Random random(about.seed ^ seed);
    ExactFields fields{std::vector<uint32_t>(SOURCES), std::vector<std::vector<double>>(SOURCES)};
    for (uint32_t& source : fields.sources)
        source = random.below(static_cast<uint32_t>(vertex_of_number.size()));
    workers.run(SOURCES, [&](FieldSolver& solver, size_t i) {
        solver.solve({&fields.sources[i], 1}, {});
        for (uint32_t vertex : vertex_of_number) fields.distances[i].push_back(solver.distance(vertex));
    });
    return fields;
}

// MSAD from one source, by number.
void answer(const Index& index, Crossing crossing, uint32_t source, std::span<float> distance) {
    std::pmr::memory_resource* const memory = std::pmr::get_default_resource();
    if (const auto* const overlay = std::get_if<OverlayIndex>(&index.engine))
        OverlaySsad(*overlay, memory, crossing).sweep(source, INFINITE, distance);
    else
        GraphQuery(std::get<GraphIndex>(index.engine), memory).msad({&source, 1}, INFINITE, distance);
}

// Of MSAD, relative to the metric.
std::vector<double> relative_errors(const Index& index, Crossing crossing,
                                    std::span<const uint32_t> vertex_of_number, const ExactFields& exact,
                                    Workers& workers) {
    std::vector<uint32_t> number_of_vertex(vertex_of_number.size());
    for (uint32_t n = 0; n < vertex_of_number.size(); ++n) number_of_vertex[vertex_of_number[n]] = n;
    std::vector<std::vector<double>> errors(SOURCES);
    workers.run(SOURCES, [&](FieldSolver&, size_t i) {
        std::vector<float> answered(vertex_of_number.size());
        answer(index, crossing, number_of_vertex[exact.sources[i]], answered);
        for (size_t number = 0; number < answered.size(); ++number) {
            const double distance = exact.distances[i][number];
            if (distance > 0 && distance < UNREACHABLE)
                errors[i].push_back((double{answered[number]} - distance) / distance);
        }
    });
    std::vector<double> all;
    for (const auto& of_source : errors) all.insert(all.end(), of_source.begin(), of_source.end());
    return all;
}

MeasuredError summary(std::vector<double> errors) {
    MeasuredError result;
    result.sources = SOURCES;
    if (errors.empty()) return result;
    const auto count = static_cast<double>(errors.size());
    for (double& error : errors) {
        result.signed_mean += error / count;
        error = std::abs(error);
        result.mean += error / count;
    }
    std::sort(errors.begin(), errors.end());
    const auto quantile = [&](double q) { return errors[static_cast<size_t>(q * (count - 1))]; };
    result.p99 = quantile(0.99);
    result.p999 = quantile(0.999);
    result.max = errors.back();
    return result;
}

// The share by which paths are too long everywhere: the mean of the signed errors, without those of paths
// that take another way altogether, such as a detour of pruned borders, which say nothing of the others.
double common_share(std::vector<double> errors) {
    constexpr double ANOTHER_WAY = 0.1;
    std::erase_if(errors, [](double error) { return std::abs(error) > ANOTHER_WAY; });
    return summary(std::move(errors)).signed_mean;
}

bool crosses_between_vertices(const Description& about) {
    return about.engine == GEOIDX_ENGINE_OVERLAY && (about.metric_flags & GEOIDX_METRIC_UNFOLDABLE) != 0;
}

}

void calibrate(std::span<const uint32_t> vertex_of_number, Workers& workers, StoredIndex& stored) {
    if (!crosses_between_vertices(stored.description)) return;
    const ExactFields exact = exact_fields(stored.description, vertex_of_number, CALIBRATION_SEED, workers);
    Index draft(std::pmr::get_default_resource());
    prepare(stored, draft);
    const double share =
        common_share(relative_errors(draft, Crossing::BETWEEN_VERTICES, vertex_of_number, exact, workers));
    for (size_t p = 0; p < stored.child_count.size(); ++p)
        stored.quantum[p] = static_cast<float>(double{stored.quantum[p]} / (1 + share));
}

MeasuredError measure_error(const Index& index, std::span<const uint32_t> vertex_of_number,
                            Workers& workers) {
    const ExactFields exact = exact_fields(index.description, vertex_of_number, MEASURING_SEED, workers);
    const auto measured = [&](Crossing crossing) {
        return summary(relative_errors(index, crossing, vertex_of_number, exact, workers));
    };
    MeasuredError result = measured(Crossing::BETWEEN_VERTICES);
    result.mean_at_vertices =
        crosses_between_vertices(index.description) ? measured(Crossing::AT_VERTICES).mean : result.mean;
    return result;
}

}
