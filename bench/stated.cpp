#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <random>
#include <utility>

#include "bench/commands.h"
#include "bench/neighbours.h"
#include "bench/report.h"
#include "bench/rows.h"
#include "bench/workload.h"

namespace geodesic::bench {

namespace {

constexpr uint32_t TARGETS = 500; // of each source, by SSSD; and near ones by MSAD
constexpr uint32_t FEWEST_EDGES = 2, MOST_EDGES = 20;
constexpr uint32_t GROUP_SIZES[] = {2, 3, 16, 64};
constexpr uint32_t TOGETHER = 4; // half of the groups are chosen from so many times as many around a vertex
// As a share of four times the longest distance from a source, and so no less than the diagonal of its
// component; such distances have no stated error.
constexpr double TOO_SHORT = 1.2e-7;

struct StatedArguments {
    std::string mesh;
    std::string index;
    std::string folder;
    uint32_t pairs = 1000000;
    uint32_t groups = 800;
    ReportArguments report;
};

// Of one kind of answers, how many pass what is stated for them.
struct Passed {
    double stated = 0, largest = 0;
    uint64_t count = 0, passed = 0;

    void add(double error) {
        constexpr double ROUNDING = 1e-6; // of answers, which are floats
        ++count;
        largest = std::max(largest, error);
        passed += error > stated + ROUNDING;
    }

    Row row(const char* asked, const char* distances) const {
        return {{"asked", "asked", asked},
                {"distances", "distances", distances},
                {"count", "answers", count},
                {"stated_percent", "stated %", 100 * stated},
                {"largest_percent", "largest %", 100 * largest},
                {"ratio", "stated / largest", largest > 0 ? stated / largest : 1},
                {"passed", "passed, in a million", 1e6 * static_cast<double>(passed) / double(count)}};
    }
};

constexpr const char* CLASSES[] = {"near", "middle", "far"};
using Classes = std::array<Passed, std::size(CLASSES)>;

// What is asked of one index, from one source or group of sources after the other.
class StatedBench {
public:
    StatedBench(const Model& model, const geoidx_info& info, geoidx_query& query, geoidx_solver& solver)
        : model_(model), query_(query), solver_(solver), edge_(average_edge(model.mesh)),
          neighbours_(model.mesh), exact_(model.mesh.vertex_count()), field_(model.mesh.vertex_count()) {
        const double stated[] = {info.error_near_max, info.error_middle_max, info.error_far_max};
        for (size_t i = 0; i < std::size(stated); ++i) random_[i].stated = near_[i].stated = stated[i];
        several_.stated = info.error_several_max;
    }

    // MSAD to all vertices, and SSSD to some.
    void ask_random(std::mt19937_64& random) {
        const uint32_t source = vertex(random);
        ask({source});
        for (uint32_t v = 0; v < field_.size(); ++v) add(random_, v, field_[v]);
        for (uint32_t i = 0; i < TARGETS; ++i) {
            const uint32_t target = vertex(random);
            add(random_, target, sssd(source, target));
        }
    }

    void ask_near(std::mt19937_64& random) {
        const uint32_t source = vertex(random);
        std::vector<uint32_t> targets = neighbours_.around(source, FEWEST_EDGES, MOST_EDGES);
        std::ranges::shuffle(targets, random);
        targets.resize(std::min<size_t>(targets.size(), TARGETS));
        if (targets.empty()) return;
        std::vector<double> exact(targets.size());
        tools::require_ok(geoidx_solver_distances(&solver_, &source, 1, targets.data(),
                                                  static_cast<uint32_t>(targets.size()), exact.data()),
                          model_.path);
        msad({source});
        for (size_t i = 0; i < targets.size(); ++i) {
            exact_[targets[i]] = exact[i];
            add(near_, targets[i], field_[targets[i]]);
            add(near_, targets[i], sssd(source, targets[i]));
        }
    }

    void ask_group(uint32_t size, bool is_together, std::mt19937_64& random) {
        std::vector<uint32_t> sources{vertex(random)};
        if (is_together) {
            const auto found =
                neighbours_.around(sources.front(), FEWEST_EDGES, UINT32_MAX, size_t{TOGETHER} * size);
            while (sources.size() < size && !found.empty()) sources.push_back(found[random() % found.size()]);
        }
        while (sources.size() < size) sources.push_back(vertex(random));
        ask(sources);
        for (uint32_t v = 0; v < field_.size(); ++v)
            if (counts(exact_[v])) several_.add(std::abs(field_[v] - exact_[v]) / exact_[v]);
    }

