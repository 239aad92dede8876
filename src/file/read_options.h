#pragma once

#include <cstdint>

#include "geoidx.h"

namespace geodesic {

struct ReadOptions {
    uint32_t threads = 1;      // that decode tables, at most
    uint64_t max_vertices = 0; // that the caller's vertex array may have had; 0: any
    // That the index must be of, or null: any. Positions that the file leaves out are taken from it.
    const geoidx_mesh* mesh = nullptr;
    // Whether a file that leaves positions out can be read without the mesh, so that all that does not depend
    // on them is checked. Positions, and the codes of packed tables, are then 0.
    bool may_lack_positions = false;
};

}
