// Paths over a mesh whose triangles cost more or less, beside the metric's own distances.
#include <algorithm>
#include <memory>
#include <random>

#include "bench/commands.h"
#include "bench/model.h"
#include "bench/report.h"
#include "bench/rows.h"
#include "bench/statistics.h"
#include "bench/timing.h"
#include "bench/workload.h"
#include "tools/library.h"

namespace geodesic::bench {

namespace {

// The metric with so many points on every edge is what paths are compared with, besides that of the index.
constexpr uint32_t MANY_POINTS = 50;

struct WeightedArguments {
    std::vector<std::string> meshes;
    std::string folder;
    double dearest = 4;
    uint32_t count = 60;
    ReportArguments report;
};

struct WeightedPair {
    geoidx_surface_point source, target;
    double of_index = 0, of_many_points = 0; // distances by the metric
};

// An index, and what belongs to it. Costs are between 1 and the dearest.
struct WeightedMesh {
    WeightedMesh(const Model& model, double dearest) : model(model) {
        std::mt19937_64 random(SEED);
        std::uniform_real_distribution<double> cost(1, dearest);
        costs.resize(model.mesh.triangles.size() / 3);
        std::ranges::generate(costs, [&] { return cost(random); });
        const geoidx_mesh view = tools::view_of(model.mesh);
        const geoidx_build_options options = options_of(0);
        geoidx* built = nullptr;
        tools::require_ok(geoidx_build(&view, &options, &built), model.name);
        index.reset(built);
        query = tools::make_query(*index, model.name);
        geoidx_surface_options costs_of;
        geoidx_surface_options_init(&costs_of);
        costs_of.face_costs = costs.data();
        costs_of.face_cost_count = costs.size();
        geoidx_surface* made = nullptr;
        tools::require_ok(geoidx_surface_create(&view, &costs_of, &made), model.name);
        surface.reset(made);
    }

    // 0 points: as many as by default.
    geoidx_build_options options_of(uint32_t points_per_edge) const {
        geoidx_build_options options;
        geoidx_build_options_init(&options);
        options.metric = GEOIDX_METRIC_WEIGHTED;
        options.face_costs = costs.data();
        options.face_cost_count = costs.size();
        if (points_per_edge > 0) options.points_per_edge = points_per_edge;
        return options;
    }
    tools::Solver solver_of(uint32_t points_per_edge) const {
        return tools::make_solver(model.mesh, model.name, options_of(points_per_edge));
    }

    const Model& model;
    std::vector<double> costs;
    tools::Index index;
    tools::Query query;
    tools::Surface surface;
};

std::vector<WeightedPair> pairs_on(const WeightedMesh& on, uint32_t count) {
    const tools::Solver few = on.solver_of(0), many = on.solver_of(MANY_POINTS);
    std::mt19937_64 random(SEED + 1);
    const auto point = [&] {
        geoidx_surface_point point{static_cast<uint32_t>(random() % on.costs.size()), 0, {}};
        double sum = 0;
        for (double& weight : point.weights) sum += weight = static_cast<double>(random() % 1000 + 1);
        for (double& weight : point.weights) weight /= sum;
        return point;
    };
    const auto solve = [&](const tools::Solver& solver, const WeightedPair& pair) {
        double distance = 0;
        tools::require_ok(
            geoidx_solver_point_distances(solver.get(), &pair.source, 1, &pair.target, 1, &distance),
            on.model.name);
        return distance;
    };
    std::vector<WeightedPair> pairs;
    while (pairs.size() < count) {
        WeightedPair pair{point(), point()};
        pair.of_index = solve(few, pair);
        pair.of_many_points = solve(many, pair);
        pairs.push_back(pair);
    }
    return pairs;
}

// By how much answers are longer, on average and at most, as a share; negative where they are shorter.
void add_excess(const char* id, const char* title, const std::vector<double>& excess, Row& row) {
    double sum = 0;
    for (const double share : excess) sum += share;
    row.push_back(
        {std::string("mean_") + id, std::string("mean, ") + title, sum / static_cast<double>(excess.size())});
    row.push_back({std::string("max_") + id, std::string("max, ") + title, std::ranges::max(excess)});
}

Row weighted_row(const WeightedMesh& on, const std::vector<WeightedPair>& pairs, uint32_t quality) {
    std::vector<double> times, over_index, over_many;
    for (const WeightedPair& pair : pairs) {
        double length = 0;
        const Duration taken = time_of([&] {
            const geoidx_status status = geoidx_query_path(on.query.get(), on.surface.get(), &pair.source,
                                                           &pair.target, quality, &length);
            if (status != GEOIDX_ERROR_NO_PATH) tools::require_ok(status, on.model.name);
        });
        if (!(length > 0)) continue; // no path
        times.push_back(1e6 * taken.wall);
        over_index.push_back(length / pair.of_index - 1);
        over_many.push_back(length / pair.of_many_points - 1);
    }
    Row row{{"mesh", "mesh", on.model.name},
            {"quality", "path", std::string(quality == GEOIDX_PATH_EXACT ? "exact" : "straight")},
            {"median_us", "median us", median(times)}};
    add_excess("over_index", "beside the index's metric", over_index, row);
    add_excess("over_many", "beside 50 points an edge", over_many, row);
    return row;
}

void weighted(const WeightedArguments& arguments) {
    Report report(
        "weighted",
        {{"pairs", "pairs", uint64_t{arguments.count}}, {"dearest", "costs are 1 to", arguments.dearest}},
        arguments.report);
    Table table{"weighted", "Paths by random costs of triangles", {}};
    const size_t failed = for_each_model(arguments.meshes, arguments.folder, [&](const Model& model) {
        progress(model.name);
        const WeightedMesh on(model, arguments.dearest);
        const auto pairs = pairs_on(on, arguments.count);
        for (const uint32_t quality : {GEOIDX_PATH_STRAIGHT, GEOIDX_PATH_EXACT})
            table.rows.push_back(weighted_row(on, pairs, quality));
    });
    report.add(std::move(table));
    report.note(
        "Random points within triangles, one thread. How much longer a path is than the metric's distance "
        "is given as a share; both are upper bounds of the true distance, so that it may be negative.");
    require_none(failed);
}

}

void add_weighted(CLI::App& app) {
    auto arguments = std::make_shared<WeightedArguments>();
    CLI::App* command =
        app.add_subcommand("weighted", "paths over surfaces whose triangles have random costs");
    command->add_option("MESH", arguments->meshes, "mesh files or names")->required();
    add_mesh_folder(*command, arguments->folder);
    command->add_option("--dearest", arguments->dearest, "costs are between 1 and this")
        ->check(CLI::Range(1.0, 1e6))
        ->capture_default_str();
    command->add_option("--count", arguments->count, "of pairs")
        ->check(CLI::PositiveNumber)
        ->capture_default_str();
    add_report_options(*command, arguments->report);
    command->callback([arguments] { weighted(*arguments); });
}

}