    Table passed() const {
        Table table{"stated", "Largest errors, stated and found", {}};
        for (const auto& [asked, classes] : {std::pair("random", &random_), std::pair("near", &near_)})
            for (size_t i = 0; i < classes->size(); ++i)
                if ((*classes)[i].count > 0) table.rows.push_back((*classes)[i].row(asked, CLASSES[i]));
        if (several_.count > 0) table.rows.push_back(several_.row("several", "all"));
        return table;
    }

private:
    uint32_t vertex(std::mt19937_64& random) const {
        return model_.mesh.triangles[random() % model_.mesh.triangles.size()];
    }

    bool counts(double exact) const { return exact > too_short_ && !std::isinf(exact); }

    void add(Classes& classes, uint32_t target, double answer) const {
        const double exact = exact_[target];
        if (!counts(exact)) return;
        const double edges = exact / edge_;
        classes[edges <= 10 ? 0 : edges <= 100 ? 1 : 2].add(std::abs(answer - exact) / exact);
    }

    void ask(const std::vector<uint32_t>& sources) {
        tools::require_ok(geoidx_solver_distances(&solver_, sources.data(),
                                                  static_cast<uint32_t>(sources.size()), nullptr,
                                                  static_cast<uint32_t>(exact_.size()), exact_.data()),
                          model_.path);
        msad(sources);
    }

    void msad(const std::vector<uint32_t>& sources) {
        tools::require_ok(geoidx_query_msad(&query_, sources.data(), static_cast<uint32_t>(sources.size()),
                                            field_.data(), static_cast<uint32_t>(field_.size())),
                          model_.path);
        float longest = 0;
        for (const float distance : field_)
            if (!std::isinf(distance)) longest = std::max(longest, distance);
        // The longest distance from the nearest of several sources says less.
        too_short_ = TOO_SHORT * 4 * double{longest};
        if (sources.size() == 1)
            most_too_short_ = std::max(most_too_short_, too_short_);
        else
            too_short_ = most_too_short_;
    }

    double sssd(uint32_t source, uint32_t target) {
        float distance = 0;
        tools::require_ok(geoidx_query_sssd(&query_, source, target, &distance), model_.path);
        return distance;
    }

    const Model& model_;
    geoidx_query& query_;
    geoidx_solver& solver_;
    const double edge_;
    double too_short_ = 0, most_too_short_ = 0; // of what is asked, and of all single sources
    Neighbours neighbours_;
    std::vector<double> exact_;
    std::vector<float> field_;
    Classes random_, near_;
    Passed several_;
};

void stated(const StatedArguments& arguments) {
    const Model model = load_model(arguments.mesh, arguments.folder);
    const tools::Index index = tools::open_index(arguments.index, &model.mesh);
    Report report("stated", {{"index", "index", arguments.index}}, arguments.report);
    const tools::Solver solver = tools::make_solver(model.mesh, model.path, options_for(1, {}));
    const tools::Query query = tools::make_query(*index, arguments.index);
    StatedBench bench(model, tools::info_of(*index, arguments.index), *query, *solver);
    std::mt19937_64 random(SEED);
    const uint32_t sources = (arguments.pairs + TARGETS - 1) / TARGETS;
    for (uint32_t i = 0; i < sources; ++i) bench.ask_random(random);
    for (uint32_t i = 0; i < sources; ++i) bench.ask_near(random);
    for (uint32_t i = 0; i < arguments.groups; ++i)
        bench.ask_group(GROUP_SIZES[i / 2 % std::size(GROUP_SIZES)], i % 2 == 1, random);
    report.add(bench.passed());
}

}

void add_stated(CLI::App& app) {
    auto arguments = std::make_shared<StatedArguments>();
    CLI::App* command =
        app.add_subcommand("stated", "how often random pairs pass the largest errors that an index states");
    command->add_option("MESH", arguments->mesh, "mesh file or name")->required();
    command->add_option("INDEX", arguments->index, "index file of this mesh, of the exact metric")
        ->required();
    add_mesh_folder(*command, arguments->folder);
    command->add_option("--pairs", arguments->pairs, "random ones, and as many near ones")
        ->check(CLI::PositiveNumber)
        ->capture_default_str();
    command->add_option("--groups", arguments->groups, "of several sources")->capture_default_str();
    add_report_options(*command, arguments->report);
    command->callback([arguments] { stated(*arguments); });
}

}
