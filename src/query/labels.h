#pragma once

#include <functional>

#include "src/index/index.h"

namespace geodesic {

// Fills the labels of an index of the overlay engine; nothing of another. Calls look_up() every now and then,
// which may throw.
void make_labels(Index& index, const std::function<void()>& look_up);

}
