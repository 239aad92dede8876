#pragma once

#include "src/overlay/codes.h"
#include "src/overlay/kernels/lanes.h"

namespace geodesic {

// Rounds distances to codes of SourceCode, as many side by side as fit into a vector: steps beyond `nearest`,
// which is the least distance of the same source. `scale` is steps_per_distance() of the quantum.
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
