#include "src/overlay/prepare/middles.h"

#include <algorithm>
#include <vector>

#include "src/overlay/kernels/lanes.h"
#include "src/overlay/kernels/unfolding.h"
#include "src/overlay/prepare/raised_middles.h"

namespace geodesic {

namespace {

constexpr size_t LANES = 4; // so many middles are computed at once

using Steps = Floats<LANES * sizeof(float)>;
using Codes = VectorOf<uint16_t, LANES * sizeof(uint16_t)>::Type;

Steps steps_of(const uint16_t* first) {
    Codes codes;
    load(first, codes);
    return __builtin_convertvector(__builtin_convertvector(codes, FourKeys), Steps);
}

void write_codes(const Steps& steps, uint16_t* first) {
    const FourKeys rounded = __builtin_convertvector(steps + 0.5f, FourKeys);
    store(__builtin_convertvector(rounded, Codes), first);
}

// Writes the codes of the middles beside one row of an inner table. segment_length is in steps of the
// quantum, NaN where there is a gap. It is filled up with gaps to whole vectors, so that up to three codes
// behind the row are written, too.
void add_middles(const uint16_t* row, std::span<const float> segment_length, uint16_t* middles) {
    // Its square has this root exactly.
    const Steps unreached = Steps{} + float{TableCode::UNREACHED};
    for (size_t k = 0; k < segment_length.size(); k += LANES) {
        const Steps from_first = steps_of(row + k), from_second = steps_of(row + k + 1);
        Steps length, square;
        load(segment_length.data() + k, length);
        middle_square(from_first, from_second, length, square);
        square = from_first < unreached ? square : unreached * unreached;
        square = from_second < unreached ? square : unreached * unreached;
        square = square >= 0 ? square : unreached * unreached; // NaN where there is no middle
        take_square_root(square);
        write_codes(square, middles + k);
    }
}

// The lengths of the segments of a ring, in steps of the quantum of its patch.
void measure_in_steps(const OverlayIndex& index, uint32_t patch, std::vector<float>& length) {
    const float* first = index.rings.segment_length.data() + index.rings.begin[patch];
    const size_t places = index.rings.size(patch);
    length.assign((places + LANES - 1) / LANES * LANES, Rings::GAP);
    for (size_t k = 0; k < places; ++k) length[k] = first[k] / index.quantum[patch];
}

}

// Rows are written one after the other: what is written behind one is overwritten by the next, or is padding.
void make_middle_tables(const OverlayIndex& index, std::span<uint16_t> middles) {
    static_assert(TableCode::PADDING > LANES);
    std::ranges::fill(middles.subspan(index.hops.inner_begin.back()), TableCode::UNREACHED);
    std::vector<float> length;
    MiddleRaiser raiser(index);
    for (uint32_t p = 1; p < index.numbering.patch_count(); ++p) {
        measure_in_steps(index, p, length);
        for (uint32_t i = 0; i < index.numbering.inner_size(p); ++i)
            add_middles(index.hops.inner.data() + index.inner_row(p, i), length,
                        middles.data() + index.inner_row(p, i));
        if (p >= index.numbering.first_leaf()) raiser.raise(p, middles.data() + index.inner_row(p, 0));
    }
}

}
