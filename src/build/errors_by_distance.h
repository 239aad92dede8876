#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <functional>
#include <span>

#include "src/build/short_distances.h"
#include "src/index/description.h"
#include "src/metric/metric.h"

namespace geodesic {

// Whether an answer can have a relative error at this distance: whatever the builder states, compares or
// averages as a share of distances leaves out the others. `too_short` is what
// ShortDistances::up_to() says.
inline bool has_relative_error(double exact, double too_short) {
    return exact > too_short && exact < UNREACHABLE;
}

inline double relative_error(double exact, double answer) { return std::abs((answer - exact) / exact); }

// Calls use(distance, answer) for each vertex of a mesh whose answer can have a relative error. exact(vertex)
// is the distance by the metric; answers are by the caller's ids, of which this is one for each vertex.
template <class Exact, class Use>
void for_each_comparison(std::span<const float> answers, std::span<const uint32_t> id_of_vertex,
                         const ShortDistances& too_short, const Exact& exact, const Use& use) {
    for (uint32_t v = 0; v < id_of_vertex.size(); ++v)
        if (const double distance = exact(v); has_relative_error(distance, too_short.up_to(v)))
            use(distance, double{answers[id_of_vertex[v]]});
}

// The mean and the largest of relative errors. Errors are added one by one to the sum of one part, such as
// those of one source, and parts to each other.
class ErrorSum {
public:
    void add(double error) {
        sum_ += error;
        ++count_;
        add_to_max(error);
    }
    void add_to_max(double error) { largest_[0] = std::max(largest_[0], error); }
    void add(const ErrorSum& other) {
        sum_ += other.sum_;
        count_ += other.count_;
        std::array<double, 2 * PARTS> both;
        std::ranges::merge(largest_, other.largest_, both.begin(), std::ranges::greater{});
        std::copy_n(both.begin(), PARTS, largest_.begin());
    }
    double mean() const { return count_ == 0 ? 0 : sum_ / static_cast<double>(count_); }
    double largest() const { return largest_[0]; }

    // What the largest error of all is expected to be if those that were looked at are a part of them. Tails
    // fall exponentially at least, so that each e-fold of what is looked at makes the largest one larger by
    // the mean of what large errors are above the least of them. Infinite where an error is, of a distance
    // that the index does not know.
    double expected_largest() const {
        if (std::isinf(largest_[0])) return largest_[0];
        const auto end = std::ranges::find(largest_, 0.0);
        if (end - largest_.begin() < 2) return largest_[0];
        double above = 0;
        for (auto error = largest_.begin(); error != end; ++error) above += *error - end[-1];
        return largest_[0] + above / static_cast<double>(end - largest_.begin() - 1);
    }

private:
    static constexpr size_t PARTS = 10;
    double sum_ = 0;
    std::array<double, PARTS> largest_{}; // of different parts, in descending order
    uint64_t count_ = 0;
};

// Relative errors by the exact distance.
class ErrorsByDistance {
public:
    explicit ErrorsByDistance(double average_edge) : average_edge_(average_edge) {}

    ErrorSum& of(double exact) { return sums_[distance_class(exact / average_edge_)]; }
    // Of MSAD.
    void add_of_fields(double exact, double error) {
        of(exact).add(error);
        of_fields_.add_to_max(error);
    }
    void add_to_max_of_fields(double exact, double error) {
        of(exact).add_to_max(error);
        of_fields_.add_to_max(error);
    }
    void add(const ErrorsByDistance& other) {
        of_fields_.add(other.of_fields_);
        for (size_t i = 0; i < sums_.size(); ++i) sums_[i].add(other.sums_[i]);
    }
    const std::array<ErrorSum, DISTANCE_CLASSES>& sums() const { return sums_; }

    // Those of MSAD at any distance; the mean is not known.
    const ErrorSum& of_fields() const { return of_fields_; }

private:
    double average_edge_;
    std::array<ErrorSum, DISTANCE_CLASSES> sums_;
    ErrorSum of_fields_;
};

}
