#pragma once

#include <span>

#include "src/index/stored.h"
#include "src/metric/workers.h"

namespace geodesic {

// Fills the tables of the graph engine with distances on the whole surface (paper 3.2), and the bound scale.
// The layout must be stored already. vertex_of_number gives the mesh vertex of each number.
void fill_graph_tables(std::span<const uint32_t> vertex_of_number, Workers& workers, StoredIndex& stored);

}
