// What a point sees of the faces around it, compared with the plane and with the exact metric.
#include <cmath>
#include <numbers>

#include "src/surface/nearby.h"
#include "tests/path/path_cases.h"
#include "tests/points/polygons.h"
#include "tests/support/drilled_plate.h"
#include "tests/support/sanitized.h"
#include "tests/support/surfaces.h"

using namespace geodesic;
using namespace geodesic::test;

namespace {

// But not every third vertex, unless it is a corner.
struct Some final : AllKnown {
    explicit Some(const std::array<uint32_t, 3>& corners) : corners(corners) {}
    bool is_known(uint32_t vertex) const {
        return vertex % 3 != 0 || std::ranges::find(corners, vertex) != corners.end();
    }
    uint32_t number_of(uint32_t vertex) const override { return is_known(vertex) ? vertex : NONE; }
    std::array<uint32_t, 3> corners;
};

struct Nothing final : AllKnown {
    bool go_on(uint32_t, uint32_t, double) const override { return false; }
};

Surface surface_of_flipped(const Soup& soup) {
    Intake intake = intake_of(soup);
    FlatFaces flat(flip_flat_edges(intake.mesh));
    return Surface(std::move(intake), {}, std::move(flat));
}

// Heights at random, so that most edges are ridges or valleys.
Soup rough_terrain() {
    Soup soup = grid(14, 14, 14, 14);
    std::mt19937_64 random(6);
    for (Eigen::Vector3d& at : soup.positions) at.z() = uniform(random, 0, 3);
    return soup;
}

// Panels side by side on the x axis, in the given directions.
Soup panels(std::initializer_list<double> turns) {
    constexpr uint32_t LONG = 6, WIDE = 3;
    Soup soup;
    for (uint32_t i = 0; i <= LONG; ++i) soup.positions.push_back({double(i), 0, 0});
    for (const double turn : turns) {
        const auto first = static_cast<uint32_t>(soup.positions.size());
        for (uint32_t j = 1; j <= WIDE; ++j)
            for (uint32_t i = 0; i <= LONG; ++i)
                soup.positions.push_back({double(i), j * std::cos(turn), j * std::sin(turn)});
        const auto at = [&](uint32_t i, uint32_t j) { return j == 0 ? i : first + (j - 1) * (LONG + 1) + i; };
        for (uint32_t j = 0; j < WIDE; ++j)
            for (uint32_t i = 0; i < LONG; ++i) {
                soup.triangles.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1)});
                soup.triangles.push_back({at(i, j), at(i + 1, j + 1), at(i, j + 1)});
            }
    }
    return soup;
}

std::vector<double> distances_of(const FacePoint& point, const std::function<double(uint32_t)>& distance) {
    std::vector<double> distances;
    for (uint32_t k = 0; k < point.vertex_count; ++k) distances.push_back(distance(point.numbers[k]));
    return distances;
}

}

TEST_CASE("seen faces: in a plane everything is where it is") {
    const Surface surface = surface_of_flipped(jittered_grid(16, 3));
    std::mt19937_64 random(1);
    uint32_t far = 0, near = 0;
    for (size_t i = 0; i < 300; ++i) {
        CAPTURE(i);
        const SurfacePoint at = random_point(surface, random, i);
        const Polygon seen = look(surface, at);
        const Eigen::Vector3d origin = position_of(surface, at);
        for (uint32_t k = 0; k < seen.point.vertex_count; ++k)
            if (seen.point.straight[k] < UNREACHABLE)
                CHECK(seen.point.straight[k] ==
                      doctest::Approx((surface.positions[seen.point.numbers[k]] - origin).norm()));
        for (uint32_t v = 0; v < surface.vertex_count(); v += 7) {
            const auto from = distances_of(seen.point, [&](uint32_t number) {
                return (surface.positions[number] - surface.positions[v]).norm();
            });
            // Vertices that the polygon has inside or on its far side are not behind its edges.
            const double straight = (surface.positions[v] - origin).norm();
            if (straight < 0.5) continue;
            CHECK(distance_over(seen.point, from) == doctest::Approx(straight).epsilon(1e-9));
            ++far;
        }
        for (size_t j = 0; j < 20; ++j) {
            const SurfacePoint other = random_point(surface, random, j);
            const double straight = seen.faces.straight_to(surface, other);
            if (straight == UNREACHABLE) continue;
            CHECK(straight == doctest::Approx((position_of(surface, other) - origin).norm()));
            ++near;
        }
    }
    CHECK(far > 3000);
    CHECK(near > 50);
}

