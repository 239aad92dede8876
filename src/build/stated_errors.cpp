#include "src/build/stated_errors.h"

#include <algorithm>

#include "geoidx.h"
#include "src/base/array.h"
#include "src/build/errors_by_distance.h"
#include "src/build/near_search.h"
#include "src/build/several_errors.h"
#include "src/build/two_way_search.h"
#include "src/query/query.h"

namespace geodesic {

namespace {

constexpr uint64_t NEAR_SEED = 0x6E656172, GROUP_SEED = 0x67726F7570, PAIR_SEED = 0x7061697273,
                   TWO_WAY_SEED = 0x74776F776179;

constexpr uint32_t VERY_FEW = 256; // vertices

// How much is compared. What takes longer to ask is asked less.
struct Effort {
    NearEffort near;
    TwoWayEffort two_way;     // no sources: it is left out
    uint32_t pairs;           // of each source of which the whole field is known
    uint32_t rounds;          // of groups of sources
    bool is_complete = false; // nearly all pairs are looked at, those of ten edges and less
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
    if (vertex_count <= VERY_FEW) return 2 * vertex_count; // half of them are the first ones
    const uint32_t of_few = std::clamp(vertex_count / 6, 30u, 120u);
    return std::clamp(vertex_count / 80, of_few, 2000u);
}

// SSSD loses the ways of some pairs in a million: up to a million are looked at. Of those of few vertices it
// is a larger share.
TwoWayEffort two_way_effort(uint32_t vertex_count) {
    constexpr uint32_t MOST_VERTICES = 3072, AROUND_WORST = 1024, SOURCES = 20, PAIRS_PER_VERTEX = 12,
                       MOST_PAIRS = 1000000;
    return {std::min(vertex_count, MOST_VERTICES), AROUND_WORST, SOURCES,
            std::min(PAIRS_PER_VERTEX * std::min(vertex_count, MOST_PAIRS), MOST_PAIRS)};
}

// Takes about a tenth of a build. The graph engine is asked for no pairs: SSSD takes the shortest of more
// ways than MSAD, none of which is too short, so that its errors are no larger; and it takes long where
// borders have many vertices.
Effort effort_for(const Description& about, bool is_near_known, uint32_t vertex_count) {
    const bool is_graph = about.engine == GEOIDX_ENGINE_GRAPH;
    const uint32_t screened = is_graph ? 1 : 4;
    constexpr TwoWayEffort NONE_OF_TWO_WAYS{0, 0, 0, 0};
    if (about.metric == GEOIDX_METRIC_CALLBACK)
        return {near_effort(40, screened), NONE_OF_TWO_WAYS, is_graph ? 0u : 20u, 0};
    const uint32_t sources = source_count(vertex_count);
    constexpr uint32_t PAIRS = 50;
    const uint32_t pairs = is_graph ? 0 : PAIRS;
    if (about.metric == GEOIDX_METRIC_WEIGHTED)
        return {near_effort(std::max(sources / 4, 12u), screened), NONE_OF_TWO_WAYS, pairs, 1};
    const TwoWayEffort two_way = is_graph ? NONE_OF_TWO_WAYS : two_way_effort(vertex_count);
    // Where near errors of MSAD are known, near sources only show where SSSD has larger ones.
    const bool is_complete = vertex_count <= VERY_FEW;
    return {near_effort(is_near_known ? sources / 2 : sources, screened), two_way, pairs, 1, is_complete};
}

struct FieldErrors {
    ErrorsByDistance by_distance;
    std::vector<double> of_msad; // with signs
};

// The errors of MSAD and of `pairs` SSSD from the i-th source.
FieldErrors errors_of_field(const Compared& compared, const ExactFields& exact, size_t i,
                            bool counts_in_means, uint32_t pairs) {
    const auto& ids = compared.intake.id_of_vertex;
    const ShortDistances& too_short = compared.scale.too_short;
    FieldErrors errors{ErrorsByDistance(compared.scale.average_edge), {}};
    Query query(compared.index, global_heap());
    const auto& distances = exact.distances[i];
    const uint32_t source = ids[exact.sources[i]];
    std::vector<float> answers(compared.index.description.id_count);
    query.msad({&source, 1}, INFINITE, answers);
    for_each_comparison(
        answers, ids, too_short, [&](uint32_t v) { return distances[v]; },
        [&](double distance, double answer) {
            const double error = relative_error(distance, answer);
            if (counts_in_means)
                errors.by_distance.add_of_fields(distance, error);
            else
                errors.by_distance.add_to_max_of_fields(distance, error);
            errors.of_msad.push_back((answer - distance) / distance);
        });
    Random random(compared.index.description.seed ^ PAIR_SEED ^ i);
    for (uint32_t k = 0; k < pairs; ++k) {
        const uint32_t v = random.below(static_cast<uint32_t>(distances.size()));
        if (!has_relative_error(distances[v], too_short.up_to(v))) continue;
        const double answer = query.sssd(source, ids[v]);
        errors.by_distance.of(distances[v]).add_to_max(relative_error(distances[v], answer));
    }
    return errors;
}

// Adds the errors by distance, and returns those of MSAD.
std::vector<double> add_errors_of_fields(const Compared& compared, const ExactFields& exact,
                                         bool counts_in_means, uint32_t pairs, Workers& workers,
                                         ErrorsByDistance& errors) {
    std::vector<FieldErrors> of_source(exact.sources.size(),
                                       {ErrorsByDistance(compared.scale.average_edge), {}});
    workers.run(of_source.size(), [&](FieldSolver&, size_t i) {
        of_source[i] = errors_of_field(compared, exact, i, counts_in_means, pairs);
    });
    std::vector<double> of_msad;
    for (const FieldErrors& of_one : of_source) {
        errors.add(of_one.by_distance);
        of_msad.insert(of_msad.end(), of_one.of_msad.begin(), of_one.of_msad.end());
    }
    return of_msad;
}

// The figures that measure_error() took of the tables alone, taken again of the index, which may hold
// measured pairs by now. How exact paths over vertices are does not change by these.
MeasuredError with_measured_pairs(const Description& about, std::vector<double> errors) {
    MeasuredError stated = summary(std::move(errors), about.error.sources);
    stated.mean_at_vertices = crosses_between_vertices(about) ? about.error.mean_at_vertices : stated.mean;
    return stated;
}

ErrorSum error_of_several(const Compared& compared, const ExactFields& exact, uint32_t rounds,
                          Workers& workers) {
    if (rounds == 0) return errors_of_known_groups(compared, exact, workers);
    const uint64_t seed = compared.index.description.seed ^ GROUP_SEED;
    const auto groups = source_groups(compared.index, compared.intake, rounds, seed);
    return errors_of_groups(compared, groups, workers);
}

// Searches for large errors, near and at all distances, and adds them to the maxima.
void add_largest_errors(const Compared& compared, const Effort& effort, Workers& workers,
                        ErrorsByDistance& errors) {
    const uint64_t seed = compared.index.description.seed;
    NearSearch near(compared);
    near.run(effort.near, seed ^ NEAR_SEED, workers);
    errors.add(near.errors());
    if (effort.two_way.sources == 0) return;
    TwoWaySearch two_way(compared);
    two_way.run(effort.two_way, seed ^ TWO_WAY_SEED, workers);
    errors.add(two_way.errors());
}

// The largest errors that were seen, if these are of nearly all pairs, or those that are to be expected.
void state_largest(const ErrorsByDistance& errors, const ErrorSum& several, bool is_complete,
                   MeasuredError& stated) {
    const auto largest = [&](const ErrorSum& sum) {
        return is_complete ? sum.largest() : sum.expected_largest();
    };
    for (size_t c = 0; c < DISTANCE_CLASSES; ++c) {
        stated.by_distance[c] = {errors.sums()[c].mean(), largest(errors.sums()[c])};
        stated.max = std::max(stated.max, stated.by_distance[c].max);
    }
    // The least of distances that are each off by no more than some share is off by no more than that.
    stated.several = {several.mean(), std::max(several.largest(), largest(errors.of_fields()))};
}

}

void state_errors(const Intake& intake, const DistanceScale& scale,
                  std::span<const ExactFields* const> fields, const std::optional<ErrorsByDistance>& known,
                  Workers& workers, Index& index) {
    const Description& about = index.description;
    const ExactFields& measuring = *fields.front();
    const Compared compared{index, intake, scale};
    const Effort effort = effort_for(about, known.has_value(), intake.mesh.vertex_count());
    ErrorsByDistance errors = known.value_or(ErrorsByDistance(scale.average_edge));
    MeasuredError stated = about.error;
    for (const ExactFields* exact : fields) {
        const bool is_measuring = exact == &measuring;
        auto of_msad = add_errors_of_fields(compared, *exact, is_measuring, effort.pairs, workers, errors);
        if (is_measuring && (known || crosses_between_vertices(about)))
            stated = with_measured_pairs(about, std::move(of_msad));
    }
    add_largest_errors(compared, effort, workers, errors);
    const ErrorSum several = error_of_several(compared, measuring, effort.rounds, workers);
    state_largest(errors, several, effort.is_complete, stated);
    index.description.error = stated;
    release_pairs(index);
}

}
