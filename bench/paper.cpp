#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>

#include "bench/commands.h"
#include "bench/plot.h"
#include "bench/report.h"
#include "bench/rows.h"
#include "tools/failure.h"

// The tables and the figure of Aiello et al., "Compression and Querying of Arbitrary Geodesic Distances",
// 2015: an index of two levels for every n1 and n2, then pruning of the best one.

namespace geodesic::bench {

namespace {

constexpr double ACCEPTED_MEAN_ERROR = 0.003; // of the n1 and n2 that are called best
constexpr double DELTAS[] = {0, 0.1, 0.2, 0.5, 1, 2};

struct PaperArguments {
    std::string mesh;
    std::string folder;
    std::vector<uint32_t> n1{8, 16, 32};
    std::vector<uint32_t> leaf{60, 110, 200};
    bool quick = false;
    uint32_t threads = 2;
    uint32_t error_sources = 20;
    std::string csv;
    std::string svg;
    ReportArguments report;
};

struct Configuration {
    uint32_t n1;
    uint32_t n2;
    double delta;
};

struct Run {
    Configuration configuration;
    geoidx_info info;
    double sssd;       // seconds
    double msad;       // seconds
    double mean_error; // of MSAD, a fraction
    Row figures;       // what all tables show
};

class Experiment {
public:
    Experiment(const PaperArguments& arguments, Report& report)
        : arguments_(arguments), report_(report), model_(load_model(arguments.mesh, arguments.folder)) {
        progress(model_.name + ": exact distances");
        const geoidx_build_options options = options_for(1, {});
        const tools::Solver solver = tools::make_solver(model_.mesh, model_.path, options);
        workload_ = make_workload(*solver, model_, arguments.error_sources);
    }

    const Model& model() const { return model_; }

    Run run(const Configuration& configuration) const {
        progress(model_.name + ": n1 " + std::to_string(configuration.n1) + ", n2 " +
                 std::to_string(configuration.n2) + ", delta " + to_text(configuration.delta, 2) + " %");
        geoidx_build_options options = options_for(arguments_.threads, {configuration.n1, configuration.n2});
        options.engine = GEOIDX_ENGINE_GRAPH;
        options.delta = configuration.delta;
        const Measurement measurement = measure(build_index(model_, options), model_, workload_);
        const std::string note = mismatch_note(model_.name, measurement.errors);
        if (!note.empty()) report_.note(note);
        return summary(configuration, measurement);
    }

private:
    static Run summary(const Configuration& configuration, const Measurement& measurement) {
        Run run{configuration,
                measurement.info,
                measurement.times.sssd.wall,
                measurement.times.msad.wall,
                measurement.errors.msad.relative().mean,
                {}};
        add_query_times(run.figures, measurement);
        add_errors(run.figures, measurement.errors, measurement.info);
        add_build_time(run.figures, measurement.build, measurement.info);
        add_size(run.figures, measurement);
        return run;
    }

