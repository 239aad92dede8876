#pragma once

#include "src/overlay/codes.h"
#include "src/overlay/kernels/lanes.h"

namespace geodesic {

// Rounds distances to codes of SourceCode, as many side by side as fit into a vector: steps beyond `nearest`,
// which is the least distance of the same source. This rounds as StepsOf does, but counts from that distance
// itself, where StepsOf counts from the whole steps in it: both give the same codes if it is whole steps
// away. `scale` is steps_per_distance() of the quantum. The sweep and the crossing both take their codes from
// here.
template <size_t BYTES>
[[gnu::always_inline]] inline void round_to_codes(const Floats<BYTES>& distance, const Floats<BYTES>& nearest,
                                                  float scale, typename Lanes<BYTES>::Keys& codes) {
    using Numbers = typename Lanes<BYTES>::Keys;
    const Floats<BYTES> largest = Floats<BYTES>{} + float{TableCode::LARGEST};
    const Floats<BYTES> steps = (distance - nearest) * scale + 0.5f;
    codes = __builtin_convertvector(steps < largest ? steps : largest, Numbers) + SourceCode::NEAREST;
    codes = distance < INFINITE ? codes : Numbers{} + SourceCode::UNREACHED;
}

}
