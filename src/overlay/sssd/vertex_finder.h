#pragma once

#include <algorithm>
#include <cstdint>
#include <span>

#include "src/overlay/hops/border_part.h"

namespace geodesic {

// Finds vertices of one border in a part of another, one after the other. Where two borders have a piece in
// common, one goes along the other, to and fro.
class VertexFinder {
public:
    VertexFinder(const Rings& rings, const BorderPart& part) : rings_(rings), part_(part) {}

    // Where the vertex is: the index in the part, and the place; both NONE if it is not there.
    struct Found {
        uint32_t index, place;
    };
    Found find(uint32_t vertex) {
        for (const uint32_t beside : {last_ + 1, last_ - 1})
            if (beside >= range_.first && beside <= range_.last && rings_.vertex[beside] == vertex)
                return found(beside);
        index_of_range_ = 0;
        for (const BorderRange& range : part_.ranges()) {
            const auto places = std::span(rings_.vertex).subspan(range.first, range.size());
            range_ = range;
            if (const auto at = std::ranges::find(places, vertex); at != places.end())
                return found(range.first + static_cast<uint32_t>(at - places.begin()));
            index_of_range_ += range.size();
        }
        range_ = NOWHERE;
        return {NONE, NONE};
    }

private:
    static constexpr BorderRange NOWHERE{1, 0};

    Found found(uint32_t place) {
        last_ = place;
        return {index_of_range_ + place - range_.first, place};
    }

    const Rings& rings_;
    const BorderPart& part_;
    BorderRange range_ = NOWHERE; // where a vertex was found,
    uint32_t index_of_range_ = 0; // the index of its first place,
    uint32_t last_ = 0;           // and the place of the vertex
};

}
