#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>

#include "src/index/face_point.h"
#include "src/overlay/kernels/near.h"
#include "src/overlay/tables/codes.h"
#include "src/overlay/tables/tables.h"

namespace geodesic {

// What the kernels read and write, and the one table through which they are called.

// How many fields, each from a source of its own, are swept and lowered as a batch. What each of them has of
// a place, a row or a vertex lies side by side.
inline constexpr size_t FIELDS_AT_ONCE = 16;

// Rows of a table: one a place, each with a code a column, or one a target, each with a code a place.
using Rows = std::span<const uint16_t* const>;
// The same of rows that lie one after the other.
struct TableRows {
    const uint16_t* codes;
    size_t columns, count;

    size_t size() const { return count; }
    const uint16_t* operator[](size_t row) const { return codes + row * columns; }
};
// Some columns of a table.
using Columns = std::span<const uint32_t>;

// ---- What a crossing reads: a border, one source, and any rows

// The border of a patch and the distances of one source from it, by the places of the border's ring.
struct BorderFromSource {
    static constexpr uint16_t NO_PLACE = 0xffff; // a winner where there is no way

    size_t places;
    const int16_t* code;                // of SourceCode
    const float* distance;              // infinity behind the last place, too, up to whole blocks
    const float *length, *half_inverse; // of the segment to the next place; NaN: a gap
    const float *foot, *height;         // of the source, in the plane of the segment
    float quantum;                      // of the rows
    // Up to how many times the longest segment a distance is near, see near.h.
    float near_segments = NEAR_SEGMENTS;
};

// The part of a border that is near to the source.
struct NearRange {
    float nearest;      // the distance of the nearest place
    float reach;        // up to which a distance is near
    size_t first, last; // near places, and those between them; none if first > last
    bool is_near() const { return first <= last; }

    // What is read of the border, or of a row: Rings::REACH more places on each side, in whole parts, so that
    // results are of the same ones whatever the width of a vector.
    static constexpr size_t PART = 64 / sizeof(float);
    static constexpr size_t whole_parts(size_t count) { return (count + PART - 1) / PART * PART; }
    size_t begin() const { return (std::max(first, size_t{Rings::REACH}) - Rings::REACH) / PART * PART; }
    size_t end(size_t places) const { return whole_parts(std::min(last + Rings::REACH, places)); }
};

// A few places of a border and the distances of one source from them.
struct FewPlaces {
    static constexpr size_t MOST = 32;

    size_t places;
    // All of these are readable for a block behind the last place.
    const float* distance;
    const float *length, *half_inverse; // of the segment to the next place; NaN: a gap
    const int8_t* is_own;               // 0 or -1
    float quantum;                      // of the rows
};

// The samples of a border and the distances of one source from them.
struct SampledBorder {
    const float* distance; // infinity behind the last sample, up to whole blocks
    float quantum;         // of the rows
    std::span<const Samples::LongSegment> long_segments;
    int16_t* code; // scratch, with room for whole blocks
};

// The places of a ring that a path crosses from one end to the other, and the segments that begin at them.
struct BorderBetween {
    size_t places;
    const float *from, *to; // distances of the two ends; infinity behind the last place, up to whole blocks
    const float *length, *half_inverse; // of the segment to the next place; NaN: a gap
};

// ---- What a sweep reads: a border, one or several sources, and all rows of the table in their order

// The distances of sources from the places of a ring: infinity behind the last one, up to whole blocks.
struct BorderDistances {
    size_t places;
    const float* distance;
    const float* length;   // of the segment to the next place; NaN: a gap
    const int16_t* stride; // of that segment, as MiddleStrides has them
    float quantum;         // of the rows
};

// The distances as codes of SourceCode, from the places and from the middles of the segments that begin at
// them. Of several sources, codes of two places alternate: those of places 2 k and 2 k + 1 from source s are
// at 2 (k * FIELDS_AT_ONCE + s) and behind it.
struct BorderCodes {
    int16_t *code, *middle;
    float* nearest; // per source; infinity: none is reached, and its codes say nothing
    int16_t* bound; // scratch of sweep_bounded(): one a block of InnerBounds
};

// Rows of a table, end to end: a code a place, and the MiddleOffset of the segment that begins there; of long
// borders, also a code of InnerBounds a block.
struct SweepRows {
    size_t count;
    const uint16_t* codes;
    const uint8_t* middles;
    const uint16_t* bounds;
};

// ---- Tables that are turned

// Codes of ROWS rows, in SIDE columns side by side, and where the first of these is written.
struct TurnedSquares {
    static constexpr size_t SIDE = HalfTable::SIDE, ROWS = 32;

    size_t first_column;
    uint16_t* out;
};

// ---- The table

// All kernels, compiled for one instruction set.
struct Kernels {
    static constexpr size_t NEAR_COLUMNS = 16, FEW_COLUMNS = 32;

