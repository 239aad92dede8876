#pragma once

#include <concepts>
#include <limits>

namespace geodesic {

// Small differences of either sign, modulo 2^bits, as small numbers: 0, -1, 1, -2, 2 are 0, 1, 2, 3, 4.
template <std::unsigned_integral T>
constexpr T folded(T difference) {
    constexpr int SIGN = std::numeric_limits<T>::digits - 1;
    return static_cast<T>(difference << 1) ^ (difference >> SIGN ? std::numeric_limits<T>::max() : T{0});
}
template <std::unsigned_integral T>
constexpr T unfolded(T number) {
    return number >> 1 ^ (number & 1 ? std::numeric_limits<T>::max() : T{0});
}

}
