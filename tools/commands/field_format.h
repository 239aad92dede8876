#pragma once

#include <array>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "tools/mesh_io/triangle_mesh.h"

namespace geodesic::tools {

// The files that distances can be written to, a number per vertex in the order of the ids:
//   f32  little-endian float32, nothing else
//   csv  the line "vertex,distance", then a line a vertex; what is unreachable is "inf"
//   npy  NumPy's format 1.0, '<f4', shape (n,)
//   ply  the mesh, binary, little-endian: positions as double, a float "distance" and a colour a vertex
enum class FieldFormat { f32, csv, npy, ply };
inline constexpr std::array<const char*, 4> FIELD_FORMAT_NAMES{"f32", "csv", "npy", "ply"};

std::optional<FieldFormat> field_format_of_name(std::string_view name);

// By how the name of the file ends, in any case.
std::optional<FieldFormat> field_format_of_file(std::string_view path);

// The whole file. `mesh` is read for ply only, and may be null otherwise.
std::vector<unsigned char> encode_field(FieldFormat format, std::span<const float> distances,
                                        const TriangleMesh* mesh);

}
