#pragma once

#include <algorithm>
#include <cmath>
#include <cstring>

#include "src/overlay/kernels/dispatch.h"
#include "src/overlay/kernels/lanes.h"
#include "src/overlay/kernels/rounding.h"

namespace geodesic {

// The kernels that sweep from a border to what lies inside of it: what Kernels says of prepare_sweep() and
// sweep(), for one source and for each of several, is done by the structs of these names. Only dispatch.cpp
// includes this.

template <size_t BYTES>
using Sums = typename Lanes<BYTES>::Codes;

// ---- The border, made ready for `COUNT` sources, 1 or FIELDS_AT_ONCE, side by side at each place

template <size_t BYTES, size_t COUNT>
struct PrepareSweep {
    using Distances = Floats<BYTES>;
    using Numbers = typename Lanes<BYTES>::Keys;
    static constexpr size_t LANES = Lanes<BYTES>::FLOATS;
    static constexpr size_t VECTORS = COUNT == 1 ? 1 : COUNT / LANES; // of nearest distances

    [[gnu::always_inline]] static void run(const BorderDistances& border, const BorderCodes& codes,
                                           float* middle_distance) {
        Distances nearest[VECTORS];
        measure_middles(border, middle_distance, nearest);
        if constexpr (COUNT == 1) {
            const float least = least_of<BYTES>(nearest[0]);
            nearest[0] = Distances{} + least;
            *codes.nearest = least;
        } else {
            std::memcpy(codes.nearest, nearest, sizeof nearest);
        }
        encode(border, border.distance, nearest, codes.code);
        encode(border, middle_distance, nearest, codes.middle);
    }

private:
    // nearest: of places and middles.
    [[gnu::always_inline]] static void measure_middles(const BorderDistances& border, float* middle_distance,
                                                       Distances* nearest) {
        for (size_t v = 0; v < VECTORS; ++v) nearest[v] = Distances{} + INFINITE;
        for (size_t i = 0; i < border.places * COUNT; i += LANES) {
            Distances first, second, length, middle;
            load(border.distance + i, first);
            load(border.distance + i + COUNT, second);
            if constexpr (COUNT == 1)
                load(border.length + i, length);
            else
                length = Distances{} + border.length[i / COUNT];
            middle_square(first, second, length, middle);
            take_square_root(middle);
            store(middle, middle_distance + i);
            lower(nearest[i / LANES % VECTORS], first);
            lower(nearest[i / LANES % VECTORS], middle);
        }
        if constexpr (COUNT > 1) std::fill_n(middle_distance + border.places * COUNT, COUNT, INFINITE);
    }

    // LANES codes, of distances side by side.
    [[gnu::always_inline]] static void round_lanes(const float* distances, const Distances& nearest,
                                                   float scale, Numbers& codes) {
        Distances distance;
        load(distances, distance);
        round_to_codes<BYTES>(distance, nearest, scale, codes);
    }