    const char* name;

    // Fills code, foot and height, which must be the arrays that `border` points to, from the rest of the
    // border. Where is_own is 0 and not -1, the code is that of a place that is not reached. If the nearest
    // place is at infinity, it fills nothing.
    NearRange (*prepare_crossing)(const BorderFromSource& border, const int8_t* is_own, int16_t* code,
                                  float* foot, float* height);

    // To columns of a table in which each place k of the border has a row, rows[k]. The winner of columns[i]
    // is the first place with the least sum of codes, and distances[i] is the way over it or, where that is
    // shorter, straightened over one of Rings::REACH segments on each side of it; infinity where there is no
    // way. winners[i], if not NULL: that place, or NO_PLACE. Each place that has a code has REACH places of
    // the border on each side, whose rows are read. Rows are read up to whole blocks behind a column. Columns
    // side by side take least time, in ascending or descending order.
    void (*cross)(const BorderFromSource& border, Rows rows, Columns columns, float* distances,
                  uint16_t* winners);

    // rows[r] is that of target r. distances[r] is read and, if it is at most range.reach and there is a way
    // over a near place, replaced, by what may be longer: by the least sum of distance and code over the near
    // places, or by a shorter way that is straightened over a near segment. Where a border is jagged, the
    // straight way does not always pass near the place with the least sum. Of a row, the codes from
    // range.begin() up to that at range.end() are read.
    void (*cross_near)(const BorderFromSource& border, const NearRange& range, Rows rows, float* distances);

    // ways[c]: the least way over a near place, or straightened over any segment that is near, to column
    // first + c of NEAR_COLUMNS columns, or infinity. rows[k] is that of place k.
    void (*cross_near_columns)(const BorderFromSource& border, const NearRange& range, Rows rows,
                               size_t first, float* ways);

    // To `count` columns from `first` on, of which there are no more than FEW_COLUMNS: ways[c] is the least
    // way over an own place, or straightened over any segment, or infinity; winners[c] is the first own place
    // with the least way over it, or NO_PLACE if there is none. Both have room for FEW_COLUMNS. rows[k] is
    // that of place k. Where few places are crossed, this takes less time than cross(), and needs nothing of
    // prepare_crossing().
    void (*cross_few)(const FewPlaces& border, Rows rows, size_t first, size_t count, float* ways,
                      uint16_t* winners);

    // Fills border.code. rows[i] belongs to the i-th sample; the last one is followed by readable codes.
    // distances[c]: the least way over a sample to column c, or straightened over a long segment where that
    // is shorter, or infinity; winners[c]: the first sample with the least way, or the first end of that
    // segment, if there is any way. Both are written in whole blocks, but winners not at all where no sample
    // is reached.
    void (*cross_samples)(const SampledBorder& border, const TableRows& rows, float* distances,
                          uint16_t* winners);

    // The least way over any place, or straightened over any segment, or infinity.
    float (*meet)(const BorderBetween& border);

    // As distance_over() has it, from many vertices at once: rows + k * row_size is the row of distances from
    // vertex k of the point's polygon. All of a row is read and written, in whole parts of NearRange.
    void (*look_out)(const FacePoint& point, const float* rows, size_t row_size, float* distances);

    // A hop down, from a border to all that lies one hop inside of it, over places and middles. It is called
    // sweep because a sweep of MSAD spends nearly all of its time there. Each kernel of it comes for one
    // source, and for FIELDS_AT_ONCE of them, which gives the same bits.

    // Fills codes, with room for whole blocks; middle_distance: scratch of the same size.
    void (*prepare_sweep)(const BorderDistances& border, const BorderCodes& codes, float* middle_distance);
    void (*prepare_sweep_each)(const BorderDistances& border, const BorderCodes& codes,
                               float* middle_distance);

    // distances[row]: the least way over any place or middle, or infinity; of each:
    // distances[row * FIELDS_AT_ONCE + source].
    void (*sweep)(const BorderDistances& border, const BorderCodes& codes, const SweepRows& rows,
                  float* distances);
    void (*sweep_each)(const BorderDistances& border, const BorderCodes& codes, const SweepRows& rows,
                       float* distances);

    // The same bits as sweep(), for rows with bounds: of each row, only the blocks of places are read that
    // may hold the least way.
    void (*sweep_bounded)(const BorderDistances& border, const BorderCodes& codes, const SweepRows& rows,
                          float* distances);

    // Writes columns as rows, `row_size` codes apart. All squares are from the same TurnedSquares::ROWS rows.
    void (*turn_squares)(const uint16_t* const* rows, std::span<const TurnedSquares> squares,
                         size_t row_size);
};

// Those that this processor can run, the fastest last. All give the same bits.
std::span<const Kernels> runnable_kernels();

}
