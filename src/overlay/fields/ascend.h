#pragma once

#include <algorithm>
#include <cstdint>
#include <span>

#include "src/overlay/fields/point_ways.h"
#include "src/overlay/tables/tables.h"

namespace geodesic {

// Calls function(number, distance) for every vertex in the overlay of an inner patch, with its distance from
// the vertex at this overlay position. That vertex itself is among them.
template <class Function>
void for_each_in_overlay(const OverlayIndex& index, uint32_t patch, uint32_t position,
                         const Function& function) {
    for (uint32_t i = 0; i < index.numbering.overlay_size(patch); ++i)
        function(index.numbering.overlay_number(patch, i),
                 index.distance(index.overlay_code(patch, i, position), patch));
}

// Calls function(number, distance) for the source itself and for every vertex whose distance from it is an
// entry of the tables of the patch that the source is an inner vertex of: the patch's border and its other
// inner vertices.
template <class Function>
void for_each_way_from(const OverlayIndex& index, uint32_t source, const Function& function) {
    const Numbering& numbering = index.numbering;
    if (numbering.is_border(source)) {
        for_each_in_overlay(index, numbering.owner[source], numbering.position_at_owner(source), function);
        return;
    }
    const uint32_t leaf = numbering.leaf_of(source), first = numbering.first_internal(leaf),
                   own = source - first;
    const auto border = numbering.border_of(leaf);
    for (uint32_t i = 0; i < border.size(); ++i)
        function(border[i], index.distance(index.border_internal_code(leaf, i, own), leaf));
    for (uint32_t i = 0; i < numbering.internal_size(leaf); ++i)
        function(first + i, i == own ? 0 : index.distance(index.internal_code(leaf, own, i), leaf));
}

// The same within the leaves alone that the vertex is in or on the border of: to their borders and internal
// vertices.
template <class Function>
void for_each_way_in_leaves(const OverlayIndex& index, uint32_t source, const Function& function) {
    const Numbering& numbering = index.numbering;
    if (!numbering.is_border(source)) return for_each_way_from(index, source, function);
    for (const auto& [leaf, position] : numbering.borders_of(source)) {
        if (leaf < numbering.first_leaf()) continue;
        const auto in_parent = numbering.positions_in_parent(leaf);
        const auto border = numbering.border_of(leaf);
        const uint32_t parent = numbering.parent[leaf], first = numbering.first_internal(leaf);
        for (uint32_t i = 0; i < border.size(); ++i)
            function(border[i],
                     index.distance(index.overlay_code(parent, in_parent[position], in_parent[i]), parent));
        for (uint32_t i = 0; i < numbering.internal_size(leaf); ++i)
            function(first + i, index.distance(index.border_internal_code(leaf, position, i), leaf));
    }
}

// Without the offset: to the vertices of the leaf of a point of a face, and to those of the leaves of each
// vertex that it sees beyond its polygon, over that. What was measured counts instead of what tables say of
// the latter.
template <class Function>
void for_each_way_from(const OverlayIndex& index, const PointWays& point, const Function& function) {
    if (point.vertex != NONE) return for_each_way_from(index, point.vertex, function);
    const auto border = index.numbering.border_of(point.leaf);
    for (size_t i = 0; i < border.size(); ++i) function(border[i], point.distance[i]);
    uint32_t number = index.numbering.first_internal(point.leaf);
    for (size_t i = border.size(); i < point.distance.size(); ++i) function(number++, point.distance[i]);
    for (const PointWays::Beyond& seen : point.beyond)
        for_each_way_in_leaves(index, seen.number, [&](uint32_t other, float distance) {
            const float* const measured = index.measured.distance(seen.number, other);
            function(other, seen.distance + (measured ? *measured : distance));
        });
}

// The sources of a sweep, each with a key: that of a vertex is its number, and those of points follow the
// numbers of all vertices, as do those of vertices whose fields begin with an offset.
struct Sources {
    std::span<const uint32_t> keys;
    std::span<const PointWays> points{};

    // The vertex that a source is, or NONE.
    uint32_t vertex(const Numbering& numbering, uint32_t key) const {
        const uint32_t vertices = numbering.vertex_count();
        return key < vertices ? key : points[key - vertices].vertex;
    }
    float offset(const Numbering& numbering, uint32_t key) const {
        const uint32_t vertices = numbering.vertex_count();
        return key < vertices ? 0 : points[key - vertices].offset;
    }
    uint32_t innermost_patch(const Numbering& numbering, uint32_t key) const {
        const uint32_t at = vertex(numbering, key);
        return at != NONE ? numbering.innermost_patch(at) : points[key - numbering.vertex_count()].leaf;
    }
    template <class Function>
    void for_each_way(const OverlayIndex& index, uint32_t key, const Function& function) const {
        const uint32_t vertices = index.numbering.vertex_count();
        if (key < vertices)
            for_each_way_from(index, key, function);
        else
            for_each_way_from(index, points[key - vertices], function);
    }
    // Calls use(way) for those of some vertices whose distances from a source are known besides what tables
    // say: measured ones of a vertex, and the ways that are known from a point. Without the offset.
    template <class Use>
    void for_each_known(const OverlayIndex& index, uint32_t key, uint32_t first, uint32_t end,
                        const Use& use) const {
        const uint32_t at = vertex(index.numbering, key);
        if (at != NONE) {
            for (const auto& [number, measured] : index.measured.of(at, first, end))
                use(KnownWay{number, measured, measured});
            return;
        }
        const auto known = points[key - index.numbering.vertex_count()].known;
        const auto begin = std::ranges::lower_bound(known, first, {}, &KnownWay::number);
        for (const KnownWay& way : std::span(begin, known.end())) {
            if (way.number >= end) return;
            use(way);
        }
    }
};

// Counts how many sources lie inside of each patch. The whole mesh, patch 0, has all of them.
inline void count_sources(const Numbering& numbering, const Sources& sources,
                          Array<uint32_t>& sources_inside) {
    sources_inside.assign(numbering.patch_count(), 0);
    for (const uint32_t key : sources.keys)
        for (uint32_t p = sources.innermost_patch(numbering, key); p != NONE; p = numbering.parent[p])
            ++sources_inside[p];
}

// The way up: calls hop(patch) for all patches with sources inside but the whole mesh, children before
// parents. A hop leads from the border of the patch to the overlay of its parent. Distances to the overlays
// of the patches in which the sources are inner vertices (see for_each_way_from) must be known before;
// afterwards those to the overlays of all patches with sources inside are.
template <class Hop>
void ascend(const Numbering& numbering, std::span<const uint32_t> sources_inside, const Hop& hop) {
    for (uint32_t p = numbering.patch_count() - 1; p > 0; --p)
        if (sources_inside[p] > 0) hop(p);
}

}
