#pragma once

#include <bit>
#include <cstdint>
#include <limits>

namespace geodesic {

// By what share of a positive normal number rounded() changes it at most.
inline constexpr float LARGEST_ROUNDING = 1.f / (1 << 13);

// A positive normal number, rounded to 13 significant bits. The other bits are 0, so that such numbers take
// few bytes in a file. The largest floats are rounded down, since above there is only infinity.
inline float rounded(float number) {
    constexpr uint32_t DROPPED = (1 << 11) - 1;
    const auto bits = std::bit_cast<uint32_t>(number);
    const uint32_t to_nearest = bits + DROPPED / 2 + 1;
    const bool is_finite = to_nearest < std::bit_cast<uint32_t>(std::numeric_limits<float>::infinity());
    return std::bit_cast<float>((is_finite ? to_nearest : bits) & ~DROPPED);
}

}
