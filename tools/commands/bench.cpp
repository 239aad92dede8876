#include <algorithm>
#include <chrono>
#include <cstdio>
#include <random>

#include "tools/commands/arguments.h"
#include "tools/commands/commands.h"
#include "tools/json.h"
#include "tools/library.h"

namespace geodesic::tools {

namespace {

struct BenchArguments {
    std::string index, mesh;
    uint32_t queries = 100;
    uint64_t seed = 1;
    bool json = false;
};

template <class Work>
double microseconds(const Work& work) {
    const auto begin = std::chrono::steady_clock::now();
    work();
    return std::chrono::duration<double, std::micro>(std::chrono::steady_clock::now() - begin).count();
}

double median(std::vector<double>& values) {
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    return *middle;
}

// Times are in microseconds.
void print_text(const BenchArguments& arguments, double sssd, double msad, uint32_t vertex_count) {
    std::printf("queries            %u\n", arguments.queries);
    std::printf("SSSD, median       %.4g us\n", sssd);
    std::printf("MSAD, median       %.4g us, %.4g ns per vertex\n", msad, 1000 * msad / vertex_count);
}

void print_json(const BenchArguments& arguments, double sssd, double msad, uint32_t vertex_count) {
    JsonObject object;
    object.text("index", arguments.index).count("vertex_count", vertex_count);
    object.count("queries", arguments.queries).count("seed", arguments.seed);
    object.number("sssd_median_us", sssd).number("msad_median_us", msad);
    object.number("msad_median_ns_per_vertex", 1000 * msad / vertex_count).print();
}

// Wall time of random queries, one after the other on this thread.
void bench(const BenchArguments& arguments) {
    const Index index = open_index_with(arguments.mesh, arguments.index);
    const auto count = static_cast<uint32_t>(info_of(*index, arguments.index).vertex_count);
    const Query query = make_query(*index, arguments.index);
    std::mt19937_64 random(arguments.seed);
    std::vector<float> distances(count);
    std::vector<double> sssd, msad;
    for (uint32_t i = 0; i < arguments.queries; ++i) {
        const auto source = static_cast<uint32_t>(random() % count);
        const auto target = static_cast<uint32_t>(random() % count);
        float distance = 0;
        geoidx_status status = GEOIDX_OK;
        sssd.push_back(
            microseconds([&] { status = geoidx_query_sssd(query.get(), source, target, &distance); }));
        require_ok(status, arguments.index);
        msad.push_back(microseconds(
            [&] { status = geoidx_query_msad(query.get(), &source, 1, distances.data(), count); }));
        require_ok(status, arguments.index);
    }
    arguments.json ? print_json(arguments, median(sssd), median(msad), count)
                   : print_text(arguments, median(sssd), median(msad), count);
}

}

void add_bench(CLI::App& app) {
    auto arguments = std::make_shared<BenchArguments>();
    CLI::App* command = app.add_subcommand("bench", "time random queries on an index");
    command->add_option("FILE", arguments->index, "index file")->required();
    add_mesh_option(*command, arguments->mesh);
    command->add_option("--queries", arguments->queries, "how many of each kind")
        ->capture_default_str()
        ->check(CLI::Range(1u, 100000000u));
    command->add_option("--seed", arguments->seed, "of the random vertices")->check(whole_number());
    command->add_flag("--json", arguments->json, "print a JSON object");
    command->callback([arguments] { bench(*arguments); });
}

}
