#pragma once

#include <memory>
#include <span>

#include "src/mesh/mesh.h"
#include "src/metric/metric.h"

namespace geodesic {

// Rough geodesic distances in the time of a search along the edges (Kimmel and Sethian 1998). A front passes
// the vertices from the nearest on. From two vertices of a face whose distances are known, the third one gets
// that of the point in the plane from which both are as far, if the straight way from there crosses the edge
// between them, and otherwise that of a way along an edge. On meshes of even triangles distances are some
// percent too long or too short; where triangles are obtuse, they are those along edges, than which no
// distance is longer.
class FastMarchingMetric final : public Metric {
public:
    // lengths[e] of every edge of the mesh, finite and not negative.
    FastMarchingMetric(const Mesh& mesh, std::span<const double> lengths);
    std::unique_ptr<FieldSolver> make_solver() const override;

    // A face seen from one of its vertices: the two others, how far they are from it, and from each other.
    struct Corner {
        uint32_t first, second;
        double to_first, to_second, between;
    };

private:
    std::shared_ptr<const ListOfLists<Corner>> corners_; // per vertex
};

}
