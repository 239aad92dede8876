#pragma once

#include <cstdint>
#include <vector>

#include "src/tables/distance_tables.h"

namespace geodesic {

// How the distances of one patch are rounded: to multiples of 2^shift quanta. Queries count in quanta, so
// that what they add up is rounded less than what is stored.
struct Steps {
    float quantum = 0;
    uint8_t shift = 0;
};

// To what the distances of each patch may be rounded: to `rounding` times the distance between neighbours in
// its tables, but to no more than a small share of the longest way from there, so that small surfaces are not
// rounded so much that it is seen in their longest distances. 0 for tables without entries, and where all
// tables together have so few that nothing would be gained.
std::vector<float> rounding_of_patches(const Numbering& numbering, const DistanceTables& tables,
                                       double rounding);

// Steps of `wanted`, or longer ones where the longest distance would not be a code otherwise.
Steps choose_steps(float longest, float wanted);

}
