#include "src/partition/poisson_disk.h"

#include <algorithm>

#include "src/mesh/mesh.h"

namespace geodesic {

namespace {

// Adds a sample: lowers the distances of candidates within `radius` of it to their nearest sample.
void add_sample(FieldSolver& solver, std::span<const uint32_t> candidates, uint32_t sample, double radius,
                std::vector<double>& nearest) {
    solver.solve({&sample, 1}, candidates, radius);
    for (size_t i = 0; i < candidates.size(); ++i)
        nearest[i] = std::min(nearest[i], solver.distance(candidates[i]));
}

// Returns, for each candidate, a bound on how far apart any two are that the metric joins to it: twice the
// distance of the farthest one from some vertex among these. A metric need not join all that edges join,
// since a caller's may have walls: candidates of a component that some solves do not reach count as 0, and
// get no sample.
std::vector<double> widths(FieldSolver& solver, std::span<const uint32_t> component_of_vertex,
                           std::span<const uint32_t> candidates) {
    constexpr int MOST_SOLVES = 8; // of a component
    std::vector<uint32_t> component_of;
    for (const uint32_t candidate : candidates) component_of.push_back(component_of_vertex[candidate]);
    const auto members = group_by(component_of, std::ranges::max(component_of) + 1);
    std::vector<double> result(candidates.size(), 0);
    std::vector<uint32_t> left, vertices; // of one component: those that no solve has reached
    for (size_t component = 0; component < members.size(); ++component) {
        left.assign(members[component].begin(), members[component].end());
        for (int solve = 0; solve < MOST_SOLVES && !left.empty(); ++solve) {
            vertices.clear();
            for (const uint32_t i : left) vertices.push_back(candidates[i]);
            solver.solve(std::span(vertices).first(1), vertices);
            double farthest = 0;
            for (const uint32_t vertex : vertices)
                if (solver.distance(vertex) < UNREACHABLE)
                    farthest = std::max(farthest, solver.distance(vertex));
            std::erase_if(left, [&](uint32_t i) {
                if (solver.distance(candidates[i]) == UNREACHABLE) return false;
                result[i] = 2 * farthest;
                return true;
            });
        }
    }
    return result;
}

}

// Takes candidates in a random order, each as a sample if it lies outside the disks of all samples before it.
// Whenever no candidate lies outside all disks, the radius of the disks shrinks, until there are enough
// samples. Distances that were found for a larger radius stay valid for a smaller one.
//
// A component that has no sample yet counts as its width (see widths()) away from the nearest sample. So
// loose triangles beside a large body get a sample only once the disks on the body are no larger than they
// are.
std::vector<uint32_t> poisson_disk_samples(FieldSolver& solver, std::span<const uint32_t> component_of_vertex,
                                           std::span<const uint32_t> candidates, uint32_t count,
                                           Random& random) {
    constexpr double SHRINK = 0.8;
    std::vector<uint32_t> shuffled(candidates.begin(), candidates.end());
    random.shuffle(std::span(shuffled));
    if (count >= shuffled.size()) return shuffled;

    std::vector<double> nearest(shuffled.size(), UNREACHABLE);
    std::vector<uint32_t> samples{shuffled[0]};
    add_sample(solver, shuffled, samples[0], UNREACHABLE, nearest);
    if (std::ranges::max(nearest) == UNREACHABLE) {
        nearest = widths(solver, component_of_vertex, shuffled);
        samples[0] = shuffled[static_cast<size_t>(std::ranges::max_element(nearest) - nearest.begin())];
        add_sample(solver, shuffled, samples[0], UNREACHABLE, nearest);
    }
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
