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

constexpr uint32_t TARGETS = 500; // of each source
constexpr uint32_t FEWEST_EDGES = 2, MOST_EDGES = 20;
constexpr double LONGER_THAN_EDGE = 1.05;

struct TailsArguments {
    std::string mesh;
    std::string index;
    std::string folder;
    uint32_t pairs = 1000000;
    uint32_t worst = 5;
    ReportArguments report;
};

struct MeasuredEdge {
    uint32_t a, b;
    double length;
};

// Each edge once, and the neighbours of each vertex.
struct Edges {
    explicit Edges(const tools::TriangleMesh& mesh) : neighbours(mesh.vertex_count()) {
        for_each_side(mesh, [&](uint32_t a, uint32_t b) {
            if (neighbours.add(a, b)) all.push_back({a, b, straight(mesh, a, b)});
        });
    }
    static double straight(const tools::TriangleMesh& mesh, uint32_t a, uint32_t b) {
        const double *p = mesh.positions.data() + size_t{3} * a, *q = mesh.positions.data() + size_t{3} * b;
        return std::hypot(p[0] - q[0], p[1] - q[1], p[2] - q[2]);
    }

    Neighbours neighbours;
    std::vector<MeasuredEdge> all;
};

struct Answer {
    uint32_t source = 0, target = 0;
    double exact = 0, answer = 0;
    double error() const { return std::abs(answer - exact) / exact; }
};

// The errors of one kind of query over one kind of pairs.
class Tail {
public:
    void add(const Answer& answer, double straight) {
        if (!(answer.exact > 0) || std::isinf(answer.exact)) return;
        const double error = answer.error();
        ++count_;
        sum_ += error;
        for (size_t i = 0; i < LIMITS.size(); ++i) over_[i] += error > LIMITS[i];
        below_line_ += answer.answer < straight * (1 - 1e-6);
        worst_.push_back(answer);
        std::ranges::push_heap(worst_, std::greater(), &Answer::error);
        if (worst_.size() <= KEPT) return;
        std::ranges::pop_heap(worst_, std::greater(), &Answer::error);
        worst_.pop_back();
    }

    std::vector<Answer> worst() const {
        auto worst = worst_;
        std::ranges::sort(worst, std::greater(), &Answer::error);
        return worst;
    }

    Row row(const char* pairs, const char* query) const {
        const double each = 1e6 / static_cast<double>(std::max<uint64_t>(1, count_));
        const auto per_million = [&](uint64_t count) { return each * static_cast<double>(count); };
        return {{"pairs", "pairs", pairs},
                {"query", "query", query},
                {"count", "distances", count_},
                {"mean_percent", "mean %", 1e-4 * each * sum_},
                {"over_01", "over 0.1 %, in a million", per_million(over_[0])},
                {"over_1", "over 1 %", per_million(over_[1])},
                {"over_3", "over 3 %", per_million(over_[2])},
                {"below_line", "below the straight line", per_million(below_line_)},
                {"max_percent", "max %", worst_.empty() ? 0 : 100 * worst().front().error()}};
    }

private:
    static constexpr std::array LIMITS{0.001, 0.01, 0.03};
    static constexpr size_t KEPT = 100;
    uint64_t count_ = 0, below_line_ = 0;
    double sum_ = 0;
    std::array<uint64_t, LIMITS.size()> over_{};
    std::vector<Answer> worst_; // a heap, the least error first
};

// What is asked of one index, from one source after the other.
class TailBench {
public:
    TailBench(const Model& model, geoidx_query& query, geoidx_solver& solver)
        : model_(model), query_(query), solver_(solver), edges_(model.mesh),
          field_(model.mesh.vertex_count()) {}

    void ask_random(std::mt19937_64& random) {
        std::vector<uint32_t> targets(TARGETS);
        for (uint32_t& target : targets) target = vertex(random);
        ask(vertex(random), targets, random_);
    }

    void ask_near(std::mt19937_64& random) {
        const uint32_t source = vertex(random);
        std::vector<uint32_t> targets = edges_.neighbours.around(source, FEWEST_EDGES, MOST_EDGES);
        std::ranges::shuffle(targets, random);
        targets.resize(std::min<size_t>(targets.size(), TARGETS));
        if (!targets.empty()) ask(source, targets, near_);
    }

    Table tails() const {
        return {"tails",
                "Errors",
                {random_.sssd.row("random", "SSSD"), random_.msad.row("random", "MSAD"),
                 near_.sssd.row("near", "SSSD"), near_.msad.row("near", "MSAD")}};
    }

    Table edges() const {
        return {"edges",
                "Edges whose ends differ by more than 1.05 times their length",
                {{{"edges", "edges", edges_asked_},
                  {"steep", "of these", steep_},
                  {"largest", "largest difference / length", steepest_, 4}}}};
    }

