#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

namespace geodesic {

// What three quarters of the numbers are not below; 0 without any.
template <class Number>
Number lower_quartile(std::vector<Number> numbers) {
    if (numbers.empty()) return 0;
    const auto quartile = numbers.begin() + static_cast<std::ptrdiff_t>(numbers.size() / 4);
    std::ranges::nth_element(numbers, quartile);
    return *quartile;
}

}
