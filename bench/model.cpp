#include "bench/model.h"

#include <cmath>
#include <cstdlib>
#include <filesystem>

#include "bench/report.h"
#include "bench/root3.h"
#include "tools/failure.h"
#include "tools/mesh_io/mesh_io.h"

namespace geodesic::bench {

namespace {

namespace fs = std::filesystem;

std::string default_folder() {
    const char* const named = std::getenv("GEOIDX_MESHES");
    return named && *named ? named : "../shared/meshes";
}

// "armadillo+2": twice.
std::pair<std::string, int> refinement_of(const std::string& mesh) {
    const size_t plus = mesh.size() - 2;
    if (mesh.size() < 3 || mesh[plus] != '+' || mesh[plus + 1] < '1' || mesh[plus + 1] > '5')
        return {mesh, 0};
    return {mesh.substr(0, plus), mesh[plus + 1] - '0'};
}

fs::path find_mesh(const std::string& mesh, const std::string& folder) {
    std::error_code ignored;
    if (fs::is_regular_file(mesh, ignored)) return mesh;
    for (const char* extension : {"", ".obj", ".ply", ".off", ".stl"}) {
        const fs::path path = fs::path(folder) / (mesh + extension);
        if (fs::is_regular_file(path, ignored)) return path;
    }
    throw tools::Failure(mesh + ": is no file, nor the name of a mesh in " + folder +
                         " (set --meshes or GEOIDX_MESHES to the folder of the meshes)");
}

}

void add_mesh_folder(CLI::App& command, std::string& folder) {
    folder = default_folder();
    command.add_option("--meshes", folder, "folder of meshes given by name (GEOIDX_MESHES)")
        ->capture_default_str();
}

double average_edge(const tools::TriangleMesh& mesh) {
    double sum = 0;
    for (size_t i = 0; i < mesh.triangles.size(); ++i) {
        const double* a = mesh.positions.data() + size_t{3} * mesh.triangles[i];
        const double* b = mesh.positions.data() + size_t{3} * mesh.triangles[i % 3 == 2 ? i - 2 : i + 1];
        sum += std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]);
    }
    return sum / static_cast<double>(mesh.triangles.size());
}

Model load_model(const std::string& mesh, const std::string& folder) {
    const auto [name, steps] = refinement_of(mesh);
    const fs::path path = find_mesh(name, folder);
    Model model{path.stem().string(), path.string(), tools::read_mesh(path.string())};
    for (int i = 0; i < steps; ++i) model.mesh = root3_subdivided(model.mesh);
    if (steps) model.name += "+" + std::to_string(steps);
    return model;
}

size_t for_each_model(const std::vector<std::string>& meshes, const std::string& folder,
                      const std::function<void(const Model&)>& measure) {
    size_t failed = 0;
    for (const std::string& mesh : meshes) {
        try {
            measure(load_model(mesh, folder));
        } catch (const std::runtime_error& error) {
            progress("geoidx_bench: left out: " + std::string(error.what()));
            ++failed;
        }
    }
    return failed;
}

void require_none(size_t failed) {
    if (failed) throw tools::Failure("meshes that could not be measured: " + std::to_string(failed));
}

}
