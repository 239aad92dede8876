// Paths and distances between points of the surface, compared with the exact metric.
#include <algorithm>
#include <cmath>
#include <memory>
#include <random>

#include "bench/commands.h"
#include "bench/measurement.h"
#include "bench/model.h"
#include "bench/report.h"
#include "bench/rows.h"
#include "bench/statistics.h"
#include "bench/timing.h"
#include "bench/workload.h"
#include "tools/library.h"
#include "tools/mesh_io/mesh_io.h"

namespace geodesic::bench {

namespace {

struct PathsArguments {
    std::string mesh, index;
    uint32_t count = 300;
    ReportArguments report;
};

struct PointPair {
    geoidx_surface_point source, target;
    double exact = 0;
};

// What is asked, and of what.
struct Subject {
    tools::TriangleMesh mesh;
    tools::Index index;
    tools::Query query;
    tools::Surface surface;
    tools::Solver solver;
};

Subject subject_of(const PathsArguments& arguments) {
    Subject on;
    on.mesh = tools::read_mesh(arguments.mesh);
    on.index = tools::open_index(arguments.index, &on.mesh);
    on.query = tools::make_query(*on.index, arguments.index);
    on.surface = tools::make_surface(on.mesh, arguments.mesh);
    on.solver = tools::make_solver(on.mesh, arguments.mesh, options_for(1, {}));
    return on;
}

geoidx_surface_point random_point(const Subject& on, std::mt19937_64& random, bool at_vertex) {
    geoidx_surface_point point{};
    point.triangle = static_cast<uint32_t>(random() % (on.mesh.triangles.size() / 3));
    if (at_vertex) {
        point.weights[random() % 3] = 1;
        return point;
    }
    double sum = 0;
    for (double& weight : point.weights) sum += weight = static_cast<double>(random() % 1000 + 1);
    for (double& weight : point.weights) weight /= sum;
    return point;
}

// Pairs with a path, no longer than `longest`.
std::vector<PointPair> random_pairs(const Subject& on, uint32_t count, bool at_vertices, double longest) {
    constexpr uint32_t TARGETS = 4000;
    std::mt19937_64 random(SEED);
    std::vector<PointPair> pairs;
    for (uint32_t tries = 0; pairs.size() < count && tries < 10 * count; ++tries) {
        const auto source = random_point(on, random, at_vertices);
        std::vector<geoidx_surface_point> targets(std::isfinite(longest) ? TARGETS : 4);
        for (auto& target : targets) target = random_point(on, random, at_vertices);
        std::vector<double> exact(targets.size());
        tools::require_ok(geoidx_solver_point_distances(on.solver.get(), &source, 1, targets.data(),
                                                        static_cast<uint32_t>(targets.size()), exact.data()),
                          "the exact metric");
        uint32_t taken = 0;
        for (size_t i = 0; i < targets.size() && taken < 4 && pairs.size() < count; ++i)
            if (exact[i] > 0 && exact[i] <= longest && std::isfinite(exact[i])) {
                pairs.push_back({source, targets[i], exact[i]});
                ++taken;
            }
    }
    return pairs;
}

// What was asked, and how long it took.
Row row_of_times(const char* pairs, const char* what, std::vector<double>& times) {
    std::sort(times.begin(), times.end());
    return {{"pairs", "pairs", std::string(pairs)},
            {"what", "what", std::string(what)},
            {"median_us", "median us", median(times)},
            {"p99_us", "p99 us", quantile(times, 0.99)}};
}

void add_errors(const std::vector<double>& errors, Row& row) {
    double sum = 0, largest = 0;
    uint64_t same = 0;
    for (const double error : errors) {
        sum += std::abs(error);
        largest = std::max(largest, std::abs(error));
        same += std::abs(error) <= 1e-6;
    }
    const auto count = static_cast<double>(errors.size());
    row.push_back({"mean_error", "mean error", sum / count});
    row.push_back({"max_error", "max error", largest});
    row.push_back({"within_1e-6", "share within 1e-6", static_cast<double>(same) / count});
}

// Asks each pair once before it is timed.
template <class Ask>
Row measure(const char* name, const char* what, const std::vector<PointPair>& pairs, const Ask& ask) {
    std::vector<double> times, errors;
    for (const PointPair& pair : pairs) {
        double answer = ask(pair);
        times.push_back(1e6 * time_of([&] { answer = ask(pair); }).wall);
        errors.push_back(answer / pair.exact - 1);
    }
    Row row = row_of_times(name, what, times);
    add_errors(errors, row);
    return row;
}

double path_length(const Subject& on, const PointPair& pair, uint32_t quality) {
    double length = 0;
    tools::require_ok(
        geoidx_query_path(on.query.get(), on.surface.get(), &pair.source, &pair.target, quality, &length),
        "path");
    return length;
}

double distance(const Subject& on, const PointPair& pair) {
    float distance = 0;
    tools::require_ok(
        geoidx_query_point_sssd(on.query.get(), on.surface.get(), &pair.source, &pair.target, &distance),
        "points");
    return double{distance};
}

// Walks along each pair by steps, each of which is timed. Errors are those of the lengths of the walks.
Row walk_row(const Subject& on, const char* name, const std::vector<PointPair>& pairs) {
    std::vector<double> times, errors;
    for (const PointPair& pair : pairs) {
        tools::require_ok(geoidx_query_prepare_target(on.query.get(), on.surface.get(), &pair.target),
                          "target");
        geoidx_surface_point at = pair.source;
        double walked = 0;
        for (double length = 1; length > 0; walked += length) {
            geoidx_path_point step[2];
            times.push_back(1e6 * time_of([&] {
                                      tools::require_ok(geoidx_query_next_step(on.query.get(),
                                                                               on.surface.get(), &at, step,
                                                                               nullptr),
                                                        "step");
                                  }).wall);
            length = 0;
            for (size_t i = 0; i < 3; ++i)
                length = std::hypot(length, step[1].position[i] - step[0].position[i]);
            at = step[1].point;
        }
        errors.push_back(walked / pair.exact - 1);
    }
    Row row = row_of_times(name, "step of a walk", times);
    add_errors(errors, row);
    return row;
}

Row field_row(const Subject& on, bool at_vertices) {
    std::mt19937_64 random(SEED);
    std::vector<double> times;
    std::vector<float> field(on.mesh.positions.size() / 3);
    for (uint32_t i = 0; i < 100; ++i) {
        const auto source = random_point(on, random, at_vertices);
        times.push_back(1e6 * time_of([&] {
                                  tools::require_ok(geoidx_query_point_msad(
                                                        on.query.get(), on.surface.get(), &source, 1, nullptr,
                                                        field.data(), static_cast<uint32_t>(field.size())),
                                                    "field");
                              }).wall);
    }
    return row_of_times("all", at_vertices ? "MSAD from a vertex" : "MSAD from a point", times);
}

void paths(const PathsArguments& arguments) {
    Report report("paths", {{"pairs", "pairs", uint64_t{arguments.count}}}, arguments.report);
    Table table{"paths", "Paths and points", {}}, fields{"fields", "Fields", {}};
    const Subject on = subject_of(arguments);
    const struct {
        const char* name;
        double edges; // the longest pair, in average edges
    } kinds[] = {{"random", INFINITY}, {"within 30 edges", 30}, {"within 3 edges", 3}};
    for (const auto& [name, edges] : kinds) {
        progress(name);
        const double longest = edges * average_edge(on.mesh);
        const auto vertices = random_pairs(on, arguments.count, true, longest),
                   points = random_pairs(on, arguments.count, false, longest);
        table.rows.push_back(measure(name, "SSSD of vertices", vertices,
                                     [&](const PointPair& pair) { return distance(on, pair); }));
        table.rows.push_back(measure(name, "SSSD of points", points,
                                     [&](const PointPair& pair) { return distance(on, pair); }));
        table.rows.push_back(measure(name, "path, straight", points, [&](const PointPair& pair) {
            return path_length(on, pair, GEOIDX_PATH_STRAIGHT);
        }));
        table.rows.push_back(measure(name, "path, exact", points, [&](const PointPair& pair) {
            return path_length(on, pair, GEOIDX_PATH_EXACT);
        }));
        table.rows.push_back(walk_row(on, name, points));
    }
    for (const bool at_vertex : {true, false}) fields.rows.push_back(field_row(on, at_vertex));
    report.add(std::move(table));
    report.add(std::move(fields));
    report.note("Each pair is timed once, right after it was asked once, on one thread; of walks each step "
                "is. Errors "
                "are relative to the exact distance, those of walks the errors of their lengths.");
}

}

void add_paths(CLI::App& app) {
    auto arguments = std::make_shared<PathsArguments>();
    CLI::App* command =
        app.add_subcommand("paths", "times and lengths of paths between points of the surface");
    command->add_option("MESH", arguments->mesh, "mesh file")->required();
    command->add_option("INDEX", arguments->index, "index file of that mesh")->required();
    command->add_option("--count", arguments->count, "of pairs of each kind")
        ->check(CLI::PositiveNumber)
        ->capture_default_str();
    add_report_options(*command, arguments->report);
    command->callback([arguments] { paths(*arguments); });
}

}
