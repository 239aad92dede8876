#pragma once

#include "src/mesh/intake.h"
#include "src/query/index.h"

namespace geodesic {

// The number that an index gives a vertex of the mesh that it is built from.
inline uint32_t number_of_vertex(const Index& index, const Intake& intake, uint32_t vertex) {
    return index.number_of_id[intake.id_of_vertex[vertex]];
}

}
