// Exact distances against CGAL's Surface_mesh_shortest_path. An executable of its own, where CGAL is found.
#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <random>
#include <string>
#include <thread>
#include <vector>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/Surface_mesh_shortest_path.h>
#include <doctest/doctest.h>

#include "src/mesh/intake.h"
#include "src/metric/window_propagation.h"
#include "tests/support/meshes.h"
#include "tests/support/oracles.h"
#include "tests/support/stress_meshes.h"
#include "tools/mesh_io/mesh_io.h"

using namespace geodesic;
using namespace geodesic::test;

namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using SurfaceMesh = CGAL::Surface_mesh<Kernel::Point_3>;
using ShortestPath =
    CGAL::Surface_mesh_shortest_path<CGAL::Surface_mesh_shortest_path_traits<Kernel, SurfaceMesh>>;

// CGAL takes oriented manifolds only. Returns how many faces it refuses.
size_t to_cgal(const Mesh& mesh, SurfaceMesh& out) {
    for (const auto& p : mesh.positions) out.add_vertex(Kernel::Point_3(p.x(), p.y(), p.z()));
    size_t refused = 0;
    for (const auto& [a, b, c] : mesh.faces)
        refused += out.add_face(SurfaceMesh::Vertex_index(a), SurfaceMesh::Vertex_index(b),
                                SurfaceMesh::Vertex_index(c)) == SurfaceMesh::null_face();
    return refused;
}

std::vector<double> cgal_field(const Mesh& mesh, uint32_t source) {
    SurfaceMesh surface;
    to_cgal(mesh, surface);
    ShortestPath paths(surface);
    paths.add_source_point(SurfaceMesh::Vertex_index(source));
    std::vector<double> distances(mesh.vertex_count());
    for (uint32_t v = 0; v < mesh.vertex_count(); ++v) {
        const double d = paths.shortest_distance_to_source_points(SurfaceMesh::Vertex_index(v)).first;
        distances[v] = d < 0 ? UNREACHABLE : d;
    }
    return distances;
}

// One source a thread at a time, each with CGAL objects of its own.
std::vector<double> differences(const Mesh& mesh, const std::vector<uint32_t>& sources) {
    std::vector<double> worst(sources.size(), UNREACHABLE);
    std::atomic<size_t> next = 0;
    const ExactMetric metric(mesh);
    const auto work = [&] {
        const auto solver = metric.make_solver();
        for (size_t i; (i = next++) < sources.size();)
            worst[i] = largest_relative_difference(field(mesh, *solver, {&sources[i], 1}),
                                                   cgal_field(mesh, sources[i]));
    };
    {
        std::jthread other(work);
        work();
    }
    return worst;
}

std::vector<uint32_t> seeded_sources(const Mesh& mesh, size_t count) {
    std::mt19937_64 random(2024);
    std::vector<uint32_t> sources(count);
    for (uint32_t& s : sources) s = static_cast<uint32_t>(random() % mesh.vertex_count());
    return sources;
}

constexpr double AGREEMENT = 1e-11; // stress meshes come to 6e-13

void compare_with_cgal(const std::string& name, const Mesh& mesh, size_t source_count) {
    const auto sources = seeded_sources(mesh, source_count);
    const auto worst = differences(mesh, sources);
    for (size_t i = 0; i < sources.size(); ++i) {
        CAPTURE(name);
        CAPTURE(sources[i]);
        CHECK(worst[i] < AGREEMENT);
    }
    MESSAGE(name, ": ", mesh.vertex_count(), " vertices, largest relative difference to CGAL ",
            *std::max_element(worst.begin(), worst.end()));
}

// Where CGAL cannot take the mesh: between Steiner points and what they converge to.
void compare_with_steiner(const std::string& name, const Mesh& mesh) {
    for (uint32_t source : seeded_sources(mesh, 2)) {
        CAPTURE(name);
        CAPTURE(source);
        const auto exact = exact_field(mesh, source);
        double mean[2] = {0, 0}, below = 0;
        const uint32_t points[2] = {5, 20};
        for (size_t k = 0; k < 2; ++k) {
            const auto bound = steiner_distances(mesh, source, points[k]);
            for (uint32_t v = 0; v < mesh.vertex_count(); ++v) {
                REQUIRE((exact[v] == UNREACHABLE) == (bound[v] == UNREACHABLE));
                if (exact[v] == bound[v]) continue;
                below = std::max(below, 1 - bound[v] / exact[v]);
                mean[k] += (bound[v] / exact[v] - 1) / mesh.vertex_count();
            }
        }
        CHECK(below < 1e-11);
        CHECK(mean[1] < 2e-3);
        CHECK(mean[1] < 0.4 * mean[0]); // 6 / 21 or better
    }
}

}

