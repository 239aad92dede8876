#include <algorithm>
#include <memory>
#include <random>

#include "bench/commands.h"
#include "bench/report.h"
#include "bench/rows.h"
#include "bench/statistics.h"
#include "bench/timing.h"
#include "bench/workload.h"
#include "tools/library.h"

namespace geodesic::bench {

namespace {

constexpr uint32_t NEAREST_ROUNDS = 40;

struct NearestArguments {
    std::vector<std::string> files;
    uint32_t sources = 64;
    uint32_t found = 1000;
    uint32_t targets = 1000;
    uint32_t wanted = 4;
    ReportArguments report;
};

// One query, and what it answers into.
struct Asked {
    const std::string& path;
    geoidx_query* query;
    uint32_t vertices;
    std::vector<float> field;
    std::vector<uint32_t> ids;
    std::mt19937_64 random{SEED};

    Asked(const std::string& path, geoidx_query* query, uint32_t vertices)
        : path(path), query(query), vertices(vertices), field(vertices), ids(vertices) {}

    std::vector<uint32_t> some(uint32_t count) {
        std::vector<uint32_t> some(count);
        for (uint32_t& id : some) id = static_cast<uint32_t>(random() % vertices);
        return some;
    }
    // In microseconds.
    template <class Ask>
    double time(const Ask& ask) const {
        return 1e6 * time_of([&] { tools::require_ok(ask(), path); }).wall;
    }
    double time_msad(const std::vector<uint32_t>& sources) {
        return time([&] {
            return geoidx_query_msad(query, sources.data(), static_cast<uint32_t>(sources.size()),
                                     field.data(), vertices);
        });
    }
};

// MSAD from the same sources right before.
Row nearest_sources_row(Asked& asked, uint32_t count) {
    std::vector<double> msad, nearest, ratio;
    for (uint32_t round = 0; round <= NEAREST_ROUNDS; ++round) {
        const auto sources = asked.some(count);
        const double field_time = asked.time_msad(sources), nearest_time = asked.time([&] {
            return geoidx_query_nearest_sources(asked.query, sources.data(), count, asked.ids.data(),
                                                asked.field.data(), asked.vertices);
        });
        if (round == 0) continue; // takes memory
        msad.push_back(field_time);
        nearest.push_back(nearest_time);
        ratio.push_back(nearest_time / field_time);
    }
    return {{"index", "index", asked.path},
            {"sources", "sources", uint64_t{count}},
            {"msad_us", "MSAD us", median(msad)},
            {"nearest_us", "with sources us", median(nearest)},
            {"ratio", "ratio", median(ratio)}};
}

// The radius is where the field has so many vertices.
Row within_row(Asked& asked, uint32_t found) {
    std::vector<double> whole, cut, within;
    for (uint32_t round = 0; round <= NEAREST_ROUNDS; ++round) {
        const auto source = asked.some(1);
        const double field_time = asked.time_msad(source);
        std::vector<float> sorted = asked.field;
        std::ranges::nth_element(sorted, sorted.begin() + std::min(found, asked.vertices) - 1);
        const float radius = sorted[std::min(found, asked.vertices) - 1];
        uint32_t count = 0;
        const double cut_time = asked.time([&] {
            return geoidx_query_msad_within(asked.query, source.data(), 1, radius, asked.field.data(),
                                            asked.vertices);
        });
        const double within_time = asked.time([&] {
            return geoidx_query_within(asked.query, source.data(), 1, radius, asked.ids.data(),
                                       asked.field.data(), asked.vertices, &count);
        });
        if (round == 0) continue;
        whole.push_back(field_time);
        cut.push_back(cut_time);
        within.push_back(within_time);
    }
    return {{"index", "index", asked.path},
            {"found", "vertices", uint64_t{found}},
            {"msad_us", "MSAD us", median(whole)},
            {"msad_within_us", "MSAD within us", median(cut)},
            {"within_us", "within us", median(within)}};
}

Row nearest_targets_row(Asked& asked, uint32_t targets, uint32_t wanted) {
    std::vector<double> msad, nearest;
    std::vector<uint32_t> positions(wanted);
    for (uint32_t round = 0; round <= NEAREST_ROUNDS; ++round) {
        const auto source = asked.some(1), among = asked.some(targets);
        uint32_t count = 0;
        const double field_time = asked.time_msad(source), nearest_time = asked.time([&] {
            return geoidx_query_nearest_targets(asked.query, source[0], among.data(), targets,
                                                positions.data(), nullptr, wanted, &count);
        });
        if (round == 0) continue;
        msad.push_back(field_time);
        nearest.push_back(nearest_time);
    }
    return {{"index", "index", asked.path},
            {"targets", "targets", uint64_t{targets}},
            {"wanted", "wanted", uint64_t{wanted}},
            {"msad_us", "MSAD us", median(msad)},
            {"nearest_us", "nearest targets us", median(nearest)}};
}

void nearest(const NearestArguments& arguments) {
    Report report("nearest", {{"rounds", "rounds", uint64_t{NEAREST_ROUNDS}}}, arguments.report);
    Table sources{"nearest_sources", "Which source is the nearest", {}},
        within{"within", "Vertices within a radius", {}},
        targets{"nearest_targets", "The nearest of some targets", {}};
    for (const std::string& file : arguments.files) {
        const tools::Index index = tools::open_index(file, nullptr);
        const tools::Query query = tools::make_query(*index, file);
        Asked asked(file, query.get(), static_cast<uint32_t>(tools::info_of(*index, file).vertex_count));
        sources.rows.push_back(nearest_sources_row(asked, arguments.sources));
        for (uint32_t found = 10; found <= arguments.found; found *= 10)
            within.rows.push_back(within_row(asked, found));
        for (uint32_t count = 10; count <= arguments.targets; count *= 10)
            targets.rows.push_back(nearest_targets_row(asked, count, arguments.wanted));
    }
    for (Table* table : {&sources, &within, &targets}) report.add(std::move(*table));
    report.note("Medians over rounds, each with sources and targets of its own, on one thread.");
}

}

void add_nearest(CLI::App& app) {
    auto arguments = std::make_shared<NearestArguments>();
    CLI::App* command =
        app.add_subcommand("nearest", "nearest sources, vertices within a radius, nearest targets");
    command->add_option("INDEX", arguments->files, "index files")->required();
    command->add_option("--sources", arguments->sources, "of which one is the nearest")
        ->check(CLI::PositiveNumber)
        ->capture_default_str();
    command->add_option("--found", arguments->found, "at most so many vertices within a radius")
        ->check(CLI::PositiveNumber)
        ->capture_default_str();
    command->add_option("--targets", arguments->targets, "at most so many targets")
        ->check(CLI::PositiveNumber)
        ->capture_default_str();
    command->add_option("--wanted", arguments->wanted, "so many of the targets")
        ->check(CLI::PositiveNumber)
        ->capture_default_str();
    add_report_options(*command, arguments->report);
    command->callback([arguments] { nearest(*arguments); });
}

}
