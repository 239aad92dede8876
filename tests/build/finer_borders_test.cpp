#include "src/build/finer_borders.h"

#include <algorithm>
#include <cmath>
#include <map>

#include <Eigen/Geometry>

#include <doctest/doctest.h>

#include "src/mesh/halve_edges.h"
#include "src/metric/window_propagation.h"
#include "tests/support/meshes.h"

using namespace geodesic;
using namespace geodesic::test;

namespace {

// A mesh with a hierarchy of one level, and the metric.
struct Split {
    Mesh mesh;
    ExactMetric metric;
    Workers workers;
    Hierarchy hierarchy;

    explicit Split(const Soup& soup)
        : mesh(mesh_of(soup)), metric(mesh), workers(metric, 2, {}),
          hierarchy(build_hierarchy(mesh, {{5}}, workers)) {}

    bool is_border(uint32_t edge) const {
        const auto faces = mesh.edge_faces[edge];
        return std::ranges::any_of(
            faces, [&](uint32_t f) { return hierarchy.leaf_of_face[f] != hierarchy.leaf_of_face[faces[0]]; });
    }
    std::vector<BorderEdge> edges(std::span<const uint32_t> sources, double too_short = 0) {
        return border_edges(mesh, hierarchy.leaf_of_face, sources,
                            {std::vector<uint32_t>(mesh.vertex_count(), 0), {too_short}}, workers);
    }
};

constexpr uint32_t SOURCES[] = {0, 3, 11};

SurfacePoint middle_of_edge(const Mesh& mesh, uint32_t edge) {
    SurfacePoint middle{mesh.edge_faces[edge][0], {0.5, 0.5, 0.5}};
    for (size_t k = 0; k < 3; ++k)
        if (mesh.face_edges[middle.face][k] == edge) middle.weights[k] = 0;
    return middle;
}

}

TEST_CASE("border edges: all edges between leaves, and no others") {
    for (const Soup& soup : {sphere(2), comb(2), joined(cube(3), moebius(9, 2))}) {
        Split split(soup);
        std::vector<uint32_t> found, expected;
        for (const BorderEdge& edge : split.edges(SOURCES)) found.push_back(edge.edge);
        for (uint32_t e = 0; e < split.mesh.edge_count(); ++e)
            if (split.is_border(e)) expected.push_back(e);
        std::ranges::sort(found);
        REQUIRE(!expected.empty());
        CHECK(found == expected);
    }
}

TEST_CASE("border edges: in a plane unfolding is exact") {
    Split split(jittered_grid(9, 2));
    const auto edges = split.edges(SOURCES);
    REQUIRE(!edges.empty());
    for (const BorderEdge& edge : edges) CHECK(edge.deviation < 1e-12);
}

// Where the middle is a vertex, and by the law of cosines at one end of the edge.
TEST_CASE("border edges: deviations, largest first, against distances to vertices in the middle") {
    Split split(joined(bumpy_sphere(2, 3), sphere(1)));
    const auto edges = split.edges(SOURCES);
    std::vector<uint32_t> cut;
    for (const BorderEdge& edge : edges) cut.push_back(edge.edge);
    const Mesh halved = halve_edges(split.mesh, cut).mesh;
    const auto solver = ExactMetric(halved).make_solver();
    std::vector<double> expected(edges.size(), 0);
    for (const uint32_t source : SOURCES) {
        solver->solve({&source, 1}, {});
        for (uint32_t i = 0; i < edges.size(); ++i) {
            const auto [p, q] = split.mesh.edges[cut[i]];
            const double a = solver->distance(p), b = solver->distance(q), c = split.mesh.edge_length(cut[i]);
            if (a == UNREACHABLE || a == 0) continue;
            const double cosine = (a * a + c * c - b * b) / (2 * a * c);
            const double square = a * a + c * c / 4 - a * c * cosine;
            const double exact = solver->distance(split.mesh.vertex_count() + i);
            expected[i] += std::abs(std::sqrt(std::max(0.0, square)) / exact - 1) / std::size(SOURCES);
        }
    }
    REQUIRE(expected.front() > 1e-3);
    for (size_t i = 0; i < edges.size(); ++i) {
        CHECK(edges[i].deviation == doctest::Approx(expected[i]).epsilon(1e-6).scale(1e-3));
        if (i > 0) CHECK(edges[i].deviation <= edges[i - 1].deviation);
    }
}

