#include <algorithm>
#include <cmath>
#include <cstdio>
#include <optional>

#include "tools/commands/arguments.h"
#include "tools/commands/commands.h"
#include "tools/failure.h"
#include "tools/json.h"
#include "tools/library.h"
#include "tools/mesh_io/mesh_io.h"
#include "tools/read_file.h"

namespace geodesic::tools {

namespace {

struct SssdArguments {
    std::string index;
    std::vector<std::string> ids;
    std::string mesh, exact_mesh;
    double weld_tolerance = 0;
    bool json = false;
};

std::string standard_input() {
    try {
        return read_standard_input();
    } catch (const std::runtime_error& error) {
        throw Failure(std::string("standard input: ") + error.what());
    }
}

std::vector<uint32_t> vertex_pairs(const std::vector<std::string>& ids) {
    if (ids.size() == 1 && ids.front() == "-") return vertex_pairs_of_text(standard_input());
    if (std::ranges::find(ids, "-") != ids.end())
        throw CLI::ValidationError("- takes all pairs from standard input, so no other ids can be given");
    if (ids.size() % 2 != 0)
        throw CLI::ValidationError("vertex ids come in pairs, but there are " + std::to_string(ids.size()));
    return vertex_ids(ids);
}

std::vector<float> index_distances(const geoidx& index, const std::string& path,
                                   const std::vector<uint32_t>& pairs) {
    std::vector<float> distances(pairs.size() / 2);
    if (distances.empty()) return distances;
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

// A solver does not tell how many vertices it has, so a surface with the same tolerance is made: queries
// refuse it if it has another number of them than the index.
void require_same_welding(const geoidx& index, const SssdArguments& arguments, const TriangleMesh& mesh) {
    const Surface surface = make_surface(mesh, arguments.exact_mesh, arguments.weld_tolerance);
    const Query query = make_query(index, arguments.index);
    geoidx_surface_point any;
    float distance = 0;
    require_ok(geoidx_closest_point(surface.get(), mesh.positions.data(), &any, nullptr),
               arguments.exact_mesh);
    require_ok(geoidx_query_point_sssd(query.get(), surface.get(), &any, &any, &distance),
               arguments.exact_mesh);
}

double relative_error(double distance, double exact) {
    if (distance == exact) return 0; // also where both are infinite
    return std::abs(distance - exact) / exact;
}

struct Answer {
    uint32_t source;
    uint32_t target;
    float distance;
    std::optional<double> exact;
};

std::vector<Answer> answers_of(const std::vector<uint32_t>& pairs, const std::vector<float>& distances) {
    std::vector<Answer> answers;
    for (size_t i = 0; i < distances.size(); ++i)
        answers.push_back({pairs[2 * i], pairs[2 * i + 1], distances[i], std::nullopt});
    return answers;
}

void add_exact_distance(geoidx_solver& solver, const std::string& path, Answer& answer) {
    double exact = 0;
    require_ok(geoidx_solver_distances(&solver, &answer.source, 1, &answer.target, 1, &exact), path);
    answer.exact = exact;
}

void print_text(const Answer& answer) {
    std::printf("%u %u %.9g", answer.source, answer.target, double{answer.distance});
    if (answer.exact)
        std::printf(" %.9g %.9g", *answer.exact, relative_error(double{answer.distance}, *answer.exact));
    std::puts("");
}

void print_json(const Answer& answer) {
    std::printf("{\"source\": %u, \"target\": %u, \"distance\": %s", answer.source, answer.target,
                json_number(answer.distance).c_str());
    if (answer.exact)
        std::printf(", \"exact\": %s, \"relative_error\": %s", json_number(*answer.exact).c_str(),
                    json_number(relative_error(double{answer.distance}, *answer.exact)).c_str());
    std::printf("}");
}

// An object with a pair a line.
void print_json(const std::string& index, const std::vector<Answer>& answers) {
    std::printf("{\n  \"index\": %s,\n  \"pairs\": [", json_text(index).c_str());
    for (size_t i = 0; i < answers.size(); ++i) {
        std::printf(i == 0 ? "\n    " : ",\n    ");
        print_json(answers[i]);
    }
    std::printf("]\n}\n");
}

void sssd(const SssdArguments& arguments) {
    const std::vector<uint32_t> pairs = vertex_pairs(arguments.ids);
    const bool with_exact = !arguments.exact_mesh.empty();
    TriangleMesh mesh;
    if (with_exact) mesh = read_mesh(arguments.exact_mesh);
    const Index index =
        with_exact ? open_index(arguments.index, &mesh) : open_index_with(arguments.mesh, arguments.index);
    std::vector<Answer> answers = answers_of(pairs, index_distances(*index, arguments.index, pairs));
    if (with_exact) {
        const Solver solver = solver_like(*index, arguments, mesh);
        require_same_welding(*index, arguments, mesh);
        for (Answer& answer : answers) add_exact_distance(*solver, arguments.exact_mesh, answer);
    }
    if (arguments.json) return print_json(arguments.index, answers);
    for (const Answer& answer : answers) print_text(answer);
}

}

void add_sssd(CLI::App& app) {
    auto arguments = std::make_shared<SssdArguments>();
    CLI::App* command = app.add_subcommand("sssd", "print distances between pairs of vertices: A B distance");
    command->add_option("FILE", arguments->index, "index file")->required();
    command->add_option("A B", arguments->ids, "vertex ids, two a pair; -: from stdin, a pair a line")
        ->required();
    CLI::Option* exact =
        command->add_option("--exact", arguments->exact_mesh,
                            "the index's mesh: print the metric's own distance and the relative error, too");
    command->add_option("--weld-tolerance", arguments->weld_tolerance, "that the index was built with")
        ->needs(exact);
    add_mesh_option(*command, arguments->mesh)->excludes(exact); // which is the same mesh
    command->add_flag("--json", arguments->json, "print a JSON object");
    command->callback([arguments] { sssd(*arguments); });
}

}
