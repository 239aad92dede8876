// What a surface takes: time to make it, memory, and the nearest point of it.
#include <cmath>
#include <memory>
#include <random>

#include "bench/commands.h"
#include "bench/machine.h"
#include "bench/model.h"
#include "bench/report.h"
#include "bench/statistics.h"
#include "bench/timing.h"
#include "bench/workload.h"
#include "tools/library.h"
#include "tools/mesh_io/mesh_io.h"

namespace geodesic::bench {

namespace {

struct SurfaceArguments {
    std::vector<std::string> meshes;
    uint32_t count = 2000;
    ReportArguments report;
};

tools::Surface surface_from(const geoidx_mesh& mesh, const std::string& path) {
    geoidx_surface* surface = nullptr;
    tools::require_ok(geoidx_surface_create(&mesh, nullptr, &surface), path);
    return tools::Surface(surface);
}

// As far as an average edge off a random vertex.
std::array<double, 3> random_position(const tools::TriangleMesh& mesh, double edge, std::mt19937_64& random) {
    std::uniform_real_distribution<double> off(-edge, edge);
    const size_t vertex = random() % (mesh.positions.size() / 3);
    std::array<double, 3> position;
    for (size_t k = 0; k < 3; ++k) position[k] = mesh.positions[3 * vertex + k] + off(random);
    return position;
}

double closest_us(const geoidx_surface& surface, const tools::TriangleMesh& mesh, uint32_t count) {
    const double edge = average_edge(mesh);
    std::mt19937_64 random(SEED);
    std::vector<double> times;
    for (uint32_t i = 0; i < count; ++i) {
        const auto position = random_position(mesh, edge, random);
        geoidx_surface_point point;
        times.push_back(1e6 * time_of([&] {
                                  tools::require_ok(
                                      geoidx_closest_point(&surface, position.data(), &point, nullptr),
                                      "closest point");
                              }).wall);
    }
    return median(times);
}

Row surface_row(const std::string& path, const tools::TriangleMesh& mesh, const geoidx_mesh& view,
                uint32_t count) {
    tools::Surface surface;
    const uint64_t before = heap_memory();
    const double made = time_of([&] { surface = surface_from(view, path); }).wall;
    const auto bytes = static_cast<double>(heap_memory() - before);
    const bool is_single = view.position_type == GEOIDX_POSITION_FLOAT;
    return {{"mesh", "mesh", path},
            {"positions", "positions", std::string(is_single ? "single" : "double")},
            {"vertices", "vertices", view.vertex_count},
            {"make_ms", "made in ms", 1e3 * made},
            {"bytes_per_vertex", "bytes a vertex", bytes / static_cast<double>(view.vertex_count)},
            {"closest_us", "closest point us", closest_us(*surface, mesh, count)}};
}

void surfaces(const SurfaceArguments& arguments) {
    Report report("surface", {{"count", "positions", uint64_t{arguments.count}}}, arguments.report);
    Table table{"surface", "Surfaces", {}};
    for (const std::string& path : arguments.meshes) {
        progress(path);
        const tools::TriangleMesh mesh = tools::read_mesh(path);
        geoidx_mesh view = tools::view_of(mesh);
        table.rows.push_back(surface_row(path, mesh, view, arguments.count));
        const std::vector<float> single(mesh.positions.begin(), mesh.positions.end());
        view.positions = single.data();
        view.position_type = GEOIDX_POSITION_FLOAT;
        table.rows.push_back(surface_row(path, mesh, view, arguments.count));
    }
    report.add(std::move(table));
    report.note("Memory is what the C library has given and not taken back (glibc only). Closest points are "
                "medians, of positions within an average edge of a vertex on each axis.");
}

}

void add_surface(CLI::App& app) {
    auto arguments = std::make_shared<SurfaceArguments>();
    CLI::App* command = app.add_subcommand("surface", "memory of surfaces, and times of closest points");
    command->add_option("MESH", arguments->meshes, "mesh files")->required();
    command->add_option("--count", arguments->count, "of positions that the closest point is asked for")
        ->check(CLI::PositiveNumber)
        ->capture_default_str();
    add_report_options(*command, arguments->report);
    command->callback([arguments] { surfaces(*arguments); });
}

}
