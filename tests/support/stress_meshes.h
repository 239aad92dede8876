#pragma once

#include <random>
#include <span>

#include "tests/support/meshes.h"

namespace geodesic::test {

// Meshes that are hard on distances: each call of `draw` gives another one, of about 10 to 1,000 vertices.
struct StressFamily {
    const char* name;
    Soup (*draw)(std::mt19937_64& random);
};

// Oriented manifolds: slivers, fans of needles, bent strips, tori, saddles, grids of equal distances, bumpy
// spheres, plates with holes whose flat faces are cut into slivers.
std::span<const StressFamily> stress_families();

// What is no oriented manifold: mixed winding, Moebius strips, sheets that share a vertex, edges of three
// triangles.
std::span<const StressFamily> unorientable_families();

// Each coordinate multiplied by the factor of its axis.
Soup scaled(Soup soup, double x, double y, double z);

}
