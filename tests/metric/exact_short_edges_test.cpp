// Edges that are far shorter than paths are long, as isosurfaces and rounded positions have them: a vertex in
// whose place there is a tiny polygon is passed as the vertex itself is.
#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include <doctest/doctest.h>

#include "src/mesh/intake.h"
#include "src/metric/intrinsic_mesh.h"
#include "tests/support/meshes.h"
#include "tests/support/oracles.h"
#include "tests/support/sanitized.h"

using namespace geodesic;
using namespace geodesic::test;

namespace {

// Cuts the corners of all faces around a vertex off, `radius` from it, and puts triangles between these cuts
// and the vertex.
void blow_up(Soup& soup, uint32_t vertex, double radius) {
    std::map<uint32_t, uint32_t> cut; // by the far end of an edge
    const auto cut_towards = [&](uint32_t end) {
        const auto [at, is_new] = cut.try_emplace(end, soup.vertex_count());
        if (is_new) {
            const Eigen::Vector3d center = soup.positions[vertex];
            soup.positions.push_back(center + radius * (soup.positions[end] - center).normalized());
        }
        return at->second;
    };
    const auto triangles = soup.triangles;
    soup.triangles.clear();
    for (const auto& triangle : triangles) {
        const auto at = std::ranges::find(triangle, vertex) - triangle.begin();
        if (at == 3) {
            soup.triangles.push_back(triangle);
            continue;
        }
        const auto k = static_cast<size_t>(at);
        const uint32_t b = triangle[(k + 1) % 3], c = triangle[(k + 2) % 3];
        const uint32_t near_b = cut_towards(b), near_c = cut_towards(c);
        soup.triangles.push_back({near_b, b, c});
        soup.triangles.push_back({near_b, c, near_c});
        soup.triangles.push_back({vertex, near_b, near_c});
    }
}

// A height field of 12 x 12 cells, over whose saddles paths bend.
Soup waves() {
    Soup soup = grid(12, 12, 12, 12);
    for (Eigen::Vector3d& p : soup.positions)
        p.z() = 0.4 * std::sin(0.75 * p.x()) * std::cos(7.0 / 12 * p.y());
    return soup;
}

// For some vertices, of which none lies beside another one.
Soup with_tiny_polygons(Soup soup, double radius) {
    const Mesh mesh = mesh_of(soup);
    std::vector<uint32_t> chosen;
    for (uint32_t vertex = 20; vertex < mesh.vertex_count(); vertex += 17) {
        const auto is_beside = [&](uint32_t other) { return find_edge(mesh, vertex, other) != NONE; };
        if (std::ranges::any_of(chosen, is_beside)) continue;
        chosen.push_back(vertex);
        blow_up(soup, vertex, radius);
    }
    return soup;
}

// Of distances between vertices that both meshes have.
double largest_difference(const Soup& soup, const std::vector<std::vector<double>>& expected) {
    const Intake intake = take_in(view_of(soup), {});
    double largest = 0;
    for (size_t source = 0; source < expected.size(); ++source) {
        const auto d = exact_field(intake.mesh, intake.vertex_of_id[source]);
        for (size_t v = 0; v < expected[source].size(); ++v)
            if (const double off = std::abs(d[intake.vertex_of_id[v]] - expected[source][v]);
                !(off <= largest))
                largest = off; // also NaN
    }
    return largest;
}

}

// The sphere has needles, whose cut corners are faces without area to rounding.
TEST_CASE("short edges: paths go around tiny polygons as around the vertices in their places") {
    for (const auto& [soup, rounding] : {std::pair(waves(), 1e-8), std::pair(bumpy_sphere(3, 3), 1e-6)}) {
        const Mesh mesh = mesh_of(soup);
        std::vector<std::vector<double>> expected;
        for (uint32_t v = 0; v < soup.vertex_count() / sparse(4); ++v)
            expected.push_back(exact_field(mesh, v));
        // A path passes few polygons, and takes at most the half of one to get around it.
        for (const double radius : {1e-3, 1e-5, 1e-7, 1e-8, 1e-9, 1e-10, 1e-11, 1e-12, 1e-13, 1e-14, 1e-15}) {
            CAPTURE(radius);
            CHECK(largest_difference(with_tiny_polygons(soup, radius), expected) <
                  std::max(20 * radius, rounding));
        }
    }
}

// Far longer edges elsewhere make none of these short: windows then would leave all vertices in all
// directions.
TEST_CASE("short edges: as another component has them changes nothing") {
    const Soup soup = waves();
    Soup far = soup;
    far.positions.insert(far.positions.end(), {{1e9, 0, 0}, {2e9, 0, 0}, {1e9, 1e9, 0}});
    far.triangles.push_back({soup.vertex_count(), soup.vertex_count() + 1, soup.vertex_count() + 2});
    const IntrinsicMesh alone(mesh_of(soup)), beside(mesh_of(far));
    for (uint32_t v = 0; v < soup.vertex_count(); ++v) {
        CHECK(beside.fan[v] == alone.fan[v]);
        CHECK(beside.can_bend[v] == alone.can_bend[v]);
    }
}
