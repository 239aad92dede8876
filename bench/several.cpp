#include <algorithm>
#include <memory>
#include <numeric>
#include <random>

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

struct QueryCloser {
    void operator()(geoidx_query* query) const { geoidx_query_close(query); }
};
using Query = std::unique_ptr<geoidx_query, QueryCloser>;

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

// The vertices around the first source, of which it takes as many.
std::vector<uint32_t> cluster(Bench& bench, uint32_t center, uint32_t count, std::mt19937_64& random) {
    bench.ask({center});
    std::vector<uint32_t> vertices(bench.field.size());
    std::iota(vertices.begin(), vertices.end(), 0u);
    std::ranges::sort(vertices, {}, [&](uint32_t v) { return bench.field[v]; });
    vertices.resize(std::min(vertices.size(), size_t{CLUSTER} * count));
    std::vector<uint32_t> sources;
    for (uint32_t i = 0; i < count; ++i) sources.push_back(vertices[random() % vertices.size()]);
    return sources;
}

Row several_row(Bench& bench, uint32_t count, bool is_cluster) {
    std::mt19937_64 random(SEED + count);
    std::vector<Duration> overlay, from_scratch;
    ErrorSample errors;
    for (uint32_t round = 0; round < ROUNDS; ++round) {
        std::vector<uint32_t> sources = random_sources(bench.solver, bench.model, is_cluster ? 1 : count,
                                                       SEED + uint64_t{count} * ROUNDS + round);
        if (is_cluster) sources = cluster(bench, sources.front(), count, random);
        bench.ask(sources);
        overlay.push_back(time_of([&] { bench.ask(sources); }));
        from_scratch.push_back(time_of([&] { bench.compute(sources); }));
        for (size_t v = 0; v < bench.field.size(); ++v) errors.add(double{bench.field[v]}, bench.exact[v]);
    }
    const double seconds = median(overlay).wall;
    const ErrorSummary error = errors.relative();
    return {{"where", "where", is_cluster ? "together" : "anywhere"},
            {"sources", "sources", uint64_t{count}},
            {"msad_ms", "MSAD ms", 1e3 * seconds},
            {"msad_ns_per_vertex", "ns/vertex", 1e9 * seconds / static_cast<double>(bench.field.size())},
            {"exact_ms", "exact ms", 1e3 * median(from_scratch).wall},
            {"mean_percent", "mean %", 100 * error.mean},
            {"p999_percent", "p99.9 %", 100 * error.p999},
            {"max_percent", "max %", 100 * error.max}};
}

void several(const SeveralArguments& arguments) {
    const Model model = load_model(arguments.mesh, arguments.folder);
    const tools::Index index = tools::open_index(arguments.index, &model.mesh);
    Report report("several", {{"index", "Index", arguments.index}, {"rounds", "rounds", uint64_t{ROUNDS}}},
                  arguments.report);
    const tools::Solver solver = tools::make_solver(model.mesh, model.path, options_for(1, {}));
    geoidx_query* created = nullptr;
    tools::require_ok(geoidx_query_create(index.get(), &created), arguments.index);
    const Query query(created);
    const size_t count = model.mesh.vertex_count();
    Bench bench{model, *query, *solver, std::vector<float>(count), std::vector<double>(count)};
    Table table{"several_sources", "MSAD of several sources", {}};
    for (const bool is_cluster : {false, true})
        for (const uint32_t sources : arguments.counts)
            if (sources > 1 || !is_cluster) table.rows.push_back(several_row(bench, sources, is_cluster));
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