TEST_CASE("seen faces: the polygon goes all around, has room for more, and ends where the surface does") {
    const Surface surface = surface_of_flipped(bumpy_sphere(3, 4));
    const Surface sheet = surface_of_flipped(jittered_grid(4, 5));
    std::mt19937_64 random(2);
    double least = INFINITE;
    for (size_t i = 0; i < 200; ++i) {
        CAPTURE(i);
        const size_t most = i % 2 == 0 ? 16 : FacePoint::MOST_VERTICES;
        const Polygon seen = look(surface, random_point(surface, random, i), AllKnown(), most);
        CHECK(angle_seen(seen.point) == doctest::Approx(2 * std::numbers::pi));
        CHECK(seen.point.vertex_count == most);
        const double on_sheet = angle_seen(look(sheet, random_point(sheet, random, i)).point);
        CHECK(on_sheet <= 2 * std::numbers::pi + 1e-9);
        least = std::min(least, on_sheet);
    }
    CHECK(least < std::numbers::pi);
}

TEST_CASE("seen faces: over edges of several faces all of these are seen, as if each were the only one") {
    const Soup soup = panels({0, 1, 2.5, 4});
    const Surface surface = surface_of_flipped(soup);
    std::mt19937_64 random(4);
    const uint32_t of_panel = static_cast<uint32_t>(soup.triangles.size() / 4);
    const auto flat = [&](uint32_t panel, const SurfacePoint& point) { // unfolded onto the side of that panel
        const Eigen::Vector3d at = position_of(surface, point);
        return Eigen::Vector2d(at.x(), std::hypot(at.y(), at.z()) * (panel == 0 ? -1 : 1));
    };
    std::array<uint32_t, 4> seen_in{};
    for (size_t i = 0; i < 200; ++i) {
        CAPTURE(i);
        SurfacePoint at = random_point(surface, random, 0);
        at.face = static_cast<uint32_t>(random() % (2 * 6)); // of the first panel, beside the edge
        const SeenFaces seen = see_around(surface, at, FacePoint::MOST_VERTICES).faces;
        for (size_t j = 0; j < 40; ++j) {
            const SurfacePoint other = random_point(surface, random, j);
            const double straight = seen.straight_to(surface, other);
            if (straight == UNREACHABLE) continue;
            const uint32_t panel = other.face / of_panel;
            CHECK(straight == doctest::Approx((flat(panel, other) - flat(0, at)).norm()));
            ++seen_in[panel];
        }
        // The polygon has vertices of all panels.
        const Polygon polygon = look(surface, at, AllKnown(), 32);
        std::array<uint32_t, 4> vertices{};
        for (uint32_t k = 0; k < polygon.point.vertex_count; ++k)
            if (polygon.point.numbers[k] > 6) ++vertices[(polygon.point.numbers[k] - 7) / (3 * 7)];
        for (const uint32_t count : vertices) CHECK(count > 0);
    }
    for (const uint32_t count : seen_in) CHECK(count > 200);
}

