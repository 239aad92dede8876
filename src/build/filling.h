#pragma once

#include <optional>
#include <vector>

#include "src/build/relative_errors.h"
#include "src/index/stored.h"
#include "src/mesh/intake.h"
#include "src/partition/hierarchy.h"
#include "src/tables/measured_tables.h"
#include "src/tables/near_distances.h"

namespace geodesic {

// A mesh of the same surface as the caller's, split into patches. Its first vertices are those of the
// caller's mesh, with their numbers; others are added vertices.
struct SplitSurface {
    const Mesh& mesh;
    const Hierarchy& hierarchy;
};

// Fills an index from a hierarchy. May be called again with finer meshes of the same surface: what was solved
// for the first is used again.
class Filling {
public:
    // The options are complete and checked. `about` has all but the errors, and what is filled becomes
    // `index`.
    Filling(const Intake& intake, const geoidx_build_options& options, const Description& about,
            Index& index);

    // From the borders to the measured index, which is prepared, too. The workers' metric is of this mesh.
    // For `measured` see fill_overlay_tables().
    StoredIndex fill(const SplitSurface& surface, Workers& workers, std::optional<MeasuredTables>* measured);

    // What was solved for fill(): first the fields that the error was measured by, then those that the index
    // was calibrated by, if it was.
    std::vector<const ExactFields*> solved_fields() const;

    // What fill() found near each vertex, if the metric is one for which that is kept.
    std::optional<NearDistances>& near_distances() { return near_; }

    // The number of table entries that fill() would make.
    uint64_t count_entries(const SplitSurface& surface, Workers& workers) const;

private:
    std::vector<uint32_t> lay_out_vertices(const SplitSurface& surface, Workers& workers,
                                           StoredIndex& stored) const;
    void fill_tables(const SplitSurface& surface, std::span<const uint32_t> vertex_of_number,
                     Workers& workers, StoredIndex& stored, std::optional<MeasuredTables>* measured);
    const ExactFields& fields(std::optional<ExactFields>& fields, uint64_t seed, Workers& workers) const;

    const Intake& intake_;
    const geoidx_build_options& options_;
    const Description& about_;
    Index& index_;
    // Solved once, since distances between vertices of the caller's are the same on all meshes.
    std::optional<ExactFields> calibration_, measuring_;
    std::optional<NearDistances> near_; // taken once for each vertex, for the same reason
};

}
