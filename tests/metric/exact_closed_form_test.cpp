// Exact distances where a formula is known.
#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>

#include <Eigen/Geometry>
#include <doctest/doctest.h>

#include "src/metric/window_propagation.h"
#include "tests/support/meshes.h"
#include "tests/support/oracles.h"
#include "tests/support/sanitized.h"

using namespace geodesic;
using namespace geodesic::test;
using Eigen::Vector3d;

namespace {

using Formula = std::function<double(uint32_t source, uint32_t target)>;

// The largest relative error over all targets of the given sources.
double worst_error(const Mesh& mesh, std::span<const uint32_t> sources, const Formula& formula) {
    const auto solver = ExactMetric(mesh).make_solver();
    double worst = 0;
    for (uint32_t source : sources) {
        std::vector<double> expected(mesh.vertex_count());
        for (uint32_t v = 0; v < mesh.vertex_count(); ++v) expected[v] = formula(source, v);
        worst = std::max(worst, largest_relative_difference(field(mesh, *solver, {&source, 1}), expected));
    }
    return worst;
}

// Every `step`-th vertex, the first and the last among them.
std::vector<uint32_t> some_sources(const Mesh& mesh, uint32_t step) {
    std::vector<uint32_t> sources;
    for (uint32_t v = 0; v < mesh.vertex_count(); v += step) sources.push_back(v);
    sources.push_back(mesh.vertex_count() - 1);
    return sources;
}

Formula straight_line(const Mesh& mesh) {
    return [&](uint32_t a, uint32_t b) { return (mesh.positions[a] - mesh.positions[b]).norm(); };
}

double cross(const Vector3d& a, const Vector3d& b) { return a.x() * b.y() - a.y() * b.x(); }

// ---- The cube, by unfolding every sequence of faces

struct CubeFace {
    Vector3d normal;
    double offset; // normal . p of its points

    bool holds(const Vector3d& p) const { return std::abs(normal.dot(p) - offset) < 1e-12; }
};

std::vector<CubeFace> cube_faces() {
    std::vector<CubeFace> faces;
    for (int axis = 0; axis < 3; ++axis)
        for (double sign : {-1.0, 1.0}) faces.push_back({sign * Vector3d::Unit(axis), sign > 0 ? 1.0 : 0.0});
    return faces;
}

// Walks over all sequences of different faces from one that holds the source, with each face turned into
// the first one's plane, and measures the straight lines that stay on the sequence.
class CubeUnfolding {
public:
    CubeUnfolding(const Vector3d& source, const Vector3d& target) : source_(source), target_(target) {
        for (size_t f = 0; f < faces_.size(); ++f)
            if (faces_[f].holds(source)) {
                normal_ = faces_[f].normal;
                visit(f, Eigen::Isometry3d::Identity());
            }
    }

    double shortest() const { return shortest_; }

private:
    struct Door {
        Vector3d from, to;
    };

    void visit(size_t face, const Eigen::Isometry3d& unfolded) {
        if (faces_[face].holds(target_)) measure(unfolded * target_);
        used_[face] = true;
        for (size_t next = 0; next < faces_.size(); ++next) {
            if (used_[next] || faces_[next].normal.dot(faces_[face].normal) != 0) continue;
            // Their common edge, and the turn around it that lays `next` beside `face`.
            const Vector3d along = faces_[face].normal.cross(faces_[next].normal).cwiseAbs();
            Vector3d from = Vector3d::Zero();
            for (size_t f : {face, next}) from += faces_[f].normal * faces_[f].offset;
            const Eigen::Quaterniond turn =
                Eigen::Quaterniond::FromTwoVectors(faces_[next].normal, faces_[face].normal);
            const Eigen::Isometry3d step =
                Eigen::Translation3d(from) * turn * Eigen::Translation3d(Vector3d(-from));
            doors_.push_back({unfolded * from, unfolded * Vector3d(from + along)});
            visit(next, unfolded * step);
            doors_.pop_back();
        }
        used_[face] = false;
    }

