#include <algorithm>
#include <chrono>

#include "tools/commands/arguments.h"
#include "tools/commands/commands.h"
#include "tools/commands/index_output.h"
#include "tools/commands/index_rows.h"
#include "tools/failure.h"
#include "tools/library.h"
#include "tools/mesh_io/mesh_io.h"
#include "tools/output_file.h"
#include "tools/progress_bar.h"
#include "tools/signals.h"

namespace geodesic::tools {

namespace {

struct BuildArguments {
    std::string mesh;
    std::string output;
    MetricArguments metric;
    std::string engine;
    FileForm form;
    uint32_t exact_vertices = 0;
    double rounding = 0;
    double target_error = 0;
    bool store_mesh = false;
    double delta = 0;
    uint32_t levels = 0;
    std::vector<uint32_t> patches;
    uint64_t seed = 0;
    uint32_t threads = 0;
    uint32_t lloyd_iterations = 0;
    bool progress = false;
    bool json = false;
};

int32_t on_progress(void* user, float fraction, const char* stage) {
    static_cast<ProgressBar*>(user)->show(fraction, stage ? stage : "");
    return 1; // Ctrl-C ends the program without asking
}

geoidx_build_options build_options(const BuildArguments& arguments, ProgressBar& bar) {
    geoidx_build_options options;
    geoidx_build_options_init(&options);
    apply(arguments.metric, options);
    options.engine = engine_of_name(arguments.engine);
    options.exact_vertices = arguments.exact_vertices;
    options.rounding = arguments.rounding;
    options.target_error = arguments.target_error;
    options.store_mesh = arguments.store_mesh ? 1 : 0;
    options.delta = arguments.delta;
    options.seed = arguments.seed;
    options.threads = arguments.threads;
    options.lloyd_iterations = arguments.lloyd_iterations;
    // Whoever gives the patches of three levels means three levels.
    options.level_count =
        arguments.levels ? arguments.levels : static_cast<uint32_t>(arguments.patches.size());
    std::copy(arguments.patches.begin(), arguments.patches.end(), options.patches);
    options.progress = on_progress;
    options.progress_user = &bar;
    return options;
}

Index build_index(const TriangleMesh& mesh, const BuildArguments& arguments, ProgressBar& bar) {
    const geoidx_build_options options = build_options(arguments, bar);
    const geoidx_mesh view = view_of(mesh);
    geoidx* index = nullptr;
    require_ok(geoidx_build(&view, &options, &index), arguments.mesh);
    return Index(index);
}

void print_json(const geoidx& index, const BuildArguments& arguments, double seconds) {
    const geoidx_info info = info_of_saved(index, arguments.form, arguments.output);
    JsonObject object;
    object.text("mesh", arguments.mesh).text("output", arguments.output).number("build_seconds", seconds);
    add_rows(rows_of_index(info, arguments.output, true), object);
    object.print();
}

void build(const BuildArguments& arguments) {
    require_json_apart(arguments.json, arguments.output);
    require_mesh_or_no_positions(arguments.form, arguments.store_mesh);
    require_index_output(arguments.output, arguments.mesh);
    const TriangleMesh mesh = read_mesh(arguments.mesh);
    ProgressBar bar(arguments.progress);
    const auto begin = std::chrono::steady_clock::now();
    const Index index = build_index(mesh, arguments, bar);
    const std::chrono::duration<double> time = std::chrono::steady_clock::now() - begin;
    save_index(*index, arguments.form, arguments.output);
    bar.show(1, "written");
    if (arguments.json) print_json(*index, arguments, time.count());
}

void add_shape_options(CLI::App& command, BuildArguments& arguments) {
    command.add_option("--engine", arguments.engine, "what answers queries: graph (the paper's) or overlay")
        ->check(CLI::IsMember(ENGINE_NAMES))
        ->capture_default_str();
    command
        .add_option("--exact-vertices", arguments.exact_vertices,
                    "of the overlay engine: largest patch whose tables are the metric's own distances")
        ->check(whole_number())
        ->capture_default_str();
    command
        .add_option("--rounding", arguments.rounding,
                    "of the overlay engine: what distances are rounded to, as a share of the way from a "
                    "vertex to the next; 0: 16 bits")
        ->capture_default_str();
    command
        .add_option("--target-error", arguments.target_error,
                    "of the overlay engine: mean error, as a share, above which vertices are added to the "
                    "borders of patches, also that of fields from points within large triangles; 0: never")
        ->capture_default_str();
    command.add_flag("--store-mesh", arguments.store_mesh,
                     "keep the mesh in the file, which then is enough for 'geoidx path'");
    add_form_options(command, arguments.form);
    command.add_option("--delta", arguments.delta, "pruning threshold, % of the bounding-box diagonal")
        ->capture_default_str();
    command.add_option("--levels", arguments.levels, "levels of patches; 0: automatic")
        ->check(CLI::Range(0, int{GEOIDX_MAX_LEVELS}))
        ->capture_default_str();
    command
        .add_option("--patches", arguments.patches,
                    "patches of level 1, then patches each patch is split into, level by level (n1,n2,...)")
        ->delimiter(',')
        ->expected(1, GEOIDX_MAX_LEVELS)
        ->type_size(1)
        ->check(whole_number());
    command.add_option("--lloyd-iterations", arguments.lloyd_iterations, "relaxations of the patches' seeds")
        ->check(whole_number())
        ->capture_default_str();
}

}

void add_build(CLI::App& app) {
    auto arguments = std::make_shared<BuildArguments>();
    geoidx_build_options defaults;
    geoidx_build_options_init(&defaults);
    arguments->lloyd_iterations = defaults.lloyd_iterations;
    arguments->seed = defaults.seed;
    arguments->exact_vertices = defaults.exact_vertices;
    arguments->rounding = defaults.rounding;
    arguments->target_error = defaults.target_error;
    arguments->engine = ENGINE_NAMES[defaults.engine];

    CLI::App* command = app.add_subcommand("build", "build the index of a mesh");
    command->add_option("MESH", arguments->mesh, "mesh file: .obj, .ply, .off or .stl")->required();
    command->add_option("-o,--output", arguments->output, "index file to write; - is stdout")->required();
    add_metric_options(*command, arguments->metric);
    add_shape_options(*command, *arguments);
    command->add_option("--seed", arguments->seed, "of every random choice")
        ->check(whole_number())
        ->capture_default_str();
    command->add_option("--threads", arguments->threads, "0: one per processor")
        ->check(whole_number())
        ->capture_default_str();
    command->add_flag("--progress", arguments->progress, "without a terminal, too: a line every ten percent");
    command->add_flag("--json", arguments->json, "print a JSON object: what info prints, and the time");
    command->callback([arguments] { build(*arguments); });
}

}
