// Rooms whose walls, with windows, are those of their neighbours: three and four triangles meet at edges.
#include <cmath>
#include <map>
#include <tuple>

#include <doctest/doctest.h>

#include "tests/support/handles.h"
#include "tests/support/meshes.h"
#include "tests/support/sanitized.h"

using namespace geodesic::test;
using Eigen::Vector3d;

namespace {

class Rooms {
public:
    Rooms(uint32_t wide, uint32_t deep, uint32_t high, uint64_t seed) : random_(seed) {
        const Vector3d x(4, 0, 0), y(0, 3, 0), z(0, 0, 2.5);
        for (uint32_t i = 0; i <= wide; ++i)
            for (uint32_t j = 0; j <= deep; ++j)
                for (uint32_t k = 0; k <= high; ++k) {
                    const Vector3d at = i * x + j * y + k * z;
                    if (j < deep && k < high) add_wall(at, y, z);
                    if (i < wide && k < high) add_wall(at, x, z);
                    if (i < wide && j < deep) add_wall(at, x, y);
                }
    }

    Soup soup;

private:
    uint32_t vertex_at(const Vector3d& at) {
        const auto next = static_cast<uint32_t>(soup.positions.size());
        const auto [found, is_new] = numbers_.try_emplace({at.x(), at.y(), at.z()}, next);
        if (is_new) soup.positions.push_back(at);
        return found->second;
    }

    // Three of five walls have a window.
    void add_wall(const Vector3d& at, const Vector3d& a, const Vector3d& b) {
        constexpr double SIZE = 0.3;
        const std::array<uint32_t, 4> corners{vertex_at(at), vertex_at(at + a), vertex_at(at + a + b),
                                              vertex_at(at + b)};
        if (uniform(random_, 0, 1) > 0.6) {
            soup.triangles.push_back({corners[0], corners[1], corners[2]});
            soup.triangles.push_back({corners[0], corners[2], corners[3]});
            return;
        }
        const double s = uniform(random_, 0.15, 0.5), t = uniform(random_, 0.15, 0.5);
        const Vector3d low = at + s * a + t * b;
        const std::array<uint32_t, 4> window{vertex_at(low), vertex_at(low + SIZE * a),
                                             vertex_at(low + SIZE * (a + b)), vertex_at(low + SIZE * b)};
        for (size_t k = 0; k < 4; ++k) {
            const size_t next = (k + 1) % 4;
            soup.triangles.push_back({corners[k], corners[next], window[next]});
            soup.triangles.push_back({corners[k], window[next], window[k]});
        }
    }

    std::mt19937_64 random_;
    std::map<std::tuple<double, double, double>, uint32_t> numbers_;
};

}

// An end may see the middle of a segment alone, so that its distances to the ends of the segment do not tell
// where it lies.
TEST_CASE("shared walls: pairs are as far apart as the metric says" * doctest::skip(SANITIZED)) {
    const Rooms rooms(6, 4, 2, 22);
    const geoidx_mesh mesh = view_of(rooms.soup);
    geoidx* index = nullptr;
    geoidx_solver* solver = nullptr;
    REQUIRE(geoidx_build(&mesh, nullptr, &index) == GEOIDX_OK);
    const IndexHandle owns_index(index);
    REQUIRE(geoidx_solver_create(&mesh, nullptr, &solver) == GEOIDX_OK);
    const SolverHandle owns_solver(solver);
    std::vector<double> exact(rooms.soup.vertex_count());
    for (uint32_t source = 0; source < rooms.soup.vertex_count(); ++source) {
        CAPTURE(source);
        REQUIRE(geoidx_solver_distances(solver, &source, 1, nullptr, rooms.soup.vertex_count(),
                                        exact.data()) == GEOIDX_OK);
        for (uint32_t target = source + 1; target < rooms.soup.vertex_count(); ++target) {
            CAPTURE(target);
            float distance = 0;
            REQUIRE(geoidx_sssd(index, source, target, &distance) == GEOIDX_OK);
            CHECK(double{distance} == doctest::Approx(exact[target]).epsilon(0.05));
            float back = 0;
            REQUIRE(geoidx_sssd(index, target, source, &back) == GEOIDX_OK);
            CHECK(back == distance);
        }
    }
}
