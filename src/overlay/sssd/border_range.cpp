#include "src/overlay/sssd/border_range.h"

#include <algorithm>

namespace geodesic {

namespace {

// A range has so many places on each side of where a way is expected to cross.
constexpr uint32_t EACH_SIDE = 5;

// So many places on each side of one, as far as the ring goes.
BorderRange range_about(const OverlayIndex& index, uint32_t patch, uint32_t place, uint32_t each_side) {
    const BorderRange whole = whole_border(index, patch);
    return {place - std::min(each_side, place - whole.first),
            place + std::min(each_side, whole.last - place)};
}

}

BorderRange whole_border(const OverlayIndex& index, uint32_t patch) {
    return {index.rings.begin[patch], index.rings.begin[patch + 1] - 1};
}

BorderRange range_within(const OverlayIndex& index, uint32_t patch, std::span<const float> values,
                         float limit) {
    const auto places = index.pairs.samples.of(patch);
    BorderRange range = whole_border(index, patch);
    const uint32_t ring = range.first;
    const auto is_within = [&](float value) { return value <= limit; };
    const auto first = std::ranges::find_if(values, is_within) - values.begin();
    if (first == std::ssize(values)) return range;
    const auto last = values.rend() - std::ranges::find_if(values.rbegin(), values.rend(), is_within) - 1;
    if (first > 0) range.first = ring + places[static_cast<size_t>(first - 1)];
    if (last + 1 < std::ssize(places)) range.last = ring + places[static_cast<size_t>(last + 1)];
    return range;
}

// A parabola through the three lengths has its lowest point where the shortest way is expected.
BorderRange range_near(const OverlayIndex& index, uint32_t patch, uint32_t sample,
                       const WaysNearSample& ways) {
    const auto places = index.pairs.samples.of(patch);
    const float before = ways.over_previous - ways.over_sample, after = ways.over_next - ways.over_sample;
    auto place = static_cast<float>(places[sample]);
    if (sample > 0 && sample + 1 < places.size() && before + after < INFINITE && before + after > 0) {
        const float share = std::clamp((before - after) / (2 * (before + after)), -0.5f, 0.5f);
        place += share * static_cast<float>(share > 0 ? places[sample + 1] - places[sample]
                                                      : places[sample] - places[sample - 1]);
    }
    return range_about(index, patch, index.rings.begin[patch] + static_cast<uint32_t>(place + 0.5f),
                       EACH_SIDE);
}

BorderRange range_beside(const OverlayIndex& index, uint32_t patch, BorderRange range, uint32_t place) {
    const BorderRange whole = whole_border(index, patch);
    const uint32_t each_side = std::max(EACH_SIDE, range.size() / 2);
    const uint32_t own = own_place(index.rings, index.numbering, patch, index.rings.position[place]);
    if (own < range.first || own > range.last) return range_about(index, patch, own, each_side);
    const auto chain = *std::ranges::lower_bound(index.rings.chains_of(patch), own, {}, &Rings::Chain::last);
    if (chain.is_closed && own == chain.first && range.last < chain.last)
        return range_about(index, patch, chain.last, each_side);
    if (chain.is_closed && own == chain.last && range.first > chain.first)
        return range_about(index, patch, chain.first, each_side);
    const bool is_at_end = (own < range.first + Rings::REACH && range.first > whole.first) ||
                           (own + Rings::REACH > range.last && range.last < whole.last);
    return is_at_end ? range_about(index, patch, own, each_side) : range;
}

}
