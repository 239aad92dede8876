#pragma once

#include <algorithm>
#include <memory_resource>
#include <span>

#include "src/overlay/border_field.h"
#include "src/overlay/tables.h"

namespace geodesic {

// A border vertex close to a source, and its distance from that source, even if another source is nearer to
// it.
struct NearVertex {
    uint32_t source, border_vertex;
    float distance;
};

// The border vertices close to each of several sources. With these, a source can cross a border straight
// although some of the border's vertices are nearer to other sources.
class NearSources {
public:
    NearSources(const OverlayIndex& index, std::pmr::memory_resource* memory);

    // Forgets all vertices. Call it before the first add(), too.
    void clear();
    // Adds a vertex to those borders on which it lies within the near radius of its source. `nearest` is an
    // upper bound of the vertex's least distance from any source. A source that is more than two segment
    // lengths farther from the vertex than that is skipped: the nearest source is nearer to both ends of any
    // segment that the skipped one's path could cross there.
    void add(const NearVertex& vertex, float nearest) {
        if (vertex.distance <= longest_reach_) add_near(vertex, nearest);
    }

    // Appends the vertices that were added to the border of a patch.
    void collect(uint32_t patch, Array<NearVertex>& vertices) const;

private:
    struct Link {
        NearVertex vertex;
        uint32_t next; // index of the next link of the same border, or NONE
    };

    void add_near(const NearVertex& vertex, float nearest);

    const OverlayIndex& index_;
    const Numbering& numbering_;
    float longest_reach_ = 0;
    Array<Link> links_;
    Array<uint32_t> first_link_; // per patch: index of the first link of its border, or NONE
};

// Lets single sources cross a border that they are close to.
class NearCrossing {
public:
    NearCrossing(const OverlayIndex& index, size_t most_rows, std::pmr::memory_resource* memory);

    // Takes the memory that cross() needs. Call it before the first one.
    void reserve() { own_.resize(numbering_.border_vertex_count(), INFINITE); }

    // The vertices that a hop leads to, and for each of them the least distance so far and the source that it
    // is from.
    struct Ways {
        HopTargets targets;
        std::span<float> distance;
        uint32_t* source;
    };

    // Lowers the distances by ways from each of these vertices' sources over near segments of the patch's
    // border, on which the vertices lie. Sorts `vertices` by their sources, and skips a source which is
    // nearest to none of them; nearest_source is by number. Calls found(source, row, distance) for every way
    // that is near, whether it is shorter or not.
    template <class Found>
    void cross(uint32_t patch, Array<NearVertex>& vertices, const Ways& ways, const uint32_t* nearest_source,
               const Found& found) {
        std::ranges::sort(vertices, {}, &NearVertex::source);
        for (std::span<const NearVertex> left = vertices; !left.empty();) {
            const uint32_t source = left.front().source;
            const auto count = static_cast<size_t>(
                std::ranges::upper_bound(left, source, {}, &NearVertex::source) - left.begin());
            const auto of_source = left.first(count);
            left = left.subspan(count);
            if (std::ranges::none_of(of_source, [&](const NearVertex& v) {
                    return nearest_source[v.border_vertex] == source;
                }))
                continue;
            cross_from_one(patch, of_source, ways);
            for (size_t r = 0; r < ways.distance.size(); ++r) {
                if (!(way_[r] < INFINITE)) continue;
                found(source, r, way_[r]);
                if (way_[r] >= ways.distance[r]) continue;
                ways.distance[r] = way_[r];
                ways.source[r] = source;
            }
        }
    }

private:
    void cross_from_one(uint32_t patch, std::span<const NearVertex> vertices, const Ways& ways);

    const OverlayIndex& index_;
    const Numbering& numbering_;
    BorderField field_;
    Array<float> own_; // by number: distance from the current source; infinite in between
    Array<float> way_; // per row: the way from the current source
};

}
