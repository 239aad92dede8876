#pragma once

#include "src/index/index.h"

namespace geodesic {

// Fills what the overlay tables hold besides the distances of the file, from these and their quanta: the
// codes of two vertices on one border, the coarse tables and the middle tables.
void derive_tables(Index& index);

}
