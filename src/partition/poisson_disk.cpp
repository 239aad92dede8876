#include "src/partition/poisson_disk.h"

#include <algorithm>

namespace geodesic {

namespace {

// Adds a sample: lowers the distances of candidates within `radius` of it to their nearest sample.
void add_sample(FieldSolver& solver, std::span<const uint32_t> candidates, uint32_t sample, double radius,
                std::vector<double>& nearest) {
    solver.solve({&sample, 1}, candidates, radius);
    for (size_t i = 0; i < candidates.size(); ++i)
        nearest[i] = std::min(nearest[i], solver.distance(candidates[i]));
}

double largest_finite(std::span<const double> values) {
    double largest = 0;
    for (double value : values)
        if (value < UNREACHABLE) largest = std::max(largest, value);
    return largest;
}

}

// Takes candidates in a random order, each as a sample if it lies outside the disks of all samples before it.
// Whenever no candidate lies outside all disks, the radius of the disks shrinks, until there are enough
// samples. Distances that were found for a larger radius stay valid for a smaller one.
std::vector<uint32_t> poisson_disk_samples(FieldSolver& solver, std::span<const uint32_t> candidates,
                                           uint32_t count, Random& random) {
    constexpr double SHRINK = 0.8;
    std::vector<uint32_t> shuffled(candidates.begin(), candidates.end());
    random.shuffle(std::span(shuffled));
    if (count >= shuffled.size()) return shuffled;

    std::vector<double> nearest(shuffled.size(), UNREACHABLE);
    std::vector<uint32_t> samples{shuffled[0]};
    add_sample(solver, shuffled, shuffled[0], UNREACHABLE, nearest);
    double radius = largest_finite(nearest);
    while (samples.size() < count) {
        for (size_t i = 0; i < shuffled.size() && samples.size() < count; ++i) {
            if (!(nearest[i] >= radius) || nearest[i] == 0) continue;
            samples.push_back(shuffled[i]);
            add_sample(solver, shuffled, shuffled[i], radius, nearest);
        }
        if (largest_finite(nearest) == 0) break; // every candidate left is at distance 0 from a sample
        radius *= SHRINK;
    }
    return samples;
}

}
