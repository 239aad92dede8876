#include "src/query/crossing.h"

#include <algorithm>
#include <cmath>
#include <cstring>

#include "src/index/unfolding.h"

namespace geodesic {

namespace {

constexpr float INFINITE = std::numeric_limits<float>::infinity();

// So many rows at a time: first their nearest places, then the ways over them, so that the processor has
// several rows at work at once.
constexpr size_t ROWS = 64;

// ---- The place with the least sum of each row, in vectors of the kernel's width

template <size_t BYTES>
struct Vectors {
    using Codes [[gnu::vector_size(BYTES), gnu::aligned(2), gnu::may_alias]] = int16_t; // at any address
    using Keys [[gnu::vector_size(BYTES)]] = int32_t;
};

// A key is a sum, and below it a place: the least one is the first place with the least sum.
constexpr int32_t PLACE_BITS = 16, PLACE_MASK = 0xffff;

// Sums from here on may be of places that are not seen, or of no way.
constexpr int32_t NO_SUM = SeenBorder::NEAREST + OverlayTables::UNREACHED;

using FourKeys = Vectors<16>::Keys;

// Vectors wider than the baseline's go by reference: how they are returned depends on the processor.
template <class Keys>
[[gnu::always_inline]] inline void lower(Keys& keys, const Keys& others) {
    keys = keys < others ? keys : others;
}

[[gnu::always_inline]] inline void fold(const FourKeys& keys, FourKeys& least) { least = keys; }

[[gnu::always_inline]] inline void fold(const Vectors<32>::Keys& keys, FourKeys& least) {
    least = __builtin_shufflevector(keys, keys, 0, 1, 2, 3);
    lower<FourKeys>(least, __builtin_shufflevector(keys, keys, 4, 5, 6, 7));
}

[[gnu::always_inline]] inline void fold(const Vectors<64>::Keys& keys, FourKeys& least) {
    Vectors<32>::Keys half = __builtin_shufflevector(keys, keys, 0, 1, 2, 3, 4, 5, 6, 7);
    lower<Vectors<32>::Keys>(half, __builtin_shufflevector(keys, keys, 8, 9, 10, 11, 12, 13, 14, 15));
    fold(half, least);
}

// least[i]: the least key of row i.
[[gnu::always_inline]] inline void fold_rows(const FourKeys rows[4], FourKeys& least) {
    FourKeys pair[2];
    for (int i = 0; i < 2; ++i) {
        const FourKeys &a = rows[2 * i], &b = rows[2 * i + 1];
        pair[i] = __builtin_shufflevector(a, b, 0, 4, 1, 5);
        lower<FourKeys>(pair[i], __builtin_shufflevector(a, b, 2, 6, 3, 7));
    }
    least = __builtin_shufflevector(pair[0], pair[1], 0, 1, 4, 5);
    lower<FourKeys>(least, __builtin_shufflevector(pair[0], pair[1], 2, 3, 6, 7));
}

// Where the number of vectors that hold the places is known, 1 .. 8, the border's codes stay in registers;
// BLOCKS = 0: any number.
template <size_t BYTES, size_t BLOCKS>
struct NearestPlaces {
    using Codes = typename Vectors<BYTES>::Codes;
    using Keys = typename Vectors<BYTES>::Keys;
    static constexpr size_t LANES = BYTES / sizeof(int16_t);

    [[gnu::always_inline]] static void find(const SeenBorder& border, Rows rows, int32_t* keys) {
        const size_t blocks = BLOCKS ? BLOCKS : (border.places + LANES - 1) / LANES;
        Codes codes[BLOCKS + 1], lanes;
        for (size_t b = 0; b < BLOCKS; ++b) codes[b] = at(border.code, b);
        for (size_t i = 0; i < LANES; ++i) lanes[i] = static_cast<int16_t>(i);
        for (size_t r = 0; r < rows.size(); r += 4) {
            FourKeys row_keys[4];
            for (size_t i = 0; i < 4; ++i) {
                const uint16_t* row = rows[std::min(r + i, rows.size() - 1)];
                Codes best = at(row, 0) + (BLOCKS ? codes[0] : at(border.code, 0));
                Codes place = lanes, here = lanes;
                for (size_t b = 1; b < blocks; ++b) {
                    here += static_cast<int16_t>(LANES);
                    const Codes sum = at(row, b) + (BLOCKS ? codes[b] : at(border.code, b));
                    const auto is_lower = sum < best;
                    place = is_lower ? here : place;
                    best = is_lower ? sum : best;
                }
                make_keys(best, place, row_keys[i]);
            }
            FourKeys least;
            fold_rows(row_keys, least);
            std::memcpy(keys + r, &least, sizeof least);
        }
    }

private:
    template <class Code>
    [[gnu::always_inline]] static const Codes& at(const Code* first, size_t block) {
        return *reinterpret_cast<const Codes*>(first + block * LANES);
    }

