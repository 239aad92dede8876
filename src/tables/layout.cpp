#include "src/tables/layout.h"

#include <algorithm>
#include <tuple>

#include "src/tables/borders.h"

namespace geodesic {

namespace {

// Where a vertex goes: border vertices first by owner, internal ones by leaf and distance to the border.
struct Slot {
    bool internal;
    uint32_t group; // owner patch or leaf
    double distance_to_border;
    uint32_t vertex;

    auto key() const { return std::tie(internal, group, distance_to_border, vertex); }
};

std::vector<double> distances_to_border(const std::vector<uint32_t>& border, uint32_t vertex_count,
                                        Workers& workers) {
    std::vector<double> result(vertex_count, 0);
    if (border.empty()) return result;
    workers.run(1, [&](FieldSolver& solver, size_t) {
        solver.solve(border, {});
        for (uint32_t v = 0; v < vertex_count; ++v) result[v] = solver.distance(v);
    });
    return result;
}

std::vector<Slot> sorted_slots(const Hierarchy& hierarchy, const ListOfLists<uint32_t>& leaves_at_vertex,
                               const std::vector<uint8_t>& is_border, Workers& workers) {
    const auto vertex_count = static_cast<uint32_t>(leaves_at_vertex.size());
    std::vector<uint32_t> border;
    for (uint32_t v = 0; v < vertex_count; ++v)
        if (leaves_at_vertex[v].size() > 1 && is_border[v]) border.push_back(v);
    const auto distance = distances_to_border(border, vertex_count, workers);

    std::vector<Slot> slots;
    for (uint32_t v = 0; v < vertex_count; ++v) {
        const auto leaves = leaves_at_vertex[v];
        const bool internal = leaves.size() == 1 || !is_border[v];
        slots.push_back({internal, internal ? leaves[0] : common_ancestor(hierarchy, leaves),
                         internal ? distance[v] : 0, v});
    }
    std::sort(slots.begin(), slots.end(), [](const Slot& a, const Slot& b) { return a.key() < b.key(); });
    return slots;
}

// begin[i] .. begin[i + 1] - 1: the slots of group first + i among slots[from] .. slots[to - 1].
void group_begins(const std::vector<Slot>& slots, size_t from, size_t to, uint32_t first, uint32_t count,
                  Array<uint32_t>& begin) {
    begin.assign(size_t{count} + 1, static_cast<uint32_t>(from));
    size_t next = from;
    for (uint32_t i = 0; i < count; ++i) {
        while (next < to && slots[next].group <= first + i) ++next;
        begin[i + 1] = static_cast<uint32_t>(next);
    }
}

std::vector<ListOfLists<uint32_t>> faces_by_level(const Hierarchy& hierarchy) {
    std::vector<ListOfLists<uint32_t>> levels(hierarchy.level_count() + 1);
    std::vector<uint32_t> patch = hierarchy.leaf_of_face;
    for (uint32_t l = hierarchy.level_count(); l > 0; --l) {
        std::vector<uint32_t> key(patch);
        for (uint32_t& k : key) k -= hierarchy.level_begin[l];
        levels[l] = group_by(key, hierarchy.level_begin[l + 1] - hierarchy.level_begin[l]);
        for (uint32_t& p : patch) p = hierarchy.parent[p];
    }
    return levels;
}

// The border of a patch: its vertices that lie on no deeper owner's overlay only, along the boundary; those
// where the patch merely touches another come last.
std::vector<uint32_t> border_of_patch(const Mesh& mesh, uint32_t patch, std::span<const uint32_t> faces,
                                      std::vector<uint8_t>& inside, const std::vector<uint32_t>& number,
                                      const Index& index) {
    const auto on_border = [&](uint32_t v) {
        return index.is_border(number[v]) && !index.is_within(index.owner[number[v]], patch);
    };
    for (uint32_t f : faces) inside[f] = 1;
    auto walks = walk_border(mesh, faces, inside);
    for (uint32_t f : faces) inside[f] = 0;
    std::vector<uint32_t> border, touching;
    for (auto& walk : walks) {
        // So that what is left of a ring, if a part of it is none of the border, is in one piece.
        if (const auto other = std::ranges::find_if_not(walk, on_border); other != walk.end())
            std::rotate(walk.begin(), other, walk.end());
        for (uint32_t v : walk)
            if (on_border(v)) border.push_back(number[v]);
    }
    for (uint32_t f : faces)
        for (uint32_t v : mesh.faces[f])
            if (on_border(v)) touching.push_back(number[v]);
    std::sort(touching.begin(), touching.end());
    touching.erase(std::unique(touching.begin(), touching.end()), touching.end());
    std::vector<uint32_t> known(border);
    std::sort(known.begin(), known.end());
    std::set_difference(touching.begin(), touching.end(), known.begin(), known.end(),
                        std::back_inserter(border));
    return border;
}

void lay_out_borders(const Mesh& mesh, const Hierarchy& hierarchy, const std::vector<uint32_t>& number,
                     Workers& workers, Index& index) {
    const auto faces = faces_by_level(hierarchy);
    std::vector<std::vector<uint32_t>> borders(hierarchy.patch_count());
    for (uint32_t l = 1; l <= hierarchy.level_count(); ++l) {
        const uint32_t first = hierarchy.level_begin[l];
        workers.run(1, [&](FieldSolver&, size_t) {
            std::vector<uint8_t> inside(mesh.face_count(), 0);
            for (uint32_t i = 0; i < faces[l].size(); ++i)
                borders[first + i] = border_of_patch(mesh, first + i, faces[l][i], inside, number, index);
        });
    }
    index.border_begin.assign(1, 0);
    for (const auto& border : borders) {
        index.border.insert(index.border.end(), border.begin(), border.end());
        index.border_begin.push_back(static_cast<uint32_t>(index.border.size()));
    }
}

}

std::vector<uint32_t> lay_out(const Intake& intake, const Hierarchy& hierarchy,
                              const ListOfLists<uint32_t>& leaves_at_vertex,
                              const std::vector<uint8_t>& is_border, Workers& workers, Index& index) {
    index.level_begin.assign(hierarchy.level_begin.begin(), hierarchy.level_begin.end());
    index.parent.assign(hierarchy.parent.begin(), hierarchy.parent.end());
    index.child_begin.assign(hierarchy.child_begin.begin(), hierarchy.child_begin.end());

    const auto slots = sorted_slots(hierarchy, leaves_at_vertex, is_border, workers);
    const auto border_count = static_cast<size_t>(
        std::count_if(slots.begin(), slots.end(), [](const Slot& slot) { return !slot.internal; }));
    group_begins(slots, 0, border_count, 0, hierarchy.patch_count(), index.owned_begin);
    group_begins(slots, border_count, slots.size(), hierarchy.first_leaf(),
                 hierarchy.patch_count() - hierarchy.first_leaf(), index.internal_begin);
    index.owner.clear();
    for (size_t i = 0; i < border_count; ++i) index.owner.push_back(slots[i].group);

    std::vector<uint32_t> vertex_of_number, number(slots.size());
    for (const Slot& slot : slots) {
        number[slot.vertex] = static_cast<uint32_t>(vertex_of_number.size());
        vertex_of_number.push_back(slot.vertex);
        const auto& p = intake.mesh.positions[slot.vertex];
        index.positions.push_back(
            {static_cast<float>(p[0]), static_cast<float>(p[1]), static_cast<float>(p[2])});
    }
    for (uint32_t vertex : intake.vertex_of_id)
        index.number_of_id.push_back(vertex == NONE ? NONE : number[vertex]);
    lay_out_borders(intake.mesh, hierarchy, number, workers, index);
    derive(index);
    allocate_tables(index);
    return vertex_of_number;
}

}
