#include "src/build/calibration.h"

#include <cmath>
#include <utility>
#include <vector>

#include "src/base/array.h"
#include "src/base/quantiles.h"
#include "src/query/index.h"

namespace geodesic {

namespace {

// The share by which paths are too long everywhere: the median of the signed errors. Taking it away leaves
// the least mean of absolute errors. The mean of signed errors would follow a few large ones, of pairs that
// measured distances will put right. Where an error is very large the path takes another way altogether, for
// instance a detour over pruned borders, and says nothing about the others.
double common_share(std::vector<double> errors) {
    constexpr double ANOTHER_WAY = 0.1;
    std::erase_if(errors, [](double error) { return std::abs(error) > ANOTHER_WAY; });
    return median(std::move(errors));
}

}

void calibrate(const ExactFields& exact, std::span<const uint32_t> vertex_of_number, Workers& workers,
               StoredIndex& stored) {
    Index draft(global_heap());
    prepare(stored, draft);
    const double share =
        common_share(relative_errors(draft, Crossing::BETWEEN_VERTICES, vertex_of_number, exact, workers));
    for (size_t p = 0; p < stored.child_count.size(); ++p)
        stored.quantum[p] = static_cast<float>(double{stored.quantum[p]} / (1 + share));
}

}
