#include "src/partition/hierarchy.h"

#include <algorithm>
#include <cmath>
#include <mutex>
#include <utility>

#include "geoidx.h"

#include "src/mesh/components.h"
#include "src/metric/edge_graph.h"
#include "src/partition/split.h"

namespace geodesic {

namespace {

uint64_t seed_of_patch(uint64_t seed, uint32_t patch) {
    return Random(seed ^ (uint64_t{patch} << 20)).next();
}

// Returns into how many others a patch of `faces` faces is split.
uint32_t child_count(const HierarchyOptions& options, uint32_t level, size_t faces, size_t faces_of_mesh) {
    const uint32_t count = options.split[level];
    if (options.in_proportion.empty() || !options.in_proportion[level]) return count;
    double average = static_cast<double>(faces_of_mesh);
    for (uint32_t l = 0; l < level; ++l) average /= options.split[l];
    const auto own = static_cast<double>(faces);
    return static_cast<uint32_t>(std::clamp(std::floor(count * (own / average) + 0.5), 1.0, own));
}

// Returns the least number of levels that gives this many leaves if a patch is split into at most
// `largest_split` others, which must be more than 1.
uint32_t fewest_levels(double leaves, double largest_split) {
    uint32_t count = 1;
    for (double most = largest_split; most < leaves; most *= largest_split) ++count;
    return count;
}

// A caller who gives the patch counts of three levels wants three levels.
uint32_t levels_named(std::span<const uint32_t> given) {
    auto count = static_cast<uint32_t>(given.size());
    while (count > 0 && given[count - 1] == 0) --count;
    return count;
}

// Fewer patches have shorter borders, too: where faces are not connected, splits can differ in their number.
bool is_worth_it(const Split& by_roots, const Split& by_metric) {
    return by_roots.patches.size() >= by_metric.patches.size() &&
           by_roots.border_cost <= by_metric.border_cost / HierarchyOptions::LEAST_GAIN;
}

// Solvers of another metric than that of the workers, no more of them than threads ask for at once.
class OtherSolvers {
public:
    OtherSolvers(const Metric* metric, const Workers& workers) : metric_(metric), workers_(workers) {}

    // Returns what task(solver) returns. No other thread uses that solver meanwhile.
    template <class Task>
    auto use(const Task& task) {
        auto solver = take();
        auto result = task(*solver);
        const std::lock_guard lock(mutex_);
        idle_.push_back(std::move(solver));
        return result;
    }

private:
    std::unique_ptr<FieldSolver> take() {
        {
            const std::lock_guard lock(mutex_);
            if (!idle_.empty()) {
                auto solver = std::move(idle_.back());
                idle_.pop_back();
                return solver;
            }
        }
        auto solver = metric_->make_solver();
        workers_.end_when_cancelled(*solver);
        return solver;
    }

    const Metric* const metric_;
    const Workers& workers_;
    std::mutex mutex_;
    std::vector<std::unique_ptr<FieldSolver>> idle_;
};

}

std::vector<uint32_t> automatic_split(uint32_t vertex_count, uint32_t level_count,
                                      std::span<const uint32_t> given, const SplitShape& shape) {
    const double leaves = std::max(1.0, vertex_count / shape.leaf_vertices);
    if (level_count == 0) level_count = levels_named(given);
    if (level_count == 0) level_count = fewest_levels(leaves, shape.largest_split);
    level_count = std::min<uint32_t>(level_count, GEOIDX_MAX_LEVELS);
    double remaining = leaves;
    uint32_t open = 0;
    std::vector<uint32_t> split(level_count, 0);
    for (uint32_t l = 0; l < level_count; ++l) {
        if (l < given.size()) split[l] = given[l];
        if (split[l] == 0)
            ++open;
        else
            remaining /= split[l];
    }
    // If the caller asks for more levels than the mesh needs, leaves become smaller. Only a mesh that is
    // small enough for a single leaf is not split.
    const uint32_t fewest = level_count > 1 ? 2 : 1;
    for (uint32_t& count : split) {
        if (count > 0) continue;
        const double each = std::pow(std::max(1.0, remaining), 1.0 / open--);
        count = std::max(fewest, static_cast<uint32_t>(std::lround(each)));
        remaining /= count;
    }
    return split;
}

Hierarchy build_hierarchy(const Mesh& mesh, const HierarchyOptions& options, Workers& workers) {
    Hierarchy hierarchy;
    hierarchy.parent = {NONE};
    hierarchy.level_begin = {0, 1};
    const std::vector<double> lengths =
        options.edge_lengths.empty() ? edge_lengths(mesh) : options.edge_lengths;
    const Components components = components_of(mesh);
    const Splitting splitting{mesh, lengths, components.of_vertex, options.lloyd_iterations};
    std::vector<std::vector<uint32_t>> patches(1); // faces of the patches of the latest level
    for (uint32_t f = 0; f < mesh.face_count(); ++f) patches[0].push_back(f);
    OtherSolvers rough(options.rough_metric.get(), workers);
    OtherSolvers by_roots(options.root_metric.get(), workers);

    for (uint32_t level = 0; level < options.split.size(); ++level) {
        const uint32_t first = hierarchy.level_begin[hierarchy.level_begin.size() - 2];
        std::vector<std::vector<std::vector<uint32_t>>> children(patches.size());
        workers.run(patches.size(), [&](FieldSolver& solver, size_t i) {
            const uint32_t count = child_count(options, level, patches[i].size(), mesh.face_count());
            const auto split = [&](FieldSolver& by) {
                Random random(seed_of_patch(options.seed, first + static_cast<uint32_t>(i)));
                return split_patch(splitting, patches[i], count, by, random);
            };
            const bool is_large = patches[i].size() > HierarchyOptions::LARGE_PATCH;
            Split best = options.rough_metric && is_large ? rough.use(split) : split(solver);
            if (options.root_metric && best.border_cost > 0)
                if (Split other = by_roots.use(split); is_worth_it(other, best)) best = std::move(other);
            children[i] = std::move(best.patches);
        });
        std::vector<std::vector<uint32_t>> next;
        for (uint32_t i = 0; i < children.size(); ++i) {
            hierarchy.child_begin.push_back(hierarchy.patch_count());
            for (auto& child : children[i]) {
                hierarchy.parent.push_back(first + i);
                next.push_back(std::move(child));
            }
        }
        hierarchy.level_begin.push_back(hierarchy.patch_count());
        patches = std::move(next);
    }
    hierarchy.child_begin.resize(hierarchy.patch_count() + 1, hierarchy.patch_count());
    hierarchy.leaf_of_face.resize(mesh.face_count());
    for (uint32_t i = 0; i < patches.size(); ++i)
        for (uint32_t f : patches[i]) hierarchy.leaf_of_face[f] = hierarchy.first_leaf() + i;
    return hierarchy;
}

}
