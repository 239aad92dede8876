#include "src/build/build.h"

#include <cmath>
#include <memory>
#include <optional>
#include <string>
#include <utility>

#include "format/error.h"
#include "src/base/number_text.h"
#include "src/base/threads.h"
#include "src/build/filling.h"
#include "src/build/metric_options.h"
#include "src/build/rounds.h"
#include "src/build/stated_errors.h"
#include "src/build/steep_search.h"
#include "src/build/wrong_pairs.h"
#include "src/file/kept_mesh.h"
#include "src/index/stored.h"
#include "src/mesh/flat_edges.h"
#include "src/metric/edge_graph.h"
#include "src/metric/fast_marching.h"
#include "src/metric/window_propagation.h"
#include "src/partition/hierarchy.h"

namespace geodesic {

namespace {

constexpr double FILLING_END = 0.85; // the share of the whole work; looking for large errors is the rest
constexpr double WRONG_PAIRS_END = 0.5, STEEP_EDGES_END = 0.8; // shares of that rest

void check_options(const geoidx_build_options& options) {
    if (!(options.delta >= 0 && options.delta <= 100))
        refuse_argument("delta is " + number_text(options.delta) + ", not in 0 .. 100 %");
    if (!(options.rounding >= 0 && options.rounding <= 1))
        refuse_argument("rounding is " + number_text(options.rounding) + ", not in 0 .. 1");
    if (!(options.target_error >= 0 && options.target_error <= 1))
        refuse_argument("target_error is " + number_text(options.target_error) + ", not in 0 .. 1");
    if (options.level_count > GEOIDX_MAX_LEVELS)
        refuse_argument("level_count is " + std::to_string(options.level_count) + ", more than " +
                        std::to_string(GEOIDX_MAX_LEVELS));
    thread_count(options.threads);
    if (options.lloyd_iterations > 1000)
        refuse_argument("lloyd_iterations is " + std::to_string(options.lloyd_iterations) +
                        ", more than 1000");
    if (options.engine > GEOIDX_ENGINE_OVERLAY)
        refuse_argument("engine " + std::to_string(options.engine) + " is not a GEOIDX_ENGINE_*");
    if (options.store_mesh > 1)
        refuse_argument("store_mesh is " + std::to_string(options.store_mesh) + ", not 0 or 1");
    check_metric_options(options);
}

// Of which lengths of edges are the square roots: halfway between the metric and one that counts edges.
std::shared_ptr<const Metric> root_metric(const Mesh& surface, std::vector<double> lengths) {
    for (double& length : lengths) length = std::sqrt(length);
    return std::make_shared<FastMarchingMetric>(surface, lengths);
}

// `surface` has the edges of the intake's mesh wherever the caller gives lengths for these.
HierarchyOptions hierarchy_options(const geoidx_mesh& mesh, const Intake& intake, const Mesh& surface,
                                   const geoidx_build_options& options) {
    HierarchyOptions result;
    const uint32_t vertices = surface.vertex_count();
    result.split = automatic_split(vertices, options.level_count, options.patches,
                                   options.engine == GEOIDX_ENGINE_OVERLAY ? OVERLAY_SPLIT : GRAPH_SPLIT);
    for (size_t level = 0; level < result.split.size(); ++level)
        result.in_proportion.push_back(options.patches[level] == 0);
    result.lloyd_iterations = options.lloyd_iterations;
    result.seed = options.seed;
    result.edge_lengths = given_lengths(mesh, intake, options);
    if (result.edge_lengths.empty()) result.edge_lengths = edge_lengths(surface);
    if (options.metric == GEOIDX_METRIC_EXACT) {
        result.rough_metric = std::make_shared<FastMarchingMetric>(surface, result.edge_lengths);
        // Paths of the graph engine cross borders at vertices, which are far apart on long edges.
        if (options.engine == GEOIDX_ENGINE_OVERLAY)
            result.root_metric = root_metric(surface, result.edge_lengths);
    }
    return result;
}

Description describe(const Intake& intake, const geoidx_build_options& options) {
    Description about;
    about.id_count = intake.vertex_of_id.size();
    about.triangle_count = intake.face_of_triangle.size();
    about.mesh_fingerprint = intake.fingerprint;
    about.bounding_box_diagonal = intake.bounding_box_diagonal;
    about.seed = options.seed;
    about.engine = options.engine;
    about.metric = options.metric;
    about.metric_flags = metric_flags(options);
    about.metric_fingerprint = metric_fingerprint(options);
    about.delta = options.delta;
    about.codec = options.engine == GEOIDX_ENGINE_GRAPH ? GEOIDX_CODEC_LOSSLESS : GEOIDX_CODEC_PACKED;
    return about;
}

// Whether distances are those along the surface that the positions give, however it is cut into faces.
bool is_exact_by_positions(const geoidx_build_options& options) {
    return options.metric == GEOIDX_METRIC_EXACT && options.edge_length_count == 0;
}

bool may_add_vertices(const geoidx_build_options& options) {
    return options.target_error > 0 && options.engine == GEOIDX_ENGINE_OVERLAY &&
           is_exact_by_positions(options) && options.delta == 0;
}

ProgressFunction progress_function(const geoidx_build_options& options) {
    if (!options.progress) return {};
    return [&options](double fraction, const char* stage) {
        return options.progress(options.progress_user, static_cast<float>(fraction), stage) != 0;
    };
}

// What the first filling leaves for rounds of added vertices.
struct FirstFilling {
    Hierarchy hierarchy;
    StoredIndex stored;
    std::optional<MeasuredTables> measured; // only if rounds may follow
};

// Each step is given workers of its own, which end with the call: they have solvers of some 150 bytes a
// vertex.
FirstFilling first_filling(const Mesh& surface, const HierarchyOptions& hierarchy_options,
                           bool rounds_may_follow, Filling& filling, Workers&& workers) {
    workers.begin_stage("patches", 0.05);
    FirstFilling first{build_hierarchy(surface, hierarchy_options, workers), {}, {}};
    first.stored =
        filling.fill({surface, first.hierarchy}, workers, rounds_may_follow ? &first.measured : nullptr);
    return first;
}

// Makes the index hold what its tables have wrong, and states the errors that are left.
void correct_and_state_errors(const Intake& intake, Filling& filling, Workers&& workers, Index& index) {
    const auto scale = distance_scale(index.description, intake.mesh, *filling.solved_fields().front());
    std::optional<ErrorsByDistance> let_pass;
    if (filling.near_distances()) {
        let_pass =
            hold_wrong_pairs(intake, scale, *filling.near_distances(), workers, index, WRONG_PAIRS_END);
        filling.near_distances().reset();
        if (follows_positions(index.description)) hold_steep_edges(intake, workers, index, STEEP_EDGES_END);
    }
    workers.begin_stage("accuracy", 1);
    state_errors(intake, scale, filling.solved_fields(), let_pass, workers, index);
}

}

void build_index(const geoidx_mesh& mesh, const geoidx_build_options& options, Index& index) {
    check_options(options);
    const ProgressFunction progress = progress_function(options);
    if (progress && !progress(0, "mesh")) throw_cancelled();
    const Intake intake = take_in(mesh, intake_options(options));
    const auto flipped = is_exact_by_positions(options) ? flip_flat_edges(intake.mesh) : std::nullopt;
    const Mesh& surface = flipped ? flipped->mesh : intake.mesh;
    const double tolerance = tolerance_of_tables(options);
    const auto metric = flipped ? std::make_unique<ExactMetric>(surface, tolerance)
                                : make_metric(mesh, intake, options, tolerance);
    const Description about = describe(intake, options);
    const ProgressFunction filling_progress = part_of_progress(progress, 0, FILLING_END);
    const bool rounds_may_follow = may_add_vertices(options);
    const double first_end = rounds_may_follow ? FIRST_FILLING_END : 1;
    Filling filling(intake, options, about, index);
    FirstFilling first =
        first_filling(surface, hierarchy_options(mesh, intake, surface, options), rounds_may_follow, filling,
                      Workers(*metric, options.threads, part_of_progress(filling_progress, 0, first_end)));
    if (rounds_may_follow)
        Rounds(intake, flipped, options, filling_progress, filling, index)
            .run({surface, first.hierarchy}, *metric, std::move(first.stored), std::move(first.measured));
    correct_and_state_errors(intake, filling,
                             Workers(*metric, options.threads, part_of_progress(progress, FILLING_END, 1)),
                             index);
    if (options.store_mesh) keep_mesh(pack_mesh(mesh).view(), index);
}

}
