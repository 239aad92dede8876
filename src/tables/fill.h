#pragma once

#include <span>

#include "src/concurrency/workers.h"
#include "src/index/index.h"

namespace geodesic {

// Fills the tables of a laid out index with distances on the whole surface (paper 3.2), and bound_scale.
// vertex_of_number: the mesh vertex of each number.
void fill_graph_tables(Index& index, std::span<const uint32_t> vertex_of_number, Workers& workers);

}
