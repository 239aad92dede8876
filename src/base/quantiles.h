#pragma once

#include <algorithm>
#include <cstddef>
#include <utility>
#include <vector>

namespace geodesic {

// The number that comes at this position in ascending order.
template <class Number>
Number number_at(std::vector<Number> numbers, size_t position) {
    const auto at = numbers.begin() + static_cast<std::ptrdiff_t>(position);
    std::ranges::nth_element(numbers, at);
    return *at;
}

// What three quarters of the numbers are not below; 0 without any.
template <class Number>
Number lower_quartile(std::vector<Number> numbers) {
    const size_t position = numbers.size() / 4;
    return numbers.empty() ? 0 : number_at(std::move(numbers), position);
}

// What half of the numbers are not below; 0 without any.
template <class Number>
Number median(std::vector<Number> numbers) {
    const size_t position = numbers.size() / 2;
    return numbers.empty() ? 0 : number_at(std::move(numbers), position);
}

}
