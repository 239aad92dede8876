#pragma once

#include <algorithm>

#include "src/overlay/kernels/sweep.h"

namespace geodesic {

// The kernel sweep_bounded(): sweep() of one source over a long border, of which each row reads only the
// blocks that may hold its least way. Only dispatch.cpp includes this.
template <size_t BYTES>
struct SweepBounded {
    static constexpr size_t PLACES = InnerBounds::PLACES;
    static constexpr size_t WIDTH = std::min(BYTES, PLACES * sizeof(int16_t)), LANES = Lanes<WIDTH>::CODES;
    static constexpr size_t ROWS = Sweep<BYTES>::ROWS;
    // The row that comes so many rows later is likely to read what this one reads: it is asked for ahead.
    static constexpr size_t ROWS_AHEAD = 4;
    using Vector = Sums<WIDTH>;
    using Eight = typename Sweep<BYTES>::Eight;

    // Codes and middles of one row.
    struct Row {
        const uint16_t* codes;
        const uint8_t* middles;
        const int16_t* strides;
        const uint16_t* bounds;
        size_t ahead; // in places
    };

    [[gnu::always_inline]] static int16_t least_lane(const Vector& sums) {
        Eight least;
        fold(sums, least);
        lower<Eight>(least, __builtin_shufflevector(least, least, 4, 5, 6, 7, 0, 1, 2, 3));
        lower<Eight>(least, __builtin_shufflevector(least, least, 2, 3, 0, 1, 6, 7, 4, 5));
        lower<Eight>(least, __builtin_shufflevector(least, least, 1, 0, 3, 2, 5, 4, 7, 6));
        return least[0];
    }

    // Fills the bounds of the source's codes. Returns the block with the least one.
    [[gnu::always_inline]] static size_t bound_source(const BorderCodes& codes, size_t blocks) {
        size_t nearest = 0;
        for (size_t block = 0; block < blocks; ++block) {
            Vector least = Vector{} + SourceCode::UNREACHED, others;
            for (size_t k = block * PLACES; k < (block + 1) * PLACES; k += LANES) {
                load(codes.code + k, others);
                lower<Vector>(least, others);
                load(codes.middle + k, others);
                lower<Vector>(least, others);
            }
            codes.bound[block] = least_lane(least);
            if (codes.bound[block] < codes.bound[nearest]) nearest = block;
        }
        return nearest;
    }

    template <class Entry>
    [[gnu::always_inline]] static void prefetch_block(const Entry* entries, size_t offset) {
        prefetch_line_at(entries, offset);
        prefetch_line_at(entries, offset + PLACES - 1);
    }

    [[gnu::always_inline]] static int16_t least_sum_in(size_t block, const BorderCodes& codes,
                                                       const Row& row) {
        Vector least = Vector{} + std::numeric_limits<int16_t>::max(), code, entries, strides, middles;
        prefetch_block(row.codes + block * PLACES, row.ahead);
        prefetch_block(row.middles + block * PLACES, row.ahead);
        for (size_t k = block * PLACES; k < (block + 1) * PLACES; k += LANES) {
            load(row.strides + k, strides);
            read_row(row.codes + k, row.middles + k, strides, entries, middles);
            load(codes.code + k, code);
            lower<Vector>(least, code + entries);
            load(codes.middle + k, code);
            lower<Vector>(least, code + middles);
        }
        return least_lane(least);
    }

    // The least sum of a row. That of the row before was in block `likely`; that of this row is there
    // afterwards.
    [[gnu::always_inline]] static int16_t least_sum(const BorderCodes& codes, const Row& row, size_t blocks,
                                                    size_t& likely) {
        const size_t first = likely;
        int16_t least = least_sum_in(first, codes, row);
        for (size_t block = 0; block < blocks; ++block) {
            if (codes.bound[block] + row.bounds[block] >= least || block == first) continue;
            const int16_t sum = least_sum_in(block, codes, row);
            if (sum >= least) continue;
            least = sum;
            likely = block;
        }
        return least;
    }

    [[gnu::always_inline]] static void run(const BorderDistances& border, const BorderCodes& codes,
                                           const SweepRows& rows, float* distances) {
        const size_t blocks = InnerBounds::blocks(border.places);
        size_t likely = bound_source(codes, blocks);
        for (size_t done = 0; done < rows.count; done += ROWS) {
            const size_t count = std::min(ROWS, rows.count - done);
            size_t row_begin[ROWS] = {};
            Eight sums = Eight{} + static_cast<int16_t>(SourceCode::NEAREST); // where there is no row
            for (size_t r = 0; r < count; ++r) {
                row_begin[r] = (done + r) * border.places;
                const Row row{rows.codes + row_begin[r], rows.middles + row_begin[r], border.stride,
                              rows.bounds + (done + r) * blocks, ROWS_AHEAD * border.places};
                sums[r] = least_sum(codes, row, blocks, likely);
            }
            float of_rows[ROWS];
            Sweep<BYTES>::decode(border, codes, rows, row_begin, sums, of_rows);
            std::copy_n(of_rows, count, distances + done);
        }
    }
};

}
