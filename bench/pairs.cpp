#include <algorithm>
#include <memory>
#include <random>
#include <span>

#include "bench/commands.h"
#include "bench/report.h"
#include "bench/rows.h"
#include "bench/statistics.h"
#include "bench/timing.h"
#include "bench/workload.h"
#include "tools/library.h"

namespace geodesic::bench {

namespace {

struct PairsArguments {
    std::vector<std::string> files;
    uint32_t count = 100000;
    ReportArguments report;
};

using VertexPair = std::pair<uint32_t, uint32_t>;

std::vector<VertexPair> random_pairs(uint64_t vertices, uint32_t count) {
    std::mt19937_64 random(SEED);
    const auto vertex = [&] { return static_cast<uint32_t>(random() % vertices); };
    std::vector<VertexPair> pairs(count);
    for (auto& [a, b] : pairs) {
        a = vertex();
        b = vertex();
    }
    return pairs;
}

tools::Index open_with(const std::string& path, uint32_t flags) {
    geoidx_open_options options;
    geoidx_open_options_init(&options);
    options.flags = flags;
    options.threads = 1;
    geoidx* opened = nullptr;
    tools::require_ok(geoidx_open(path.c_str(), &options, &opened), path);
    return tools::Index(opened);
}

// The microseconds that each pair takes, asked of a query of its own.
std::vector<double> times_of(const geoidx& index, const std::string& path,
                             std::span<const VertexPair> pairs) {
    const tools::Query query = tools::make_query(index, path);
    std::vector<double> times;
    for (const VertexPair& pair : pairs) {
        float distance = 0;
        const Duration taken = time_of([&] {
            tools::require_ok(geoidx_query_sssd(query.get(), pair.first, pair.second, &distance), path);
        });
        times.push_back(1e6 * taken.wall);
    }
    return times;
}

// The time of the first pair counts from when the index is open. All others are asked of an index that is
// ready for pairs.
Row pairs_row(const std::string& path, bool with_labels, uint32_t count) {
    const uint32_t flags = with_labels ? 0 : GEOIDX_OPEN_NO_LABELS;
    const tools::Index index = open_with(path, flags | GEOIDX_OPEN_PAIRS);
    const auto pairs = random_pairs(tools::info_of(*index, path).vertex_count, count);
    const double first = times_of(*open_with(path, flags), path, std::span(pairs).first(1)).front();
    std::vector<double> times = times_of(*index, path, pairs);
    std::sort(times.begin(), times.end());
    return {{"index", "index", path},
            {"labels", "labels", std::string(with_labels ? "yes" : "no")},
            {"first_pair_ms", "first pair ms", 1e-3 * first},
            {"median_us", "median us", median(times)},
            {"p99_us", "p99 us", quantile(times, 0.99)},
            {"p999_us", "p99.9 us", quantile(times, 0.999)}};
}

void pairs(const PairsArguments& arguments) {
    Report report("pairs", {{"pairs", "pairs", uint64_t{arguments.count}}}, arguments.report);
    Table table{"pairs", "Pairs", {}};
    for (const std::string& file : arguments.files)
        for (const bool with_labels : {true, false}) {
            progress(file);
            table.rows.push_back(pairs_row(file, with_labels, arguments.count));
        }
    report.add(std::move(table));
    report.note("Random pairs, one after the other, each timed by itself, on one thread.");
}

}

void add_pairs(CLI::App& app) {
    auto arguments = std::make_shared<PairsArguments>();
    CLI::App* command = app.add_subcommand("pairs", "times of SSSD of index files, with and without labels");
    command->add_option("INDEX", arguments->files, "index files")->required();
    command->add_option("--count", arguments->count, "of pairs")
        ->check(CLI::PositiveNumber)
        ->capture_default_str();
    add_report_options(*command, arguments->report);
    command->callback([arguments] { pairs(*arguments); });
}

}
