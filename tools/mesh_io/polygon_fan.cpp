#include "tools/mesh_io/polygon_fan.h"

namespace geodesic::tools {

void append_fan(std::span<const uint32_t> polygon, std::vector<uint32_t>& triangles) {
    for (size_t corner = 2; corner < polygon.size(); ++corner)
        triangles.insert(triangles.end(), {polygon[0], polygon[corner - 1], polygon[corner]});
}

std::string out_of_range(const std::string& index, uint64_t vertex_count) {
    return "vertex index " + index + " is out of range, the mesh has " + std::to_string(vertex_count) +
           " vertices";
}

}
