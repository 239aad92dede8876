#include "tools/commands/arguments.h"
#include "tools/commands/commands.h"
#include "tools/commands/field_output.h"
#include "tools/library.h"
#include "tools/mesh_io/mesh_io.h"

namespace geodesic::tools {

namespace {

struct ExactArguments {
    std::string mesh;
    std::vector<std::string> sources;
    MetricArguments metric;
    double tolerance = 0;
    FieldOutput output;
};

std::vector<float> distances_from(const TriangleMesh& mesh, const ExactArguments& arguments,
                                  const std::vector<uint32_t>& sources) {
    geoidx_build_options options;
    geoidx_build_options_init(&options);
    apply(arguments.metric, options);
    options.solver_tolerance = arguments.tolerance;
    const Solver solver = make_solver(mesh, arguments.mesh, options);
    std::vector<double> distances(mesh.vertex_count());
    require_ok(geoidx_solver_distances(solver.get(), sources.data(), static_cast<uint32_t>(sources.size()),
                                       nullptr, static_cast<uint32_t>(distances.size()), distances.data()),
               arguments.mesh);
    std::vector<float> rounded;
    rounded.reserve(distances.size());
    for (const double distance : distances) rounded.push_back(static_cast<float>(distance));
    return rounded;
}

void exact(const ExactArguments& arguments) {
    const std::vector<uint32_t> sources = vertex_ids(arguments.sources);
    require_writable(arguments.output, true, {&arguments.mesh, 1});
    const TriangleMesh mesh = read_mesh(arguments.mesh);
    write_field(arguments.output, distances_from(mesh, arguments, sources), &mesh, sources,
                JsonObject().text("mesh", arguments.mesh).text("metric", arguments.metric.metric));
}

}

void add_exact(CLI::App& app) {
    auto arguments = std::make_shared<ExactArguments>();
    CLI::App* command =
        app.add_subcommand("exact", "write every vertex's distance to the nearest source, without an index");
    command->add_option("MESH", arguments->mesh, "mesh file: .obj, .ply, .off or .stl")->required();
    command->add_option("S", arguments->sources, "source vertex ids")->required();
    add_metric_options(*command, arguments->metric);
    command->add_option(
        "--tolerance", arguments->tolerance,
        "by about which share of themselves distances may be off, 0 .. 1e-4, to take less time");
    add_field_options(*command, arguments->output);
    command->callback([arguments] { exact(*arguments); });
}

}