    void measure(const Vector3d& image) {
        for (const Door& door : doors_) {
            // Where the line crosses the door, in shares of the door.
            const Vector3d way = image - source_, along = door.to - door.from;
            const double denominator = normal_.dot(way.cross(along));
            if (std::abs(denominator) < 1e-12) {
                // Along the door: fine if it is on it.
                if (std::abs(normal_.dot(along.cross(source_ - door.from))) > 1e-9) return;
                continue;
            }
            const double share = normal_.dot(way.cross(source_ - door.from)) / denominator;
            if (share < -1e-9 || share > 1 + 1e-9) return;
        }
        shortest_ = std::min(shortest_, (image - source_).norm());
    }

    const std::vector<CubeFace> faces_ = cube_faces();
    Vector3d source_, target_, normal_;
    std::array<bool, 6> used_{};
    std::vector<Door> doors_;
    double shortest_ = UNREACHABLE;
};

// ---- Cones, unrolled

// The angle from the first ray to each, around the apex; the last entry is the whole turn.
std::vector<double> unrolled_angles(std::span<const Vector3d> rays) {
    std::vector<double> angles{0};
    for (size_t i = 0; i < rays.size(); ++i) {
        const Vector3d &a = rays[i], &b = rays[(i + 1) % rays.size()];
        angles.push_back(angles.back() + std::atan2(a.cross(b).norm(), a.dot(b)));
    }
    return angles;
}

Formula cone_formula(const Mesh& mesh, std::span<const Vector3d> rays) {
    return [&mesh, angles = unrolled_angles(rays), count = rays.size()](uint32_t s, uint32_t t) {
        const double a = mesh.positions[s].norm(), b = mesh.positions[t].norm();
        if (s == 0 || t == 0) return a + b;
        const double apart = std::abs(angles[(s - 1) % count] - angles[(t - 1) % count]);
        const double angle = std::min(apart, angles.back() - apart);
        if (angle >= std::numbers::pi) return a + b;
        // a^2 + b^2 - 2 a b cos(angle), without cancellation.
        const double half = std::sin(angle / 2);
        return std::sqrt((a - b) * (a - b) + 4 * a * b * half * half);
    };
}

}

TEST_CASE("exact: edges of three triangles, a square with two fins unfolds for every pair") {
    const Mesh mesh = mesh_of(comb(2));
    const auto formula = [&](uint32_t a, uint32_t b) {
        const Vector3d &p = mesh.positions[a], &q = mesh.positions[b];
        const double along = std::abs(p.x() - q.x());
        // Points of one fin see each other; all other paths go down to the square and up again.
        const double across = along < 1e-9 ? std::abs(p.z() - q.z()) : along + p.z() + q.z();
        return std::hypot(across, p.y() - q.y());
    };
    CHECK(worst_error(mesh, some_sources(mesh, 7), formula) < 1e-12);
}

TEST_CASE("exact, plane: a regular grid, every vertex as source") {
    const Mesh mesh = mesh_of(grid(12, 9, 12, 9));
    CHECK(worst_error(mesh, some_sources(mesh, 1), straight_line(mesh)) < 1e-9);
}

TEST_CASE("exact, plane: larger grids, square and stretched") {
    for (const Soup& soup : {grid(60, 60, 1, 1), grid(60, 30, 1000, 1), grid(30, 60, 1, 0.7)}) {
        const Mesh mesh = mesh_of(soup);
        CHECK(worst_error(mesh, some_sources(mesh, 333), straight_line(mesh)) < 1e-9);
    }
}

TEST_CASE("exact, plane: jittered grids with diagonals at random") {
    for (uint64_t seed = 1; seed <= 5; ++seed) {
        const Mesh mesh = mesh_of(jittered_grid(25, seed));
        CHECK(worst_error(mesh, some_sources(mesh, 97), straight_line(mesh)) < 1e-9);
    }
}

TEST_CASE("exact, plane: Delaunay triangulations of random points") {
    for (uint64_t seed = 1; seed <= 5; ++seed) {
        const Soup soup = delaunay_square(400, seed);
        // Euler: a triangulated square with n inner and 4 boundary vertices has 2 n + 2 triangles.
        REQUIRE(soup.triangles.size() == 802);
        const Mesh mesh = mesh_of(soup);
        CHECK(worst_error(mesh, some_sources(mesh, 45), straight_line(mesh)) < 1e-9);
    }
}

