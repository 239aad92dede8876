#pragma once

#include <algorithm>
#include <cstdint>
#include <limits>
#include <span>

#include "src/query/crossing.h"

namespace geodesic {

// Distances to places of a border as codes that a kernel reads: steps of a quantum beyond the nearest one,
// which is at least that many whole steps away.
class StepsOf {
public:
    StepsOf(std::span<const float> distances, float quantum)
        : scale_(quantum > 0 ? std::min(1 / quantum, std::numeric_limits<float>::max()) : 0) {
        float nearest = INFINITE;
        for (const float d : distances) nearest = std::min(nearest, d);
        if (nearest < INFINITE) nearest_ = static_cast<uint32_t>(std::min(nearest * scale_, 0x1p30f));
    }

    uint32_t nearest() const { return nearest_; }

    int16_t code(float distance) const {
        if (distance == INFINITE) return SeenCodes::NOT_SEEN;
        const float steps = std::clamp(distance * scale_ - static_cast<float>(nearest_) + 0.5f, 0.f, MOST);
        return static_cast<int16_t>(SeenCodes::NEAREST + static_cast<int32_t>(steps));
    }

private:
    static constexpr float INFINITE = std::numeric_limits<float>::infinity();
    static constexpr float MOST = SeenCodes::NOT_SEEN - 2 - SeenCodes::NEAREST;

    float scale_;
    uint32_t nearest_ = 0;
};

}
