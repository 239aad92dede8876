#include "src/build/measure.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "src/index/derived_tables.h"
#include "src/partition/random.h"
#include "src/query/query.h"

namespace geodesic {

namespace {

constexpr uint32_t SOURCES = 20;
constexpr uint64_t MEASURING_SEED = 0x6572726F72, CALIBRATION_SEED = 0x7363616C65;

// Distances under the metric from random sources, by number.
struct ExactFields {
    std::vector<uint32_t> sources; // mesh vertices
    std::vector<std::vector<double>> distances;
};

ExactFields exact_fields(const Index& index, std::span<const uint32_t> vertex_of_number, uint64_t seed,
                         Workers& workers) {
    Random random(index.seed ^ seed);
    ExactFields fields{std::vector<uint32_t>(SOURCES), std::vector<std::vector<double>>(SOURCES)};
    for (uint32_t& source : fields.sources) source = random.below(index.vertex_count());
    workers.run(SOURCES, [&](FieldSolver& solver, size_t i) {
        solver.solve({&fields.sources[i], 1}, {});
        for (uint32_t vertex : vertex_of_number) fields.distances[i].push_back(solver.distance(vertex));
    });
    return fields;
}

// Of MSAD, relative to the metric.
std::vector<double> relative_errors(const Index& index, std::span<const uint32_t> vertex_of_number,
                                    std::span<const uint32_t> id_of_vertex, const ExactFields& exact,
                                    Workers& workers) {
    std::vector<std::vector<double>> errors(SOURCES);
    workers.run(SOURCES, [&](FieldSolver&, size_t i) {
        Query query(index, std::pmr::get_default_resource());
        std::vector<float> answered(index.id_count);
        query.msad({&id_of_vertex[exact.sources[i]], 1}, std::numeric_limits<float>::infinity(), answered);
        for (uint32_t number = 0; number < index.vertex_count(); ++number) {
            const double distance = exact.distances[i][number];
            const double answer = double{answered[id_of_vertex[vertex_of_number[number]]]};
            if (distance > 0 && distance < UNREACHABLE) errors[i].push_back((answer - distance) / distance);
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

bool crosses_between_vertices(const Index& index) {
    return index.engine == GEOIDX_ENGINE_OVERLAY && (index.metric_flags & GEOIDX_METRIC_UNFOLDABLE) != 0;
}

// While it lives, no segment joins border vertices. The arrays that are exchanged have one allocator.
class WithoutSegments {
public:
    explicit WithoutSegments(Rings& rings)
        : rings_(rings), lengths_(rings.segment_length.size(), std::numeric_limits<float>::quiet_NaN(),
                                  rings.segment_length.get_allocator()),
          inverses_(lengths_, rings.half_inverse.get_allocator()) {
        exchange();
    }
    ~WithoutSegments() { exchange(); }
    WithoutSegments(const WithoutSegments&) = delete;
    WithoutSegments& operator=(const WithoutSegments&) = delete;

private:
    void exchange() {
        lengths_.swap(rings_.segment_length);
        inverses_.swap(rings_.half_inverse);
    }

    Rings& rings_;
    Array<float> lengths_, inverses_;
};

}

void calibrate(Index& index, std::span<const uint32_t> vertex_of_number,
               std::span<const uint32_t> id_of_vertex, Workers& workers) {
    if (!crosses_between_vertices(index)) return;
    const ExactFields exact = exact_fields(index, vertex_of_number, CALIBRATION_SEED, workers);
    const double share = common_share(relative_errors(index, vertex_of_number, id_of_vertex, exact, workers));
    for (uint32_t p = 0; p < index.first_leaf(); ++p)
        index.overlay_tables.quantum[p] =
            static_cast<float>(double{index.overlay_tables.quantum[p]} / (1 + share));
    derive_tables(index);
}

MeasuredError measure_error(Index& index, std::span<const uint32_t> vertex_of_number,
                            std::span<const uint32_t> id_of_vertex, Workers& workers) {
    const ExactFields exact = exact_fields(index, vertex_of_number, MEASURING_SEED, workers);
    const auto measured = [&] {
        return summary(relative_errors(index, vertex_of_number, id_of_vertex, exact, workers));
    };
    MeasuredError result = measured();
    result.mean_at_vertices = result.mean;
    if (crosses_between_vertices(index)) {
        const WithoutSegments while_measuring(index.overlay_tables.rings);
        result.mean_at_vertices = measured().mean;
    }
    return result;
}

}
