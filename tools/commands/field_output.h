#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>

#include "tools/mesh_io/triangle_mesh.h"

namespace geodesic::tools {

// Where a distance field goes: numbers, and a picture if one is wanted.
struct FieldOutput {
    std::string numbers;
    std::string picture;
    std::string size = "1200x1000";
    uint32_t isolines = 24;
    std::string up = "y";
};

// Returns the --png option.
CLI::Option* add_field_options(CLI::App& command, FieldOutput& output);

// Before the work: throws CLI::ValidationError for a bad --size, Failure where a file cannot be written.
void require_writable(const FieldOutput& output, std::span<const std::string> inputs);

// Numbers as little-endian float32, one a vertex. `mesh` may be null where no picture is wanted.
void write_field(const FieldOutput& output, std::span<const float> distances, const TriangleMesh* mesh,
                 std::span<const uint32_t> sources);

}