TEST_CASE("border edges: middles up to a distance that is too short do not count") {
    Split split(bumpy_sphere(2, 3));
    const uint32_t source[] = {3};
    const auto solver = split.metric.make_solver();
    const auto all = split.edges(source);
    std::vector<SurfacePoint> middles;
    for (const BorderEdge& edge : all) middles.push_back(middle_of_edge(split.mesh, edge.edge));
    solver->solve({source, {}, {}, middles});
    std::vector<double> distances;
    for (size_t i = 0; i < all.size(); ++i) distances.push_back(solver->point_distance(i));
    auto sorted = distances;
    std::ranges::sort(sorted);
    const double too_short = sorted[sorted.size() / 2];
    std::map<uint32_t, double> expected;
    for (size_t i = 0; i < all.size(); ++i)
        expected[all[i].edge] = distances[i] > too_short ? all[i].deviation : 0;
    for (const auto& [edge, deviation] : split.edges(source, too_short))
        CHECK(deviation == doctest::Approx(expected[edge]));
}

TEST_CASE("border edges: as many as have a share of all deviations") {
    const std::vector<BorderEdge> edges{{7, 5}, {2, 3}, {9, 1}, {4, 1}, {5, 0}};
    const std::pair<double, size_t> expected[] = {{0, 0},    {0.1, 1}, {0.5, 1}, {0.51, 2}, {0.8, 2},
                                                  {0.81, 3}, {0.9, 3}, {1, 4},   {2, 4}};
    for (const auto& [share, count] : expected) CHECK(count_for_share(edges, share) == count);
    CHECK(count_for_share({}, 1) == 0);
    const std::vector<BorderEdge> flat{{1, 0}, {2, 0}};
    CHECK(count_for_share(flat, 1) == 0);
}

TEST_CASE("finer borders: the given edges are cut, and each part of a face is in its leaf") {
    for (const Soup& soup : {bumpy_sphere(2, 8), comb(2)}) {
        Split split(soup);
        auto edges = split.edges(SOURCES);
        edges.resize(edges.size() / 2);
        const FinerSurface finer = with_finer_borders(split.mesh, split.hierarchy, edges);
        REQUIRE(finer.mesh.vertex_count() == split.mesh.vertex_count() + edges.size());
        CHECK(finer.hierarchy.parent == split.hierarchy.parent);
        CHECK(finer.hierarchy.level_begin == split.hierarchy.level_begin);
        CHECK(finer.hierarchy.child_begin == split.hierarchy.child_begin);
        for (const BorderEdge& edge : edges) {
            const auto [a, b] = split.mesh.edges[edge.edge];
            CHECK(find_edge(finer.mesh, a, b) == NONE);
        }
        // The area of each leaf stays the same.
        std::vector<double> area(split.hierarchy.patch_count(), 0);
        const auto add = [&](const Mesh& mesh, const Hierarchy& hierarchy, double factor) {
            REQUIRE(hierarchy.leaf_of_face.size() == mesh.face_count());
            for (uint32_t f = 0; f < mesh.face_count(); ++f) {
                const auto [a, b, c] = mesh.faces[f];
                const Eigen::Vector3d ab = mesh.positions[b] - mesh.positions[a];
                area[hierarchy.leaf_of_face[f]] +=
                    factor * ab.cross(mesh.positions[c] - mesh.positions[a]).norm();
            }
        };
        add(split.mesh, split.hierarchy, 1);
        add(finer.mesh, finer.hierarchy, -1);
        for (const double left : area) CHECK(std::abs(left) < 1e-12);
    }
}
