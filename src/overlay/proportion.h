#pragma once

#include "src/overlay/tables.h"

namespace geodesic {

// The overlay engine derives codes of 16 bits from what a file holds: its outer, inner and coarse tables and
// its labels. It may derive so many for each number stored of tables, borders and vertices, and a few
// megabytes of them always. A mesh takes 1 to 12, up to 33 where nothing unfolds, so that every border vertex
// is a chain by itself, and more only where triangles join vertices at random. What takes more is refused
// before any memory is taken.
constexpr uint64_t MOST_DERIVED_EACH = 128, ALWAYS_DERIVED = uint64_t{1} << 22;

// When the rings are laid out: how many codes those tables and labels will take, without padding.
uint64_t derived_codes(const OverlayIndex& index);

// The entries of the stored tables, the places on borders and the vertices.
uint64_t stored_numbers(const OverlayIndex& index);

// Throws Error LIMIT where tables and labels would be out of proportion to what they are derived from.
void require_proportion(const OverlayIndex& index);

}
