#include "src/build/filling.h"

#include <algorithm>
#include <cmath>

#include "src/base/array.h"
#include "src/build/calibration.h"
#include "src/build/measure.h"
#include "src/tables/borders.h"
#include "src/tables/fill.h"
#include "src/tables/layout.h"
#include "src/tables/overlay_fill.h"
#include "src/tables/pruning.h"

namespace geodesic {

namespace {

constexpr double TABLES_END = 0.91; // the share of the work that is done when all tables are filled

// Whether the metric finds what is near each vertex while it is solved for tables.
bool finds_near_distances(const Description& about) {
    if (about.engine != GEOIDX_ENGINE_OVERLAY || about.delta != 0) return false;
    return about.metric == GEOIDX_METRIC_WEIGHTED ||
           (about.metric == GEOIDX_METRIC_EXACT && follows_positions(about));
}

// With how many vertices around each one answers are compared at first: as far as wrong ones are frequent,
// which is some ten edges on scans, and on weighted surfaces as far as tables are measured anyway, since more
// would take long. On very large meshes they are fewer, so that they take no more than 1.5 GB, and twice that
// where hold_wrong_pairs() looks much farther.
uint32_t compared_around(const Description& about, uint32_t vertex_count) {
    constexpr uint64_t VERTICES = 400000;
    const uint64_t most = about.metric == GEOIDX_METRIC_WEIGHTED ? 120 : 480;
    return static_cast<uint32_t>(std::clamp<uint64_t>(most * VERTICES / vertex_count, 1, most));
}

}

Filling::Filling(const Intake& intake, const geoidx_build_options& options, const Description& about,
                 Index& index)
    : intake_(intake), options_(options), about_(about), index_(index) {
    if (finds_near_distances(about))
        near_.emplace(intake.mesh.vertex_count(), compared_around(about, intake.mesh.vertex_count()));
}

StoredIndex Filling::fill(const SplitSurface& surface, Workers& workers,
                          std::optional<MeasuredTables>* measured) {
    StoredIndex stored;
    stored.description = about_;
    workers.begin_stage("borders", 0.06);
    const auto vertex_of_number = lay_out_vertices(surface, workers, stored);
    workers.begin_stage("tables", options_.engine == GEOIDX_ENGINE_OVERLAY ? 0.88 : TABLES_END);
    fill_tables(surface, vertex_of_number, workers, stored, measured);
    workers.begin_stage("calibration", 0.95);
    if (crosses_between_vertices(about_))
        calibrate(fields(calibration_, CALIBRATION_SEED, workers), vertex_of_number, workers, stored);
    workers.begin_stage("accuracy", 1);
    workers.run(1, [&](FieldSolver&, size_t) { prepare(stored, index_); });
    index_.description.error =
        measure_error(index_, fields(measuring_, MEASURING_SEED, workers), vertex_of_number, workers);
    stored.description = index_.description;
    return stored;
}

std::vector<const ExactFields*> Filling::solved_fields() const {
    std::vector<const ExactFields*> solved;
    for (const auto* fields : {&measuring_, &calibration_})
        if (*fields) solved.push_back(&**fields);
    return solved;
}

uint64_t Filling::count_entries(const SplitSurface& surface, Workers& workers) const {
    StoredIndex stored;
    lay_out_vertices(surface, workers, stored);
    Numbering numbering(global_heap());
    number_vertices(stored, numbering);
    return numbering.overlay_engine_entries();
}

std::vector<uint32_t> Filling::lay_out_vertices(const SplitSurface& surface, Workers& workers,
                                                StoredIndex& stored) const {
    const auto leaves_at_vertex = leaves_at_vertices(surface.mesh, surface.hierarchy);
    const auto is_border = merge_border_vertices(
        surface.mesh, leaves_at_vertex, options_.delta / 100 * intake_.bounding_box_diagonal, workers);
    return lay_out(surface.mesh, intake_.vertex_of_id, surface.hierarchy, leaves_at_vertex, is_border,
                   workers, stored);
}

void Filling::fill_tables(const SplitSurface& surface, std::span<const uint32_t> vertex_of_number,
                          Workers& workers, StoredIndex& stored, std::optional<MeasuredTables>* measured) {
    if (options_.engine == GEOIDX_ENGINE_GRAPH) return fill_graph_tables(vertex_of_number, workers, stored);
    const bool unfold = (about_.metric_flags & GEOIDX_METRIC_UNFOLDABLE) != 0;
    fill_overlay_tables(surface.mesh, surface.hierarchy.leaf_of_face, vertex_of_number,
                        {options_.exact_vertices, options_.rounding, unfold, TABLES_END}, workers, stored,
                        near_ ? &*near_ : nullptr, measured);
}

const ExactFields& Filling::fields(std::optional<ExactFields>& fields, uint64_t seed,
                                   Workers& workers) const {
    if (!fields) fields = exact_fields(about_, intake_.mesh, about_.seed ^ seed, workers);
    return *fields;
}

}
