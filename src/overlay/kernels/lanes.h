#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <type_traits>
#include <utility>

#include "src/overlay/kernels/unfolding.h"

namespace geodesic {

// Vectors of the kernels, of the width of a processor. All functions are always inlined and take vectors by
// reference, as those of unfolding.h.
template <size_t BYTES>
struct Lanes {
    static constexpr size_t CODES = BYTES / sizeof(int16_t), FLOATS = BYTES / sizeof(float);
    using Codes [[gnu::vector_size(BYTES)]] = int16_t;
    using Keys [[gnu::vector_size(BYTES)]] = int32_t;
};

using FourKeys = Lanes<16>::Keys;

template <class T, size_t BYTES>
struct VectorOf {
    using Type [[gnu::vector_size(BYTES)]] = T;
};

using EightCodes [[gnu::vector_size(16)]] = uint16_t;

template <class V, class T>
[[gnu::always_inline]] inline void load(const T* first, V& values) {
    std::memcpy(&values, first, sizeof values);
}

template <class V, class T>
[[gnu::always_inline]] inline void store(const V& values, T* first) {
    std::memcpy(first, &values, sizeof values);
}

template <class V>
[[gnu::always_inline]] inline void lower(V& least, const V& others) {
    least = others < least ? others : least;
}

// Whether any lane of a mask is set.
template <class V>
[[gnu::always_inline]] inline bool any(const V& mask) {
    int64_t bits[sizeof mask / sizeof(int64_t)], all = 0;
    std::memcpy(bits, &mask, sizeof mask);
    for (int64_t part : bits) all |= part;
    return all != 0;
}

// least[i]: the least lane of four[i].
template <class Four>
[[gnu::always_inline]] inline void least_lanes(const Four four[4], Four& least) {
    Four pair[2];
    for (int i = 0; i < 2; ++i) {
        const Four &a = four[2 * i], &b = four[2 * i + 1];
        pair[i] = __builtin_shufflevector(a, b, 0, 4, 1, 5);
        lower<Four>(pair[i], __builtin_shufflevector(a, b, 2, 6, 3, 7));
    }
    least = __builtin_shufflevector(pair[0], pair[1], 0, 1, 4, 5);
    lower<Four>(least, __builtin_shufflevector(pair[0], pair[1], 2, 3, 6, 7));
}

// lane[i]: lane I of four[i].
template <int I, class Four>
[[gnu::always_inline]] inline void pick_lanes(const Four four[4], Four& lane) {
    lane = __builtin_shufflevector(__builtin_shufflevector(four[0], four[1], I, I + 4, I, I + 4),
                                   __builtin_shufflevector(four[2], four[3], I, I + 4, I, I + 4), 0, 1, 4, 5);
}

// Rows become columns.
template <class Four>
[[gnu::always_inline]] inline void transpose(Four four[4]) {
    const Four low_01 = __builtin_shufflevector(four[0], four[1], 0, 4, 1, 5);
    const Four low_23 = __builtin_shufflevector(four[2], four[3], 0, 4, 1, 5);
    const Four high_01 = __builtin_shufflevector(four[0], four[1], 2, 6, 3, 7);
    const Four high_23 = __builtin_shufflevector(four[2], four[3], 2, 6, 3, 7);
    four[0] = __builtin_shufflevector(low_01, low_23, 0, 1, 4, 5);
    four[1] = __builtin_shufflevector(low_01, low_23, 2, 3, 6, 7);
    four[2] = __builtin_shufflevector(high_01, high_23, 0, 1, 4, 5);
    four[3] = __builtin_shufflevector(high_01, high_23, 2, 3, 6, 7);
}

template <size_t FIRST, class Wide, class Part, size_t... I>
[[gnu::always_inline]] inline void take_part(const Wide& wide, Part& part, std::index_sequence<I...>) {
    part = __builtin_shufflevector(wide, wide, static_cast<int>(FIRST + I)...);
}

// The lanes of a vector, 16 bytes by 16.
template <class Wide, class Part>
[[gnu::always_inline]] inline void split(const Wide& wide, Part* parts) {
    constexpr size_t LANES = sizeof(Part) / sizeof(wide[0]);
    constexpr std::make_index_sequence<LANES> ALL;
    if constexpr (sizeof wide == sizeof(Part)) {
        parts[0] = wide;
    } else {
        take_part<0>(wide, parts[0], ALL);
        take_part<LANES>(wide, parts[1], ALL);
        if constexpr (sizeof wide == 4 * sizeof(Part)) {
            take_part<2 * LANES>(wide, parts[2], ALL);
            take_part<3 * LANES>(wide, parts[3], ALL);
        }
    }
}

template <class Half, class Wide, size_t... I>
[[gnu::always_inline]] inline void concatenate(const Half& low, const Half& high, Wide& wide,
                                               std::index_sequence<I...>) {
    wide = __builtin_shufflevector(low, high, static_cast<int>(I)...);
}

// part(0), part(1) ..., of 16 bytes each, side by side.
template <class Part, class Wide>
[[gnu::always_inline]] inline void join(const Part& part, Wide& wide) {
    using Lane = std::remove_cvref_t<decltype(wide[0])>;
    constexpr std::make_index_sequence<sizeof wide / sizeof(Lane)> ALL;
    if constexpr (sizeof wide == 16) {
        wide = part(0);
    } else if constexpr (sizeof wide == 32) {
        concatenate(part(0), part(1), wide, ALL);
    } else {
        typename VectorOf<Lane, 32>::Type low, high;
        join(part, low);
        join([&](size_t i) { return part(i + 2); }, high);
        concatenate(low, high, wide, ALL);
    }
}

// As many bytes as there are lanes, in a vector of 16 or 32 bytes. As many bytes again are read. (Compilers
// make twice the instructions of a conversion.)
template <class Codes>
[[gnu::always_inline]] inline void widen_bytes(const uint8_t* first, Codes& codes) {
    typename VectorOf<uint8_t, sizeof codes>::Type bytes, wide, none{};
    load(first, bytes);
    if constexpr (sizeof codes == 16) {
        wide = __builtin_shufflevector(bytes, none, 0, 16, 1, 17, 2, 18, 3, 19, 4, 20, 5, 21, 6, 22, 7, 23);
    } else {
        using Eighths = typename VectorOf<int64_t, sizeof codes>::Type;
        const auto eighths = reinterpret_cast<Eighths>(bytes);
        bytes = reinterpret_cast<decltype(bytes)>(__builtin_shufflevector(eighths, eighths, 0, 0, 1, 1));
        wide = __builtin_shufflevector(bytes, none, 0, 32, 1, 33, 2, 34, 3, 35, 4, 36, 5, 37, 6, 38, 7, 39,
                                       16, 48, 17, 49, 18, 50, 19, 51, 20, 52, 21, 53, 22, 54, 23, 55);
    }
    codes = reinterpret_cast<Codes>(wide);
}

// Of each 16 bytes of codes four, from the STEP-th on.
template <size_t STEP, class Codes, class Numbers, size_t... I>
[[gnu::always_inline]] inline void widen_four(const Codes& codes, Numbers& numbers,
                                              std::index_sequence<I...>) {
    constexpr size_t ZERO = sizeof...(I);
    numbers = reinterpret_cast<Numbers>(__builtin_shufflevector(
        codes, Codes{}, static_cast<int>(I % 2 ? ZERO : I / 8 * 8 + STEP + I % 8 / 2)...));
}

// The least lanes of a wide vector, in 16 bytes.
template <class Wide, class Part>
[[gnu::always_inline]] inline void fold(const Wide& wide, Part& least) {
    constexpr size_t PARTS = sizeof wide / sizeof least;
    Part parts[PARTS];
    split(wide, parts);
    least = parts[0];
    for (size_t i = 1; i < PARTS; ++i) lower(least, parts[i]);
}

template <size_t BYTES>
[[gnu::always_inline]] inline float least_of(const Floats<BYTES>& floats) {
    BesideFloats four;
    fold(floats, four);
    return std::min(std::min(four[0], four[1]), std::min(four[2], four[3]));
}

}