// And not more of them than there is room for.
TEST_CASE("seen faces: edges of many faces end what is seen, and may be all that there are") {
    for (const size_t count : {5u, 6u}) {
        const Soup soup = count == 5 ? panels({0, 1, 2, 3, 4}) : panels({0, 1, 2, 3, 4, 5});
        const Surface surface = surface_of_flipped(soup);
        std::mt19937_64 random(5);
        const uint32_t of_panel = static_cast<uint32_t>(soup.triangles.size() / count);
        std::vector<uint32_t> seen_in(count);
        for (size_t i = 0; i < 50; ++i) {
            SurfacePoint at = random_point(surface, random, 0);
            at.face = static_cast<uint32_t>(random() % (2 * 6));
            const SeenFaces seen = see_around(surface, at, FacePoint::MOST_VERTICES).faces;
            for (const SeenFaces::Face& face : std::span(seen.faces).first(seen.count))
                ++seen_in[face.face / of_panel];
        }
        for (size_t panel = 1; panel < count; ++panel) CHECK((seen_in[panel] > 0) == (count == 5));
    }
    // Three planes through each vertex, so that all edges have four faces.
    Soup cells;
    constexpr uint32_t SIDE = 4;
    const auto id = [](uint32_t x, uint32_t y, uint32_t z) { return (x * (SIDE + 1) + y) * (SIDE + 1) + z; };
    for (uint32_t i = 0; i < (SIDE + 1) * (SIDE + 1) * (SIDE + 1); ++i)
        cells.positions.push_back({double(i / (SIDE + 1) / (SIDE + 1)), double(i / (SIDE + 1) % (SIDE + 1)),
                                   double(i % (SIDE + 1))});
    for (uint32_t w = 0; w <= SIDE; ++w)
        for (uint32_t a = 0; a < SIDE; ++a)
            for (uint32_t b = 0; b < SIDE; ++b)
                for (const uint32_t axis : {0u, 1u, 2u}) {
                    const auto at = [&](uint32_t i, uint32_t j) {
                        return axis == 0 ? id(w, i, j) : axis == 1 ? id(i, w, j) : id(i, j, w);
                    };
                    cells.triangles.push_back({at(a, b), at(a + 1, b), at(a + 1, b + 1)});
                    cells.triangles.push_back({at(a, b), at(a + 1, b + 1), at(a, b + 1)});
                }
    const Surface surface = surface_of_flipped(cells);
    std::mt19937_64 random(6);
    for (size_t i = 0; i < 100; ++i)
        for (const size_t most : {size_t{16}, size_t{32}, FacePoint::MOST_VERTICES}) {
            const Polygon seen = look(surface, random_point(surface, random, i), AllKnown(), most);
            CHECK(seen.point.vertex_count > 8);
            CHECK(seen.point.vertex_count <= most);
            CHECK(seen.point.edge_count <= FacePoint::MOST_EDGES);
        }
}

// A needle with a side of 1e-9, and a face beyond a long side.
TEST_CASE("seen faces: whether a face is too flat does not depend on its first corner") {
    for (const double width : {1e-9, 1e-3}) {
        Soup soup;
        soup.positions = {{0, 0, 0}, {width, 0, 0}, {0, 1, 0}, {1, 1, 0}};
        for (uint32_t first = 0; first < 3; ++first) {
            soup.triangles = {{first, (first + 1) % 3, (first + 2) % 3}, {1, 3, 2}};
            const SeenAround around = see_around(surface_of(soup), {0, {0.4, 0.3, 0.3}}, 32);
            CHECK((around.vertex_count > 0) == (width > 1e-6));
        }
    }
}

TEST_CASE("seen faces: nothing is seen that is not known") {
    const Surface surface = surface_of_flipped(bumpy_sphere(3, 4));
    std::mt19937_64 random(3);
    for (size_t i = 0; i < 100; ++i) {
        CAPTURE(i);
        const SurfacePoint at = random_point(surface, random, i);
        const Some some(surface.faces[at.face]);
        const Polygon seen = look(surface, at, some);
        for (uint32_t k = 0; k < seen.point.vertex_count; ++k) CHECK(some.is_known(seen.point.numbers[k]));
        CHECK(look(surface, at, Nothing()).point.vertex_count == 3);
    }
}

