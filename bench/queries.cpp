#include <limits>
#include <memory>
#include <optional>

#include "bench/commands.h"
#include "bench/machine.h"
#include "bench/report.h"
#include "bench/rows.h"
#include "tools/failure.h"

namespace geodesic::bench {

namespace {

struct QueriesArguments {
    std::vector<std::string> meshes;
    std::string folder;
    std::string index; // file; empty: build
    std::string keep;  // folder for the indices built; empty: they are not kept
    std::vector<std::string> engines{tools::ENGINE_NAMES[GEOIDX_ENGINE_OVERLAY],
                                     tools::ENGINE_NAMES[GEOIDX_ENGINE_GRAPH]};
    std::vector<uint32_t> patches;
    uint32_t exact_vertices = 0;
    double delta = 0;
    uint32_t threads = 2;
    uint32_t error_sources = 20;
    ReportArguments report;
};

geoidx_build_options build_options(const QueriesArguments& arguments, const std::string& engine) {
    geoidx_build_options options = options_for(arguments.threads, arguments.patches);
    options.engine = tools::engine_of_name(engine);
    if (arguments.exact_vertices) options.exact_vertices = arguments.exact_vertices;
    options.delta = arguments.delta;
    return options;
}

BuiltIndex built_or_opened(const Model& model, const QueriesArguments& arguments, const std::string& engine) {
    if (arguments.index.empty()) {
        BuiltIndex built = build_index(model, build_options(arguments, engine));
        if (!arguments.keep.empty()) {
            const std::string path = arguments.keep + '/' + model.name + '-' + engine + ".gidx";
            tools::require_ok(geoidx_save(built.index.get(), path.c_str(), nullptr), path);
        }
        return built;
    }
    const double unknown = std::numeric_limits<double>::quiet_NaN();
    return {tools::open_index(arguments.index, &model.mesh), {unknown, unknown}};
}

Workload workload_of(const Model& model, uint32_t metric, uint32_t error_sources) {
    geoidx_build_options options = options_for(1, {});
    options.metric = metric;
    const tools::Solver solver = tools::make_solver(model.mesh, model.path, options);
    return make_workload(*solver, model, error_sources);
}

Row row_of(const Model& model, const Measurement& measurement, uint64_t build_peak) {
    Row row{{"mesh", "mesh", model.name},
            {"engine", "engine", std::string(tools::ENGINE_NAMES[measurement.info.engine])},
            {"vertices", "vertices", uint64_t{measurement.info.vertex_count}}};
    add_patches(row, measurement.info);
    add_query_times(row, measurement);
    add_errors(row, measurement.errors, measurement.info);
    add_build_time(row, measurement.build, measurement.info);
    row.push_back({"peak_bytes", "", build_peak});
    row.push_back({"peak_mib", "peak MiB", static_cast<double>(build_peak) / (1 << 20)});
    add_size(row, measurement);
    return row;
}

// The peak is that of building (or opening) alone: exact distances come afterwards.
Row measured(const Model& model, const QueriesArguments& arguments, const std::string& engine,
             std::optional<Workload>& workload, Report& report) {
    progress(model.name + ", " + engine + (arguments.index.empty() ? ": building" : ": opening"));
    forget_peak_memory();
    const BuiltIndex built = built_or_opened(model, arguments, engine);
    const uint64_t peak = peak_memory();
    if (!workload) {
        progress(model.name + ": exact distances");
        const uint32_t metric = tools::info_of(*built.index, model.path).metric;
        workload = workload_of(model, metric, arguments.error_sources);
    }
    progress(model.name + ", " + engine + ": queries");
    const Measurement measurement = measure(built, model, *workload);
    const std::string note = mismatch_note(model.name, measurement.errors);
    if (!note.empty()) report.note(note);
    return row_of(model, measurement, peak);
}

Row parameters_of(const QueriesArguments& arguments) {
    Row row{{"index", "index", arguments.index.empty() ? "built" : arguments.index},
            {"threads", "build threads", uint64_t{arguments.threads}}};
    const Row workload = workload_parameters(arguments.error_sources);
    row.insert(row.end(), workload.begin(), workload.end());
    return row;
}

void queries(const QueriesArguments& arguments) {
    if (!arguments.index.empty() && arguments.meshes.size() != 1)
        throw CLI::ValidationError("--index belongs to one mesh, not several");
    const std::vector<std::string> engines =
        arguments.index.empty() ? arguments.engines : std::vector<std::string>{"as built"};
    Report report("queries", parameters_of(arguments), arguments.report);
    Table table{"queries", "Queries", {}};
    const size_t failed = for_each_model(arguments.meshes, arguments.folder, [&](const Model& model) {
        std::optional<Workload> workload;
        for (const std::string& engine : engines)
            table.rows.push_back(measured(model, arguments, engine, workload, report));
    });
    report.add(std::move(table));
    require_none(failed);
}

void add_index_options(CLI::App& command, QueriesArguments& arguments) {
    CLI::Option* const index =
        command.add_option("--index", arguments.index, "index file, instead of building");
    command
        .add_option("--patches", arguments.patches,
                    "patches of level 1, then patches each patch is split into, level by level (n1,n2,...)")
        ->delimiter(',')
        ->check(CLI::PositiveNumber)
        ->excludes(index);
    command.add_option("--engine", arguments.engines, "graph, overlay, or both, one after the other")
        ->delimiter(',')
        ->check(CLI::IsMember(tools::ENGINE_NAMES))
        ->excludes(index)
        ->capture_default_str();
    command.add_option("--exact-vertices", arguments.exact_vertices, "as geoidx_build_options")
        ->excludes(index);
    command.add_option("--delta", arguments.delta, "pruning threshold, % of the bounding-box diagonal")
        ->excludes(index)
        ->capture_default_str();
    command.add_option("--keep", arguments.keep, "folder to save the indices in, as NAME-ENGINE.gidx")
        ->excludes(index)
        ->check(CLI::ExistingDirectory);
    command.add_option("--threads", arguments.threads, "of building")
        ->check(CLI::PositiveNumber)
        ->capture_default_str();
}

}

void add_queries(CLI::App& app) {
    auto arguments = std::make_shared<QueriesArguments>();
    CLI::App* command = app.add_subcommand("queries", "times, errors and sizes of indices");
    command->add_option("MESH", arguments->meshes, "mesh files or names")->required();
    add_mesh_folder(*command, arguments->folder);
    add_index_options(*command, *arguments);
    command->add_option("--sources", arguments->error_sources, "that errors are measured from")
        ->check(CLI::PositiveNumber)
        ->capture_default_str();
    add_report_options(*command, arguments->report);
    command->callback([arguments] { queries(*arguments); });
}

}
