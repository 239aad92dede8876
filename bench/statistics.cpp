#include "bench/statistics.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace geodesic::bench {

namespace {

ErrorSummary summary(std::vector<double> errors) {
    ErrorSummary result;
    if (errors.empty()) return result;
    const auto count = static_cast<double>(errors.size());
    result.count = errors.size();
    result.signed_mean = std::accumulate(errors.begin(), errors.end(), 0.0) / count;
    for (double& error : errors) error = std::abs(error);
    std::sort(errors.begin(), errors.end());
    result.mean = std::accumulate(errors.begin(), errors.end(), 0.0) / count;
    result.p99 = quantile(errors, 0.99);
    result.p999 = quantile(errors, 0.999);
    result.max = errors.back();
    return result;
}

}

double median(std::vector<double> values) {
    if (values.empty()) return std::numeric_limits<double>::quiet_NaN();
    std::sort(values.begin(), values.end());
    const size_t middle = values.size() / 2;
    return values.size() % 2 ? values[middle] : (values[middle - 1] + values[middle]) / 2;
}

double quantile(std::span<const double> sorted, double share) {
    const auto rank = static_cast<size_t>(std::ceil(share * static_cast<double>(sorted.size())));
    return sorted[std::clamp<size_t>(rank, 1, sorted.size()) - 1];
}

Duration median(std::span<const Duration> durations) {
    std::vector<double> wall, cpu;
    for (const Duration& duration : durations) {
        wall.push_back(duration.wall);
        cpu.push_back(duration.cpu);
    }
    return {median(std::move(wall)), median(std::move(cpu))};
}

void ErrorSample::add(double answer, double expected, double exact) {
    if (std::isfinite(answer) != std::isfinite(expected)) {
        ++mismatches_;
        return;
    }
    if (!std::isfinite(exact) || !std::isfinite(answer) || exact == 0) return;
    differences_.push_back(answer - expected);
    exact_.push_back(exact);
}

ErrorSummary ErrorSample::relative() const {
    return relative_between(0, std::numeric_limits<double>::infinity());
}

ErrorSummary ErrorSample::relative_between(double from, double to) const {
    std::vector<double> errors;
    for (size_t i = 0; i < differences_.size(); ++i)
        if (exact_[i] > from && exact_[i] <= to) errors.push_back(differences_[i] / exact_[i]);
    return summary(std::move(errors));
}

ErrorSummary ErrorSample::scaled_by(double unit) const {
    std::vector<double> errors(differences_.size());
    for (size_t i = 0; i < errors.size(); ++i) errors[i] = differences_[i] / unit;
    return summary(std::move(errors));
}

}
