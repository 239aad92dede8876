#include "bench/workload.h"

#include <cmath>
#include <random>

#include "tools/failure.h"
#include "tools/library.h"

namespace geodesic::bench {

namespace {

constexpr uint32_t NONE = UINT32_MAX;

// The same numbers with every standard library, unlike std::uniform_int_distribution.
uint32_t below(std::mt19937_64& random, size_t count) { return static_cast<uint32_t>(random() % count); }

// For each vertex another corner of one of its triangles.
std::vector<uint32_t> one_neighbour_each(const tools::TriangleMesh& mesh) {
    std::vector<uint32_t> neighbour(mesh.vertex_count(), NONE);
    for (size_t i = 0; i < mesh.triangles.size(); ++i)
        neighbour[mesh.triangles[i]] = mesh.triangles[i % 3 == 2 ? i - 2 : i + 1];
    return neighbour;
}

bool is_connected(geoidx_solver& solver, const Model& model, uint32_t source, uint32_t neighbour) {
    double distance = 0;
    tools::require_ok(geoidx_solver_distances(&solver, &source, 1, &neighbour, 1, &distance), model.path);
    return std::isfinite(distance);
}

std::vector<Pair> random_pairs(const Workload& workload, uint64_t seed) {
    std::mt19937_64 random(seed);
    const size_t field_count = workload.exact_fields.size();
    std::vector<Pair> pairs;
    for (size_t i = 0; i < field_count * PAIRS_PER_FIELD; ++i) {
        const std::vector<double>& exact = workload.exact_fields[i % field_count];
        uint32_t target = below(random, exact.size());
        while (!std::isfinite(exact[target])) target = below(random, exact.size());
        pairs.push_back({workload.error_sources[i % field_count], target, exact[target]});
    }
    return pairs;
}

}

std::vector<uint32_t> random_sources(geoidx_solver& solver, const Model& model, uint32_t count,
                                     uint64_t seed) {
    const std::vector<uint32_t> neighbour = one_neighbour_each(model.mesh);
    std::mt19937_64 random(seed);
    std::vector<uint32_t> sources;
    size_t attempts = size_t{1000} * (count + 1);
    while (sources.size() < count) {
        if (attempts-- == 0) throw tools::Failure(model.path + ": hardly any vertex can be a source");
        const uint32_t source = below(random, neighbour.size());
        if (neighbour[source] != NONE && is_connected(solver, model, source, neighbour[source]))
            sources.push_back(source);
    }
    return sources;
}

std::vector<double> exact_field(geoidx_solver& solver, const Model& model, uint32_t source) {
    std::vector<double> distances(model.mesh.vertex_count());
    tools::require_ok(geoidx_solver_distances(&solver, &source, 1, nullptr,
                                              static_cast<uint32_t>(distances.size()), distances.data()),
                      model.path);
    return distances;
}

Workload make_workload(geoidx_solver& solver, const Model& model, uint32_t error_source_count) {
    Workload workload;
    workload.timed_sources = random_sources(solver, model, TIMED_QUERIES, SEED);
    workload.timed_targets = random_sources(solver, model, TIMED_QUERIES, SEED + 3);
    workload.error_sources = random_sources(solver, model, error_source_count, SEED + 1);
    for (const uint32_t source : workload.error_sources)
        workload.exact_fields.push_back(exact_field(solver, model, source));
    workload.pairs = random_pairs(workload, SEED + 2);
    return workload;
}

}
