#pragma once

#include "src/overlay/tables/tables.h"

namespace geodesic {

// The overlay engine derives codes of 16 bits from what a file holds: the border, inner and owned tables,
// those of middles, of which two count as a code, flags of borders, one bit each, of which 16 do, the bounds
// of long rows, the tables of samples, and labels.
// It may derive MOST_DERIVED_EACH of them for each stored table entry, slot and vertex, and ALWAYS_DERIVED
// more. Meshes take 1 to 12 for each, or up to 33 where nothing unfolds, because every border vertex is then
// a chain by itself. What exceeds the limit, as hundreds of patches inside of one whose border they share, is
// refused before any memory is taken.
constexpr uint64_t MOST_DERIVED_EACH = 128, ALWAYS_DERIVED = uint64_t{1} << 22;

// The number of codes that those tables will take, without padding, and labels at most, but for long bridges.
// The index needs its rings.
uint64_t derived_codes(const OverlayIndex& index);

// The number of stored table entries, slots and vertices.
uint64_t stored_numbers(const OverlayIndex& index);

// Throws Error LIMIT if tables would be out of proportion to what they are derived from.
void require_proportion(const OverlayIndex& index);

}
