#pragma once

#include <algorithm>
#include <cstdint>
#include <optional>
#include <vector>

#include "src/mesh/flat_edges.h"
#include "src/mesh/intake.h"
#include "src/metric/workers.h"
#include "src/query/index.h"
#include "src/surface/surface.h"

namespace geodesic {

// From how many sources rounds of added vertices look at a surface. Fields of small meshes are short, and
// more of them together see more of all edges.
inline uint32_t source_count_of_rounds(uint32_t vertex_count) {
    constexpr uint32_t FEWEST = 20, MOST = 100, VERTICES_IN_ALL = 1 << 18;
    return std::clamp(VERTICES_IN_ALL / vertex_count, FEWEST, MOST);
}

// Whether edges are long on a sixteenth of a surface, so that points there are worth asking.
bool have_long_edges(const Mesh& mesh);

// Compares fields from random points within faces with the metric, where edges are long: there, they are less
// exact than fields from vertices. Each index on the same surface is compared with the same distances.
class PointErrors {
public:
    // `flipped` is what flip_flat_edges() returns for the mesh of the intake. The metric of the workers is
    // the exact one of the faces that the index is made on.
    PointErrors(const Intake& intake, const std::optional<FlippedEdges>& flipped, uint64_t seed,
                Workers& workers);

    // The relative errors of MSAD from each of the points alone.
    MeasuredError measure(const Index& index, Workers& workers) const;

private:
    void choose_points(const std::vector<double>& areas, uint64_t seed);

    Surface surface_;
    std::vector<SurfacePoint> points_;
    std::vector<std::vector<double>> distances_; // by the metric: of each point, per vertex
};

}
