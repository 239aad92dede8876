#include "src/tables/borders.h"

#include <algorithm>
#include <map>
#include <set>

namespace geodesic {

ListOfLists<uint32_t> leaves_at_vertices(const Mesh& mesh, const Hierarchy& hierarchy) {
    ListOfLists<uint32_t> leaves;
    std::vector<uint32_t> here;
    for (uint32_t v = 0; v < mesh.vertex_count(); ++v) {
        here.clear();
        for (uint32_t f : mesh.vertex_faces[v]) here.push_back(hierarchy.leaf_of_face[f]);
        std::sort(here.begin(), here.end());
        here.erase(std::unique(here.begin(), here.end()), here.end());
        leaves.items.insert(leaves.items.end(), here.begin(), here.end());
        leaves.close_list();
    }
    return leaves;
}

uint32_t common_ancestor(const Hierarchy& hierarchy, std::span<const uint32_t> leaves) {
    // Leaves are all on the same level and numbered by ancestor: the first and the last are farthest apart.
    uint32_t first = leaves.front(), last = leaves.back();
    while (first != last) {
        first = hierarchy.parent[first];
        last = hierarchy.parent[last];
    }
    return first;
}

std::vector<std::vector<uint32_t>> walk_border(const Mesh& mesh, std::span<const uint32_t> faces,
                                               const std::vector<uint8_t>& inside) {
    std::map<uint32_t, std::set<uint32_t>> neighbours; // over edges between the patch and others
    for (uint32_t f : faces)
        for (uint32_t e : mesh.face_edges[f]) {
            const auto sides = mesh.edge_faces[e];
            if (std::all_of(sides.begin(), sides.end(), [&](uint32_t g) { return inside[g]; })) continue;
            neighbours[mesh.edges[e][0]].insert(mesh.edges[e][1]);
            neighbours[mesh.edges[e][1]].insert(mesh.edges[e][0]);
        }
    std::set<uint32_t> visited;
    const auto walk_from = [&](uint32_t v) {
        std::vector<uint32_t> walk;
        const auto next = [&] {
            return std::ranges::find_if(neighbours[v], [&](uint32_t n) { return !visited.contains(n); });
        };
        for (auto n = next(); n != neighbours[v].end(); n = next()) {
            v = *n;
            visited.insert(v);
            walk.push_back(v);
        }
        return walk;
    };
    std::vector<std::vector<uint32_t>> walks;
    for (const auto& [start, unused] : neighbours) {
        if (!visited.insert(start).second) continue;
        const auto forth = walk_from(start);
        auto walk = walk_from(start); // back, if it is no ring
        std::ranges::reverse(walk);
        walk.push_back(start);
        walk.insert(walk.end(), forth.begin(), forth.end());
        walks.push_back(std::move(walk));
    }
    return walks;
}

}