    [[gnu::always_inline]] static void encode(const BorderDistances& border, const float* distances,
                                              const Distances* nearest, int16_t* codes) {
        const float scale = steps_per_distance(border.quantum);
        const size_t places_filled = border.places + border.places % 2;
        if constexpr (COUNT == 1) {
            round_all<BYTES>(distances, border.places, *nearest, scale, codes);
        } else {
            Numbers of_place, of_next;
            for (size_t k = 0; k < places_filled; k += 2)
                for (size_t v = 0; v < VECTORS; ++v) {
                    const float* of_sources = distances + k * COUNT + v * LANES;
                    round_lanes(of_sources, nearest[v], scale, of_place);
                    round_lanes(of_sources + COUNT, nearest[v], scale, of_next);
                    const Numbers pairs = (of_place & 0xffff) | (of_next << 16);
                    store(pairs, codes + k * COUNT + 2 * v * LANES);
                }
        }
        std::fill(codes + places_filled * COUNT, codes + SourceCode::whole_blocks(border.places) * COUNT,
                  SourceCode::UNREACHED);
    }
};

template <size_t BYTES>
using PrepareSweepOfOne = PrepareSweep<BYTES, 1>;
template <size_t BYTES>
using PrepareSweepOfEach = PrepareSweep<BYTES, FIELDS_AT_ONCE>;

// ---- The least ways

// For what sums of codes do not tell: ways of which one end is out of reach. Over places only.
inline float way_over_places(const BorderDistances& border, size_t stride, const float* distance,
                             const uint16_t* row) {
    float least = INFINITE;
    for (size_t k = 0; k < border.places; ++k)
        if (row[k] != TableCode::UNREACHED)
            least = std::min(least, distance[k * stride] + static_cast<float>(row[k]) * border.quantum);
    return least;
}

// Rows are read in parts of so many bytes of codes. Wider ones would mostly cross the ends of cache lines.
template <size_t BYTES>
constexpr size_t ROW_PART = std::min(BYTES, size_t{32});

// Reads the codes of as many places as there are lanes, and of the middles of the segments that begin there.
template <class Codes>
[[gnu::always_inline]] inline void read_row(const uint16_t* row, const uint8_t* offsets, const Codes& strides,
                                            Codes& codes, Codes& middles) {
    // Holds the sum of two codes, and 1.
    using Unsigned = typename VectorOf<uint16_t, sizeof(Codes)>::Type;
    Unsigned first, second;
    Codes wide;
    load(row, first);
    load(row + 1, second);
    widen_bytes(offsets, wide);
    codes = reinterpret_cast<Codes>(first);
    middles = reinterpret_cast<Codes>((first + second + 1) >> 1) - wide * strides;
}

// least[i]: the least lane of eight[i].
template <class Eight>
[[gnu::always_inline]] inline void least_lanes_of_eight(const Eight eight[8], Eight& least) {
    Eight four[4], two[2];
    for (int i = 0; i < 4; ++i) {
        const Eight &a = eight[2 * i], &b = eight[2 * i + 1];
        four[i] = __builtin_shufflevector(a, b, 0, 8, 1, 9, 2, 10, 3, 11);
        lower<Eight>(four[i], __builtin_shufflevector(a, b, 4, 12, 5, 13, 6, 14, 7, 15));
    }
    for (int i = 0; i < 2; ++i) {
        const Eight &a = four[2 * i], &b = four[2 * i + 1];
        two[i] = __builtin_shufflevector(a, b, 0, 1, 8, 9, 2, 3, 10, 11);
        lower<Eight>(two[i], __builtin_shufflevector(a, b, 4, 5, 12, 13, 6, 7, 14, 15));
    }
    least = __builtin_shufflevector(two[0], two[1], 0, 1, 2, 3, 8, 9, 10, 11);
    lower<Eight>(least, __builtin_shufflevector(two[0], two[1], 4, 5, 6, 7, 12, 13, 14, 15));
}

// Asks for the line of memory so many entries behind the first one.
template <class Entry>
[[gnu::always_inline]] inline void prefetch_line_at(const Entry* first, size_t offset) {
    __builtin_prefetch(
        reinterpret_cast<const void*>(reinterpret_cast<uintptr_t>(first) + offset * sizeof(Entry)));
}

template <class Entry>
[[gnu::always_inline]] inline void prefetch_lines(const Entry* entries, size_t begin, size_t end) {
    constexpr size_t LINE = 64 / sizeof(Entry);
    for (size_t offset = begin; offset < end; offset += LINE) prefetch_line_at(entries, offset);
}

// Also of rows behind the last one, with which the next sweep is likely to begin.
[[gnu::always_inline]] inline void prefetch_rows(const BorderDistances& border, const SweepRows& rows,
                                                 size_t first, size_t count) {
    const size_t begin = first * border.places, end = (first + count) * border.places;
    prefetch_lines(rows.codes, begin, end);
    prefetch_lines(rows.middles, begin, end);
}

// ---- From one source: eight rows at a time, a vector of places after the other

template <size_t BYTES>
struct Sweep {
    static constexpr size_t ROWS = 8, WIDTH = ROW_PART<BYTES>;
    using Vector = Sums<WIDTH>;
    using Eight = Sums<ROWS * sizeof(int16_t)>;

