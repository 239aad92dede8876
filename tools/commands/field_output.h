#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>

#include "tools/commands/picture_output.h"
#include "tools/json.h"
#include "tools/mesh_io/triangle_mesh.h"

namespace geodesic::tools {

// Where a distance field goes: numbers, a picture, a JSON object, or several of these.
struct FieldOutput {
    std::string numbers;
    std::string format; // of the numbers; empty: by the name
    PictureOutput picture;
    bool json = false;
};

// Returns the --png option.
CLI::Option* add_field_options(CLI::App& command, FieldOutput& output);

// Before the work. Throws CLI::ValidationError where the options do not go together or the format is unknown
// or needs a mesh, and Failure where a file cannot be written.
void require_writable(const FieldOutput& output, bool has_mesh, std::span<const std::string> inputs);

// Writes what is wanted. `mesh` may be null where neither a picture nor a ply is. `object` already says what
// was asked, and is printed if JSON is wanted; where that is all, it holds the distances themselves.
void write_field(const FieldOutput& output, std::span<const float> distances, const TriangleMesh* mesh,
                 std::span<const uint32_t> sources, JsonObject object);

}
