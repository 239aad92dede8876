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

std::vector<uint32_t> walk_boundary(const Mesh& mesh, std::span<const uint32_t> faces,
                                    const std::vector<uint8_t>& inside) {
    std::map<uint32_t, std::set<uint32_t>> neighbours; // over boundary edges not walked yet
    for (uint32_t f : faces)
        for (uint32_t e : mesh.face_edges[f]) {
            const auto sides = mesh.edge_faces[e];
            if (sides.size() > 1 &&
                std::all_of(sides.begin(), sides.end(), [&](uint32_t g) { return inside[g]; }))
                continue;
            neighbours[mesh.edges[e][0]].insert(mesh.edges[e][1]);
            neighbours[mesh.edges[e][1]].insert(mesh.edges[e][0]);
        }
    std::vector<uint32_t> walk;
    std::set<uint32_t> visited;
    for (const auto& [start, unused] : neighbours) {
        for (uint32_t v = start; visited.insert(v).second;) {
            walk.push_back(v);
            for (uint32_t next : neighbours[v])
                if (!visited.contains(next)) {
                    v = next;
                    break;
                }
        }
    }
    return walk;
}

}