TEST_CASE("exact, plane: far from the origin, distances are those of the rounded positions") {
    Soup soup = jittered_grid(12, 8);
    for (auto& p : soup.positions) p += Vector3d(1e4, -2e4, 0);
    const Mesh mesh = mesh_of(soup);
    CHECK(worst_error(mesh, some_sources(mesh, 23), straight_line(mesh)) < 1e-9);
}

TEST_CASE("exact, plane: faces without area, as fillers of T-junctions are, are walked through") {
    // Above the line y = 0 a fan over four short edges, below it one long edge, in between faces in the line,
    // one and several on top of each other.
    Soup one;
    one.positions = {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {0.5, 1, 0}, {1.5, 1, 0}, {1, -1, 0}};
    one.triangles = {{0, 1, 3}, {1, 4, 3}, {1, 2, 4}, {0, 2, 1}, {0, 5, 2}};
    Soup several;
    several.positions = {{0, 0, 0}, {1, 0, 0}, {2, 0, 0},  {3, 0, 0},
                         {4, 0, 0}, {2, 1, 0}, {2, -1, 0}, {2, -2, 0}};
    several.triangles = {{0, 1, 5}, {1, 2, 5}, {2, 3, 5}, {3, 4, 5}, {0, 2, 1},
                         {0, 3, 2}, {0, 4, 3}, {0, 6, 4}, {0, 7, 6}, {4, 6, 7}};
    Soup crossed = several; // the same line, its faces in another order
    crossed.triangles[4] = {1, 3, 2};
    crossed.triangles[5] = {1, 4, 3};
    crossed.triangles[6] = {0, 4, 1};
    for (const Soup& soup : {one, several, crossed})
        for (double angle : {0.0, 0.4, 1.3}) { // turned, the faces have an area of some roundings
            Soup turned = soup;
            for (auto& p : turned.positions) p = Eigen::AngleAxisd(angle, Vector3d(1, 2, 3).normalized()) * p;
            const Mesh mesh = mesh_of(turned);
            CAPTURE(angle);
            CHECK(worst_error(mesh, some_sources(mesh, 1), straight_line(mesh)) < 1e-6);
        }
}

TEST_CASE("exact, plane with a reflex corner: paths go around it") {
    const Vector3d corner(1, 1, 0);
    for (const uint32_t cells : {1u, 4u, 11u}) {
        const Mesh mesh = mesh_of(l_shape(cells));
        const Formula formula = [&](uint32_t s, uint32_t t) {
            const Vector3d &a = mesh.positions[s], &b = mesh.positions[t];
            // The corner blocks the line from above the diagonal arm to the right one if it lies below it.
            const bool opposite = (a.x() <= 1 && b.y() <= 1) || (b.x() <= 1 && a.y() <= 1);
            const Vector3d& top = a.y() > b.y() ? a : b;
            const Vector3d& right = a.y() > b.y() ? b : a;
            const bool blocked =
                opposite && top.y() > 1 && right.x() > 1 && cross(right - top, corner - top) < 0;
            return blocked ? (a - corner).norm() + (b - corner).norm() : (a - b).norm();
        };
        CHECK(worst_error(mesh, some_sources(mesh, cells), formula) < 1e-9);
    }
}

TEST_CASE("exact, cube: all pairs, against all unfoldings" * doctest::skip(SANITIZED)) {
    for (const uint32_t cells : {1u, 2u, 3u, 5u}) {
        const Mesh mesh = mesh_of(cube(cells));
        const Formula formula = [&](uint32_t s, uint32_t t) {
            return CubeUnfolding(mesh.positions[s], mesh.positions[t]).shortest();
        };
        CHECK(worst_error(mesh, some_sources(mesh, cells), formula) < 1e-9);
    }
    // The oracle itself: opposite corners are sqrt(5) apart, centres of opposite faces 2.
    CHECK(CubeUnfolding({0, 0, 0}, {1, 1, 1}).shortest() == doctest::Approx(std::sqrt(5.0)).epsilon(1e-14));
    CHECK(CubeUnfolding({0.5, 0.5, 0}, {0.5, 0.5, 1}).shortest() == doctest::Approx(2.0).epsilon(1e-14));
}

