#include "src/overlay/tables/measured_pairs.h"

#include <algorithm>

namespace geodesic {

std::span<const MeasuredPairs::Other> MeasuredPairs::of(uint32_t number, uint32_t first, uint32_t end) const {
    const auto all = of(number);
    const auto from = std::ranges::lower_bound(all, first, {}, &Other::number);
    return {from, std::ranges::lower_bound(from, all.end(), end, {}, &Other::number)};
}

const float* MeasuredPairs::distance(uint32_t first, uint32_t second) const {
    const auto pairs = of(first);
    if (pairs.empty()) return nullptr;
    const auto found = std::ranges::lower_bound(pairs, second, {}, &Other::number);
    return found != pairs.end() && found->number == second ? &found->distance : nullptr;
}

}
