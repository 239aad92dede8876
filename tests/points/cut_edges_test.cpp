// Edges of a point's polygon that are cut at vertices of the index between their ends.
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <set>
#include <utility>
#include <vector>

#include "src/capi/handles.h"
#include "src/overlay/fields/point_ways.h"
#include "src/points/face_points.h"
#include "tests/path/path_cases.h"
#include "tests/points/polygons.h"
#include "tests/support/sanitized.h"
#include "tests/support/surfaces.h"

using namespace geodesic;
using namespace geodesic::test;

namespace {

// No face behind that of the point, and so many vertices between the ends of each edge. Their numbers follow
// those of the surface's vertices.
class CutFace : public AllKnown {
public:
    CutFace(const Surface& surface, size_t per_edge) : per_edge_(per_edge), positions_(surface.positions) {}

    bool go_on(uint32_t, uint32_t, double) const override { return false; }
    // The same whenever it is asked for an edge.
    size_t find_between(uint32_t a, uint32_t b, double length,
                        std::span<VertexBetween> found) const override {
        if (per_edge_ > found.size()) return 0;
        const auto [first, is_new] =
            first_between_.try_emplace({a, b}, static_cast<uint32_t>(positions_.size()));
        for (uint32_t i = 0; i < per_edge_; ++i) {
            const double share =
                std::pow(static_cast<double>(i + 1) / static_cast<double>(per_edge_ + 1), 1.2);
            found[i] = {first->second + i, share * length};
            if (is_new) positions_.push_back((1 - share) * positions_[a] + share * positions_[b]);
        }
        return per_edge_;
    }
    const Eigen::Vector3d& position(uint32_t number) const { return positions_[number]; }

private:
    const size_t per_edge_;
    mutable std::vector<Eigen::Vector3d> positions_; // by number
    mutable std::map<std::pair<uint32_t, uint32_t>, uint32_t> first_between_;
};

// The distance of a target that the polygon knows from where its field is the least of two, each as if from a
// place in the plane and some way before that.
struct TwoWays {
    std::array<Eigen::Vector3d, 2> from;
    std::array<double, 2> before;

    double at(const Eigen::Vector3d& place) const {
        return std::min((place - from[0]).norm() + before[0], (place - from[1]).norm() + before[1]);
    }
};

double distance_by(const FacePoint& point, const CutFace& known, const TwoWays& ways) {
    std::vector<double> from_vertices;
    for (uint32_t k = 0; k < point.vertex_count; ++k)
        from_vertices.push_back(ways.at(known.position(point.numbers[k])));
    return distance_over(point, from_vertices);
}

Surface plane() { return surface_of(grid(3, 3, 3, 3)); }

// In a face that has others on all sides.
SurfacePoint point_inside(const Surface& surface, std::mt19937_64& random) {
    for (;;) {
        const SurfacePoint point = random_point(surface, random, 0);
        if (look(surface, point).alone.edge_count == 3) return point;
    }
}

Eigen::Vector3d place_at(std::mt19937_64& random, double radius) {
    const double turn = uniform(random, 0, 2 * std::numbers::pi);
    return {1.5 + radius * std::cos(turn), 1.5 + radius * std::sin(turn), 0};
}

}

TEST_CASE("cut edges: the parts see what the edges see, and straight lines over them are straight") {
    const Surface surface = plane();
    std::mt19937_64 random(1);
    for (size_t i = 0; i < 200; ++i) {
        CAPTURE(i);
        const SurfacePoint at = point_inside(surface, random);
        const CutFace known(surface, i % 8);
        const FacePoint point = look(surface, at, known).point;
        CHECK(point.vertex_count == 3 + 3 * (i % 8));
        CHECK(point.edge_count == 3 + 3 * (i % 8));
        CHECK(point.longest_edge == look(surface, at, AllKnown(), 3).point.longest_edge);
        CHECK(angle_seen(point) == doctest::Approx(2 * std::numbers::pi));
        const Eigen::Vector3d origin = position_of(surface, at);
        for (uint32_t k = 0; k < point.vertex_count; ++k)
            CHECK(point.straight[k] == doctest::Approx((known.position(point.numbers[k]) - origin).norm()));
        for (int j = 0; j < 20; ++j) {
            const Eigen::Vector3d target = place_at(random, 6);
            CHECK(distance_by(point, known, {{target, target}, {0, 0}}) ==
                  doctest::Approx((target - origin).norm()).epsilon(1e-9));
        }
    }
}

