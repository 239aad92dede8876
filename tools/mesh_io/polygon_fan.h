#pragma once

#include <span>
#include <string>

#include "tools/mesh_io/triangle_mesh.h"

namespace geodesic::tools {

// Vertex ids end before the number that the library keeps for itself.
inline constexpr uint64_t MAX_VERTICES = 0xFFFFFFFEu;

// Appends a polygon as the triangles 0 1 2, 0 2 3, 0 3 4, ...; fewer than three corners give none.
void append_fan(std::span<const uint32_t> polygon, std::vector<uint32_t>& triangles);

// "vertex index 9 is out of range, the mesh has 8 vertices"
std::string out_of_range(const std::string& index, uint64_t vertex_count);

}
