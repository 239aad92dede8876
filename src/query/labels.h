#pragma once

#include "src/index/index.h"

namespace geodesic {

// Fills the labels of an index of the overlay engine; nothing of another.
void make_labels(Index& index);

}
