#include <limits>
#include <memory>

#include "bench/commands.h"
#include "bench/report.h"
#include "bench/rows.h"
#include "tools/failure.h"

namespace geodesic::bench {

namespace {

struct ErrorArguments {
    std::string mesh;
    std::string index;
    std::string folder;
    double weld_tolerance = 0;
    uint32_t error_sources = 20;
    ReportArguments report;
};

tools::Solver solver_for(const Model& model, const geoidx_info& info, const ErrorArguments& arguments) {
    if (info.metric == GEOIDX_METRIC_CALLBACK)
        throw tools::Failure(arguments.index + ": its metric is a callback, which only its builder has");
    geoidx_build_options options = options_for(1, {});
    options.metric = info.metric;
    options.weld_tolerance = arguments.weld_tolerance;
    return tools::make_solver(model.mesh, model.path, options);
}

Row error_row(const char* query, const char* unit, const ErrorSummary& error) {
    return {{"query", "query", query},
            {"unit", "% of", unit},
            {"count", "distances", error.count},
            {"mean_percent", "mean %", 100 * error.mean},
            {"signed_mean_percent", "signed mean %", 100 * error.signed_mean},
            {"p99_percent", "p99 %", 100 * error.p99},
            {"p999_percent", "p99.9 %", 100 * error.p999},
            {"max_percent", "max %", 100 * error.max}};
}

Table error_table(const IndexErrors& errors, double diagonal) {
    Table table{"errors", "Errors", {}};
    const auto add = [&](const char* query, const ErrorSample& sample) {
        table.rows.push_back(error_row(query, "distance", sample.relative()));
        table.rows.push_back(error_row(query, "diagonal", sample.scaled_by(diagonal)));
    };
    add("MSAD", errors.msad);
    add("SSSD", errors.sssd);
    add("SSSD - MSAD", errors.difference);
    return table;
}

// Of MSAD: relative errors are largest a few edges from a source.
Table near_table(const ErrorSample& msad, double edge) {
    Table table{"errors_by_distance", "Errors of MSAD by distance", {}};
    double from = 0;
    for (double to : {2., 4., 8., 16., 32., 64., std::numeric_limits<double>::infinity()}) {
        const ErrorSummary error = msad.relative_between(from * edge, to * edge);
        table.rows.push_back({{"edges", "up to average edges", to},
                              {"count", "distances", error.count},
                              {"mean_percent", "mean %", 100 * error.mean},
                              {"signed_mean_percent", "signed mean %", 100 * error.signed_mean},
                              {"p999_percent", "p99.9 %", 100 * error.p999},
                              {"max_percent", "max %", 100 * error.max}});
        from = to;
    }
    return table;
}

// What the builder measured itself, to compare with.
Table stored_table(const geoidx_info& info) {
    const ErrorSummary stored{
        0, info.error_mean, info.error_signed_mean, info.error_p99, info.error_p999, info.error_max};
    Row row = error_row("MSAD", "distance", stored);
    std::erase_if(row, [](const Field& field) { return field.key == "count"; });
    row.insert(row.begin(), {"sources", "sources", uint64_t{info.error_sources}});
    return {"stored_errors", "Errors as the file states them", {row}};
}

Row index_row(const Model& model, const geoidx& index, const geoidx_info& info) {
    Row row{{"mesh", "mesh", model.name},
            {"vertices", "vertices", uint64_t{info.vertex_count}},
            {"metric", "metric", tools::metric_name(info.metric)},
            {"delta_percent", "delta %", info.delta, 2},
            {"bounding_box_diagonal", "diagonal", info.bounding_box_diagonal, 6},
            {"file_bytes", "file bytes", file_size(index, model.path)}};
    add_patches(row, info);
    return row;
}

Row parameters_of(const ErrorArguments& arguments) {
    Row row{{"index", "index", arguments.index}};
    const Row workload = error_parameters(arguments.error_sources);
    row.insert(row.end(), workload.begin(), workload.end());
    return row;
}

void error(const ErrorArguments& arguments) {
    const Model model = load_model(arguments.mesh, arguments.folder);
    const tools::Index index = tools::open_index(arguments.index, &model.mesh);
    const geoidx_info info = tools::info_of(*index, arguments.index);
    Report report("error", parameters_of(arguments), arguments.report);
    report.add({"index", "Index", {index_row(model, *index, info)}});

    const tools::Solver solver = solver_for(model, info, arguments);
    const Workload workload = make_workload(*solver, model, arguments.error_sources);
    const IndexErrors errors = measure_errors(*index, model, workload);
    report.add(error_table(errors, info.bounding_box_diagonal));
    report.add(near_table(errors.msad, average_edge(model.mesh)));
    report.add(stored_table(info));
    const std::string note = mismatch_note(model.name, errors);
    if (!note.empty()) report.note(note);
}

}

void add_error(CLI::App& app) {
    auto arguments = std::make_shared<ErrorArguments>();
    CLI::App* command = app.add_subcommand("error", "errors of an index file");
    command->add_option("MESH", arguments->mesh, "mesh file or name")->required();
    command->add_option("INDEX", arguments->index, "index file of this mesh")->required();
    add_mesh_folder(*command, arguments->folder);
    command->add_option("--sources", arguments->error_sources, "that errors are measured from")
        ->check(CLI::PositiveNumber)
        ->capture_default_str();
    command->add_option("--weld-tolerance", arguments->weld_tolerance, "that the index was built with")
        ->capture_default_str();
    add_report_options(*command, arguments->report);
    command->callback([arguments] { error(*arguments); });
}

}
