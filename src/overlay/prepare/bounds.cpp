#include "src/overlay/prepare/bounds.h"

#include <algorithm>
#include <span>

namespace geodesic {

namespace {

// The bounds of one row.
void bound_row(const uint16_t* codes, const uint8_t* middles, std::span<const int16_t> strides,
               uint16_t* bounds) {
    const size_t places = strides.size();
    for (size_t first = 0; first < places; first += InnerBounds::PLACES) {
        uint16_t least = TableCode::UNREACHED;
        for (size_t k = first; k < std::min(first + InnerBounds::PLACES, places); ++k) {
            least = std::min(least, codes[k]);
            if (strides[k] > 0) // not a gap
                least = std::min(least, MiddleOffset::code(codes[k], codes[k + 1], middles[k], strides[k]));
        }
        *bounds++ = least;
    }
}

uint64_t bounds_of_patch(const OverlayIndex& index, uint32_t patch) {
    const uint32_t places = index.rings.size(patch);
    if (!InnerBounds::are_kept(places)) return 0;
    return InnerBounds::blocks(places) * uint64_t{index.numbering.inner_size(patch)};
}

}

void make_inner_bounds(OverlayIndex& index) {
    InnerBounds& bounds = index.bounds;
    const uint32_t patches = index.numbering.patch_count();
    bounds.begin.assign(1, 0);
    for (uint32_t p = 0; p < patches; ++p)
        bounds.begin.push_back(bounds.begin.back() + bounds_of_patch(index, p));
    bounds.codes.resize(bounds.begin.back());
    for (uint32_t p = 0; p < patches; ++p) {
        const size_t places = index.rings.size(p);
        if (!InnerBounds::are_kept(places)) continue;
        uint16_t* of_row = bounds.codes.data() + bounds.begin[p];
        for (uint32_t i = 0; i < index.numbering.inner_size(p); ++i, of_row += InnerBounds::blocks(places)) {
            const uint64_t row = index.inner_row(p, i);
            bound_row(index.hops.inner.data() + row, index.hops.inner_middles.data() + row,
                      {index.strides.of(p), places}, of_row);
        }
    }
}

uint64_t count_bound_codes(const OverlayIndex& index) {
    uint64_t codes = 0;
    for (uint32_t p = 0; p < index.numbering.patch_count(); ++p) codes += bounds_of_patch(index, p);
    return codes;
}

}