    [[gnu::always_inline]] static void lower_all(const BorderDistances& border, const BorderCodes& codes,
                                                 const SweepRows& rows, const size_t* row_begin,
                                                 Vector* least) {
        for (size_t k = 0; k < border.places; k += Lanes<WIDTH>::CODES) {
            Vector code, middle, strides;
            load(codes.code + k, code);
            load(codes.middle + k, middle);
            load(border.stride + k, strides);
            for (size_t r = 0; r < ROWS; ++r) {
                const uint16_t* const row = rows.codes + row_begin[r] + k;
                Vector entries, middles;
                read_row(row, rows.middles + row_begin[r] + k, strides, entries, middles);
                lower<Vector>(least[r], code + entries);
                lower<Vector>(least[r], middle + middles);
            }
        }
    }

    // Rows may be the same.
    [[gnu::always_inline]] static void sweep_eight(const BorderDistances& border, const BorderCodes& codes,
                                                   const SweepRows& rows, const size_t* row_begin,
                                                   float* distances) {
        Vector least[ROWS];
        for (auto& lanes : least) lanes = Vector{} + std::numeric_limits<int16_t>::max();
        lower_all(border, codes, rows, row_begin, least);
        Eight folded[ROWS], sums;
        for (size_t r = 0; r < ROWS; ++r) fold(least[r], folded[r]);
        least_lanes_of_eight(folded, sums);
        decode(border, codes, rows, row_begin, sums, distances);
    }

    // From the least sums of eight rows to distances.
    [[gnu::always_inline]] static void decode(const BorderDistances& border, const BorderCodes& codes,
                                              const SweepRows& rows, const size_t* row_begin,
                                              const Eight& sums, float* distances) {
        using EightFloats = Floats<ROWS * sizeof(float)>;
        EightFloats decoded;
        decode_sums<Eight, EightFloats>(sums, border.quantum, EightFloats{} + *codes.nearest, decoded);
        store(decoded, distances);
        if (any(sums >= static_cast<int16_t>(SourceCode::NO_SUM))) [[unlikely]]
            for (size_t r = 0; r < ROWS; ++r)
                if (sums[r] >= SourceCode::NO_SUM)
                    distances[r] = way_over_places(border, 1, border.distance, rows.codes + row_begin[r]);
    }

    [[gnu::always_inline]] static void run(const BorderDistances& border, const BorderCodes& codes,
                                           const SweepRows& rows, float* distances) {
        size_t row_begin[ROWS];
        for (size_t done = 0; done < rows.count; done += ROWS) {
            for (size_t r = 0; r < ROWS; ++r)
                row_begin[r] = std::min(done + r, rows.count - 1) * border.places;
            prefetch_rows(border, rows, done + ROWS, ROWS);
            if (done + ROWS <= rows.count) {
                sweep_eight(border, codes, rows, row_begin, distances + done);
            } else {
                float last[ROWS];
                sweep_eight(border, codes, rows, row_begin, last);
                std::copy_n(last, rows.count - done, distances + done);
            }
        }
    }
};

// ---- From each of FIELDS_AT_ONCE: lanes are the sources, each with two places; several rows share what
// they read of the border

template <size_t BYTES>
struct SweepEach {
    static constexpr size_t LANES = BYTES / sizeof(int32_t), VECTORS = FIELDS_AT_ONCE / LANES;
    using Pairs = typename Lanes<BYTES>::Keys;

    // Entries of two places, as each source's.
    [[gnu::always_inline]] static void load_pair(const uint16_t* entries, Sums<BYTES>& pairs) {
        int32_t pair;
        std::memcpy(&pair, entries, sizeof pair);
        pairs = reinterpret_cast<Sums<BYTES>>(Pairs{} + pair);
    }

