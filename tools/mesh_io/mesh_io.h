#pragma once

#include <stdexcept>
#include <string>
#include <string_view>

#include "tools/mesh_io/triangle_mesh.h"

namespace geodesic::tools {

// A file that cannot be read as a mesh; the text says where in it (line or byte) and why.
struct MeshFileError : std::runtime_error {
    using std::runtime_error::runtime_error;
};

// What follows the last dot of a file's name, empty where there is none.
std::string lower_case_extension(std::string_view path);

enum class MeshFormat { unknown, obj, ply, off, stl };

// By the extension of the name, in any case; where it is none of ours, by how the contents begin.
MeshFormat mesh_format(std::string_view path, std::string_view bytes);

// Readers of whole files in memory. They throw MeshFileError.
TriangleMesh read_obj(std::string_view bytes);
TriangleMesh read_ply(std::string_view bytes);
TriangleMesh read_off(std::string_view bytes);
TriangleMesh read_stl(std::string_view bytes);

// Reads a mesh file of any known format. Throws MeshFileError with the path in front, also where the file
// cannot be opened or holds no triangle.
TriangleMesh read_mesh(const std::string& path);

}