TEST_CASE("CGAL: generated meshes") {
    const std::pair<const char*, Soup> meshes[] = {{"bumpy sphere", bumpy_sphere(4, 1)},
                                                   {"torus", torus(40, 20, 2, 0.8)},
                                                   {"jittered grid", jittered_grid(25, 2)},
                                                   {"regular grid", grid(20, 20, 1, 1)},
                                                   {"saddle", cone(saddle_rays(16, 0.8), 10)},
                                                   {"L", l_shape(10)},
                                                   {"annulus", annulus(40, 6)},
                                                   {"components", joined(sphere(3), prism(7, 5, 3))}};
    for (const auto& [name, soup] : meshes) {
        const Mesh mesh = mesh_of(soup);
        SurfaceMesh surface;
        REQUIRE(to_cgal(mesh, surface) == 0);
        compare_with_cgal(name, mesh, 10);
    }
}

// CGAL is asked for the mesh of unit size: scaled by 1000 it loses paths among equal ones, up to 2 % above
// what Steiner points show to be possible.
TEST_CASE("CGAL: 200 stress meshes, in millimetres and kilometres, too") {
    std::mt19937_64 random(77);
    const auto families = stress_families();
    double worst_of_all = 0;
    for (uint32_t i = 0; i < 200; ++i) {
        const auto& [name, family] = families[i % families.size()];
        const double scale = std::array{1.0, 1e-3, 1e3}[i / families.size() % 3];
        const Soup soup = family(random);
        const Mesh mesh = mesh_of(soup), scaled_mesh = mesh_of(scaled(soup, scale, scale, scale));
        SurfaceMesh surface;
        REQUIRE(to_cgal(mesh, surface) == 0);
        CAPTURE(std::string(name));
        CAPTURE(i);
        for (uint32_t k = 0; k < 2; ++k) {
            const auto source = static_cast<uint32_t>(random() % mesh.vertex_count());
            CAPTURE(source);
            auto expected = cgal_field(mesh, source);
            for (double& d : expected) d *= scale;
            const double difference = largest_relative_difference(exact_field(scaled_mesh, source), expected);
            CHECK(difference < AGREEMENT);
            worst_of_all = std::max(worst_of_all, difference);
        }
    }
    MESSAGE("200 stress meshes: largest relative difference to CGAL ", worst_of_all);
}

TEST_CASE("Steiner points: stress meshes that CGAL drops faces of") {
    std::mt19937_64 random(78);
    const auto families = unorientable_families();
    for (uint32_t i = 0; i < 12; ++i) {
        const double scale = std::array{1.0, 1e-3, 1e3}[i % 3];
        const Soup soup = families[i % families.size()].draw(random);
        compare_with_steiner("stress", mesh_of(scaled(soup, scale, scale, scale)));
    }
}

TEST_CASE("CGAL: scanned and modelled meshes of GEOIDX_MESHES") {
    const char* folder = std::getenv("GEOIDX_MESHES");
    if (!folder || !std::filesystem::is_directory(folder)) {
        MESSAGE("SKIPPED: GEOIDX_MESHES names no folder, real meshes were not compared with CGAL");
        return;
    }
    for (const std::string name : {"spot", "teapot", "bunny", "armadillo", "nefertiti"}) {
        const auto path = std::filesystem::path(folder) / (name + ".obj");
        if (!std::filesystem::exists(path)) {
            MESSAGE("SKIPPED: ", path.string(), " does not exist");
            continue;
        }
        const auto file = tools::read_mesh(path.string());
        geoidx_mesh view{};
        view.struct_size = sizeof view;
        view.position_type = GEOIDX_POSITION_DOUBLE;
        view.positions = file.positions.data();
        view.vertex_count = file.vertex_count();
        view.triangles = file.triangles.data();
        view.triangle_count = file.triangle_count();
        const Intake intake = take_in(view, {});
        SurfaceMesh surface;
        const size_t refused = to_cgal(intake.mesh, surface);
        if (refused == 0) {
            const bool is_large = intake.mesh.vertex_count() > 40000; // CGAL takes ten seconds a source
            compare_with_cgal(name, intake.mesh, is_large ? 1 : 2);
        } else {
            MESSAGE(name, ": CGAL refuses ", refused, " of its faces; compared with Steiner points instead");
            compare_with_steiner(name, intake.mesh);
        }
    }
}
