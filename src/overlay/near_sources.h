#pragma once

#include <limits>
#include <span>

#include "src/overlay/border_field.h"
#include "src/overlay/tables.h"

namespace geodesic {

// A border vertex next to a source, and that source's own distance to it, whichever source it is nearest to.
struct NearVertex {
    uint32_t source, border_vertex;
    float distance;
};

// Those of several sources: what it takes to cross a border straight where its vertices are partly nearer to
// others.
class NearSources {
public:
    NearSources(const OverlayIndex& index, std::pmr::memory_resource* memory);

    void clear();
    // To the borders that it lies on and is near to; `nearest`: the vertex's distance from any source, so
    // far. What is farther by two segments is left out: where it crosses one, another source is nearer to
    // both ends.
    void add(const NearVertex& vertex, float nearest) {
        if (vertex.distance <= longest_reach_) add_near(vertex, nearest);
    }

    // Appends what lies on the border of a patch.
    void collect(uint32_t patch, Array<NearVertex>& vertices) const;

private:
    struct Entry {
        NearVertex vertex;
        uint32_t next; // on the same border
    };

    void add_near(const NearVertex& vertex, float nearest);

    const OverlayIndex& index_;
    const Numbering& numbering_;
    float longest_reach_ = 0;
    Array<Entry> entries_;
    Array<uint32_t> first_entry_; // per patch
};

// The crossings of borders by single sources that are near.
class NearCrossing {
public:
    NearCrossing(const OverlayIndex& index, size_t most_rows, std::pmr::memory_resource* memory);

    void reserve() { own_.resize(numbering_.border_vertex_count(), INFINITE); }

    // Rows of a patch, and the least distances of any source so far.
    struct Targets {
        Rows rows;
        float quantum;
        float* distance;
        uint32_t* source;
    };

    // After reserve(). Lowers the distances over near segments of the patch's border, on which these lie;
    // found(source, row, distance) for every distance that is near, lower or not.
    template <class Found>
    void cross(uint32_t patch, Array<NearVertex>& vertices, const Targets& targets,
               const uint32_t* nearest_source, const Found& found) {
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
            cross_from_one(patch, of_source, targets);
            for (size_t r = 0; r < targets.rows.size(); ++r) {
                if (!(way_[r] < INFINITE)) continue;
                found(source, r, way_[r]);
                if (way_[r] >= targets.distance[r]) continue;
                targets.distance[r] = way_[r];
                targets.source[r] = source;
            }
        }
    }

private:
    void cross_from_one(uint32_t patch, std::span<const NearVertex> vertices, const Targets& targets);

    const OverlayIndex& index_;
    const Numbering& numbering_;
    BorderField field_;
    Array<float> own_; // by number: of the source at hand, otherwise infinite
    Array<float> way_; // per row
};

}
