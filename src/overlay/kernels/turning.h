#pragma once

#include "src/overlay/kernels/dispatch.h"
#include "src/overlay/kernels/lanes.h"

namespace geodesic {

// The kernel turn_squares(): rows of codes become columns. A vector holds codes of as many squares as it has
// parts of 16 bytes, which are turned together. Only dispatch.cpp includes this.
template <size_t BYTES>
struct TurnSquares {
    static constexpr size_t SIDE = TurnedSquares::SIDE, LANES = BYTES / sizeof(uint16_t);
    static_assert(SIDE == sizeof(EightCodes) / sizeof(uint16_t));
    using Codes = typename VectorOf<uint16_t, BYTES>::Type;

    [[gnu::always_inline]] static void run(const uint16_t* const* rows,
                                           std::span<const TurnedSquares> squares, size_t row_size) {
        for (const TurnedSquares& turned : squares)
            for (size_t r = 0; r < TurnedSquares::ROWS; r += LANES)
                turn(rows + r, turned.first_column, turned.out + r, row_size);
    }

private:
    static constexpr std::make_index_sequence<LANES> ALL{};

    [[gnu::always_inline]] static void turn(const uint16_t* const* rows, size_t column, uint16_t* out,
                                            size_t row_size) {
        Codes square[SIDE], other[SIDE];
        for (size_t i = 0; i < SIDE; ++i)
            join(
                [&](size_t part) {
                    EightCodes codes;
                    load(rows[part * SIDE + i] + column, codes);
                    return codes;
                },
                square[i]);
        riffle(square, other, ALL);
        riffle(other, square, ALL);
        riffle(square, other, ALL);
        for (size_t i = 0; i < SIDE; ++i) store(other[i], out + i * row_size);
    }

    // Interleaves the lanes of row i with those of row i + 4. Done three times, this turns a square.
    template <size_t... I>
    [[gnu::always_inline]] static void riffle(const Codes* from, Codes* to, std::index_sequence<I...>) {
        for (size_t i = 0; i < SIDE / 2; ++i) {
            const Codes &a = from[i], &b = from[i + SIDE / 2];
            to[2 * i] = __builtin_shufflevector(a, b, lane_of_riffle(I, 0)...);
            to[2 * i + 1] = __builtin_shufflevector(a, b, lane_of_riffle(I, SIDE / 2)...);
        }
    }
    // In each part, four lanes of both rows from this one on.
    static constexpr int lane_of_riffle(size_t lane, size_t from) {
        return static_cast<int>(lane / SIDE * SIDE + from + lane % SIDE / 2 + lane % 2 * LANES);
    }
};

}