TEST_CASE("exact, cones: less than a full turn around the apex") {
    for (const double slope : {0.2, 0.7, 1.2, 1.5})
        for (const uint32_t count : {3u, 8u, 24u}) {
            const auto rays = cone_rays(count, slope);
            REQUIRE(unrolled_angles(rays).back() < 2 * std::numbers::pi);
            const Mesh mesh = mesh_of(cone(rays, 6));
            CAPTURE(slope);
            CAPTURE(count);
            CHECK(worst_error(mesh, some_sources(mesh, 5), cone_formula(mesh, rays)) < 1e-9);
        }
}

TEST_CASE("exact, flat cone: exactly a full turn") {
    for (const uint32_t count : {6u, 8u, 12u}) {
        const auto rays = cone_rays(count, 0);
        const Mesh mesh = mesh_of(cone(rays, 7));
        CHECK(worst_error(mesh, some_sources(mesh, 3), straight_line(mesh)) < 1e-9);
    }
}

TEST_CASE("exact, saddle cones: more than a full turn, paths bend at the apex") {
    for (const double slope : {0.2, 0.7, 1.2})
        for (const uint32_t count : {8u, 12u, 26u}) {
            const auto rays = saddle_rays(count, slope);
            REQUIRE(unrolled_angles(rays).back() > 2 * std::numbers::pi);
            const Mesh mesh = mesh_of(cone(rays, 6));
            CAPTURE(slope);
            CAPTURE(count);
            CHECK(worst_error(mesh, some_sources(mesh, 5), cone_formula(mesh, rays)) < 1e-9);
        }
}

TEST_CASE("exact, prism: unrolled, around either side") {
    for (const uint32_t sides : {3u, 5u, 16u}) {
        const Mesh mesh = mesh_of(prism(sides, 8, 5));
        const Formula formula = [&](uint32_t s, uint32_t t) {
            const uint32_t apart = (s + sides - t % sides) % sides;
            const double across = std::min(apart, sides - apart); // sides are one wide
            return std::hypot(across, mesh.positions[s].z() - mesh.positions[t].z());
        };
        CHECK(worst_error(mesh, some_sources(mesh, 3), formula) < 1e-9);
    }
}

TEST_CASE("exact, two sheets that share a vertex: every path between them goes through it") {
    for (const uint32_t half : {1u, 3u, 6u}) {
        const Mesh mesh = mesh_of(pinched_sheets(half));
        const Formula formula = [&](uint32_t s, uint32_t t) {
            const Vector3d &a = mesh.positions[s], &b = mesh.positions[t];
            const bool same_sheet = (a.z() == 0 && b.z() == 0) || (a.z() > 0 && b.z() > 0);
            return same_sheet ? (a - b).norm() : a.norm() + b.norm();
        };
        CHECK(worst_error(mesh, some_sources(mesh, 1), formula) < 1e-9);
    }
}

TEST_CASE("exact, sheets stacked on one vertex, like the pages of a book on a point of its back") {
    // Five triangles that share vertex 0 only: five open fans.
    Soup soup;
    soup.positions.push_back({0, 0, 0});
    for (uint32_t i = 0; i < 5; ++i) {
        const double angle = 2 * std::numbers::pi * i / 5;
        for (double height : {0.5, 1.0}) {
            soup.positions.push_back({std::cos(angle), std::sin(angle), height});
        }
        soup.triangles.push_back({0, 2 * i + 1, 2 * i + 2});
    }
    const Mesh mesh = mesh_of(soup);
    const Formula formula = [&](uint32_t s, uint32_t t) {
        const bool same = s == 0 || t == 0 || (s - 1) / 2 == (t - 1) / 2;
        const Vector3d &a = mesh.positions[s], &b = mesh.positions[t];
        return same ? (a - b).norm() : a.norm() + b.norm();
    };
    CHECK(worst_error(mesh, some_sources(mesh, 1), formula) < 1e-9);
}