    [[gnu::always_inline]] static void make_keys(const Codes& sum, const Codes& place, FourKeys& keys) {
        const Keys sums = reinterpret_cast<Keys>(sum), places = reinterpret_cast<Keys>(place);
        Keys even = (sums << PLACE_BITS) | (places & PLACE_MASK);
        const Keys odd = (sums & ~PLACE_MASK) | (places >> PLACE_BITS);
        lower(even, odd);
        fold(even, keys);
    }
};

template <size_t BYTES>
[[gnu::always_inline]] inline void find_keys(const SeenBorder& border, Rows rows, int32_t* keys) {
    constexpr size_t LANES = BYTES / sizeof(int16_t);
    switch ((border.places + LANES - 1) / LANES) {
    case 1:
        return NearestPlaces<BYTES, 1>::find(border, rows, keys);
    case 2:
        return NearestPlaces<BYTES, 2>::find(border, rows, keys);
    case 3:
        return NearestPlaces<BYTES, 3>::find(border, rows, keys);
    case 4:
        return NearestPlaces<BYTES, 4>::find(border, rows, keys);
    case 5:
        return NearestPlaces<BYTES, 5>::find(border, rows, keys);
    case 6:
        return NearestPlaces<BYTES, 6>::find(border, rows, keys);
    case 7:
        return NearestPlaces<BYTES, 7>::find(border, rows, keys);
    case 8:
        return NearestPlaces<BYTES, 8>::find(border, rows, keys);
    default:
        return NearestPlaces<BYTES, 0>::find(border, rows, keys);
    }
}

constexpr int32_t NO_PLACE = SeenBorder::NO_PLACE;

// One place after the other, for what the sums of codes do not tell apart: ways of which one end is out of
// reach. NO_PLACE if there is no way.
int32_t nearest_place(const SeenBorder& border, const uint16_t* row) {
    float least = INFINITE;
    int32_t nearest = NO_PLACE;
    for (size_t k = 0; k < border.places; ++k) {
        if (border.code[k] == SeenBorder::NOT_SEEN || row[k] == OverlayTables::UNREACHED) continue;
        const float d = border.distance[k] + static_cast<float>(row[k]) * border.quantum;
        if (d >= least) continue;
        least = d;
        nearest = static_cast<int32_t>(k);
    }
    return nearest;
}

// ---- The ways over these places

// Where the segments near a row's place begin, in the border and in the row.
struct Near {
    size_t first;
    const uint16_t* codes;
};

// As many as fit into the widest vector are added at the end, like the last one.
constexpr size_t MOST_SIDE_BY_SIDE = 4;

template <size_t BYTES>
[[gnu::always_inline]] inline void find_near(const SeenBorder& border, Rows rows, int32_t* places,
                                             Near* near) {
    find_keys<BYTES>(border, rows, places);
    for (size_t r = 0; r < rows.size(); ++r) {
        const uint16_t* row = rows[r];
        const int32_t sum = places[r] >> PLACE_BITS;
        places[r] &= PLACE_MASK;
        if (sum >= NO_SUM) [[unlikely]]
            places[r] = nearest_place(border, row);
        const size_t first = places[r] == NO_PLACE ? 0 : static_cast<size_t>(places[r]) - Rings::REACH;
        near[r] = {first, row + first};
    }
    for (size_t i = 0; i < MOST_SIDE_BY_SIDE; ++i) near[rows.size() + i] = near[rows.size() - 1];
}

[[gnu::always_inline]] inline void join(const NearFloats& a, const NearFloats& b, Floats<32>& out) {
    out = __builtin_shufflevector(a, b, 0, 1, 2, 3, 4, 5, 6, 7);
}
[[gnu::always_inline]] inline void join(const FourKeys& a, const FourKeys& b, Vectors<32>::Keys& out) {
    out = __builtin_shufflevector(a, b, 0, 1, 2, 3, 4, 5, 6, 7);
}
[[gnu::always_inline]] inline void join(const Floats<32>& a, const Floats<32>& b, Floats<64>& out) {
    out = __builtin_shufflevector(a, b, 0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15);
}
[[gnu::always_inline]] inline void join(const Vectors<32>::Keys& a, const Vectors<32>::Keys& b,
                                        Vectors<64>::Keys& out) {
    out = __builtin_shufflevector(a, b, 0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15);
}

// out: part(0), part(1) ... side by side. Half: of four such parts.
template <class Half, class Part, class Wide>
[[gnu::always_inline]] inline void join_parts(const Part& part, Wide& out) {
    if constexpr (sizeof out == 16) {
        out = part(0);
    } else if constexpr (sizeof out == 32) {
        join(part(0), part(1), out);
    } else {
        Half first, second;
        join(part(0), part(1), first);
        join(part(2), part(3), second);
        join(first, second, out);
    }
}

// Four codes; eight are read.
[[gnu::always_inline]] inline FourKeys four_codes(const uint16_t* first) {
    using Codes [[gnu::vector_size(16)]] = uint16_t;
    Codes codes;
    std::memcpy(&codes, first, sizeof codes);
    return reinterpret_cast<FourKeys>(__builtin_shufflevector(codes, Codes{}, 0, 8, 1, 9, 2, 10, 3, 11));
}

// sums[4 r ..]: of row r and the border's distances, near the row's place; squares[4 r ..]: of the ways over
// the segments there. As many rows at a time as fit into a vector.
template <size_t BYTES>
[[gnu::always_inline]] inline void measure_near(const SeenBorder& border, size_t count, const Near* near,
                                                float* sums, float* squares) {
    constexpr size_t SIDE_BY_SIDE = BYTES / sizeof(NearFloats);
    static_assert(SIDE_BY_SIDE <= MOST_SIDE_BY_SIDE);
    for (size_t r = 0; r < count; r += SIDE_BY_SIDE) {
        const auto of_border = [&](const float* of_places, Floats<BYTES>& out) {
            join_parts<Floats<32>>([&](size_t i) { return near_floats(of_places + near[r + i].first); }, out);
        };
        const auto of_rows = [&](size_t step, Floats<BYTES>& out) {
            typename Vectors<BYTES>::Keys codes;
            join_parts<Vectors<32>::Keys>([&](size_t i) { return four_codes(near[r + i].codes + step); },
                                          codes);
            out = __builtin_convertvector(codes, Floats<BYTES>) * border.quantum;
        };
        SeenSegments<Floats<BYTES>> seen;
        of_border(border.length, seen.segments.length);
        of_border(border.half_inverse, seen.segments.half_inverse);
        of_border(border.foot, seen.foot);
        of_border(border.height, seen.height);
        Floats<BYTES> first, second, sum, square;
        of_rows(0, first);
        of_rows(1, second);
        of_border(border.distance, sum);
        sum += first;
        seen.square_across(first, second, square);
        std::memcpy(sums + 4 * r, &sum, sizeof sum);
        std::memcpy(squares + 4 * r, &square, sizeof square);
    }
}

template <size_t BYTES>
[[gnu::always_inline]] inline void cross(const SeenBorder& border, Rows rows, float* distances,
                                         uint16_t* winners) {
    int32_t places[ROWS];
    Near near[ROWS + MOST_SIDE_BY_SIDE];
    alignas(BYTES) float sums[4 * ROWS], squares[4 * ROWS];
    for (size_t done = 0; done < rows.size(); done += ROWS) {
        const size_t part = std::min(ROWS, rows.size() - done);
        find_near<BYTES>(border, rows.subspan(done, part), places, near);
        measure_near<BYTES>(border, part, near, sums, squares);
        for (size_t r = 0; r < part; ++r) {
            const float* s = squares + 4 * r;
            const float across = std::sqrt(std::min(std::min(s[0], s[1]), std::min(s[2], s[3])));
            const float over = sums[4 * r + Rings::REACH];
            distances[done + r] = places[r] == NO_PLACE ? INFINITE : std::min(over, across);
        }
        if (winners)
            for (size_t r = 0; r < part; ++r) winners[done + r] = static_cast<uint16_t>(places[r]);
    }
}

// ---- For each kind of processor

void cross_baseline(const SeenBorder& border, Rows rows, float* distances, uint16_t* winners) {
    cross<16>(border, rows, distances, winners);
}

#ifdef __x86_64__
[[gnu::target("avx2")]] void cross_avx2(const SeenBorder& border, Rows rows, float* distances,
                                        uint16_t* winners) {
    cross<32>(border, rows, distances, winners);
}

[[gnu::target("avx512bw,avx512vl")]] void cross_avx512(const SeenBorder& border, Rows rows, float* distances,
                                                       uint16_t* winners) {
    cross<64>(border, rows, distances, winners);
}
#endif

constexpr CrossingKernel KERNELS[] = {
    {"baseline", cross_baseline},
#ifdef __x86_64__
    {"AVX2", cross_avx2},
    {"AVX-512", cross_avx512},
#endif
};

size_t count_kernels() {
#ifdef __x86_64__
    if (!__builtin_cpu_supports("avx2")) return 1;
    return __builtin_cpu_supports("avx512bw") && __builtin_cpu_supports("avx512vl") ? 3 : 2;
#else
    return 1;
#endif
}

}

std::span<const CrossingKernel> crossing_kernels() {
    static const size_t count = count_kernels();
    return std::span(KERNELS).first(count);
}

}
