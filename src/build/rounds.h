#pragma once

#include <optional>

#include "src/build/filling.h"
#include "src/build/finer_borders.h"
#include "src/build/point_errors.h"

namespace geodesic {

// The share of the whole work that the first filling is, if rounds may follow.
inline constexpr double FIRST_FILLING_END = 0.7;

// Where answers are less exact than the options ask for, vertices are added to the borders of patches and the
// index is filled again. This is done in up to five rounds, until the error is small enough or hardly becomes
// smaller, or until there is nothing to cut or no room for more.
class Rounds {
public:
    // `flipped` is what flip_flat_edges() returns for the mesh of the intake.
    Rounds(const Intake& intake, const std::optional<FlippedEdges>& flipped,
           const geoidx_build_options& options, const ProgressFunction& progress, Filling& filling,
           Index& index)
        : intake_(intake), flipped_(flipped), options_(options), progress_(progress), filling_(filling),
          index_(index) {}

    // `filled` is what the filling made of this surface, which has no added vertices, and what the index was
    // prepared from; `measured` is what it measured for that. Afterwards the index is that of the last round
    // that was worth its added vertices, or the first one.
    void run(const SplitSurface& surface, const Metric& metric, StoredIndex filled,
             std::optional<MeasuredTables> measured);

private:
    double first_error(const Metric& metric);
    double error_of_index(Workers& workers) const;
    std::optional<FinerSurface> finer_surface(const SplitSurface& surface, const Metric& metric,
                                              uint32_t round, double error) const;
    std::optional<FinerSurface> cut_what_fits(const SplitSurface& surface, std::span<const BorderEdge> edges,
                                              Workers& workers) const;
    bool fits(const FinerSurface& surface, Workers& workers) const;

    const Intake& intake_;
    const std::optional<FlippedEdges>& flipped_;
    const geoidx_build_options& options_;
    const ProgressFunction& progress_;
    Filling& filling_;
    Index& index_;
    std::optional<PointErrors> of_points_; // where edges are so long that points are less exact than vertices
    uint64_t most_entries_ = 0;
};

}