    Table worst(uint32_t count) const {
        Table table{"worst", "Worst pairs", {}};
        const auto add = [&](const char* pairs, const char* query, const Tail& tail) {
            auto worst = tail.worst();
            worst.resize(std::min<size_t>(worst.size(), count));
            for (const Answer& answer : worst)
                table.rows.push_back({{"pairs", "pairs", pairs},
                                      {"query", "query", query},
                                      {"source", "source", uint64_t{answer.source}},
                                      {"target", "target", uint64_t{answer.target}},
                                      {"exact", "exact", answer.exact, 6},
                                      {"answer", "answer", answer.answer, 6},
                                      {"error_percent", "error %", 100 * answer.error()}});
        };
        add("random", "SSSD", random_.sssd);
        add("random", "MSAD", random_.msad);
        add("near", "SSSD", near_.sssd);
        add("near", "MSAD", near_.msad);
        return table;
    }

private:
    struct Tails {
        Tail sssd, msad;
    };

    uint32_t vertex(std::mt19937_64& random) const {
        return static_cast<uint32_t>(random() % model_.mesh.vertex_count());
    }

    void ask(uint32_t source, const std::vector<uint32_t>& targets, Tails& tails) {
        std::vector<double> exact(targets.size());
        tools::require_ok(geoidx_solver_distances(&solver_, &source, 1, targets.data(),
                                                  static_cast<uint32_t>(targets.size()), exact.data()),
                          model_.path);
        tools::require_ok(
            geoidx_query_msad(&query_, &source, 1, field_.data(), static_cast<uint32_t>(field_.size())),
            model_.path);
        for (size_t i = 0; i < targets.size(); ++i) {
            float pair = 0;
            tools::require_ok(geoidx_query_sssd(&query_, source, targets[i], &pair), model_.path);
            const double straight = Edges::straight(model_.mesh, source, targets[i]);
            tails.sssd.add({source, targets[i], exact[i], double{pair}}, straight);
            tails.msad.add({source, targets[i], exact[i], double{field_[targets[i]]}}, straight);
        }
        check_edges();
    }

    void check_edges() {
        edges_asked_ += edges_.all.size();
        for (const MeasuredEdge& edge : edges_.all) {
            const double ratio = std::abs(double{field_[edge.a]} - double{field_[edge.b]}) / edge.length;
            if (!(ratio > LONGER_THAN_EDGE)) continue;
            ++steep_;
            steepest_ = std::max(steepest_, ratio);
        }
    }

    const Model& model_;
    geoidx_query& query_;
    geoidx_solver& solver_;
    Edges edges_;
    std::vector<float> field_;
    Tails random_, near_;
    uint64_t edges_asked_ = 0, steep_ = 0;
    double steepest_ = 1;
};

void tails(const TailsArguments& arguments) {
    const Model model = load_model(arguments.mesh, arguments.folder);
    const tools::Index index = tools::open_index(arguments.index, &model.mesh);
    Report report("tails",
                  {{"index", "index", arguments.index},
                   {"near", "edges between near pairs",
                    std::to_string(FEWEST_EDGES) + " to " + std::to_string(MOST_EDGES)}},
                  arguments.report);
    const tools::Solver solver = tools::make_solver(model.mesh, model.path, options_for(1, {}));
    const tools::Query query = tools::make_query(*index, arguments.index);
    TailBench bench(model, *query, *solver);
    std::mt19937_64 random(SEED);
    const uint32_t sources = (arguments.pairs + TARGETS - 1) / TARGETS;
    for (uint32_t i = 0; i < sources; ++i) bench.ask_random(random);
    for (uint32_t i = 0; i < sources; ++i) bench.ask_near(random);
    report.add(bench.tails());
    report.add(bench.edges());
    report.add(bench.worst(arguments.worst));
}

}

void add_tails(CLI::App& app) {
    auto arguments = std::make_shared<TailsArguments>();
    CLI::App* command = app.add_subcommand("tails", "the rare large errors of an index file");
    command->add_option("MESH", arguments->mesh, "mesh file or name")->required();
    command->add_option("INDEX", arguments->index, "index file of this mesh, of the exact metric")
        ->required();
    add_mesh_folder(*command, arguments->folder);
    command->add_option("--pairs", arguments->pairs, "random ones, and as many near ones")
        ->check(CLI::PositiveNumber)
        ->capture_default_str();
    command->add_option("--worst", arguments->worst, "of each kind are listed")->capture_default_str();
    add_report_options(*command, arguments->report);
    command->callback([arguments] { tails(*arguments); });
}

}
