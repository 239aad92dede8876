#include "src/build/rounds.h"

#include <algorithm>
#include <memory>
#include <utility>

#include "format/error.h"
#include "src/build/metric_options.h"
#include "src/metric/window_propagation.h"
#include "src/partition/random.h"

namespace geodesic {

namespace {

constexpr uint32_t MOST_ROUNDS = 5; // which leave 32nds of an edge

// A round is kept where it reaches the target or leaves at most this share of the error: its added vertices
// cost entries.
constexpr double WORTHWHILE = 0.95;

// How many times the table entries of the index without added vertices there may be, in halves. Packed files
// then grow to twice their size or little more, since positions and ids do not grow with the tables.
constexpr uint64_t MOST_GROWTH_IN_HALVES = 5;

// There may always be so many, which take some 100 KB in a packed file: more than twice what a small mesh has
// without added vertices.
constexpr uint64_t FEW_ENTRIES = 1 << 17;

// Where the first round begins in the whole work. Before it, fields from points are measured.
constexpr double ROUNDS_BEGIN = FIRST_FILLING_END + 0.02;

// Where round i begins. How many rounds there will be is not known before.
double begin_of_round(uint32_t i) {
    return ROUNDS_BEGIN + (1 - ROUNDS_BEGIN) * static_cast<double>(i) / MOST_ROUNDS;
}

// A round begins with choosing edges, which is a tenth of it.
double end_of_choosing(uint32_t i) { return 0.9 * begin_of_round(i) + 0.1 * begin_of_round(i + 1); }

std::vector<uint32_t> choosing_sources(uint64_t seed, uint32_t vertex_count) {
    constexpr uint64_t CHOOSING_SEED = 0x63686F6F7365;
    Random random(seed ^ CHOOSING_SEED);
    std::vector<uint32_t> sources(source_count_of_rounds(vertex_count));
    for (uint32_t& source : sources) source = random.below(vertex_count);
    return sources;
}

// The share of all deviations that the edges to cut have together. Cutting all border edges of a low-poly
// mesh makes the error two to three times smaller, so that this is enough where the error is not far from
// what is asked for. Less than half is not worth a round, and the last few percent are those of a third of
// the edges.
double share_to_cut(double error, double target) {
    constexpr double LEAST = 0.5, MOST = 0.97;
    return std::clamp(2 * (1 - target / error), LEAST, MOST);
}

// What body() returns, or nothing if that is over a limit. An index with added vertices may be, where the one
// without them is not.
template <class Body>
auto unless_over_limit(const Body& body) -> std::optional<decltype(body())> {
    try {
        return body();
    } catch (const Error& error) {
        if (error.status != GEOIDX_ERROR_LIMIT) throw;
        return std::nullopt;
    }
}

// Whether corners and edges can still be counted when each face is cut into four.
bool can_be_cut(const Mesh& mesh) {
    return mesh.face_count() < NONE / 12 &&
           2 * size_t{mesh.edge_count()} + 3 * size_t{mesh.face_count()} <= MOST_EDGES;
}

}

void Rounds::run(const SplitSurface& surface, const Metric& metric, StoredIndex filled,
                 std::optional<MeasuredTables> measured) {
    most_entries_ = std::max<uint64_t>(FEW_ENTRIES, table_entries(index_) * MOST_GROWTH_IN_HALVES / 2);
    double error = first_error(metric);
    std::optional<FinerSurface> finer; // of the latest round, with its metric
    std::unique_ptr<const Metric> finer_metric;
    for (uint32_t i = 0; i < MOST_ROUNDS && error > options_.target_error; ++i) {
        auto next = finer ? finer_surface({finer->mesh, finer->hierarchy}, *finer_metric, i, error)
                          : finer_surface(surface, metric, i, error);
        if (!next) break;
        finer = std::move(next);
        finer_metric = std::make_unique<ExactMetric>(finer->mesh, tolerance_of_tables(options_));
        Workers workers(*finer_metric, options_.threads,
                        part_of_progress(progress_, end_of_choosing(i), begin_of_round(i + 1)));
        auto again = unless_over_limit([&] {
            return filling_.fill({finer->mesh, finer->hierarchy}, workers, &measured);
        });
        const double error_now = again ? error_of_index(workers) : INFINITE;
        if (!again || error_now > std::max(options_.target_error, WORTHWHILE * error)) {
            workers.run(1, [&](FieldSolver&, size_t) { prepare(filled, index_); });
            break;
        }
        filled = std::move(*again);
        error = error_now;
    }
    if (progress_ && !progress_(1, "accuracy")) throw_cancelled();
}

// Points are asked where edges are long: on scans they are as exact as vertices.
double Rounds::first_error(const Metric& metric) {
    if (!have_long_edges(intake_.mesh)) return index_.description.error.mean;
    constexpr uint64_t POINT_SEED = 0x706F696E7473;
    Workers workers(metric, options_.threads, part_of_progress(progress_, FIRST_FILLING_END, ROUNDS_BEGIN));
    workers.begin_stage("accuracy", 1);
    of_points_.emplace(intake_, flipped_, options_.seed ^ POINT_SEED, workers);
    return error_of_index(workers);
}

// The larger one of the mean errors of fields from vertices and from points. A mean over a whole surface
// hides what the few points see that are beside long edges: so the p99.9 of the errors from points counts,
// too. It may be 1 % by default, more than it is on meshes whose points are about as exact as their vertices.
// Pairs that tables have wrong are not measured yet.
double Rounds::error_of_index(Workers& workers) const {
    constexpr double TAIL = 20;
    const double of_vertices = index_.description.error.mean;
    if (!of_points_) return of_vertices;
    const MeasuredError of_points = of_points_->measure(index_, workers);
    return std::max({of_vertices, of_points.mean, of_points.p999 / TAIL});
}

// Nothing if there is no edge that would make paths more exact, or no room for more table entries.
std::optional<FinerSurface> Rounds::finer_surface(const SplitSurface& surface, const Metric& metric,
                                                  uint32_t round, double error) const {
    Workers workers(metric, options_.threads,
                    part_of_progress(progress_, begin_of_round(round), end_of_choosing(round)));
    workers.begin_stage("finer borders", 1);
    if (!can_be_cut(surface.mesh)) return std::nullopt;
    const auto sources = choosing_sources(options_.seed, intake_.mesh.vertex_count());
    const ShortDistances& too_short = filling_.solved_fields().front()->too_short;
    const auto edges =
        border_edges(surface.mesh, surface.hierarchy.leaf_of_face, sources, too_short, workers);
    const size_t wanted = count_for_share(edges, share_to_cut(error, options_.target_error));
    return cut_what_fits(surface, std::span(edges).first(wanted), workers);
}

// Cuts all of these edges or, if that gives too many table entries, about as many as possible, from the first
// one on. Where this is less than an eighth of them, none.
std::optional<FinerSurface> Rounds::cut_what_fits(const SplitSurface& surface,
                                                  std::span<const BorderEdge> edges, Workers& workers) const {
    const auto cut = [&](size_t count) {
        return with_finer_borders(surface.mesh, surface.hierarchy, edges.first(count));
    };
    if (edges.empty()) return std::nullopt;
    if (FinerSurface all = cut(edges.size()); fits(all, workers)) return all;
    size_t count = 0, too_many = edges.size();
    while (too_many - count > edges.size() / 32 + 1) {
        const size_t middle = (count + too_many) / 2;
        (fits(cut(middle), workers) ? count : too_many) = middle;
    }
    if (count == 0 || count < edges.size() / 8) return std::nullopt;
    return cut(count);
}

bool Rounds::fits(const FinerSurface& surface, Workers& workers) const {
    const auto entries = unless_over_limit([&] {
        return filling_.count_entries({surface.mesh, surface.hierarchy}, workers);
    });
    return entries && *entries <= most_entries_;
}

}
