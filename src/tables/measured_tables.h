#pragma once

#include <cstdint>
#include <memory_resource>
#include <span>
#include <vector>

#include "src/base/array.h"
#include "src/index/numbering.h"
#include "src/tables/distance_tables.h"

namespace geodesic {

// What was measured for the tables of a mesh, to be used again for the same hierarchy on a finer mesh of the
// same surface. That mesh has the vertices of this one, with their numbers, and others on the borders of
// leaves: the distances between these vertices are the same there, and so are the borders that they lie on,
// unless borders are pruned.
struct MeasuredTables {
    Numbering numbering{global_heap()};
    std::vector<uint32_t> number_of_vertex; // per vertex of the mesh
    DistanceTables tables;                  // of leaves and measured patches; none of others

    uint32_t vertex_count() const { return static_cast<uint32_t>(number_of_vertex.size()); }

    // Writes the distances between its vertices into the tables of the leaves and of the measured patches of
    // the finer mesh. All of these were measured here, since patches only get more vertices. vertex_of_number
    // gives the mesh vertex of each number.
    void copy_to(const Numbering& finer, std::span<const uint32_t> vertex_of_number,
                 std::span<const uint8_t> is_measured, DistanceTables& to) const;
};

}
