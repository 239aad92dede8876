#include "src/partition/split.h"

#include <algorithm>
#include <map>
#include <numeric>
#include <unordered_map>

#include "src/partition/patch.h"
#include "src/partition/poisson_disk.h"
#include "src/partition/shorten_borders.h"
#include "src/partition/voronoi.h"

namespace geodesic {

namespace {

using Faces = std::vector<uint32_t>;

// Voronoi cells, one for each face.
std::vector<uint32_t> relaxed_cells(const Splitting& splitting, std::span<const uint32_t> faces,
                                    uint32_t count, FieldSolver& solver, Random& random) {
    if (count == 1) return std::vector<uint32_t>(faces.size(), 0);
    const Mesh& mesh = splitting.mesh;
    const auto vertices = vertices_of(mesh, faces);
    auto seeds = poisson_disk_samples(solver, splitting.component_of_vertex, vertices, count, random);
    auto cell = voronoi_cells(solver, mesh, faces, seeds);
    for (uint32_t i = 0; i < splitting.lloyd_iterations; ++i) {
        relax_seeds(solver, mesh, faces, cell, seeds);
        cell = voronoi_cells(solver, mesh, faces, seeds);
    }
    return cell;
}

// Returns the other group that shares most edges with a small group, or NONE if no other shares any.
uint32_t best_neighbour(const Mesh& mesh, std::span<const uint32_t> faces, const FaceGroups& groups,
                        const std::unordered_map<uint32_t, uint32_t>& position, uint32_t group,
                        std::span<const uint32_t> members) {
    std::map<uint32_t, uint32_t> shared_edges;
    for (uint32_t i : members)
        for (uint32_t e : mesh.face_edges[faces[i]])
            for (uint32_t g : mesh.edge_faces[e])
                if (const auto found = position.find(g); found != position.end())
                    if (const uint32_t other = groups.of_face[found->second]; other != group)
                        ++shared_edges[other];
    uint32_t best = NONE, most = 0;
    for (const auto& [other, edges] : shared_edges)
        if (edges > most) {
            most = edges;
            best = other;
        }
    return best;
}

// The largest connected group of faces of a cell becomes a patch. Each smaller one joins the neighbour that
// it shares most edges with; one without neighbours becomes a patch by itself.
std::vector<Faces> connected_patches(const Mesh& mesh, std::span<const uint32_t> faces,
                                     std::span<const uint32_t> cell) {
    FaceGroups groups = connected_groups(mesh, faces, cell);
    const auto members = group_by(groups.of_face, groups.count);
    std::unordered_map<uint32_t, uint32_t> largest_of_cell, position;
    for (uint32_t c = 0; c < groups.count; ++c) {
        const auto [entry, added] = largest_of_cell.try_emplace(cell[members[c][0]], c);
        if (!added && members[c].size() > members[entry->second].size()) entry->second = c;
    }
    for (uint32_t i = 0; i < faces.size(); ++i) position.emplace(faces[i], i);

    std::vector<uint32_t> order(
        groups.count); // small ones first, since one that others have joined may join another
    std::iota(order.begin(), order.end(), 0u);
    std::stable_sort(order.begin(), order.end(),
                     [&](uint32_t a, uint32_t b) { return members[a].size() < members[b].size(); });
    std::vector<Faces> merged(groups.count);
    for (uint32_t c = 0; c < groups.count; ++c) merged[c].assign(members[c].begin(), members[c].end());
    for (uint32_t c : order) {
        const uint32_t seed = cell[members[c][0]];
        if (seed != NONE && largest_of_cell[seed] == c) continue;
        const uint32_t target = best_neighbour(mesh, faces, groups, position, c, merged[c]);
        if (target == NONE) continue;
        for (uint32_t i : merged[c]) groups.of_face[i] = target;
        merged[target].insert(merged[target].end(), merged[c].begin(), merged[c].end());
        merged[c].clear();
    }
    std::vector<Faces> patches;
    for (Faces& patch : merged) {
        if (patch.empty()) continue;
        for (uint32_t& i : patch) i = faces[i];
        std::sort(patch.begin(), patch.end());
        patches.push_back(std::move(patch));
    }
    return patches;
}

}

Split split_patch(const Splitting& splitting, std::span<const uint32_t> faces, uint32_t count,
                  FieldSolver& solver, Random& random) {
    const Mesh& mesh = splitting.mesh;
    auto cell = relaxed_cells(splitting, faces, count, solver, random);
    const uint64_t border_cost = count == 1 ? 0 : shorten_borders(mesh, splitting.edge_lengths, faces, cell);
    return {connected_patches(mesh, faces, cell), border_cost};
}

}
