#pragma once

#include <algorithm>
#include <cmath>
#include <span>

#include "src/overlay/tables/codes.h"

namespace geodesic::test {

// Rounds the distances of one source from a border to codes that count steps beyond the nearest vertex. That
// vertex is at least nearest() whole steps away. One distance at a time, against what kernels do with many.
class StepsOf {
public:
    StepsOf(std::span<const float> distances, float quantum) : scale_(steps_per_distance(quantum)) {
        float nearest = INFINITE;
        for (const float d : distances) nearest = std::min(nearest, d);
        if (nearest < INFINITE)
            nearest_ = std::trunc(std::min(nearest * scale_, std::numeric_limits<float>::max()));
    }

    // Whole, and too large for any integer where the distances are long and the quantum is that of a tiny
    // part.
    float nearest() const { return nearest_; }

    int16_t code(float distance) const {
        if (distance == INFINITE) return SourceCode::UNREACHED;
        const float steps = std::clamp(distance * scale_ - nearest_ + 0.5f, 0.f, MOST);
        return static_cast<int16_t>(SourceCode::NEAREST + static_cast<int32_t>(steps));
    }

private:
    static constexpr float MOST = SourceCode::UNREACHED - 2 - SourceCode::NEAREST;

    float scale_;
    float nearest_ = 0;
};

}
