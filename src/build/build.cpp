#include "src/build/build.h"

#include <cmath>
#include <string>

#include "format/error.h"
#include "src/base/threads.h"
#include "src/build/calibration.h"
#include "src/build/measure.h"
#include "src/build/metric_options.h"
#include "src/index/stored.h"
#include "src/partition/hierarchy.h"
#include "src/tables/borders.h"
#include "src/tables/fill.h"
#include "src/tables/layout.h"
#include "src/tables/overlay_fill.h"
#include "src/tables/pruning.h"

namespace geodesic {

namespace {

constexpr double TABLES_END = 0.91; // the share of the work that is done when all tables are filled

[[noreturn]] void invalid(const std::string& detail) { throw Error(GEOIDX_ERROR_INVALID_ARGUMENT, detail); }

void check_options(const geoidx_build_options& options) {
    if (!(options.delta >= 0 && options.delta <= 100))
        invalid("delta is " + std::to_string(options.delta) + ", not in 0 .. 100 %");
    if (!(options.rounding >= 0 && options.rounding <= 1))
        invalid("rounding is " + std::to_string(options.rounding) + ", not in 0 .. 1");
    if (options.level_count > GEOIDX_MAX_LEVELS)
        invalid("level_count is " + std::to_string(options.level_count) + ", more than " +
                std::to_string(GEOIDX_MAX_LEVELS));
    thread_count(options.threads);
    if (options.lloyd_iterations > 1000)
        invalid("lloyd_iterations is " + std::to_string(options.lloyd_iterations) + ", more than 1000");
    if (options.engine > GEOIDX_ENGINE_OVERLAY)
        invalid("engine " + std::to_string(options.engine) + " is not a GEOIDX_ENGINE_*");
    if (options.metric_flags & ~uint32_t{GEOIDX_METRIC_UNFOLDABLE})
        invalid("metric_flags is " + std::to_string(options.metric_flags) + ", which has unknown flags");
}

HierarchyOptions hierarchy_options(const Intake& intake, const geoidx_build_options& options) {
    HierarchyOptions result;
    const uint32_t vertices = intake.mesh.vertex_count();
    result.split = automatic_split(vertices, options.level_count, options.patches,
                                   options.engine == GEOIDX_ENGINE_OVERLAY ? OVERLAY_SPLIT : GRAPH_SPLIT);
    for (size_t level = 0; level < result.split.size(); ++level)
        result.in_proportion.push_back(options.patches[level] == 0);
    result.lloyd_iterations = options.lloyd_iterations;
    result.seed = options.seed;
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

void fill_tables(const Mesh& mesh, const Hierarchy& hierarchy, std::span<const uint32_t> vertex_of_number,
                 const geoidx_build_options& options, Workers& workers, StoredIndex& stored) {
    if (options.engine == GEOIDX_ENGINE_GRAPH) return fill_graph_tables(vertex_of_number, workers, stored);
    const bool unfold = (stored.description.metric_flags & GEOIDX_METRIC_UNFOLDABLE) != 0;
    fill_overlay_tables(mesh, hierarchy.leaf_of_face, vertex_of_number,
                        {options.exact_vertices, options.rounding, unfold, TABLES_END}, workers, stored);
}

ProgressFunction progress_function(const geoidx_build_options& options) {
    if (!options.progress) return {};
    return [&options](double fraction, const char* stage) {
        return options.progress(options.progress_user, static_cast<float>(fraction), stage) != 0;
    };
}

}

void build_index(const geoidx_mesh& mesh, const geoidx_build_options& options, Index& index) {
    check_options(options);
    const ProgressFunction progress = progress_function(options);
    if (progress && !progress(0, "mesh")) throw_cancelled();
    const Intake intake = take_in(mesh, intake_options(options));
    const auto metric = make_metric(mesh, intake, options);
    Workers workers(*metric, options.threads, progress);
    StoredIndex stored;
    stored.description = describe(intake, options);

    workers.begin_stage("patches", 0.1);
    const Hierarchy hierarchy = build_hierarchy(intake.mesh, hierarchy_options(intake, options), workers);
    workers.begin_stage("borders", 0.13);
    const auto leaves_at_vertex = leaves_at_vertices(intake.mesh, hierarchy);
    const auto is_border = merge_border_vertices(intake.mesh, leaves_at_vertex,
                                                 options.delta / 100 * intake.bounding_box_diagonal, workers);
    const auto vertex_of_number = lay_out(intake, hierarchy, leaves_at_vertex, is_border, workers, stored);
    workers.begin_stage("tables", options.engine == GEOIDX_ENGINE_OVERLAY ? 0.88 : TABLES_END);
    fill_tables(intake.mesh, hierarchy, vertex_of_number, options, workers, stored);
    workers.begin_stage("calibration", 0.95);
    calibrate(vertex_of_number, workers, stored);
    workers.begin_stage("accuracy", 1);
    workers.run(1, [&](FieldSolver&, size_t) { prepare(stored, index); });
    index.description.error = measure_error(index, vertex_of_number, workers);
}

}
