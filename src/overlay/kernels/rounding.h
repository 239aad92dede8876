#pragma once

#include "src/overlay/kernels/lanes.h"
#include "src/overlay/tables/codes.h"

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

// Rounds the distances of one source. Both arrays are whole vectors long.
template <size_t BYTES>
[[gnu::always_inline]] inline void round_all(const float* distances, size_t count,
                                             const Floats<BYTES>& nearest, float scale, int16_t* codes) {
    using Codes = typename VectorOf<int16_t, BYTES / 2>::Type;
    for (size_t i = 0; i < count; i += Lanes<BYTES>::FLOATS) {
        Floats<BYTES> distance;
        typename Lanes<BYTES>::Keys rounded;
        load(distances + i, distance);
        round_to_codes<BYTES>(distance, nearest, scale, rounded);
        store(__builtin_convertvector(rounded, Codes), codes + i);
    }
}

// distances = nearest + sums, which are counted from the smallest number.
template <class Narrow, class Wide>
[[gnu::always_inline]] inline void decode_sums(const Narrow& sums, float quantum, const Wide& nearest,
                                               Wide& distances) {
    using Numbers = typename VectorOf<int32_t, sizeof(Wide)>::Type;
    const Numbers steps = __builtin_convertvector(sums, Numbers) - SourceCode::NEAREST;
    distances = nearest + __builtin_convertvector(steps, Wide) * quantum;
}

}
