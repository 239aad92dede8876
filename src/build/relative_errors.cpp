#include "src/build/relative_errors.h"

#include <algorithm>
#include <cmath>

#include "geoidx.h"
#include "src/base/array.h"
#include "src/build/errors_by_distance.h"
#include "src/graph/query.h"
#include "src/partition/random.h"

namespace geodesic {

namespace {

constexpr uint32_t SOURCES = 20;

// Returns the distances of MSAD from one source, by vertex number.
void answer(const Index& index, Crossing crossing, uint32_t source, std::span<float> distance) {
    std::pmr::memory_resource* const memory = global_heap();
    if (const auto* const overlay = std::get_if<OverlayIndex>(&index.engine))
        OverlaySsad(*overlay, memory, 1, crossing).sweep({&source, 1}, INFINITE, distance);
    else
        GraphQuery(std::get<GraphIndex>(index.engine), memory).msad({&source, 1}, INFINITE, distance);
}

double mean_edge_at_sources(const Mesh& mesh, const ExactFields& exact) {
    double sum = 0;
    uint64_t count = 0;
    for (size_t i = 0; i < exact.sources.size(); ++i)
        for (const uint32_t v : neighbours(mesh, exact.sources[i]))
            if (const double length = exact.distances[i][v];
                has_relative_error(length, exact.too_short.up_to(v))) {
                sum += length;
                ++count;
            }
    return count == 0 ? 0 : sum / static_cast<double>(count);
}

// The longest of these distances that is finite, or 0.
double longest_of(std::span<const double> distances) {
    double longest = 0;
    for (const double distance : distances)
        if (distance < UNREACHABLE) longest = std::max(longest, distance);
    return longest;
}

// By the longest distances of the fields.
ShortDistances short_by_fields(const Components& components, const ExactFields& exact) {
    std::vector<double> extents(components.all.size(), 0);
    for (size_t i = 0; i < exact.sources.size(); ++i) {
        double& extent = extents[components.of_vertex[exact.sources[i]]];
        extent = std::max(extent, longest_of(exact.distances[i]));
    }
    double least_ratio = INFINITE; // of the longest distance to the diagonal, of components with a source
    for (size_t p = 0; p < extents.size(); ++p)
        if (extents[p] > 0) least_ratio = std::min(least_ratio, extents[p] / components.all[p].diagonal);
    ShortDistances result(components.of_vertex, {});
    for (size_t p = 0; p < extents.size(); ++p) {
        const bool is_estimated = extents[p] == 0 && least_ratio < INFINITE;
        result.of_component.push_back(
            ShortDistances::beside(is_estimated ? least_ratio * components.all[p].diagonal : extents[p]));
    }
    return result;
}

}

ExactFields exact_fields(const Description& about, const Mesh& mesh, uint64_t seed, Workers& workers) {
    const uint32_t vertex_count = mesh.vertex_count();
    const Components components = components_of(mesh);
    Random random(seed);
    ExactFields fields{std::vector<uint32_t>(SOURCES), std::vector<std::vector<double>>(SOURCES),
                       ShortDistances(components)};
    for (uint32_t& source : fields.sources) source = random.below(vertex_count);
    workers.run(SOURCES, [&](FieldSolver& solver, size_t i) {
        solver.solve({&fields.sources[i], 1}, {});
        for (uint32_t v = 0; v < vertex_count; ++v) fields.distances[i].push_back(solver.distance(v));
    });
    if (!follows_positions(about)) fields.too_short = short_by_fields(components, fields);
    return fields;
}

DistanceScale distance_scale(const Description& about, const Mesh& mesh, const ExactFields& exact) {
    return {exact.too_short, follows_positions(about) ? mean_edge(mesh) : mean_edge_at_sources(mesh, exact)};
}

std::vector<double> relative_errors(const Index& index, Crossing crossing,
                                    std::span<const uint32_t> vertex_of_number, const ExactFields& exact,
                                    Workers& workers) {
    std::vector<uint32_t> number_of(vertex_of_number.size());
    for (uint32_t n = 0; n < vertex_of_number.size(); ++n) number_of[vertex_of_number[n]] = n;
    std::vector<std::vector<double>> errors(exact.sources.size());
    workers.run(errors.size(), [&](FieldSolver&, size_t i) {
        std::vector<float> answered(vertex_of_number.size());
        answer(index, crossing, number_of[exact.sources[i]], answered);
        for (size_t number = 0; number < answered.size(); ++number) {
            const uint32_t vertex = vertex_of_number[number];
            if (vertex >= exact.distances[i].size()) continue; // an added vertex
            const double distance = exact.distances[i][vertex];
            if (has_relative_error(distance, exact.too_short.up_to(vertex)))
                errors[i].push_back((double{answered[number]} - distance) / distance);
        }
    });
    std::vector<double> all;
    for (const auto& of_source : errors) all.insert(all.end(), of_source.begin(), of_source.end());
    return all;
}

MeasuredError summary(std::vector<double> errors, size_t sources) {
    MeasuredError result;
    result.sources = static_cast<uint32_t>(sources);
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

bool crosses_between_vertices(const Description& about) {
    return about.engine == GEOIDX_ENGINE_OVERLAY && (about.metric_flags & GEOIDX_METRIC_UNFOLDABLE) != 0;
}

bool follows_positions(const Description& about) {
    return about.metric != GEOIDX_METRIC_CALLBACK && about.metric_fingerprint == 0;
}

}
