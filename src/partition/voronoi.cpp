#include "src/partition/voronoi.h"

#include <unordered_map>

#include "src/partition/patch.h"

namespace geodesic {

namespace {

uint32_t cell_of_face(const FieldSolver& solver, const std::array<uint32_t, 3>& face) {
    const uint32_t a = solver.nearest(face[0]), b = solver.nearest(face[1]), c = solver.nearest(face[2]);
    if (a == b || a == c) return a;
    if (b == c) return b;
    uint32_t closest = face[0];
    for (uint32_t v : face)
        if (solver.distance(v) < solver.distance(closest)) closest = v;
    return solver.nearest(closest);
}

// Returns the cell that all faces of the patch around a vertex belong to, or NONE if the vertex lies on a
// border of a cell or of the patch. Vertices in components without a seed are left out.
std::unordered_map<uint32_t, uint32_t> only_cells(const Mesh& mesh, std::span<const uint32_t> faces,
                                                  std::span<const uint32_t> cell) {
    struct Around {
        uint32_t cell;
        uint32_t faces;
    };
    std::unordered_map<uint32_t, Around> around;
    for (size_t i = 0; i < faces.size(); ++i) {
        if (cell[i] == NONE) continue; // in a component without a seed
        for (uint32_t v : mesh.faces[faces[i]]) {
            Around& at = around.try_emplace(v, Around{cell[i], 0}).first->second;
            if (at.cell != cell[i]) at.cell = NONE;
            ++at.faces;
        }
    }
    std::unordered_map<uint32_t, uint32_t> only;
    for (const auto& [v, at] : around) only[v] = at.faces == mesh.vertex_faces[v].size() ? at.cell : NONE;
    return only;
}

}

std::vector<uint32_t> voronoi_cells(FieldSolver& solver, const Mesh& mesh, std::span<const uint32_t> faces,
                                    std::span<const uint32_t> seeds) {
    const auto vertices = vertices_of(mesh, faces);
    solver.solve(seeds, vertices);
    std::vector<uint32_t> cell;
    cell.reserve(faces.size());
    for (uint32_t f : faces) cell.push_back(cell_of_face(solver, mesh.faces[f]));
    return cell;
}

void relax_seeds(FieldSolver& solver, const Mesh& mesh, std::span<const uint32_t> faces,
                 std::span<const uint32_t> cell, std::span<uint32_t> seeds) {
    const auto only = only_cells(mesh, faces, cell);
    const auto vertices = vertices_of(mesh, faces);
    std::vector<uint32_t> border;
    for (uint32_t v : vertices)
        if (const auto found = only.find(v); found != only.end() && found->second == NONE)
            border.push_back(v);
    if (border.empty()) return;
    solver.solve(border, vertices);
    std::vector<double> farthest(seeds.size(), 0);
    for (uint32_t v : vertices) {
        const auto found = only.find(v);
        const uint32_t c = found == only.end() ? NONE : found->second;
        if (c == NONE || !(solver.distance(v) > farthest[c]) || solver.distance(v) == UNREACHABLE) continue;
        farthest[c] = solver.distance(v);
        seeds[c] = v;
    }
}

}
