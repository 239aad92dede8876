#include "src/tables/pruning.h"

#include <algorithm>
#include <limits>
#include <map>
#include <numeric>

namespace geodesic {

namespace {

// The border vertices that belong to one set of leaves, the edges between them, and all distances among them.
struct SharedBorder {
    std::vector<uint32_t> vertices;
    std::vector<std::array<uint32_t, 2>> adjacent; // positions in vertices
    std::vector<double> distance;                  // a square table

    double at(uint32_t i, uint32_t j) const { return distance[size_t{i} * vertices.size() + j]; }
};

std::vector<SharedBorder> find_shared_borders(const Mesh& mesh,
                                              const ListOfLists<uint32_t>& leaves_at_vertex) {
    std::map<std::vector<uint32_t>, uint32_t> number;
    std::vector<SharedBorder> borders;
    std::vector<uint32_t> border_of(mesh.vertex_count(), NONE), position(mesh.vertex_count(), 0);
    for (uint32_t v = 0; v < mesh.vertex_count(); ++v) {
        const auto leaves = leaves_at_vertex[v];
        if (leaves.size() < 2) continue;
        const auto [entry, added] =
            number.try_emplace({leaves.begin(), leaves.end()}, static_cast<uint32_t>(borders.size()));
        if (added) borders.emplace_back();
        border_of[v] = entry->second;
        position[v] = static_cast<uint32_t>(borders[entry->second].vertices.size());
        borders[entry->second].vertices.push_back(v);
    }
    for (const auto& [a, b] : mesh.edges)
        if (border_of[a] != NONE && border_of[a] == border_of[b])
            borders[border_of[a]].adjacent.push_back({position[a], position[b]});
    return borders;
}

void measure(SharedBorder& border, FieldSolver& solver) {
    if (border.adjacent.empty()) return;
    for (uint32_t source : border.vertices) {
        solver.solve({&source, 1}, border.vertices);
        for (uint32_t target : border.vertices) border.distance.push_back(solver.distance(target));
    }
}

struct Group {
    std::vector<uint32_t> members; // positions in the border
    uint32_t representative = 0;
};

struct Merge {
    double error = std::numeric_limits<double>::infinity();
    uint32_t representative = 0;
};

// The merged group keeps the representative that is nearer to its farthest member.
Merge merge_of(const SharedBorder& border, const Group& a, const Group& b) {
    Merge best;
    for (uint32_t candidate : {a.representative, b.representative}) {
        double error = 0;
        for (const Group* group : {&a, &b})
            for (uint32_t member : group->members) error = std::max(error, border.at(candidate, member));
        if (error < best.error) best = {error, candidate};
    }
    return best;
}

void merge_shared_border(const SharedBorder& border, double largest_error, std::vector<uint8_t>& stands) {
    std::vector<Group> groups(border.vertices.size());
    std::vector<uint32_t> group_of(border.vertices.size());
    for (uint32_t i = 0; i < groups.size(); ++i) groups[i] = {{i}, i};
    std::iota(group_of.begin(), group_of.end(), 0u);
    for (;;) {
        Merge best;
        uint32_t into = NONE, from = NONE;
        for (const auto& [i, j] : border.adjacent) {
            if (group_of[i] == group_of[j]) continue;
            const Merge merge = merge_of(border, groups[group_of[i]], groups[group_of[j]]);
            if (!(merge.error < best.error)) continue;
            best = merge;
            into = group_of[i];
            from = group_of[j];
        }
        if (into == NONE || !(best.error <= largest_error)) break;
        groups[into].representative = best.representative;
        for (uint32_t member : groups[from].members) {
            group_of[member] = into;
            groups[into].members.push_back(member);
        }
        groups[from].members.clear();
    }
    for (uint32_t i = 0; i < groups.size(); ++i)
        stands[border.vertices[i]] = groups[group_of[i]].representative == i;
}

}

std::vector<uint8_t> merge_border_vertices(const Mesh& mesh, const ListOfLists<uint32_t>& leaves_at_vertex,
                                           double largest_error, Workers& workers) {
    std::vector<uint8_t> stands(mesh.vertex_count(), 1);
    if (!(largest_error > 0)) return stands;
    auto borders = find_shared_borders(mesh, leaves_at_vertex);
    workers.run(borders.size(), [&](FieldSolver& solver, size_t i) {
        measure(borders[i], solver);
        if (!borders[i].adjacent.empty()) merge_shared_border(borders[i], largest_error, stands);
    });
    return stands;
}

}
