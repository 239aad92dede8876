#pragma once

#include <cmath>
#include <random>
#include <string>
#include <vector>

#include <doctest/doctest.h>

#include "tests/capi/shared_index.h"
#include "tests/support/handles.h"
#include "tests/support/meshes.h"
#include "tests/support/stress_meshes.h"
#include "tests/support/surface_options.h"

// An index, a surface, a solver and a query of one mesh.
namespace geodesic::test {

inline geoidx_build_options path_options(uint32_t engine = GEOIDX_ENGINE_OVERLAY,
                                         uint32_t metric = GEOIDX_METRIC_EXACT) {
    geoidx_build_options options;
    geoidx_build_options_init(&options);
    options.engine = engine;
    options.metric = metric;
    return options;
}

// A sheet on which every second triangle is split from a point of its first edge, with a triangle without
// area between that and the other side of the edge.
inline Soup split_edges(uint32_t cells) {
    Soup soup = grid(cells, cells, 1, 1);
    for (Eigen::Vector3d& at : soup.positions) at.z() = 0.2 * at.x() * at.y();
    const size_t count = soup.triangles.size();
    for (size_t i = 0; i < count; i += 2) {
        const auto [a, b, c] = soup.triangles[i];
        const auto split = static_cast<uint32_t>(soup.positions.size());
        soup.positions.push_back(0.3 * soup.positions[a] + 0.7 * soup.positions[b]);
        soup.triangles[i] = {a, split, c};
        soup.triangles.push_back({split, b, c});
        soup.triangles.push_back({a, split, b});
    }
    return soup;
}

struct PathCase {
    explicit PathCase(Soup given, const geoidx_build_options& options = path_options())
        : soup(std::move(given)) {
        const geoidx_mesh view = view_of(soup);
        geoidx_query* new_query = nullptr;
        geoidx_surface* new_surface = nullptr;
        geoidx_solver* new_solver = nullptr;
        index = shared_index(view, options);
        REQUIRE(geoidx_query_create(index.get(), &new_query) == GEOIDX_OK);
        query.reset(new_query);
        const geoidx_surface_options of_surface = surface_options(options);
        REQUIRE(geoidx_surface_create(&view, &of_surface, &new_surface) == GEOIDX_OK);
        surface.reset(new_surface);
        REQUIRE(geoidx_solver_create(&view, &options, &new_solver) == GEOIDX_OK);
        solver.reset(new_solver);
    }

    Eigen::Vector3d position(const geoidx_surface_point& point) const {
        Eigen::Vector3d at = Eigen::Vector3d::Zero();
        for (size_t k = 0; k < 3; ++k)
            at += point.weights[k] * soup.positions[soup.triangles[point.triangle][k]];
        return at;
    }
    double exact(const geoidx_surface_point& a, const geoidx_surface_point& b) const {
        double distance = 0;
        REQUIRE(geoidx_solver_point_distances(solver.get(), &a, 1, &b, 1, &distance) == GEOIDX_OK);
        return distance;
    }
    geoidx_surface_point at_vertex(uint32_t id) const {
        geoidx_surface_point point{};
        REQUIRE(geoidx_vertex_point(surface.get(), id, &point) == GEOIDX_OK);
        return point;
    }
    // To all vertices.
    std::vector<double> exact_field(const geoidx_surface_point& source) const {
        std::vector<geoidx_surface_point> vertices;
        for (uint32_t id = 0; id < soup.vertex_count(); ++id) vertices.push_back(at_vertex(id));
        std::vector<double> distances(vertices.size());
        REQUIRE(geoidx_solver_point_distances(solver.get(), &source, 1, vertices.data(), soup.vertex_count(),
                                              distances.data()) == GEOIDX_OK);
        return distances;
    }
    float sssd(const geoidx_surface_point& a, const geoidx_surface_point& b) const {
        float distance = 0;
        REQUIRE(geoidx_query_point_sssd(query.get(), surface.get(), &a, &b, &distance) == GEOIDX_OK);
        return distance;
    }

    Soup soup;
    std::shared_ptr<const geoidx> index;
    SurfaceHandle surface;
    SolverHandle solver;
    QueryHandle query;
};

// Triangles between points of the unit cube, each point used by one at least.
inline Soup random_soup(std::mt19937_64& random, size_t points, size_t triangles) {
    Soup soup;
    std::vector<std::array<uint32_t, 3>> chosen;
    std::vector<uint32_t> number(points, UINT32_MAX);
    for (size_t t = 0; t < triangles; ++t) {
        std::array<uint32_t, 3> corners;
        do
            for (uint32_t& corner : corners) corner = static_cast<uint32_t>(random() % points);
        while (corners[0] == corners[1] || corners[1] == corners[2] || corners[2] == corners[0]);
        chosen.push_back(corners);
    }
    for (auto corners : chosen) {
        for (uint32_t& corner : corners) {
            uint32_t& known = number[corner];
            if (known == UINT32_MAX) {
                known = static_cast<uint32_t>(soup.positions.size());
                soup.positions.emplace_back(uniform(random, 0, 1), uniform(random, 0, 1),
                                            uniform(random, 0, 1));
            }
            corner = known;
        }
        soup.triangles.push_back(corners);
    }
    return soup;
}

// Inside of a triangle, on an edge or at a corner by turns.
inline geoidx_surface_point random_point(const Soup& soup, std::mt19937_64& random, size_t turn) {
    geoidx_surface_point point{};
    point.triangle = static_cast<uint32_t>(random() % soup.triangles.size());
    for (double& weight : point.weights) weight = uniform(random, 0.02, 1);
    if (turn % 4 == 2) point.weights[random() % 3] = 0;
    if (turn % 4 == 3) {
        for (double& weight : point.weights) weight = 0;
        point.weights[random() % 3] = 1;
    }
    const double sum = point.weights[0] + point.weights[1] + point.weights[2];
    for (double& weight : point.weights) weight /= sum;
    return point;
}

// A torus is a handle, an annulus a hole; three faces at an edge, sheets that share a vertex, thin strips,
// needles, few large triangles, several components, a surface of one side.
inline std::vector<Soup> path_soups() {
    std::vector<Soup> soups{torus(14, 9, 1, 0.4),
                            annulus(14, 3),
                            comb(1),
                            pinched_sheets(2),
                            prism(5, 9, 6),
                            bumpy_sphere(2, 5),
                            cube(1),
                            l_shape(4),
                            moebius(20, 3),
                            jittered_grid(8, 5),
                            grid(6, 6, 1, 1),
                            joined(sphere(2), torus(9, 7, 1, 0.3)),
                            with_mixed_winding(bumpy_sphere(2, 9), 4)};
    soups.push_back(cone(saddle_rays(10, 0.9), 4));
    return soups;
}

// Calls check(on) with a case of each family of stress meshes.
template <class Check>
void for_each_stress_case(const Check& check) {
    std::mt19937_64 random(11);
    for (const auto& families : {stress_families(), unorientable_families()})
        for (const StressFamily& family : families) {
            CAPTURE(std::string(family.name));
            check(PathCase(family.draw(random)));
        }
}

}
