#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

#include "src/index/description.h"
#include "src/metric/metric.h"

namespace geodesic {

// Up to which distance a float beside the extent of a mesh does not tell two points from one. As a share of
// such a distance, what is rounded anywhere on the mesh is large, and says nothing of answers: a program that
// asks for sin(pi) gets some 1e-16, and a pole made by it is a ring of vertices that far apart. The extent is
// the diagonal of the bounding box, or see too_short_to_count() where positions do not decide distances.
inline double too_short_beside(double extent) {
    return double{std::numeric_limits<float>::epsilon()} * extent;
}

// Whether an answer can have a relative error at this distance: whatever the builder states, compares or
// averages as a share of distances leaves out the others.
inline bool has_relative_error(double exact, double too_short) {
    return exact > too_short && exact < UNREACHABLE;
}

inline double relative_error(double exact, double answer) { return std::abs((answer - exact) / exact); }

// The mean and the largest of relative errors, which are added one by one.
class ErrorSum {
public:
    void add(double error) {
        sum_ += error;
        ++count_;
        add_to_max(error);
    }
    void add_to_max(double error) { max_ = std::max(max_, error); }
    void add(const ErrorSum& other) {
        sum_ += other.sum_;
        count_ += other.count_;
        add_to_max(other.max_);
    }
    MeanAndMax result() const { return {count_ == 0 ? 0 : sum_ / static_cast<double>(count_), max_}; }

private:
    double sum_ = 0, max_ = 0;
    uint64_t count_ = 0;
};

// Relative errors by the exact distance.
class ErrorsByDistance {
public:
    explicit ErrorsByDistance(double average_edge) : average_edge_(average_edge) {}

    ErrorSum& of(double exact) { return sums_[distance_class(exact / average_edge_)]; }
    void add(const ErrorsByDistance& other) {
        for (size_t i = 0; i < sums_.size(); ++i) sums_[i].add(other.sums_[i]);
    }
    std::array<MeanAndMax, DISTANCE_CLASSES> result() const {
        std::array<MeanAndMax, DISTANCE_CLASSES> results;
        std::ranges::transform(sums_, results.begin(), [](const ErrorSum& sum) { return sum.result(); });
        return results;
    }

private:
    double average_edge_;
    std::array<ErrorSum, DISTANCE_CLASSES> sums_;
};

}
