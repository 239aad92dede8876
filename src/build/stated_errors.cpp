#include "src/build/stated_errors.h"

#include "geoidx.h"
#include "src/build/border_vertices.h"
#include "src/build/errors_by_distance.h"
#include "src/build/near_search.h"
#include "src/build/several_errors.h"
#include "src/query/query.h"

namespace geodesic {

namespace {

constexpr uint64_t NEAR_SEED = 0x6E656172, GROUP_SEED = 0x67726F7570, PAIR_SEED = 0x7061697273;

// How much is compared. What takes longer to ask is asked less.
struct Effort {
    NearEffort near;
    uint32_t pairs;  // of each source of which the whole field is known
    uint32_t rounds; // of groups of sources
};

// Of so many sources, half are the first ones, chosen from `screened` times as many, and half lie around the
// worst pairs.
NearEffort near_effort(uint32_t sources, uint32_t screened) {
    constexpr uint32_t CLIMBS = 6;
    return {screened * sources / 2, sources / 2, CLIMBS, sources / 2 / CLIMBS};
}

// Of few vertices, a larger share is asked, since sources among so few soon find the worst pair, and of very
// few all of them; but not a number that is the same for all, which would take longer than all the rest of a
// small build.
uint32_t source_count(uint32_t vertex_count) {
    constexpr uint32_t VERY_FEW = 256;
    if (vertex_count <= VERY_FEW) return 2 * vertex_count; // half of them are the first ones
    const uint32_t of_few = std::clamp(vertex_count / 6, 30u, 120u);
    return std::clamp(vertex_count / 80, of_few, 2000u);
}

// Takes about a tenth of a build. The graph engine is asked for no pairs: SSSD takes the shortest of more
// ways than MSAD, none of which is too short, so that its errors are no larger; and it takes long where
// borders have many vertices.
Effort effort_for(const Description& about, uint32_t vertex_count) {
    const bool is_graph = about.engine == GEOIDX_ENGINE_GRAPH;
    const uint32_t screened = is_graph ? 1 : 4;
    if (about.metric == GEOIDX_METRIC_CALLBACK) return {near_effort(40, 4), is_graph ? 0u : 20u, 0};
    const uint32_t sources = source_count(vertex_count);
    const uint32_t pairs = is_graph ? 0 : std::min(vertex_count / 10, 500u);
    if (about.metric == GEOIDX_METRIC_WEIGHTED)
        return {near_effort(std::max(sources / 4, 12u), screened), std::min(pairs, 50u), 1};
    return {near_effort(sources, screened), pairs, 1};
}

double mean_edge_at_sources(const Mesh& mesh, const ExactFields& exact) {
    double sum = 0;
    uint64_t count = 0;
    for (size_t i = 0; i < exact.sources.size(); ++i)
        for (const uint32_t v : neighbours(mesh, exact.sources[i]))
            if (const double length = exact.distances[i][v]; has_relative_error(length)) {
                sum += length;
                ++count;
            }
    return count == 0 ? 0 : sum / static_cast<double>(count);
}

// The unit of classes of distances.
double average_edge(const Description& about, const Mesh& mesh, const ExactFields& exact) {
    return follows_positions(about) ? mean_edge(mesh) : mean_edge_at_sources(mesh, exact);
}

// The errors of MSAD and of some SSSD from the i-th source.
ErrorsByDistance errors_of_field(const Index& index, const Intake& intake, const ExactFields& exact, size_t i,
                                 bool counts_in_means, uint32_t pairs, ErrorsByDistance errors) {
    Query query(index, std::pmr::get_default_resource());
    const auto& distances = exact.distances[i];
    const uint32_t source = intake.id_of_vertex[exact.sources[i]];
    std::vector<float> answers(index.description.id_count);
    query.msad({&source, 1}, INFINITE, answers);
    for (uint32_t v = 0; v < distances.size(); ++v) {
        if (!has_relative_error(distances[v])) continue;
        const double error = relative_error(distances[v], answers[intake.id_of_vertex[v]]);
        counts_in_means ? errors.of(distances[v]).add(error) : errors.of(distances[v]).add_to_max(error);
    }
    Random random(index.description.seed ^ PAIR_SEED ^ i);
    for (uint32_t k = 0; k < pairs; ++k) {
        const uint32_t v = random.below(static_cast<uint32_t>(distances.size()));
        if (!has_relative_error(distances[v])) continue;
        const double answer = query.sssd(source, intake.id_of_vertex[v]);
        errors.of(distances[v]).add_to_max(relative_error(distances[v], answer));
    }
    return errors;
}

void add_errors_of_fields(const Index& index, const Intake& intake, const ExactFields& exact,
                          bool counts_in_means, uint32_t pairs, const ErrorsByDistance& none,
                          Workers& workers, ErrorsByDistance& errors) {
    std::vector<ErrorsByDistance> of_source(exact.sources.size(), none);
    workers.run(of_source.size(), [&](FieldSolver&, size_t i) {
        of_source[i] = errors_of_field(index, intake, exact, i, counts_in_means, pairs, none);
    });
    for (const ErrorsByDistance& of_one : of_source) errors.add(of_one);
}

// The errors of MSAD from these sources, now that the index may hold measured pairs.
MeasuredError error_of_answers(const Index& index, const Intake& intake, const ExactFields& exact,
                               Workers& workers) {
    std::vector<std::vector<double>> of_source(exact.sources.size());
    workers.run(of_source.size(), [&](FieldSolver&, size_t i) {
        Query query(index, std::pmr::get_default_resource());
        std::vector<float> answers(index.description.id_count);
        query.msad({&intake.id_of_vertex[exact.sources[i]], 1}, INFINITE, answers);
        for (uint32_t v = 0; v < exact.distances[i].size(); ++v)
            if (const double distance = exact.distances[i][v]; has_relative_error(distance))
                of_source[i].push_back((double{answers[intake.id_of_vertex[v]]} - distance) / distance);
    });
    std::vector<double> all;
    for (const auto& errors : of_source) all.insert(all.end(), errors.begin(), errors.end());
    MeasuredError error = summary(std::move(all));
    error.mean_at_vertices = index.description.error.mean_at_vertices;
    return error;
}

MeanAndMax error_of_several(const Index& index, const Intake& intake, const ExactFields& exact,
                            uint32_t rounds, Workers& workers) {
    if (rounds == 0) return errors_of_known_groups(index, intake, exact, workers).result();
    const auto groups = source_groups(index, intake, rounds, index.description.seed ^ GROUP_SEED);
    return errors_of_groups(index, intake, groups, workers).result();
}

}

void state_errors(const Intake& intake, std::span<const ExactFields* const> fields, Workers& workers,
                  Index& index) {
    const Description& about = index.description;
    const ExactFields& measuring = *fields.front();
    const double edge = average_edge(about, intake.mesh, measuring);
    const Effort effort = effort_for(about, intake.mesh.vertex_count());
    ErrorsByDistance errors(edge);
    const ErrorsByDistance none = errors;
    for (const ExactFields* exact : fields)
        add_errors_of_fields(index, intake, *exact, exact == &measuring, effort.pairs, none, workers, errors);
    NearSearch search(index, intake, edge);
    search.run(effort.near, about.seed ^ NEAR_SEED, workers);
    errors.add(search.errors());
    MeasuredError stated = about.error;
    if (crosses_between_vertices(about)) stated = error_of_answers(index, intake, measuring, workers);
    stated.by_distance = errors.result();
    for (const MeanAndMax& of_class : stated.by_distance) stated.max = std::max(stated.max, of_class.max);
    stated.several = error_of_several(index, intake, measuring, effort.rounds, workers);
    index.description.error = stated;
    release_pairs(index);
}

}
