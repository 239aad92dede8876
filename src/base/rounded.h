#pragma once

#include <bit>
#include <cstdint>

namespace geodesic {

// A positive normal number, rounded to 13 significant bits: by a share of 1/8192 at most. The other bits are
// 0, so that such numbers take few bytes in a file.
inline constexpr float ROUNDING = 1.f / (1 << 13);
inline float rounded(float number) {
    constexpr uint32_t DROPPED = (1 << 11) - 1;
    const auto bits = std::bit_cast<uint32_t>(number);
    return std::bit_cast<float>((bits + DROPPED / 2 + 1) & ~DROPPED);
}

}
