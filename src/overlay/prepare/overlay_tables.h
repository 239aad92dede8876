#pragma once

#include <cstdint>

#include "src/overlay/tables/tables.h"

namespace geodesic {

// Where the tables of one inner patch are written.
struct OverlayTables {
    uint16_t *border, *owned, *inner;
};

// Writes them from the stored distances of the patch. Those of its parent must have been written before.
void write_overlay_table(const OverlayIndex& index, uint32_t patch, const uint16_t* stored,
                         const OverlayTables& tables);

}
