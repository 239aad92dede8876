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

// Codes of the middles beside one row of an inner table. segment_length is in steps of the quantum, NaN where
// there is a gap. It is filled up with gaps to whole vectors, so that up to three codes behind the row are
// written, too.
void derive_middles(const uint16_t* row, std::span<const float> segment_length, uint16_t* middles) {
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

Steps truncated(const Steps& steps) {
    return __builtin_convertvector(__builtin_convertvector(steps, FourKeys), Steps);
}

// The offsets of middles with these codes beside one row of an inner table. inverse_stride is 0 where there
// is a gap, and as long as whole vectors. No middle comes out below 0 or above the mean; one that could not
// be derived is at the mean. Whole vectors are written.
void measure_offsets(const uint16_t* row, const uint16_t* middles, std::span<const float> inverse_stride,
                     int32_t* offsets) {
    constexpr float MOST = MiddleOffset::LARGEST;
    for (size_t k = 0; k < inverse_stride.size(); k += LANES) {
        const Steps mean = truncated(0.5f * (steps_of(row + k) + steps_of(row + k + 1)) + 0.5f);
        Steps inverse;
        load(inverse_stride.data() + k, inverse);
        Steps most = truncated(mean * inverse);
        most = most < MOST ? most : Steps{} + MOST;
        Steps offset = truncated((mean - steps_of(middles + k)) * inverse + 0.5f);
        offset = offset < most ? offset : most;
        offset = offset > 0 ? offset : Steps{};
        store(__builtin_convertvector(offset, FourKeys), offsets + k);
    }
}

class MiddleTables {
public:
    explicit MiddleTables(const OverlayIndex& index) : index_(index), raiser_(index) {}

    // Those of one patch.
    void write(uint32_t patch, uint8_t* offsets) {
        measure(patch);
        const uint32_t count = index_.numbering.inner_size(patch), places = index_.rings.size(patch);
        // Middles that raise each other are derived together.
        const bool are_raised =
            patch >= index_.numbering.first_leaf() && count <= MiddleRaiser::MOST_VERTICES;
        const uint32_t together = are_raised ? count : 1;
        codes_.resize(std::max(codes_.size(), size_t{together} * places + LANES));
        for (uint32_t first = 0; first < count; first += together) {
            for (uint32_t i = 0; i < together; ++i)
                derive_middles(row(patch, first + i), length_, codes_.data() + size_t{i} * places);
            if (are_raised) raiser_.raise(patch, codes_.data());
            for (uint32_t i = 0; i < together; ++i, offsets += places) {
                measure_offsets(row(patch, first + i), codes_.data() + size_t{i} * places, inverse_stride_,
                                offsets_.data());
                for (uint32_t k = 0; k < places; ++k) offsets[k] = static_cast<uint8_t>(offsets_[k]);
            }
        }
    }

private:
    // The lengths of the segments of a ring, in steps of the quantum of its patch, and their strides.
    void measure(uint32_t patch) {
        const float* length = index_.rings.segment_length.data() + index_.rings.begin[patch];
        const size_t places = index_.rings.size(patch), whole_places = (places + LANES - 1) / LANES * LANES;
        const int16_t* const strides = index_.strides.of(patch);
        length_.assign(whole_places, Rings::GAP);
        inverse_stride_.assign(whole_places, 0);
        offsets_.resize(whole_places);
        for (size_t k = 0; k < places; ++k) {
            length_[k] = length[k] / index_.quantum[patch];
            if (strides[k] > 0) inverse_stride_[k] = 1.f / static_cast<float>(strides[k]);
        }
    }

    const uint16_t* row(uint32_t patch, uint32_t inner) const {
        return index_.hops.inner.data() + index_.inner_row(patch, inner);
    }

    const OverlayIndex& index_;
    MiddleRaiser raiser_;
    std::vector<float> length_, inverse_stride_; // per place, in whole vectors
    std::vector<uint16_t> codes_;                // only grows
    std::vector<int32_t> offsets_;               // of one row
};

}

void measure_middle_strides(OverlayIndex& index) {
    MiddleStrides& strides = index.strides;
    strides.begin.clear();
    strides.steps.clear();
    for (uint32_t p = 0; p < index.numbering.patch_count(); ++p) {
        strides.begin.push_back(strides.steps.size());
        for (uint32_t k = index.rings.begin[p]; k < index.rings.begin[p + 1]; ++k)
            strides.steps.push_back(MiddleOffset::stride(index.rings.segment_length[k], index.quantum[p]));
        strides.steps.resize(SourceCode::whole_blocks(strides.steps.size()));
    }
}

void make_middle_tables(const OverlayIndex& index, std::span<uint8_t> middles) {
    std::ranges::fill(middles.subspan(index.hops.inner_begin.back()), uint8_t{0});
    MiddleTables tables(index);
    for (uint32_t p = 1; p < index.numbering.patch_count(); ++p)
        tables.write(p, middles.data() + index.inner_row(p, 0));
}

}
