#pragma once

#include "tests/campaign/dice.h"

namespace geodesic::campaign {

// A surface of one of many kinds, about one unit large, with roughly so many vertices: terrains, closed
// surfaces, tubes, boxes that touch, pages that meet in a spine, needles, soups. Most are in one piece; where
// two vertices have the same position, the library makes one of them.
test::Soup random_shape(Dice& dice, uint32_t vertices);

}
