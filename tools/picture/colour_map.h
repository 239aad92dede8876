#pragma once

#include <vector>

#include "tools/picture/vector.h"

namespace geodesic::tools {

// Linear-light RGB, 0 .. 1.
using Colour = Vec3;

Colour linear_from_srgb(Colour srgb);
Colour srgb_from_linear(Colour linear);

// Of what cannot be reached.
inline constexpr Colour UNREACHABLE_COLOUR{0.42, 0.42, 0.42};

// From light yellow (0) over red and violet to deep blue (1). Equal steps look equally large: it is an even
// walk along a curve in the Oklab colour space, whose lightness falls all the way.
class ColourMap {
public:
    ColourMap();
    Colour operator()(double t) const;
    // `largest` is that of all finite distances.
    Colour of_distance(double distance, double largest) const;

private:
    std::vector<Colour> table_;
};

}
