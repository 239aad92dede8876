#pragma once

#include <functional>

#include "src/overlay/tables.h"

namespace geodesic {

// Fills the labels of a prepared index. It calls look_up() from time to time, which may throw to cancel.
void make_labels(OverlayIndex& index, const std::function<void()>& look_up);

}