    const PaperArguments& arguments_;
    Report& report_;
    Model model_;
    Workload workload_;
};

// Every n1 with the n2 that make leaves of about the sizes asked for.
std::vector<Configuration> configurations(const PaperArguments& arguments, size_t vertex_count) {
    std::vector<Configuration> result;
    for (const uint32_t n1 : arguments.n1) {
        uint32_t previous = 0;
        for (const uint32_t leaf : arguments.leaf) {
            const double leaves = static_cast<double>(vertex_count) / static_cast<double>(leaf);
            const double n2 = std::round(leaves / static_cast<double>(n1));
            const auto count = static_cast<uint32_t>(std::max(2.0, n2));
            if (count != previous) result.push_back({n1, count, 0});
            previous = count;
        }
    }
    return result;
}

Row joined(Row head, const Row& figures) {
    head.insert(head.end(), figures.begin(), figures.end());
    return head;
}

Row sweep_row(const Run& run) {
    return joined({{"n1", "n1", uint64_t{run.configuration.n1}},
                   {"n2", "n2", uint64_t{run.configuration.n2}},
                   {"patches_level_1", "level 1", uint64_t{run.info.patch_count[0]}},
                   {"patches_level_2", "level 2", uint64_t{run.info.patch_count[1]}},
                   {"border_vertices", "", run.info.border_vertex_count}},
                  run.figures);
}

Row delta_row(const Run& run) {
    return joined({{"n1", "", uint64_t{run.configuration.n1}},
                   {"n2", "", uint64_t{run.configuration.n2}},
                   {"delta_percent", "delta %", run.configuration.delta, 2},
                   {"border_vertices", "border vertices", run.info.border_vertex_count}},
                  run.figures);
}

Row figure_row(const Run& run) {
    return {{"n1", "n1", uint64_t{run.configuration.n1}},
            {"n2", "n2", uint64_t{run.configuration.n2}},
            {"msad_ms", "MSAD ms", 1e3 * run.msad},
            {"sssd_us", "SSSD µs", 1e6 * run.sssd}};
}

Table table_of(const char* key, const std::string& title, const std::vector<Run>& runs,
               Row (*row_of)(const Run&)) {
    Table table{key, title, {}};
    for (const Run& run : runs) table.rows.push_back(row_of(run));
    return table;
}

std::vector<Run> by_patches(std::vector<Run> runs) {
    std::sort(runs.begin(), runs.end(), [](const Run& a, const Run& b) {
        return std::pair(a.configuration.n1, a.configuration.n2) <
               std::pair(b.configuration.n1, b.configuration.n2);
    });
    return runs;
}

Plot figure_8(const std::string& name, const std::vector<Run>& sorted_runs) {
    Plot plot{name + ": time of MSAD", "n2", "ms", {}};
    uint32_t n1 = 0;
    for (const Run& run : sorted_runs) {
        if (run.configuration.n1 != n1)
            plot.series.push_back({"n1 = " + std::to_string(run.configuration.n1), {}});
        n1 = run.configuration.n1;
        plot.series.back().points.push_back({static_cast<double>(run.configuration.n2), 1e3 * run.msad});
    }
    return plot;
}

const Run& best_of(const std::vector<Run>& runs) {
    const auto accepted = [](const Run& run) { return run.mean_error <= ACCEPTED_MEAN_ERROR; };
    return *std::min_element(runs.begin(), runs.end(), [&](const Run& a, const Run& b) {
        if (accepted(a) != accepted(b)) return accepted(a);
        return accepted(a) ? a.msad < b.msad : a.mean_error < b.mean_error;
    });
}

std::vector<Run> table_1(const Experiment& experiment, const PaperArguments& arguments, Report& report) {
    std::vector<Run> runs;
    const size_t vertex_count = experiment.model().mesh.vertex_count();
    for (const Configuration& configuration : configurations(arguments, vertex_count))
        runs.push_back(experiment.run(configuration));
    report.add(table_of("table_1", "Table 1: patches of two levels", runs, sweep_row));
    return runs;
}

void figure_8(const Experiment& experiment, const PaperArguments& arguments, const std::vector<Run>& runs,
              Report& report) {
    const std::vector<Run> sorted = by_patches(runs);
    Table table = table_of("figure_8", "Figure 8: time against n2, for each n1", sorted, figure_row);
    if (!arguments.csv.empty()) write_text_file(arguments.csv, to_csv(table));
    if (!arguments.svg.empty())
        write_text_file(arguments.svg, to_svg(figure_8(experiment.model().name, sorted)));
    report.add(std::move(table));
}

void table_2(const Experiment& experiment, const Run& best, Report& report) {
    if (best.mean_error > ACCEPTED_MEAN_ERROR)
        report.note("No n1 and n2 has a mean error of at most 0.3 %: the most accurate ones are taken.");
    std::vector<Run> runs;
    for (const double delta : DELTAS) {
        const Configuration pruned{best.configuration.n1, best.configuration.n2, delta};
        runs.push_back(delta > 0 ? experiment.run(pruned) : best);
    }
    const std::string title = "Table 2: pruning with n1 = " + std::to_string(best.configuration.n1) +
                              ", n2 = " + std::to_string(best.configuration.n2);
    report.add(table_of("table_2", title, runs, delta_row));
}

Row parameters_of(const PaperArguments& arguments) {
    return joined(
        {{"mesh", "mesh", arguments.mesh}, {"threads", "build threads", uint64_t{arguments.threads}}},
        workload_parameters(arguments.error_sources));
}

void paper(PaperArguments arguments) {
    if (arguments.quick) {
        arguments.n1.resize(std::min<size_t>(arguments.n1.size(), 2));
        arguments.leaf.resize(std::min<size_t>(arguments.leaf.size(), 2));
    }
    Report report("paper", parameters_of(arguments), arguments.report);
    const Experiment experiment(arguments, report);
    const std::vector<Run> runs = table_1(experiment, arguments, report);
    figure_8(experiment, arguments, runs, report);
    table_2(experiment, best_of(runs), report);
}

}

void add_paper(CLI::App& app) {
    auto arguments = std::make_shared<PaperArguments>();
    CLI::App* command = app.add_subcommand("paper", "the paper's Table 1, Figure 8 and Table 2");
    command->add_option("MESH", arguments->mesh, "mesh file or name")->required();
    add_mesh_folder(*command, arguments->folder);
    command->add_option("--n1", arguments->n1, "patches of level 1")
        ->delimiter(',')
        ->check(CLI::PositiveNumber)
        ->capture_default_str();
    command->add_option("--leaf", arguments->leaf, "vertices a leaf, which n2 follows from")
        ->delimiter(',')
        ->check(CLI::PositiveNumber)
        ->capture_default_str();
    command->add_flag("--quick", arguments->quick, "the first two of each only");
    command->add_option("--threads", arguments->threads, "of building")
        ->check(CLI::PositiveNumber)
        ->capture_default_str();
    command->add_option("--sources", arguments->error_sources, "that errors are measured from")
        ->check(CLI::PositiveNumber)
        ->capture_default_str();
    command->add_option("--csv", arguments->csv, "file to write the series of Figure 8 to");
    command->add_option("--svg", arguments->svg, "file to draw Figure 8 in");
    add_report_options(*command, arguments->report);
    command->callback([arguments] { paper(*arguments); });
}

}
