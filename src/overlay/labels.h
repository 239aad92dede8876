#pragma once

#include <functional>

#include "src/overlay/tables.h"

namespace geodesic {

// Fills the labels of a prepared index. Calls look_up() every now and then, which may throw. Throws Error
// LIMIT where labels would be out of proportion to the tables.
void make_labels(OverlayIndex& index, const std::function<void()>& look_up);

}
