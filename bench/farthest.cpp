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

constexpr uint32_t ROUNDS = 9;

struct FarthestArguments {
    std::vector<std::string> files;
    uint32_t count = 200;
    ReportArguments report;
};

// By one call, and as one would do it by hand: a whole field from each point.
Row farthest_row(const std::string& path, uint32_t count) {
    const tools::Index index = tools::open_index(path, nullptr);
    const tools::Query query = tools::make_query(*index, path);
    const uint64_t vertices = tools::info_of(*index, path).vertex_count;
    std::vector<uint32_t> points(count);
    std::vector<float> field(vertices);
    uint32_t found = 0;
    std::vector<double> one_call, fields;
    for (uint32_t round = 0; round <= ROUNDS; ++round) {
        const auto source = static_cast<uint32_t>(round * vertices / (ROUNDS + 1));
        const double at_once =
            time_of([&] {
                tools::require_ok(geoidx_query_farthest_points(query.get(), &source, 1, count, points.data(),
                                                               nullptr, &found),
                                  path);
            }).wall;
        const double by_fields =
            time_of([&] {
                for (uint32_t i = 0; i < found; ++i)
                    tools::require_ok(geoidx_query_msad(query.get(), &points[i], 1, field.data(),
                                                        static_cast<uint32_t>(field.size())),
                                      path);
            }).wall;
        if (round == 0) continue; // the first one takes memory
        one_call.push_back(at_once);
        fields.push_back(by_fields);
    }
    return {{"index", "index", path},
            {"points", "points", uint64_t{found}},
            {"one_call_ms", "one call ms", 1e3 * median(one_call)},
            {"fields_ms", "whole fields ms", 1e3 * median(fields)}};
}

void farthest(const FarthestArguments& arguments) {
    Report report("farthest", {{"rounds", "rounds", uint64_t{ROUNDS}}}, arguments.report);
    Table table{"farthest_points", "Farthest points", {}};
    for (const std::string& file : arguments.files) table.rows.push_back(farthest_row(file, arguments.count));
    report.add(std::move(table));
    report.note("Medians over sources. Whole fields: MSAD of each point by itself, without looking for the "
                "next one.");
}

}

void add_farthest(CLI::App& app) {
    auto arguments = std::make_shared<FarthestArguments>();
    CLI::App* command = app.add_subcommand("farthest", "farthest-point sampling of index files");
    command->add_option("INDEX", arguments->files, "index files")->required();
    command->add_option("--count", arguments->count, "of points")
        ->check(CLI::PositiveNumber)
        ->capture_default_str();
    add_report_options(*command, arguments->report);
    command->callback([arguments] { farthest(*arguments); });
}

}
