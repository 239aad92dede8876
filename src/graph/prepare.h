#pragma once

#include "src/graph/tables.h"
#include "src/index/stored.h"

namespace geodesic {

// Fills an empty index of the graph engine from what is stored: border tables are unfolded into squares.
// Throws as number_vertices() does.
void prepare_graph(const StoredIndex& stored, GraphIndex& index);

// The opposite: fills all of `stored` but the description and the ids.
void restore_graph(const GraphIndex& index, StoredIndex& stored);

}
