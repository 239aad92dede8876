#include "src/partition/poisson_disk.h"

#include <algorithm>
#include <unordered_set>

namespace geodesic {

namespace {

// Adds a sample: lowers the distances of candidates within `radius` of it to their nearest sample.
void add_sample(FieldSolver& solver, std::span<const uint32_t> candidates, uint32_t sample, double radius,
                std::vector<double>& nearest) {
    solver.solve({&sample, 1}, candidates, radius);
    for (size_t i = 0; i < candidates.size(); ++i)
        nearest[i] = std::min(nearest[i], solver.distance(candidates[i]));
}

// Returns the first candidate of each component. If there is only one, the solver has its field.
std::vector<uint32_t> first_of_components(FieldSolver& solver, std::span<const uint32_t> candidates) {
    std::vector<uint32_t> firsts;
    std::unordered_set<uint32_t> reached;
    for (const uint32_t candidate : candidates) {
        if (reached.contains(candidate)) continue;
        firsts.push_back(candidate);
        solver.solve({&candidate, 1}, firsts.size() == 1 ? candidates : std::span<const uint32_t>());
        reached.insert(solver.reached().begin(), solver.reached().end());
    }
    return firsts;
}

// Returns, for each candidate, how far it can be from any other one of its component.
std::vector<double> farthest_possible(FieldSolver& solver, std::span<const uint32_t> candidates) {
    const auto firsts = first_of_components(solver, candidates);
    if (firsts.size() > 1) solver.solve(firsts, candidates);
    std::vector<double> of_component(firsts.size(), 0);
    for (const uint32_t candidate : candidates) {
        double& farthest = of_component[solver.nearest(candidate)];
        farthest = std::max(farthest, 2 * solver.distance(candidate));
    }
    std::vector<double> result;
    for (const uint32_t candidate : candidates) result.push_back(of_component[solver.nearest(candidate)]);
    return result;
}

}

// Takes candidates in a random order, each as a sample if it lies outside the disks of all samples before it.
// Whenever no candidate lies outside all disks, the radius of the disks shrinks, until there are enough
// samples. Distances that were found for a larger radius stay valid for a smaller one. Until a component has
// a sample, all of it counts as so far from the nearest one as that could be if it had: loose triangles
// beside a large body get no samples before the disks on the body are as small as they are.
std::vector<uint32_t> poisson_disk_samples(FieldSolver& solver, std::span<const uint32_t> candidates,
                                           uint32_t count, Random& random) {
    constexpr double SHRINK = 0.8;
    std::vector<uint32_t> shuffled(candidates.begin(), candidates.end());
    random.shuffle(std::span(shuffled));
    if (count >= shuffled.size()) return shuffled;

    std::vector<double> nearest = farthest_possible(solver, shuffled);
    const auto first = static_cast<size_t>(std::ranges::max_element(nearest) - nearest.begin());
    std::vector<uint32_t> samples{shuffled[first]};
    add_sample(solver, shuffled, shuffled[first], UNREACHABLE, nearest);
    double radius = std::ranges::max(nearest);
    while (samples.size() < count) {
        for (size_t i = 0; i < shuffled.size() && samples.size() < count; ++i) {
            if (!(nearest[i] >= radius) || nearest[i] == 0) continue;
            samples.push_back(shuffled[i]);
            add_sample(solver, shuffled, shuffled[i], radius, nearest);
        }
        if (std::ranges::max(nearest) == 0) break; // every candidate left is at distance 0 from a sample
        radius *= SHRINK;
    }
    return samples;
}

}