TEST_CASE("cut edges: where a field comes from two sides, they tell more of it") {
    const Surface surface = plane();
    std::mt19937_64 random(2);
    double whole = 0, in_two = 0, in_eight = 0;
    for (size_t i = 0; i < 2000; ++i) {
        const SurfacePoint at = point_inside(surface, random);
        const TwoWays ways{{place_at(random, 4), place_at(random, 4)}, {uniform(random, 0, 2), 0}};
        const double exact = ways.at(position_of(surface, at));
        const auto error = [&](size_t per_edge) {
            const CutFace known(surface, per_edge);
            return std::abs(distance_by(look(surface, at, known).point, known, ways) - exact);
        };
        whole += error(0);
        in_two += error(1);
        in_eight += error(7);
    }
    CHECK(whole > 2000 * 0.01);
    CHECK(in_two < 0.6 * whole);
    CHECK(in_eight < 0.1 * whole);
}

TEST_CASE("cut edges: where there is no room for all vertices, some of each edge are taken") {
    const Surface surface = plane();
    std::mt19937_64 random(3);
    for (const size_t per_edge : {41u, 42u, 43u, 50u, 64u}) {
        const SurfacePoint at = point_inside(surface, random);
        const CutFace known(surface, per_edge);
        const FacePoint point = look(surface, at, known).point;
        CAPTURE(per_edge);
        CHECK(point.vertex_count <= FacePoint::MOST_VERTICES);
        CHECK(point.vertex_count == 3 + 3 * (per_edge <= 41 ? per_edge : per_edge / 2));
        CHECK(angle_seen(point) == doctest::Approx(2 * std::numbers::pi));
        std::array<uint32_t, 3> parts{}; // the parts of an edge follow each other
        size_t edge = 0;
        for (uint32_t k = 0; k < point.edge_count; ++k) {
            ++parts[edge];
            if (point.edges[k].second < 3) ++edge;
        }
        for (const uint32_t count : parts) CHECK(count == point.edge_count / 3);
    }
    // More than can be asked for are left out.
    const SurfacePoint at = point_inside(surface, random);
    CHECK(look(surface, at, CutFace(surface, 65)).point.vertex_count == 3);
}

// Some of the vertices between the ends of edges are not seen then, and edges that are seen in part begin or
// end within a part.
TEST_CASE("cut edges: behind what is unfolded, straight lines over the parts are straight, too") {
    struct Cut final : CutFace {
        using CutFace::CutFace;
        bool go_on(uint32_t, uint32_t, double) const override { return true; }
    };
    const Surface surface = surface_of(jittered_grid(12, 3));
    std::mt19937_64 random(4);
    size_t hidden = 0, in_part = 0, far = 0;
    for (size_t i = 0; i < 100; ++i) {
        CAPTURE(i);
        const SurfacePoint at = random_point(surface, random, i);
        const Cut known(surface, 1 + i % 5);
        const FacePoint point = look(surface, at, known, 16).point;
        CHECK(angle_seen(point) == doctest::Approx(angle_seen(look(surface, at, AllKnown(), 16).point)));
        const Eigen::Vector3d origin = position_of(surface, at);
        for (uint32_t k = 0; k < point.vertex_count; ++k) {
            if (point.straight[k] == UNREACHABLE)
                ++hidden;
            else
                CHECK(point.straight[k] ==
                      doctest::Approx((known.position(point.numbers[k]) - origin).norm()));
        }
        for (const FacePoint::Edge& edge : std::span(point.edges).first(point.edge_count))
            in_part += edge.seen_from > 0 || edge.seen_to < edge.length;
        for (const Eigen::Vector3d& target : surface.positions) {
            const double straight = (target - origin).norm();
            if (straight < 0.5) continue;
            CHECK(distance_by(point, known, {{target, target}, {0, 0}}) ==
                  doctest::Approx(straight).epsilon(1e-9));
            ++far;
        }
    }
    CHECK(hidden > 20);
    CHECK(in_part > 20);
    CHECK(far > 1000);
}