// Lines over the wall of a hole may come up to its rim again, and are longer than those in the plane.
TEST_CASE("seen faces: of planes that are cut into slivers the flipped faces are seen") {
    constexpr size_t MOST = 16;
    const Surface surface = surface_of_flipped(drilled_plate(3, 12, 0.1));
    std::mt19937_64 random(5);
    uint32_t flipped = 0, vertices_in_plane = 0, points_in_plane = 0;
    for (size_t i = 0; i < 400; ++i) {
        CAPTURE(i);
        const SurfacePoint on_mesh = random_point(surface, random, i);
        const auto at = indexed_point(surface, on_mesh);
        REQUIRE(at);
        const Eigen::Vector3d origin = position_of(surface, on_mesh);
        const Polygon seen = look(surface, *at, AllKnown(), MOST);
        CHECK(seen.point.vertex_count == MOST);
        CHECK(angle_seen(seen.point) == doctest::Approx(2 * std::numbers::pi));
        if (!surface.flat_faces.has(on_mesh.face)) continue;
        ++flipped;
        const auto is_level = [&](const Eigen::Vector3d& position) { return position.z() == origin.z(); };
        for (uint32_t k = 0; k < seen.point.vertex_count; ++k) {
            const Eigen::Vector3d vertex = surface.positions[seen.point.numbers[k]];
            if (!is_level(vertex)) continue;
            const double straight = (vertex - origin).norm();
            CHECK(seen.point.straight[k] > straight * (1 - 1e-9));
            vertices_in_plane += seen.point.straight[k] < straight * (1 + 1e-9);
        }
        for (size_t j = 0; j < 40; ++j) {
            const SurfacePoint other = random_point(surface, random, j);
            const double straight = seen.faces.straight_to(surface, other);
            const double in_plane = straight_in_plane(surface, on_mesh, other);
            if (straight == UNREACHABLE || in_plane == UNREACHABLE) continue;
            CHECK(straight == doctest::Approx(in_plane));
            ++points_in_plane;
        }
    }
    CHECK(flipped > 100);
    CHECK(vertices_in_plane > flipped * MOST / 2);
    CHECK(points_in_plane > 100);
}

// By exact distances of the vertices, so that nothing but the polygon makes the error.
TEST_CASE("seen faces: on rough surfaces a polygon tells far more than its face" * doctest::skip(SANITIZED)) {
    for (const Soup& soup : {bumpy_sphere(2, 5), cube(4), rough_terrain()}) {
        const Surface surface = surface_of_flipped(soup);
        const PathCase on(soup);
        std::mt19937_64 random(4);
        double by_face = 0, by_polygon = 0;
        for (size_t i = 0; i < 30; ++i) {
            CAPTURE(i);
            const SurfacePoint at = ::random_point(surface, random, i);
            geoidx_surface_point source{at.face, 0, {at.weights[0], at.weights[1], at.weights[2]}};
            const Polygon seen = look(surface, at);
            const auto exact = on.exact_field(source);
            std::vector<std::vector<double>> from(seen.point.vertex_count);
            for (uint32_t k = 0; k < seen.point.vertex_count; ++k)
                from[k] = on.exact_field(on.at_vertex(seen.point.numbers[k]));
            for (uint32_t v = 0; v < soup.vertex_count(); ++v) {
                std::vector<double> distances;
                for (const auto& field : from) distances.push_back(field[v]);
                by_polygon += std::abs(distance_over(seen.point, distances) / exact[v] - 1);
                by_face += std::abs(distance_over(seen.alone, distances) / exact[v] - 1);
            }
            for (size_t j = 0; j < 20; ++j) {
                const SurfacePoint to = ::random_point(surface, random, j);
                geoidx_surface_point target{to.face, 0, {to.weights[0], to.weights[1], to.weights[2]}};
                CHECK(seen.faces.straight_to(surface, to) >= on.exact(source, target) * (1 - 1e-9));
            }
        }
        CHECK(by_polygon < by_face / 2);
    }
}
