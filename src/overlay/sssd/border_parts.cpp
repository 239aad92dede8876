#include "src/overlay/sssd/border_parts.h"

#include <algorithm>

namespace geodesic {

namespace {

// A part has so many places on each side of where a way is expected to cross.
constexpr uint32_t EACH_SIDE = 5;

// A chain with the places that repeat its vertices.
BorderRange with_repeated(const Rings::Chain& chain) {
    return {chain.first - Rings::REACH, chain.last + Rings::REACH};
}

// A part with all bridges of its border, which may lead on from any place.
BorderPart with_bridges(const OverlayIndex& index, uint32_t patch, BorderPart part) {
    part.add({index.rings.bridges_begin(patch), whole_border(index.rings, patch).last});
    return part;
}

// So many places on each side of a vertex's own: around a closed chain, and otherwise as far as the ring
// goes.
BorderPart places_about(const OverlayIndex& index, uint32_t patch, uint32_t own, uint32_t each_side) {
    const BorderRange whole = whole_border(index.rings, patch);
    const BorderRange about{own - std::min(each_side, own - whole.first),
                            own + std::min(each_side, whole.last - own)};
    const Rings::Chain& chain = index.rings.chain_at(patch, own);
    const uint32_t before = own - chain.first, behind = chain.last - own;
    if (!chain.is_closed || (before >= each_side && behind >= each_side)) return BorderPart(about);
    const BorderRange all = with_repeated(chain);
    if (before + behind <= 2 * each_side) return BorderPart(all);
    BorderPart part({all.first, before < each_side ? own + each_side : chain.first + each_side - behind - 1});
    part.add({before < each_side ? chain.last + 1 + before - each_side : own - each_side, all.last});
    return part;
}

// These places, with all bridges.
BorderPart part_about(const OverlayIndex& index, uint32_t patch, uint32_t own, uint32_t each_side) {
    return with_bridges(index, patch, places_about(index, patch, own, each_side));
}

}

// Along a border, the way over a place gets shorter by no more than twice the way along the border. So
// between two samples, none is shorter than the mean of both ways less the piece of the border between them,
// as far as this border goes. The limit leaves room for a piece of MOST_LONGER spacings, here or elsewhere.
BorderPart part_within(const OverlayIndex& index, uint32_t patch, std::span<const float> lengths,
                       float limit) {
    const Samples& samples = index.pairs.samples;
    const auto places = samples.of(patch);
    const float* const excess = samples.excess.data() + samples.begin[patch];
    const uint32_t ring = index.rings.begin[patch];
    BorderPart part;
    const auto add = [&](uint32_t first, uint32_t last) { part.add({first, last}); };
    // Without branches, which would be taken and not taken at random.
    const auto is_piece_within = [&](uint32_t sample, uint32_t next) {
        const float a = lengths[sample], b = lengths[next];
        return (int{a <= limit} | int{b <= limit} | int{0.5f * (a + b) <= limit + excess[sample]}) != 0;
    };
    const auto add_of_chain = [&](const Rings::Chain& chain, uint32_t first, uint32_t last) {
        const BorderRange all = with_repeated(chain);
        const auto is_end_within = [&](uint32_t end) {
            return chain.is_closed ? is_piece_within(last, first) : lengths[end] <= limit;
        };
        uint32_t begin = is_end_within(first) ? all.first : NONE;
        for (uint32_t i = first; i < last; ++i) {
            const bool is_within = is_piece_within(i, i + 1);
            if (is_within == (begin != NONE)) continue;
            if (!is_within) add(begin, ring + places[i]);
            begin = is_within ? ring + places[i] : NONE;
        }
        if (is_end_within(last) && begin == NONE) begin = ring + places[last];
        if (begin != NONE) add(begin, is_end_within(last) ? all.last : ring + places[last]);
    };
    for_each_chain_of_samples(index.rings, samples, patch, add_of_chain);
    return part.size() > 0 ? with_bridges(index, patch, part) : BorderPart(whole_border(index.rings, patch));
}

// A parabola through the three lengths has its lowest point where the shortest way is expected. Between two
// samples of a chain all places are own ones.
BorderPart part_near(const OverlayIndex& index, uint32_t patch, const WaysNearSample& ways) {
    const auto places = index.pairs.samples.of(patch);
    const auto [sample, beside, over_previous, over_sample, over_next] = ways;
    const float before = over_previous - over_sample, after = over_next - over_sample;
    auto place = static_cast<float>(places[sample]);
    // In the ring's order; so is a sample without one before it, whose number is NONE.
    const bool is_around_an_end = beside.previous > sample || beside.next < sample;
    if (!is_around_an_end && before + after < INFINITE && before + after > 0) {
        const float share = std::clamp(0.5f * ((before - after) / (before + after)), -0.5f, 0.5f);
        place += share * static_cast<float>(share > 0 ? places[beside.next] - places[sample]
                                                      : places[sample] - places[beside.previous]);
    }
    return part_about(index, patch, index.rings.begin[patch] + static_cast<uint32_t>(place + 0.5f),
                      EACH_SIDE);
}

BorderPart part_beside(const OverlayIndex& index, uint32_t patch, const BorderPart& part, uint32_t place) {
    const auto is_well_inside = [&](const BorderRange& range) {
        return place >= range.first + Rings::REACH && place + Rings::REACH <= range.last;
    };
    if (index.rings.is_own[place] && std::ranges::any_of(part.ranges(), is_well_inside)) return part;
    const uint32_t own = own_place(index.rings, index.numbering, patch, index.rings.position[place]);
    if (part.covers(part_about(index, patch, own, Rings::REACH))) return part;
    const uint32_t on_each_side = std::max(EACH_SIDE, places_of_chains(index.rings, patch, part) / 2);
    return part_about(index, patch, own, on_each_side);
}

}
