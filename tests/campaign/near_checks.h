#pragma once

#include "tests/campaign/subject.h"

namespace geodesic::campaign {

// The queries of what is near, and matrices, against the fields and pairs whose bits they must have.
// `sources` are some of the mesh, and `field` is that of all of them.
void check_near(const Subject& subject, std::span<const uint32_t> sources, const Floats& field, Dice& dice);

}
