#pragma once

#include <span>
#include <vector>

#include "src/path/surface.h"
#include "src/query/query.h"

namespace geodesic {

// Distances of points of a surface by an index of its mesh.
class PointQueries {
public:
    // Throws Error MESH_MISMATCH where the index is of another mesh, and INVALID_ARGUMENT where its metric
    // does not tell what a way within a face costs.
    PointQueries(const Index& index, Query& query, const Surface& surface);

    float sssd(const SurfacePoint& source, const SurfacePoint& target);
    void msad(std::span<const SurfacePoint> sources, std::span<const float> offsets,
              std::span<float> distances);

    // The point as the query takes it.
    FacePoint face_point_of(const SurfacePoint& point) const;
    uint32_t number_of(uint32_t vertex) const { return index_.number_of_id[surface_.id_of_vertex[vertex]]; }
    bool unfolds() const;

private:
    void add_known_ways(const SurfacePoint& source, float offset, std::vector<Query::KnownWay>& known) const;

    const Index& index_;
    Query& query_;
    const Surface& surface_;
};

}
