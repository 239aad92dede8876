#pragma once

#include <algorithm>
#include <memory_resource>

#include "src/overlay/fields/nearest_sources.h"
#include "src/overlay/tables/tables.h"

namespace geodesic {

// The distances of one source at a time from the vertices of a border that several sources may be near to, so
// that each source crosses the border by itself. The object is used for one border after the other.
class OwnDistances {
public:
    OwnDistances(const OverlayIndex& index, std::pmr::memory_resource* memory)
        : index_(index), sources_(memory), last_way_(memory), ways_(memory), own_(memory),
          keys_(index.numbering.vertex_count()) {}

    // Sources have keys below this number, which is that of vertices at first.
    void set_keys(uint32_t count) { keys_ = count; }

    // Calls hop(distances, source) for each source that may be the nearest one somewhere on a patch's border,
    // if is_wanted(source). distances[number], without offset(source), is infinite where the distance from
    // that source is not known. `least` are the distances from the nearest sources, by number.
    template <class Offset, class IsWanted, class Hop>
    void for_each_source(uint32_t patch, const NearestSources& nearest, float* least, const Offset& offset,
                         const IsWanted& is_wanted, const Hop& hop) {
        if (const uint32_t only = only_source(patch, nearest); only != NONE && offset(only) == 0) {
            if (is_wanted(only)) hop(least, only);
            return;
        }
        collect(patch, nearest);
        for (const uint32_t source : sources_) {
            if (!is_wanted(source)) continue;
            const float of_source = offset(source);
            const uint32_t last = last_way_[source];
            for (uint32_t w = last; w != FIRST; w = ways_[w].before)
                own_[ways_[w].border_vertex] = std::max(ways_[w].distance - of_source, 0.f);
            hop(own_.data(), source);
            for (uint32_t w = last; w != FIRST; w = ways_[w].before) own_[ways_[w].border_vertex] = INFINITE;
        }
    }

private:
    struct Way {
        uint32_t border_vertex;
        float distance;
        uint32_t before; // the way from the same source that was found before, or FIRST
    };
    static constexpr uint32_t FIRST = NONE - 1;

    uint32_t only_source(uint32_t patch, const NearestSources& nearest) const;
    void forget();
    void collect(uint32_t patch, const NearestSources& nearest);

    const OverlayIndex& index_;
    Array<uint32_t> sources_;  // those that may be the nearest one
    Array<uint32_t> last_way_; // by key: the last way of such a source, NONE of all others
    Array<Way> ways_;          // from all of these sources
    Array<float> own_;         // by number: distances of the source that crosses, infinite elsewhere
    uint32_t keys_;
};

}