TEST_CASE("cut edges: of an edge of several faces that end what is seen, the parts are there once") {
    Soup soup = grid(1, 1, 1, 1);
    soup.positions.push_back({0.5, 0.5, 1});
    soup.positions.push_back({0.5, 0.5, -1});
    const auto [a, b, c] = soup.triangles[0];
    for (uint32_t k = 0; k < 2; ++k)
        for (const auto& [first, second] : {std::pair(a, b), std::pair(b, c), std::pair(c, a)})
            soup.triangles.push_back({first, second, 4 + k});
    const Surface surface = surface_of(soup);
    const SurfacePoint at{0, {0.3, 0.3, 0.4}};
    const Polygon polygon = look(surface, at, CutFace(surface, 5));
    CHECK(polygon.point.vertex_count == 3 + 3 * 5);
    CHECK(polygon.point.edge_count == 3 + 3 * 5);
}

// Every added vertex lies on an edge of the surface between two leaves, and both have it there.
TEST_CASE("cut edges: the added vertices on the borders of leaves are found where they lie" *
          doctest::skip(SANITIZED)) {
    for (const Soup& soup : {closed_cylinder(128, 3), bumpy_sphere(3, 3), joined(cube(8), moebius(40, 4))}) {
        auto options = path_options();
        options.target_error = 1e-6;
        const PathCase on(soup, options);
        const Index& index = on.index->index;
        const auto& overlay = std::get<OverlayIndex>(index.engine);
        const Numbering& numbering = overlay.numbering;
        const Surface& surface = on.surface->surface;
        const auto place = [&](uint32_t number) -> Eigen::Vector3d {
            const auto& [x, y, z] = numbering.positions[number];
            return Eigen::Vector3d(x, y, z) * double{numbering.position_step};
        };
        std::vector<std::set<uint32_t>> leaves_with(numbering.vertex_count());
        for (uint32_t f = 0; f < surface.face_count(); ++f)
            for (size_t k = 0; k < 3; ++k) {
                const auto& face = indexed_corners(surface, f);
                const uint32_t a = number_of(index, surface, face[k]),
                               b = number_of(index, surface, face[(k + 1) % 3]);
                const double length =
                    (surface.positions[face[k]] - surface.positions[face[(k + 1) % 3]]).norm();
                for (uint32_t leaf = numbering.first_leaf(); leaf < numbering.patch_count(); ++leaf) {
                    std::array<VertexBetween, 64> found;
                    const auto count = find_on_border(overlay, leaf, a, b, length, found);
                    if (!count) continue;
                    REQUIRE(*count <= found.size());
                    double along = 0;
                    for (const VertexBetween& vertex : std::span(found).first(*count)) {
                        const double share = vertex.along / length;
                        const Eigen::Vector3d expected = (1 - share) * place(a) + share * place(b);
                        CHECK((place(vertex.number) - expected).norm() < 2 * double{numbering.position_step});
                        CHECK(vertex.along > along);
                        along = vertex.along;
                        leaves_with[vertex.number].insert(leaf);
                    }
                    CHECK(along < length);
                }
            }
        std::vector<bool> has_id(numbering.vertex_count(), false);
        for (const uint32_t number : index.number_of_id)
            if (number != NONE) has_id[number] = true;
        for (uint32_t number = 0; number < numbering.vertex_count(); ++number)
            CHECK((has_id[number] ? leaves_with[number].empty() : leaves_with[number].size() >= 2));
        CHECK(index.vertices_with_id < numbering.vertex_count());
    }
}
