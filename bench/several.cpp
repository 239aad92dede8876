#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <numeric>
#include <random>
#include <utility>

#include "bench/commands.h"
#include "bench/report.h"
#include "bench/rows.h"

namespace geodesic::bench {

namespace {

constexpr uint32_t ROUNDS = 10;
constexpr uint32_t CLUSTER = 20; // sources are taken from so many times as many vertices around one

struct SeveralArguments {
    std::string mesh;
    std::string index;
    std::string folder;
    std::vector<uint32_t> counts{1, 2, 16, 256, 4096};
    ReportArguments report;
};

// What all rounds of all rows are measured with.
struct Bench {
    const Model& model;
    geoidx_query& query;
    geoidx_solver& solver;
    std::vector<float> field;
    std::vector<double> exact;

    void ask(const std::vector<uint32_t>& sources) {
        tools::require_ok(geoidx_query_msad(&query, sources.data(), static_cast<uint32_t>(sources.size()),
                                            field.data(), static_cast<uint32_t>(field.size())),
                          model.path);
    }
    void compute(const std::vector<uint32_t>& sources) {
        tools::require_ok(geoidx_solver_distances(&solver, sources.data(),
                                                  static_cast<uint32_t>(sources.size()), nullptr,
                                                  static_cast<uint32_t>(exact.size()), exact.data()),
                          model.path);
    }
};

enum class Arrangement { anywhere, together, circle, line };

constexpr std::pair<Arrangement, const char*> ARRANGEMENTS[] = {{Arrangement::anywhere, "anywhere"},
                                                                {Arrangement::together, "together"},
                                                                {Arrangement::circle, "on a circle"},
                                                                {Arrangement::line, "on a line"}};

// The vertices that a field reaches, in ascending order of its distances.
std::vector<uint32_t> in_order(const std::vector<float>& field) {
    std::vector<uint32_t> vertices(field.size());
    std::iota(vertices.begin(), vertices.end(), 0u);
    std::erase_if(vertices, [&](uint32_t v) { return std::isinf(field[v]); });
    std::ranges::sort(vertices, {}, [&](uint32_t v) { return field[v]; });
    return vertices;
}

// Those around a vertex.
std::vector<uint32_t> together(Bench& bench, uint32_t center, uint32_t count, std::mt19937_64& random) {
    bench.ask({center});
    std::vector<uint32_t> vertices = in_order(bench.field), sources;
    vertices.resize(std::min(vertices.size(), size_t{CLUSTER} * count));
    for (uint32_t i = 0; i < count; ++i) sources.push_back(vertices[random() % vertices.size()]);
    return sources;
}

// Those that are nearly equally far from a vertex.
std::vector<uint32_t> on_circle(Bench& bench, uint32_t center, uint32_t count, std::mt19937_64& random) {
    bench.ask({center});
    const std::vector<uint32_t> vertices = in_order(bench.field);
    const size_t taken = std::min(size_t{count}, vertices.size());
    const size_t first = random() % (vertices.size() - taken + 1);
    return {vertices.data() + first, vertices.data() + first + taken};
}

// Those beside a path from a vertex to the farthest one.
std::vector<uint32_t> on_line(Bench& bench, uint32_t end, uint32_t count) {
    bench.ask({end});
    std::vector<float> sum = bench.field;
    bench.ask({in_order(bench.field).back()});
    for (size_t v = 0; v < sum.size(); ++v) sum[v] += bench.field[v];
    std::vector<uint32_t> vertices = in_order(sum);
    vertices.resize(std::min(vertices.size(), size_t{count}));
    return vertices;
}

std::vector<uint32_t> sources_of(Bench& bench, Arrangement where, uint32_t count, uint64_t seed,
                                 std::mt19937_64& random) {
    const uint32_t drawn = where == Arrangement::anywhere ? count : 1;
    const std::vector<uint32_t> sources = random_sources(bench.solver, bench.model, drawn, seed);
    switch (where) {
    case Arrangement::together:
        return together(bench, sources[0], count, random);
    case Arrangement::circle:
        return on_circle(bench, sources[0], count, random);
    case Arrangement::line:
        return on_line(bench, sources[0], count);
    default:
        return sources;
    }
}

// The least answers of the single sources.
std::vector<float> least_of_each(Bench& bench, const std::vector<uint32_t>& sources) {
    std::vector<float> least(bench.field.size(), std::numeric_limits<float>::infinity());
    for (const uint32_t source : sources) {
        bench.ask({source});
        for (size_t v = 0; v < least.size(); ++v) least[v] = std::min(least[v], bench.field[v]);
    }
    return least;
}

// By how much an answer is worse than another one, relative to the exact distance.
double loss(double answer, double other, double exact) {
    if (!(exact > 0) || std::isinf(exact)) return 0;
    return (std::abs(answer - exact) - std::abs(other - exact)) / exact;
}

Row several_row(Bench& bench, uint32_t count, const std::pair<Arrangement, const char*>& where) {
    std::mt19937_64 random(SEED + count);
    std::vector<Duration> overlay, from_scratch;
    ErrorSample errors;
    double largest_loss = 0;
    for (uint32_t round = 0; round < ROUNDS; ++round) {
        const std::vector<uint32_t> sources =
            sources_of(bench, where.first, count, SEED + uint64_t{count} * ROUNDS + round, random);
        const std::vector<float> least = least_of_each(bench, sources);
        bench.ask(sources);
        overlay.push_back(time_of([&] { bench.ask(sources); }));
        from_scratch.push_back(time_of([&] { bench.compute(sources); }));
        for (size_t v = 0; v < bench.field.size(); ++v) {
            errors.add(double{bench.field[v]}, bench.exact[v]);
            largest_loss =
                std::max(largest_loss, loss(double{bench.field[v]}, double{least[v]}, bench.exact[v]));
        }
    }
    const double seconds = median(overlay).wall;
    const ErrorSummary error = errors.relative();
    return {{"where", "where", where.second},
            {"sources", "sources", uint64_t{count}},
            {"msad_ms", "MSAD ms", 1e3 * seconds},
            {"msad_ns_per_vertex", "ns/vertex", 1e9 * seconds / static_cast<double>(bench.field.size())},
            {"exact_ms", "exact ms", 1e3 * median(from_scratch).wall},
            {"mean_percent", "mean %", 100 * error.mean},
            {"p999_percent", "p99.9 %", 100 * error.p999},
            {"max_percent", "max %", 100 * error.max},
            {"loss_percent", "worse than the single ones by %", 100 * largest_loss}};
}

void several(const SeveralArguments& arguments) {
    const Model model = load_model(arguments.mesh, arguments.folder);
    const tools::Index index = tools::open_index(arguments.index, &model.mesh);
    Report report("several", {{"index", "Index", arguments.index}, {"rounds", "rounds", uint64_t{ROUNDS}}},
                  arguments.report);
    const tools::Solver solver = tools::make_solver(model.mesh, model.path, options_for(1, {}));
    const tools::Query query = tools::make_query(*index, arguments.index);
    const size_t count = model.mesh.vertex_count();
    Bench bench{model, *query, *solver, std::vector<float>(count), std::vector<double>(count)};
    Table table{"several_sources", "MSAD of several sources", {}};
    for (const auto& where : ARRANGEMENTS)
        for (const uint32_t sources : arguments.counts)
            if (sources > 1 || where.first == Arrangement::anywhere)
                table.rows.push_back(several_row(bench, sources, where));
    report.add(table);
}

}

void add_several(CLI::App& app) {
    auto arguments = std::make_shared<SeveralArguments>();
    CLI::App* command =
        app.add_subcommand("several", "MSAD of several sources, against the exact metric from scratch");
    command->add_option("MESH", arguments->mesh, "mesh file or name")->required();
    command->add_option("INDEX", arguments->index, "index file of this mesh, of the exact metric")
        ->required();
    add_mesh_folder(*command, arguments->folder);
    command->add_option("--sources", arguments->counts, "how many (n1,n2,...)")
        ->delimiter(',')
        ->check(CLI::PositiveNumber)
        ->capture_default_str();
    add_report_options(*command, arguments->report);
    command->callback([arguments] { several(*arguments); });
}

}
