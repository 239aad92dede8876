#pragma once

#include <optional>

#include "src/build/filling.h"
#include "src/build/finer_borders.h"

namespace geodesic {

// The share of the whole work that the first filling is, if rounds may follow.
inline constexpr double FIRST_FILLING_END = 0.7;

// Tells the progress of a part of the work, 0 .. 1, as that of the whole.
ProgressFunction part_of_progress(const ProgressFunction& whole, double begin, double end);

// Where answers are less exact than the options ask for, vertices are added to the borders of patches and the
// index is filled again. This is done in up to five rounds, until the error is small enough or does not
// become smaller, or until there is nothing to cut or no room for more.
class Rounds {
public:
    Rounds(const geoidx_build_options& options, const ProgressFunction& progress, Filling& filling,
           Index& index)
        : options_(options), progress_(progress), filling_(filling), index_(index) {}

    // `filled` is what the filling made of this surface, which has no added vertices, and what the index was
    // prepared from; `measured` is what it measured for that. Afterwards the index is the one with the
    // smallest error of all that were tried.
    void run(const SplitSurface& surface, const Metric& metric, StoredIndex filled,
             std::optional<MeasuredTables> measured);

private:
    std::optional<FinerSurface> finer_surface(const SplitSurface& surface, double error,
                                              Workers& workers) const;
    std::optional<FinerSurface> cut_what_fits(const SplitSurface& surface, std::span<const BorderEdge> edges,
                                              Workers& workers) const;
    bool fits(const FinerSurface& surface, Workers& workers) const;

    const geoidx_build_options& options_;
    const ProgressFunction& progress_;
    Filling& filling_;
    Index& index_;
    uint32_t vertex_count_ = 0; // without added vertices
    uint64_t most_entries_ = 0;
};

}