    // Over so many places; entries of a row are `row_size` behind those of the row before.
    template <size_t ROWS>
    [[gnu::always_inline]] static void lower_all(size_t places, const int16_t* codes, const uint16_t* entries,
                                                 size_t row_size, Sums<BYTES>* least) {
        for (size_t k = 0; k < places; k += 2) {
            Sums<BYTES> code[VECTORS], pair;
            std::memcpy(code, codes + k * FIELDS_AT_ONCE, sizeof code);
            for (size_t r = 0; r < ROWS; ++r) {
                load_pair(entries + r * row_size + k, pair);
                for (size_t v = 0; v < VECTORS; ++v)
                    lower<Sums<BYTES>>(least[r * VECTORS + v], code[v] + pair);
            }
        }
    }

    // Over the middles of a block of places after the other. `row` is the first place of the first row.
    template <size_t ROWS>
    [[gnu::always_inline]] static void lower_over_middles(const BorderDistances& border,
                                                          const BorderCodes& codes, const SweepRows& rows,
                                                          size_t row, Sums<BYTES>* least) {
        constexpr size_t BLOCK = SourceCode::BLOCK;
        for (size_t first = 0; first < border.places; first += BLOCK) {
            uint16_t middles[ROWS * BLOCK];
            for (size_t k = 0; k < BLOCK; k += Lanes<ROW_PART<BYTES>>::CODES) {
                Sums<ROW_PART<BYTES>> strides, entries, decoded;
                load(border.stride + first + k, strides);
                for (size_t r = 0; r < ROWS; ++r) {
                    const size_t place = row + r * border.places + first + k;
                    read_row(rows.codes + place, rows.middles + place, strides, entries, decoded);
                    store(decoded, middles + r * BLOCK + k);
                }
            }
            lower_all<ROWS>(std::min(BLOCK, border.places - first), codes.middle + first * FIELDS_AT_ONCE,
                            middles, BLOCK, least);
        }
    }

    // The rows from `first` on.
    template <size_t ROWS>
    [[gnu::always_inline]] static void sweep_rows(const BorderDistances& border, const BorderCodes& codes,
                                                  const SweepRows& rows, size_t first, float* distances) {
        Sums<BYTES> least[ROWS * VECTORS];
        for (auto& lanes : least) lanes = Sums<BYTES>{} + std::numeric_limits<int16_t>::max();
        const size_t row = first * border.places;
        lower_all<ROWS>(border.places, codes.code, rows.codes + row, border.places, least);
        lower_over_middles<ROWS>(border, codes, rows, row, least);
        for (size_t i = 0; i < ROWS * VECTORS; ++i) {
            const Pairs pairs = reinterpret_cast<Pairs>(least[i]);
            Pairs sums = pairs >> 16;
            lower<Pairs>(sums, (pairs << 16) >> 16);
            Floats<BYTES> nearest, decoded;
            load(codes.nearest + i % VECTORS * LANES, nearest);
            decode_sums(sums, border.quantum, nearest, decoded);
            store(decoded, distances + first * FIELDS_AT_ONCE + i * LANES);
            if (any(sums >= SourceCode::NO_SUM)) [[unlikely]]
                for (size_t lane = 0; lane < LANES; ++lane)
                    if (sums[lane] >= SourceCode::NO_SUM)
                        sweep_one(border, codes, rows, first * FIELDS_AT_ONCE + i * LANES + lane, distances);
        }
    }

    static void sweep_one(const BorderDistances& border, const BorderCodes& codes, const SweepRows& rows,
                          size_t way, float* distances) {
        const size_t row = way / FIELDS_AT_ONCE, source = way % FIELDS_AT_ONCE;
        if (codes.nearest[source] == INFINITE) return;
        distances[way] = way_over_places(border, FIELDS_AT_ONCE, border.distance + source,
                                         rows.codes + row * border.places);
    }

    [[gnu::always_inline]] static void run(const BorderDistances& border, const BorderCodes& codes,
                                           const SweepRows& rows, float* distances) {
        constexpr size_t ROWS = BYTES >= 32 ? 4 : 2;
        size_t r = 0;
        for (; r + ROWS <= rows.count; r += ROWS) {
            prefetch_rows(border, rows, r + ROWS, ROWS);
            sweep_rows<ROWS>(border, codes, rows, r, distances);
        }
        for (; r < rows.count; ++r) sweep_rows<1>(border, codes, rows, r, distances);
    }
};

}
