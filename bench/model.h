#pragma once

#include <functional>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>

#include "tools/mesh_io/triangle_mesh.h"

namespace geodesic::bench {

// A mesh with the name it goes by in tables.
struct Model {
    std::string name;
    std::string path;
    tools::TriangleMesh mesh;
};

// The mean length of the edges of triangles, those between two of them twice.
double average_edge(const tools::TriangleMesh& mesh);

// --meshes: the folder that names are looked up in; by default $GEOIDX_MESHES, else ../shared/meshes.
void add_mesh_folder(CLI::App& command, std::string& folder);

// `mesh` is the path of a file, or the name of one in `folder` with or without extension, and may end in
// "+N", N = 1 .. 5: so many root-3 subdivisions. Throws tools::Failure that says where it was looked for.
Model load_model(const std::string& mesh, const std::string& folder);

// Loads the meshes one after the other. One that fails is reported on stderr and left out; returns how many.
size_t for_each_model(const std::vector<std::string>& meshes, const std::string& folder,
                      const std::function<void(const Model&)>& measure);

// Throws tools::Failure if `failed` is not 0, so that the exit status tells.
void require_none(size_t failed);

}
