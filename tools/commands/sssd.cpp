#include <cmath>
#include <cstdio>

#include "tools/commands/arguments.h"
#include "tools/commands/commands.h"
#include "tools/failure.h"
#include "tools/library.h"
#include "tools/mesh_io/mesh_io.h"

namespace geodesic::tools {

namespace {

struct SssdArguments {
    std::string index;
    std::vector<std::string> ids;
    std::string exact_mesh;
    double weld_tolerance = 0;
};

std::vector<uint32_t> vertex_pairs(const SssdArguments& arguments) {
    if (arguments.ids.size() % 2 != 0)
        throw CLI::ValidationError("vertex ids come in pairs, but there are " +
                                   std::to_string(arguments.ids.size()));
    return vertex_ids(arguments.ids);
}

std::vector<float> index_distances(const geoidx& index, const std::string& path,
                                   const std::vector<uint32_t>& pairs) {
    std::vector<float> distances(pairs.size() / 2);
    require_ok(geoidx_sssd_batch(&index, pairs.data(), distances.size(), distances.data()), path);
    return distances;
}

// The index keeps neither the caller's own metric or costs nor the tolerance it was welded with.
Solver solver_like(const geoidx& index, const SssdArguments& arguments, const TriangleMesh& mesh) {
    geoidx_build_options options;
    geoidx_build_options_init(&options);
    const geoidx_info info = info_of(index, arguments.index);
    options.metric = info.metric;
    options.weld_tolerance = arguments.weld_tolerance;
    if (options.metric == GEOIDX_METRIC_CALLBACK)
        throw Failure(arguments.index + ": was built with a program's own metric, unknown to --exact");
    if (info.metric_fingerprint != 0)
        throw Failure(arguments.index + ": was built with costs of its own, unknown to --exact");
    return make_solver(mesh, arguments.exact_mesh, options);
}

double relative_error(double distance, double exact) {
    if (distance == exact) return 0; // also where both are infinite
    return std::abs(distance - exact) / exact;
}

void print_with_exact(const std::vector<uint32_t>& pairs, const std::vector<float>& distances,
                      geoidx_solver& solver, const std::string& path) {
    for (size_t i = 0; i < distances.size(); ++i) {
        double exact = 0;
        require_ok(geoidx_solver_distances(&solver, &pairs[2 * i], 1, &pairs[2 * i + 1], 1, &exact), path);
        const double distance = distances[i];
        std::printf("%u %u %.9g %.9g %.9g\n", pairs[2 * i], pairs[2 * i + 1], distance, exact,
                    relative_error(distance, exact));
    }
}

void sssd(const SssdArguments& arguments) {
    const std::vector<uint32_t> pairs = vertex_pairs(arguments);
    TriangleMesh mesh;
    if (!arguments.exact_mesh.empty()) mesh = read_mesh(arguments.exact_mesh);
    const Index index = open_index(arguments.index, arguments.exact_mesh.empty() ? nullptr : &mesh);
    const std::vector<float> distances = index_distances(*index, arguments.index, pairs);
    if (!arguments.exact_mesh.empty()) {
        const Solver solver = solver_like(*index, arguments, mesh);
        print_with_exact(pairs, distances, *solver, arguments.exact_mesh);
        return;
    }
    for (size_t i = 0; i < distances.size(); ++i)
        std::printf("%u %u %.9g\n", pairs[2 * i], pairs[2 * i + 1], double{distances[i]});
}

}

void add_sssd(CLI::App& app) {
    auto arguments = std::make_shared<SssdArguments>();
    CLI::App* command = app.add_subcommand("sssd", "print distances between pairs of vertices: A B distance");
    command->add_option("FILE", arguments->index, "index file")->required();
    command->add_option("A B", arguments->ids, "vertex ids, two a pair")->required();
    CLI::Option* exact =
        command->add_option("--exact", arguments->exact_mesh,
                            "the index's mesh: print the metric's own distance and the relative error, too");
    command->add_option("--weld-tolerance", arguments->weld_tolerance, "that the index was built with")
        ->needs(exact);
    command->callback([arguments] { sssd(*arguments); });
}

}
