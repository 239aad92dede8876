#include "bench/root3.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>

namespace geodesic::bench {

namespace {

using Edge = std::array<uint32_t, 2>; // ascending

struct Sides {
    std::vector<uint32_t> triangles;
    std::array<uint32_t, 2> in_order; // as the first triangle runs along it
};

std::map<Edge, Sides> edges_of(const tools::TriangleMesh& mesh) {
    std::map<Edge, Sides> edges;
    for (size_t i = 0; i < mesh.triangles.size(); ++i) {
        const uint32_t a = mesh.triangles[i], b = mesh.triangles[i % 3 == 2 ? i - 2 : i + 1];
        Sides& sides = edges[{std::min(a, b), std::max(a, b)}];
        if (sides.triangles.empty()) sides.in_order = {a, b};
        sides.triangles.push_back(static_cast<uint32_t>(i / 3));
    }
    return edges;
}

void smooth(const tools::TriangleMesh& mesh, const std::map<Edge, Sides>& edges, tools::TriangleMesh& out) {
    std::vector<uint32_t> valence(mesh.vertex_count(), 0);
    std::vector<uint8_t> stays(mesh.vertex_count(), 0);
    std::vector<double> sum(mesh.positions.size(), 0);
    for (const auto& [edge, sides] : edges)
        for (int end = 0; end < 2; ++end) {
            const uint32_t v = edge[end], other = edge[1 - end];
            ++valence[v];
            if (sides.triangles.size() != 2) stays[v] = 1;
            for (size_t k = 0; k < 3; ++k) sum[3 * size_t{v} + k] += mesh.positions[3 * size_t{other} + k];
        }
    for (uint32_t v = 0; v < mesh.vertex_count(); ++v) {
        if (stays[v] || valence[v] == 0) continue;
        const double n = valence[v], share = (4 - 2 * std::cos(2 * std::numbers::pi / n)) / 9;
        for (size_t k = 0; k < 3; ++k) {
            double& x = out.positions[3 * size_t{v} + k];
            x = (1 - share) * x + share * sum[3 * size_t{v} + k] / n;
        }
    }
}

}

tools::TriangleMesh root3_subdivided(const tools::TriangleMesh& mesh) {
    const auto edges = edges_of(mesh);
    const auto old_count = static_cast<uint32_t>(mesh.vertex_count());
    tools::TriangleMesh out;
    out.positions = mesh.positions;
    for (size_t t = 0; t < mesh.triangles.size(); t += 3)
        for (size_t k = 0; k < 3; ++k) {
            double middle = 0;
            for (size_t corner = 0; corner < 3; ++corner)
                middle += mesh.positions[3 * size_t{mesh.triangles[t + corner]} + k];
            out.positions.push_back(middle / 3);
        }
    smooth(mesh, edges, out);
    for (const auto& [edge, sides] : edges) {
        const auto [a, b] = sides.in_order;
        const uint32_t middle = old_count + sides.triangles[0];
        if (sides.triangles.size() == 2) {
            const uint32_t beyond = old_count + sides.triangles[1];
            out.triangles.insert(out.triangles.end(), {middle, a, beyond, middle, beyond, b});
        } else {
            for (uint32_t t : sides.triangles)
                out.triangles.insert(out.triangles.end(), {a, b, old_count + t});
        }
    }
    return out;
}

}
