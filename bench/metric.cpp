#include <algorithm>
#include <cmath>
#include <cstdio>
#include <functional>
#include <future>
#include <memory>

#include <malloc.h>

#include "bench/commands.h"
#include "bench/report.h"
#include "bench/statistics.h"
#include "bench/workload.h"
#include "tools/failure.h"
#include "tools/library.h"

namespace geodesic::bench {

namespace {

constexpr uint32_t LOCAL_SIZES[] = {150, 500, 4000}; // vertices of the fields of single patches

struct MetricArguments {
    std::vector<std::string> meshes;
    std::string folder;
    uint32_t fields = 20;
    uint32_t locals = 200;
    uint32_t threads = 2;
    std::string beside;
    std::vector<double> tolerances;
    ReportArguments report;
};

struct Task {
    uint32_t source;
    std::vector<uint32_t> targets; // none: every vertex
};

struct Timing {
    Duration per_vertex; // median of the tasks
    double elapsed;      // seconds for all tasks
};

using Solvers = std::vector<tools::Solver>;

Solvers make_solvers(const Model& model, uint32_t count, double tolerance = 0) {
    geoidx_build_options options;
    geoidx_build_options_init(&options);
    options.solver_tolerance = tolerance;
    Solvers solvers;
    for (uint32_t i = 0; i < count; ++i)
        solvers.push_back(tools::make_solver(model.mesh, model.path, options));
    return solvers;
}

// Calls work(solver, i) for i in 0 .. count - 1, on one thread a solver.
void on_all(std::span<const tools::Solver> solvers, size_t count,
            const std::function<void(geoidx_solver&, size_t)>& work) {
    std::vector<std::future<void>> threads;
    for (size_t t = 0; t < solvers.size(); ++t)
        threads.push_back(std::async(std::launch::async, [&, t] {
            for (size_t i = t; i < count; i += solvers.size()) work(*solvers[t], i);
        }));
    for (std::future<void>& thread : threads) thread.get();
}

// The k nearest vertices of the source, fewer where it does not reach so many.
std::vector<uint32_t> nearest(const std::vector<double>& field, size_t k) {
    std::vector<uint32_t> vertices;
    for (uint32_t v = 0; v < field.size(); ++v)
        if (std::isfinite(field[v])) vertices.push_back(v);
    k = std::min(k, vertices.size());
    const auto end = vertices.begin() + static_cast<std::ptrdiff_t>(k);
    std::partial_sort(vertices.begin(), end, vertices.end(), [&](uint32_t a, uint32_t b) {
        return field[a] < field[b] || (field[a] == field[b] && a < b);
    });
    vertices.resize(k);
    return vertices;
}

std::vector<Task> global_tasks(std::span<const uint32_t> sources) {
    std::vector<Task> tasks;
    for (const uint32_t source : sources) tasks.push_back({source, {}});
    return tasks;
}

// One target each, anywhere.
std::vector<Task> pairs(std::span<const uint32_t> sources, std::span<const uint32_t> targets) {
    std::vector<Task> tasks;
    for (size_t i = 0; i < sources.size(); ++i) tasks.push_back({sources[i], {targets[i]}});
    return tasks;
}

// The nearest vertices of each source, as many as the largest of LOCAL_SIZES, nearest first.
std::vector<Task> neighbourhoods(std::span<const tools::Solver> solvers, const Model& model,
                                 std::span<const uint32_t> sources) {
    std::vector<Task> tasks(sources.size());
    on_all(solvers, sources.size(), [&](geoidx_solver& solver, size_t i) {
        const std::vector<double> field = exact_field(solver, model, sources[i]);
        tasks[i] = {sources[i], nearest(field, *std::ranges::max_element(LOCAL_SIZES))};
    });
    return tasks;
}

std::vector<Task> shortened(std::vector<Task> tasks, uint32_t size) {
    std::erase_if(tasks, [&](const Task& task) { return task.targets.size() < size; });
    for (Task& task : tasks) task.targets.resize(size);
    return tasks;
}

// Seconds for each vertex that was reached.
Duration solve(geoidx_solver& solver, const Model& model, const Task& task) {
    std::vector<double> distances(task.targets.empty() ? model.mesh.vertex_count() : task.targets.size());
    geoidx_status status = GEOIDX_OK;
    const Duration duration = time_of([&] {
        status = geoidx_solver_distances(&solver, &task.source, 1,
                                         task.targets.empty() ? nullptr : task.targets.data(),
                                         static_cast<uint32_t>(distances.size()), distances.data());
    });
    tools::require_ok(status, model.path);
    const auto reached = static_cast<double>(
        std::ranges::count_if(distances, [](double distance) { return std::isfinite(distance); }));
    return {duration.wall / reached, duration.cpu / reached};
}

Timing run(std::span<const tools::Solver> solvers, const Model& model, const std::vector<Task>& tasks) {
    std::vector<Duration> durations(tasks.size());
    const Duration elapsed = time_of([&] {
        on_all(solvers, tasks.size(),
               [&](geoidx_solver& solver, size_t i) { durations[i] = solve(solver, model, tasks[i]); });
    });
    return {median(durations), elapsed.wall};
}

// Bytes that malloc has given out.
double heap_in_use() {
    const auto info = mallinfo2();
    return static_cast<double>(info.uordblks + info.hblkhd);
}

// What the first whole field of a solver makes it keep, and what the solver had before.
Row memory_row(const Model& model, uint32_t source) {
    const double before = heap_in_use();
    const Solvers solvers = make_solvers(model, 1);
    const double made = heap_in_use();
    exact_field(*solvers[0], model, source);
    const double solved = heap_in_use();
    const auto vertices = static_cast<double>(model.mesh.vertex_count());
    return {{"mesh", "mesh", model.name},
            {"solver_bytes_per_vertex", "solver, bytes/vertex", (made - before) / vertices},
            {"field_bytes_per_vertex", "first whole field, bytes/vertex", (solved - made) / vertices}};
}

// Another program's whole fields from the same sources: it is run as `PROGRAM MESH SOURCE...` and prints the
// seconds of each.
double other_seconds(const std::string& program, const Model& model, std::span<const uint32_t> sources) {
    std::string command = program + " '" + model.path + "'";
    for (const uint32_t source : sources) command += " " + std::to_string(source);
    const std::unique_ptr<FILE, int (*)(FILE*)> output(popen(command.c_str(), "r"), pclose);
    std::vector<double> seconds;
    double value = 0;
    while (output && std::fscanf(output.get(), "%lf", &value) == 1) seconds.push_back(value);
    if (seconds.size() != sources.size()) throw tools::Failure(program + ": did not print a time a source");
    return median(std::move(seconds));
}

Row beside_row(const Model& model, const std::string& program, std::span<const uint32_t> sources,
               const Solvers& solvers) {
    const double other =
        other_seconds(program, model, sources) / static_cast<double>(model.mesh.vertex_count());
    const double own = run(std::span(solvers).first(1), model, global_tasks(sources)).per_vertex.wall;
    return {{"mesh", "mesh", model.name},
            {"us_per_vertex", "µs/vertex", 1e6 * own},
            {"other_us_per_vertex", program + ", µs/vertex", 1e6 * other},
            {"ratio", "ratio", own / other}};
}

// The same whole fields with a tolerance and without, each in turn.
Row tolerance_row(const Model& model, double tolerance, std::span<const uint32_t> sources,
                  const Solvers& exact) {
    const Solvers tolerant = make_solvers(model, 1, tolerance);
    std::vector<double> seconds, exact_seconds;
    double sum = 0, largest = 0, count = 0;
    for (const uint32_t source : sources) {
        std::vector<double> expected, found;
        exact_seconds.push_back(time_of([&] { expected = exact_field(*exact[0], model, source); }).wall);
        seconds.push_back(time_of([&] { found = exact_field(*tolerant[0], model, source); }).wall);
        for (size_t v = 0; v < expected.size(); ++v) {
            if (!(expected[v] > 0) || !std::isfinite(expected[v])) continue;
            const double error = std::abs(found[v] / expected[v] - 1);
            sum += error;
            largest = std::max(largest, error);
            ++count;
        }
    }
    const double own = median(seconds), without = median(exact_seconds);
    return {{"mesh", "mesh", model.name},           {"tolerance", "tolerance", tolerance},
            {"field_ms", "ms a field", 1e3 * own},  {"exact_field_ms", "exact, ms", 1e3 * without},
            {"ratio", "ratio", own / without},      {"error_mean", "mean error", sum / count},
            {"error_max", "largest error", largest}};
}

Row row_of(const Model& model, const std::string& field, const std::vector<Task>& tasks,
           std::span<const tools::Solver> solvers) {
    const Timing alone = run(solvers.first(1), model, tasks);
    const Timing together = run(solvers, model, tasks);
    return {{"mesh", "mesh", model.name},
            {"vertices", "vertices", uint64_t{model.mesh.vertex_count()}},
            {"field", "field", field},
            {"solves", "solves", uint64_t{tasks.size()}},
            {"us_per_vertex", "µs/vertex, 1 thread", 1e6 * alone.per_vertex.wall},
            {"cpu_us_per_vertex", "", 1e6 * alone.per_vertex.cpu},
            {"threads", "threads", uint64_t{solvers.size()}},
            {"together_us_per_vertex", "µs/vertex, each thread", 1e6 * together.per_vertex.wall},
            {"together_cpu_us_per_vertex", "", 1e6 * together.per_vertex.cpu},
            {"elapsed_s", "", alone.elapsed},
            {"together_elapsed_s", "", together.elapsed},
            {"throughput_ratio", "throughput ratio", alone.elapsed / together.elapsed}};
}

void warm_up(const Solvers& solvers, const Model& model, uint32_t source) {
    on_all(solvers, solvers.size(),
           [&](geoidx_solver& solver, size_t) { exact_field(solver, model, source); });
}

struct Tables {
    Table times{"metric", "Exact distances without an index", {}};
    Table memory{"memory", "Memory", {}};
    Table tolerances{"tolerances", "Whole fields with a tolerance", {}};
    Table beside{"beside", "Whole fields beside another program", {}};
};

void measure_model(const Model& model, const MetricArguments& arguments, Tables& tables) {
    std::vector<Row>& rows = tables.times.rows;
    tables.memory.rows.push_back(memory_row(model, 0));
    const Solvers solvers = make_solvers(model, arguments.threads);
    const auto sources = random_sources(*solvers[0], model, arguments.fields, SEED);
    warm_up(solvers, model, sources.front());
    progress(model.name + ": whole fields");
    rows.push_back(row_of(model, "all", global_tasks(sources), solvers));

    progress(model.name + ": pairs");
    const auto targets = random_sources(*solvers[0], model, arguments.fields, SEED + 2);
    rows.push_back(row_of(model, "1, anywhere", pairs(sources, targets), solvers));

    progress(model.name + ": local fields");
    const auto local_sources = random_sources(*solvers[0], model, arguments.locals, SEED + 1);
    const std::vector<Task> largest = neighbourhoods(solvers, model, local_sources);
    for (const uint32_t size : LOCAL_SIZES) {
        const std::vector<Task> tasks = shortened(largest, size);
        if (!tasks.empty()) rows.push_back(row_of(model, std::to_string(size), tasks, solvers));
    }
    if (!arguments.tolerances.empty()) progress(model.name + ": tolerances");
    for (const double tolerance : arguments.tolerances)
        tables.tolerances.rows.push_back(tolerance_row(model, tolerance, sources, solvers));
    if (arguments.beside.empty()) return;
    progress(model.name + ": " + arguments.beside);
    tables.beside.rows.push_back(beside_row(model, arguments.beside, sources, solvers));
}

Row parameters_of(const MetricArguments& arguments) {
    return {{"seed", "seed", SEED},
            {"fields", "whole fields", uint64_t{arguments.fields}},
            {"locals", "local fields", uint64_t{arguments.locals}},
            {"threads", "threads", uint64_t{arguments.threads}}};
}

void metric(const MetricArguments& arguments) {
    Report report("metric", parameters_of(arguments), arguments.report);
    Tables tables;
    const size_t failed = for_each_model(arguments.meshes, arguments.folder, [&](const Model& model) {
        measure_model(model, arguments, tables);
    });
    report.add(std::move(tables.times));
    report.add(std::move(tables.memory));
    if (!arguments.tolerances.empty()) report.add(std::move(tables.tolerances));
    if (!arguments.beside.empty()) report.add(std::move(tables.beside));
    require_none(failed);
}

}

void add_metric(CLI::App& app) {
    auto arguments = std::make_shared<MetricArguments>();
    CLI::App* command = app.add_subcommand("metric", "times of exact distances without an index");
    command->add_option("MESH", arguments->meshes, "mesh files or names")->required();
    add_mesh_folder(*command, arguments->folder);
    const auto add = [&](const char* name, uint32_t& value, const char* what) {
        command->add_option(name, value, what)->check(CLI::PositiveNumber)->capture_default_str();
    };
    add("--fields", arguments->fields, "whole fields a mesh");
    add("--locals", arguments->locals, "local fields a size");
    add("--threads", arguments->threads, "at once, besides one alone");
    command->add_option(
        "--tolerance", arguments->tolerances,
        "also time whole fields with this solver_tolerance, and tell their errors; several are possible");
    command->add_option(
        "--beside", arguments->beside,
        "program to time beside, run as PROGRAM MESH SOURCE.., which prints the seconds of each field");
    add_report_options(*command, arguments->report);
    command->callback([arguments] { metric(*arguments); });
}

}
