#pragma once

#include <vector>

#include "geoidx.h"
#include "tests/campaign/oracle.h"
#include "tests/campaign/random_options.h"
#include "tests/support/handles.h"

namespace geodesic::campaign {

using test::IndexHandle;
using test::QueryHandle;
using test::SolverHandle;
using test::SurfaceHandle;

// A call that must succeed.
void succeed(geoidx_status status, const char* call);

// A mesh and its options as the library takes them, with all arrays that they point to.
class BuildInput {
public:
    BuildInput(const test::Soup& soup, const CaseOptions& chosen);
    BuildInput(const BuildInput&) = delete;
    BuildInput& operator=(const BuildInput&) = delete;

    const geoidx_mesh& mesh() const { return mesh_; }
    const geoidx_build_options& options() const { return options_; }
    const Surface& surface() const { return surface_; }
    // The metric knows the ways along edges, and finds none of them longer than the sum of these; by
    // Surface::edges().
    const std::vector<double>& edge_bounds() const { return edge_bounds_; }
    // Whether tables may be made of other edges than the mesh has, in its planes.
    bool may_flip_edges() const {
        return options_.metric == GEOIDX_METRIC_EXACT && surface_.has_flat_edges(soup_);
    }
    Eigen::Vector3d position(uint32_t id) const { return soup_.positions[id]; }
    // No metric of this kind is shorter.
    double straight(uint32_t a, uint32_t b) const;

    // The cost of a unit of length on a triangle.
    double face_cost(uint32_t triangle) const { return face_costs_.empty() ? 1 : face_costs_[triangle]; }
    // Whether paths begin and end at vertices only.
    bool has_paths_of_vertices_only() const { return !edge_costs_.empty() || has_own_distances(); }
    bool has_own_distances() const { return options_.metric == GEOIDX_METRIC_CALLBACK; }
    // Whether a piece of a path costs its length, times the cost of its triangle.
    bool has_costs_by_length() const { return edge_costs_.empty() && !has_own_distances(); }

    SolverHandle make_solver() const;
    SurfaceHandle make_surface() const;

private:
    static geoidx_status answer(void* user, uint32_t source, const uint32_t* targets, uint32_t count,
                                double* distances);
    void allow_for_faces_without_area();
    void give_lengths();
    void give_edge_costs();
    void give_face_costs();
    void measure_callback();
    double random_cost(uint64_t a, uint64_t b) const;

    CaseOptions chosen_;
    std::vector<float> positions_; // if the library is given floats
    test::Soup soup_;
    Surface surface_;
    geoidx_mesh mesh_;
    geoidx_build_options options_;
    std::vector<double> edge_bounds_, edge_costs_, face_costs_, lengths_;
    std::vector<double> square_; // distances of the callback
};

}
