#include <memory>

#include "bench/commands.h"
#include "bench/report.h"
#include "bench/rows.h"
#include "bench/statistics.h"
#include "bench/timing.h"
#include "bench/workload.h"
#include "tools/library.h"

namespace geodesic::bench {

namespace {

constexpr uint32_t MATRIX_ROUNDS = 5;

struct MatrixArguments {
    std::vector<std::string> files;
    std::vector<uint32_t> counts{10, 30, 100, 300, 1000};
    ReportArguments report;
};

// As many sources as targets, all over the mesh, other ones in each round.
Row matrix_row(const std::string& path, geoidx_query* query, uint32_t vertices, uint32_t count) {
    std::vector<uint32_t> sources(count), targets(count);
    std::vector<float> distances(size_t{count} * count);
    std::vector<double> seconds;
    uint64_t state = SEED;
    const auto next = [&] {
        state = state * 6364136223846793005u + 1442695040888963407u;
        return static_cast<uint32_t>((state >> 33) % vertices);
    };
    for (uint32_t round = 0; round <= MATRIX_ROUNDS; ++round) {
        for (uint32_t& source : sources) source = next();
        for (uint32_t& target : targets) target = next();
        const auto fill = [&] {
            tools::require_ok(geoidx_query_matrix(query, sources.data(), count, targets.data(), count,
                                                  distances.data(), distances.size()),
                              path);
        };
        const double wall = time_of(fill).wall;
        if (round > 0) seconds.push_back(wall); // the first one takes memory
    }
    return {{"index", "index", path},
            {"count", "sources, targets", uint64_t{count}},
            {"entry_us", "us an entry", 1e6 * median(seconds) / static_cast<double>(distances.size())}};
}

void matrix(const MatrixArguments& arguments) {
    Report report("matrix", {{"rounds", "rounds", uint64_t{MATRIX_ROUNDS}}}, arguments.report);
    Table table{"matrix", "Matrices", {}};
    for (const std::string& file : arguments.files) {
        const tools::Index index = tools::open_index(file, nullptr);
        const tools::Query query = tools::make_query(*index, file);
        const auto vertices = static_cast<uint32_t>(tools::info_of(*index, file).vertex_count);
        for (const uint32_t count : arguments.counts)
            table.rows.push_back(matrix_row(file, query.get(), vertices, count));
    }
    report.add(std::move(table));
    report.note("Medians over rounds, each with sources and targets of its own.");
}

}

void add_matrix(CLI::App& app) {
    auto arguments = std::make_shared<MatrixArguments>();
    CLI::App* command = app.add_subcommand("matrix", "distances from all sources to all targets");
    command->add_option("INDEX", arguments->files, "index files")->required();
    command->add_option("--counts", arguments->counts, "of sources, and of targets")->delimiter(',');
    add_report_options(*command, arguments->report);
    command->callback([arguments] { matrix(*arguments); });
}

}
