#pragma once

#include <algorithm>
#include <limits>
#include <queue>
#include <vector>

#include "src/graph/tables.h"

// The answers that the tables of an index allow, computed from them in double without any of the shortcuts of
// src/graph: no shared queue, no A*, no skipped rows, no derived slots.
namespace geodesic::test {

inline constexpr double FAR = std::numeric_limits<double>::infinity();

struct Arc {
    uint32_t to;
    double length;
};
using Arcs = std::vector<std::vector<Arc>>; // by vertex number

inline void relax(const Arcs& arcs, std::vector<double>& distance) {
    using Entry = std::pair<double, uint32_t>;
    std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue;
    for (uint32_t v = 0; v < distance.size(); ++v)
        if (distance[v] < FAR) queue.push({distance[v], v});
    while (!queue.empty()) {
        const auto [d, v] = queue.top();
        queue.pop();
        if (d > distance[v]) continue;
        for (const Arc& arc : arcs[v])
            if (d + arc.length < distance[arc.to]) {
                distance[arc.to] = d + arc.length;
                queue.push({distance[arc.to], arc.to});
            }
    }
}

inline void add_border_table(const GraphIndex& index, uint32_t patch, Arcs& arcs) {
    const auto border = index.numbering.border_of(patch);
    const float* table = index.border_tables.data() + index.border_table_begin[patch];
    for (size_t i = 0; i < border.size(); ++i)
        for (size_t j = 0; j < border.size(); ++j)
            arcs[border[i]].push_back({border[j], double{table[i * border.size() + j]}});
}

inline void add_border_internal_table(const GraphIndex& index, uint32_t leaf, Arcs& arcs) {
    const auto border = index.numbering.border_of(leaf);
    const uint32_t first = index.numbering.first_internal(leaf), count = index.numbering.internal_size(leaf);
    const float* table = index.border_internal_tables.data() +
                         index.numbering.border_internal_begin[leaf - index.numbering.first_leaf()];
    for (size_t i = 0; i < border.size(); ++i)
        for (uint32_t j = 0; j < count; ++j) {
            const double length{table[i * count + j]};
            arcs[border[i]].push_back({first + j, length});
            arcs[first + j].push_back({border[i], length});
        }
}

inline void add_internal_table(const GraphIndex& index, uint32_t leaf, Arcs& arcs) {
    const uint32_t first = index.numbering.first_internal(leaf), count = index.numbering.internal_size(leaf);
    const float* entry = index.internal_tables.data() +
                         index.numbering.internal_table_begin[leaf - index.numbering.first_leaf()];
    for (uint32_t i = 0; i < count; ++i)
        for (uint32_t j = 0; j < i; ++j, ++entry) {
            arcs[first + i].push_back({first + j, double{*entry}});
            arcs[first + j].push_back({first + i, double{*entry}});
        }
}

inline uint32_t leaf_holding(const GraphIndex& index, uint32_t internal) {
    uint32_t leaf = index.numbering.first_leaf();
    while (internal >= index.numbering.first_internal(leaf) + index.numbering.internal_size(leaf)) ++leaf;
    return leaf;
}

// The inner patch whose overlay a vertex is first in.
inline uint32_t entry_patch_of(const GraphIndex& index, uint32_t number) {
    if (number >= index.numbering.border_vertex_count())
        return index.numbering.parent[leaf_holding(index, number)];
    uint32_t patch = 0;
    while (number >= index.numbering.owned_begin[patch + 1]) ++patch;
    return patch;
}

// The root last.
inline std::vector<uint32_t> chain_to_root(const GraphIndex& index, uint32_t patch) {
    std::vector<uint32_t> chain{patch};
    while (patch != 0) chain.push_back(patch = index.numbering.parent[patch]);
    return chain;
}

// Every table of the index at once: what no query may undercut.
inline Arcs all_arcs(const GraphIndex& index) {
    Arcs arcs(index.numbering.vertex_count());
    for (uint32_t p = 1; p < index.numbering.patch_count(); ++p) add_border_table(index, p, arcs);
    for (uint32_t leaf = index.numbering.first_leaf(); leaf < index.numbering.patch_count(); ++leaf) {
        add_border_internal_table(index, leaf, arcs);
        add_internal_table(index, leaf, arcs);
    }
    return arcs;
}

// The entry of a table that has both vertices; FAR if none has.
inline double table_distance(const GraphIndex& index, uint32_t a, uint32_t b) {
    if (a == b) return 0;
    for (uint32_t p = 1; p < index.numbering.patch_count(); ++p) {
        Arcs arcs(index.numbering.vertex_count());
        const bool leaf = p >= index.numbering.first_leaf();
        const auto has = [&](uint32_t v) {
            return std::ranges::count(index.numbering.border_of(p), v) > 0 ||
                   (leaf && v >= index.numbering.first_internal(p) &&
                    v < index.numbering.first_internal(p) + index.numbering.internal_size(p));
        };
        if (!has(a) || !has(b)) continue;
        add_border_table(index, p, arcs);
        if (leaf) add_border_internal_table(index, p, arcs);
        if (leaf) add_internal_table(index, p, arcs);
        for (const Arc& arc : arcs[a])
            if (arc.to == b) return arc.length;
    }
    return FAR;
}

// The paper's 3.4: the table's entry if one table has both; otherwise the shortest path over the overlays of
// both vertices' ancestors up to the first common one, the border table of that one, and the border-internal
// tables of their own leaves.
inline double brute_force_sssd(const GraphIndex& index, uint32_t a, uint32_t b) {
    if (const double direct = table_distance(index, a, b); direct < FAR) return direct;
    const auto up_from_a = chain_to_root(index, entry_patch_of(index, a));
    const auto up_from_b = chain_to_root(index, entry_patch_of(index, b));
    const uint32_t common = *std::ranges::find_first_of(up_from_a, up_from_b);
    Arcs arcs(index.numbering.vertex_count());
    for (const auto* chain : {&up_from_a, &up_from_b})
        for (uint32_t p : *chain) {
            for (uint32_t c = index.numbering.child_begin[p]; c < index.numbering.child_begin[p + 1]; ++c)
                add_border_table(index, c, arcs);
            if (p == common) break;
        }
    if (common != 0) add_border_table(index, common, arcs);
    for (uint32_t v : {a, b})
        if (v >= index.numbering.border_vertex_count())
            add_border_internal_table(index, leaf_holding(index, v), arcs);
    std::vector<double> distance(index.numbering.vertex_count(), FAR);
    distance[a] = 0;
    relax(arcs, distance);
    return distance[b];
}

// The three phases: up from the sources' overlays, down over all overlays from their outer borders, into the
// leaves.
inline std::vector<double> brute_force_msad(const GraphIndex& index, std::vector<uint32_t> sources) {
    std::vector<double> distance(index.numbering.vertex_count(), FAR);
    std::vector<char> above(index.numbering.first_leaf(), 0);
    Arcs start(index.numbering.vertex_count());
    for (uint32_t s : sources) {
        distance[s] = 0;
        for (uint32_t p : chain_to_root(index, entry_patch_of(index, s))) above[p] = 1;
        if (s < index.numbering.border_vertex_count()) continue;
        Arcs leaf_arcs(index.numbering.vertex_count());
        add_border_internal_table(index, leaf_holding(index, s), leaf_arcs);
        add_internal_table(index, leaf_holding(index, s), leaf_arcs);
        start[s] = leaf_arcs[s];
    }
    for (uint32_t s : sources)
        for (const Arc& arc : start[s]) distance[arc.to] = std::min(distance[arc.to], arc.length);

    const auto close_overlay = [&](uint32_t p) {
        Arcs arcs(index.numbering.vertex_count());
        for (uint32_t c = index.numbering.child_begin[p]; c < index.numbering.child_begin[p + 1]; ++c)
            add_border_table(index, c, arcs);
        std::vector<double> border_distance(index.numbering.vertex_count(), FAR);
        for (uint32_t v = 0; v < index.numbering.border_vertex_count(); ++v)
            if (!arcs[v].empty()) border_distance[v] = distance[v];
        relax(arcs, border_distance);
        for (uint32_t v = 0; v < index.numbering.border_vertex_count(); ++v)
            distance[v] = std::min(distance[v], border_distance[v]);
    };
    for (uint32_t p = index.numbering.first_leaf(); p-- > 0;)
        if (above[p]) close_overlay(p);
    for (uint32_t p = 1; p < index.numbering.first_leaf(); ++p) close_overlay(p);
    for (uint32_t leaf = index.numbering.first_leaf(); leaf < index.numbering.patch_count(); ++leaf) {
        Arcs arcs(index.numbering.vertex_count());
        add_border_internal_table(index, leaf, arcs);
        for (uint32_t v : index.numbering.border_of(leaf))
            for (const Arc& arc : arcs[v])
                distance[arc.to] = std::min(distance[arc.to], distance[v] + arc.length);
    }
    return distance;
}

}
