#pragma once

#include <algorithm>
#include <memory_resource>
#include <span>

#include "src/overlay/tables.h"

namespace geodesic {

// Of several sources, the nearest ones to each border vertex, and how far away each of them is. The nearest
// one alone would do for sums of distances. The others are for paths that cross a border between two vertices
// whose nearest sources differ: to place a source in the plane of a segment takes its distances from both
// ends.
class NearestSources {
public:
    struct Way {
        float distance;
        uint32_t source;
    };

    NearestSources(const Numbering& numbering, std::pmr::memory_resource* memory)
        : numbering_(numbering), count_(memory), ways_(memory) {}

    // Forgets all ways. Call it before the first add(), too.
    void clear() {
        count_.assign(numbering_.border_vertex_count(), 0);
        ways_.resize(count_.size() * MOST);
    }

    // Only one thread at a time may add ways to the same vertex. The order of calls changes nothing.
    void add(uint32_t border_vertex, const Way& way) {
        Way* const ways = ways_.data() + border_vertex * MOST;
        uint8_t& count = count_[border_vertex];
        if (count == MOST && is_before(ways[MOST - 1], way)) return;
        Way* place = std::ranges::find(ways, ways + count, way.source, &Way::source);
        if (place == ways + MOST)
            --place;
        else if (place == ways + count)
            ++count;
        else if (place->distance <= way.distance)
            return;
        for (; place != ways && is_before(way, *(place - 1)); --place) *place = *(place - 1);
        *place = way;
    }

    // The nearest source first; none if no source reaches the vertex.
    std::span<const Way> of(uint32_t border_vertex) const {
        return {ways_.data() + border_vertex * MOST, count_[border_vertex]};
    }
    uint32_t nearest(uint32_t border_vertex) const {
        return of(border_vertex).empty() ? NONE : of(border_vertex).front().source;
    }

private:
    // So many sources of a vertex are kept at most.
    static constexpr size_t MOST = 32;

    static bool is_before(const Way& a, const Way& b) {
        return a.distance < b.distance || (a.distance == b.distance && a.source < b.source);
    }

    const Numbering& numbering_;
    Array<uint8_t> count_; // by number: of ways
    Array<Way> ways_;      // by number, MOST each, in ascending order
};

}
