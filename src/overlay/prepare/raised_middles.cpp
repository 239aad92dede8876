#include "src/overlay/prepare/raised_middles.h"

#include <algorithm>

#include "src/base/four_at_a_time.h"
#include "src/overlay/kernels/lanes.h"

namespace geodesic {

namespace {

constexpr size_t CODES_AT_ONCE = 8; // all codes are below 2^15

using SignedCodes = VectorOf<int16_t, CODES_AT_ONCE * sizeof(int16_t)>::Type;

// The largest whole number of steps that is not more, if that is a code.
uint16_t whole_steps(float steps) {
    return static_cast<uint16_t>(steps < TableCode::LARGEST ? steps : float{TableCode::LARGEST});
}

// By how much the distances of two vertices from one middle may differ. A middle may also be derived a little
// too long, and then differs more than the vertices are apart: a share of 1/25 of that is let pass, so that
// hardly any such middle raises right ones.
uint16_t allowed_difference(uint16_t code) {
    return static_cast<uint16_t>(std::min(code + code / 25, int{TableCode::LARGEST}));
}

}

void MiddleRaiser::raise(uint32_t leaf, uint16_t* middles) {
    middles_ = middles;
    count_ = index_.numbering.internal_size(leaf);
    places_ = index_.rings.size(leaf);
    whole_places_ = (places_ + CODES_AT_ONCE - 1) / CODES_AT_ONCE * CODES_AT_ONCE;
    copy_derived();
    // Only near vertices raise each other. Middles are derived too short by a part of a segment, which the
    // share that is let pass between vertices farther apart would cover.
    const uint16_t near_up_to = whole_steps(index_.longest_segment[leaf] / index_.quantum[leaf]);
    const uint16_t* apart = index_.hops.internal.data() + index_.numbering.internal_entry(leaf, 1, 0);
    for (size_t i = 1; i < count_; apart += i++)
        for (const uint32_t j : find_near(apart, i, near_up_to)) compare(i, j, allowed_difference(apart[j]));
}

void MiddleRaiser::copy_derived() {
    derived_.resize(std::max(derived_.size(), count_ * whole_places_));
    for (size_t i = 0; i < count_; ++i) {
        uint16_t* const copy = derived_.data() + i * whole_places_;
        std::transform(row(i), row(i) + places_, copy,
                       [](uint16_t code) { return code == TableCode::UNREACHED ? 0 : code; });
        std::fill(copy + places_, copy + whole_places_, uint16_t{0});
    }
}

// The positions of codes that are at most `most`. Each position is written, and the next one over it unless
// its code counts: a branch would often be mispredicted.
std::span<const uint32_t> MiddleRaiser::find_near(const uint16_t* codes, size_t count, uint16_t most) {
    near_.resize(std::max(near_.size(), count));
    uint32_t* const first = near_.data();
    size_t end = 0;
    four_at_a_time(count, [&](size_t j) {
        first[end] = static_cast<uint32_t>(j);
        end += codes[j] <= most;
    });
    return {first, end};
}

void MiddleRaiser::compare(size_t i, size_t j, uint16_t allowed) {
    if (!differ(i, j, allowed)) return;
    raise_row(i, derived(j), allowed);
    raise_row(j, derived(i), allowed);
}

// Whether two rows differ by more than so much in any place.
bool MiddleRaiser::differ(size_t i, size_t j, uint16_t allowed) const {
    const uint16_t *first = derived(i), *second = derived(j);
    SignedCodes largest{};
    for (size_t k = 0; k < whole_places_; k += CODES_AT_ONCE) {
        SignedCodes of_first, of_second;
        load(first + k, of_first);
        load(second + k, of_second);
        const SignedCodes difference = of_first - of_second, opposite = of_second - of_first;
        largest = largest > difference ? largest : difference;
        largest = largest > opposite ? largest : opposite;
    }
    return any<SignedCodes>(largest > static_cast<int16_t>(allowed));
}

void MiddleRaiser::raise_row(size_t i, const uint16_t* by, uint16_t allowed) {
    for (size_t k = 0; k < places_; ++k)
        row(i)[k] = static_cast<uint16_t>(std::max(int{row(i)[k]}, by[k] - allowed));
}

}
