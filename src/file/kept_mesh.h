#pragma once

#include <cstdint>
#include <span>

#include "format/container.h"
#include "geoidx.h"
#include "src/index/description.h"
#include "src/mesh/intake.h"

namespace geodesic {

// The mesh itself, the section MESH, for an index that is to keep it: `mesh` is one that take_in() took.
format::PackedBytes pack_mesh(const geoidx_mesh& mesh);

// What take_in() made of that mesh when the index was built. `number_of_id`, which is VERT, says what was
// welded. Throws Error CORRUPT about MESH unless it is the mesh that `about` and VERT are of.
Intake unpack_mesh(const format::StoredBytes& packed, const Description& about,
                   std::span<const uint32_t> number_of_id);

}
