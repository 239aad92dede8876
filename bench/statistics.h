#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "bench/timing.h"

namespace geodesic::bench {

// NaN where there are no values.
double median(std::vector<double> values);

// The smallest of the values that at least this share of them does not exceed: "nearest rank". `sorted` is in
// ascending order and not empty.
double quantile(std::span<const double> sorted, double share);

// Medians of wall and of CPU time, each by itself.
Duration median(std::span<const Duration> durations);

struct ErrorSummary {
    uint64_t count = 0;
    double mean = 0; // of absolute values, as are the quantiles and the maximum
    double signed_mean = 0;
    double p99 = 0;
    double p999 = 0;
    double max = 0;
};

// Differences between answers and what they should have been, with the exact distances they belong to.
class ErrorSample {
public:
    // Pairs at distance 0 and pairs without a path are left out. An answer that is finite where it should be
    // infinite, or the other way round, is counted in mismatches() only.
    void add(double answer, double expected, double exact);
    void add(double answer, double exact) { add(answer, exact, exact); }

    ErrorSummary relative() const;             // to the exact distance
    ErrorSummary scaled_by(double unit) const; // differences / unit
    // Of distances over `from`, up to `to`, relative to the exact ones.
    ErrorSummary relative_between(double from, double to) const;
    uint64_t mismatches() const { return mismatches_; }

private:
    std::vector<double> differences_;
    std::vector<double> exact_;
    uint64_t mismatches_ = 0;
};

}
