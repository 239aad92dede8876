#include "src/partition/hierarchy.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <functional>
#include <map>
#include <memory>
#include <numeric>
#include <set>
#include <string>
#include <thread>
#include <utility>

#include <doctest/doctest.h>

#include "geoidx.h"
#include "src/mesh/components.h"
#include "src/metric/edge_graph.h"
#include "src/metric/fast_marching.h"
#include "src/metric/window_propagation.h"
#include "src/partition/split.h"
#include "src/tables/borders.h"
#include "tests/support/meshes.h"
#include "tests/support/oracles.h"
#include "tests/support/sanitized.h"

using namespace geodesic;
using namespace geodesic::test;

namespace {

using Faces = std::vector<uint32_t>;

struct Surface {
    std::string name;
    Soup soup;
};

Soup triangles(uint32_t count) {
    Soup soup = grid(1, 1, 1, 1);
    soup.triangles.resize(count);
    if (count == 1) soup.positions.pop_back(), soup.triangles[0] = {0, 1, 2};
    return soup;
}

std::vector<Surface> surfaces() {
    return {{"sphere", bumpy_sphere(3, 1)},
            {"torus", torus(30, 14, 2, 0.7)},
            {"thin torus", torus(60, 4, 3, 0.2)},
            {"grid", grid(20, 20, 1, 1)},
            {"tube", prism(8, 40, 30)},
            {"annulus", annulus(40, 5)},
            {"Moebius strip", moebius(40, 4)},
            {"components",
             joined(joined(sphere(2), torus(9, 7, 2, 0.5)), joined(triangles(1), grid(6, 6, 1, 1)))},
            {"pinched", pinched_sheets(6)},
            {"triangle", triangles(1)},
            {"two triangles", triangles(2)}};
}

// Of which lengths of edges are the square roots, as the builder has it.
std::shared_ptr<const Metric> root_metric(const Mesh& mesh) {
    std::vector<double> lengths = edge_lengths(mesh);
    for (double& length : lengths) length = std::sqrt(length);
    return std::make_shared<FastMarchingMetric>(mesh, lengths);
}

// ---- What a patch is judged by, found anew from nothing but the corners of faces

using Edge = std::array<uint32_t, 2>;

std::map<Edge, std::vector<uint32_t>> faces_at_edges(const Mesh& mesh, const Faces& faces) {
    std::map<Edge, std::vector<uint32_t>> faces_at;
    for (uint32_t f : faces)
        for (size_t k = 0; k < 3; ++k) {
            const uint32_t a = mesh.faces[f][k], b = mesh.faces[f][(k + 1) % 3];
            faces_at[{std::min(a, b), std::max(a, b)}].push_back(f);
        }
    return faces_at;
}

// Things by number, some of which are one.
class Groups {
public:
    uint32_t find(uint32_t i) {
        uint32_t& group = group_.try_emplace(i, i).first->second;
        return group == i ? i : group = find(group);
    }
    void join(uint32_t a, uint32_t b) { group_[find(a)] = find(b); }

private:
    std::map<uint32_t, uint32_t> group_;
};

bool edge_connected(const Mesh& mesh, const Faces& faces) {
    Groups groups;
    for (const auto& [edge, at] : faces_at_edges(mesh, faces))
        for (uint32_t f : at) groups.join(f, at.front());
    for (uint32_t f : faces)
        if (groups.find(f) != groups.find(faces.front())) return false;
    return !faces.empty();
}

Hierarchy build(const Mesh& mesh, std::vector<uint32_t> split, uint64_t seed = 1, uint32_t threads = 1) {
    const ExactMetric metric(mesh);
    Workers workers(metric, threads, {});
    return build_hierarchy(mesh, {std::move(split), 4, seed}, workers);
}

bool same(const Hierarchy& a, const Hierarchy& b) {
    return a.level_begin == b.level_begin && a.parent == b.parent && a.child_begin == b.child_begin &&
           a.leaf_of_face == b.leaf_of_face;
}

void check_numbering(const Hierarchy& h, size_t levels) {
    REQUIRE(h.level_begin.size() == levels + 2);
    REQUIRE(h.level_count() == levels);
    CHECK(h.level_begin[0] == 0);
    CHECK(h.level_begin[1] == 1);
    CHECK(h.level_begin.back() == h.patch_count());
    CHECK(h.parent[0] == NONE);
    REQUIRE(h.child_begin.size() == h.patch_count() + 1);
    for (uint32_t level = 0; level <= levels; ++level)
        for (uint32_t p = h.level_begin[level]; p < h.level_begin[level + 1]; ++p) {
            const uint32_t begin = h.child_begin[p], end = h.child_begin[p + 1];
            if (level == levels) {
                CHECK(begin == end);
                continue;
            }
            CHECK(begin < end);
            CHECK(begin >= h.level_begin[level + 1]);
            CHECK(end <= h.level_begin[level + 2]);
            for (uint32_t c = begin; c < end; ++c) CHECK(h.parent[c] == p);
        }
}

// The faces of every patch of every level, from the leaves upwards.
std::vector<Faces> faces_of_patches(const Hierarchy& h) {
    std::vector<Faces> faces(h.patch_count());
    for (uint32_t f = 0; f < h.leaf_of_face.size(); ++f)
        for (uint32_t p = h.leaf_of_face[f]; p != NONE; p = h.parent[p]) faces[p].push_back(f);
    return faces;
}

}

TEST_CASE("hierarchy: every face in one leaf, patches connected and nested" * doctest::skip(SANITIZED)) {
    for (const auto& [name, soup] : surfaces()) {
        const auto& surface_name = name; // clang 14 captures no structured binding
        CAPTURE(surface_name);
        const Mesh mesh = mesh_of(soup);
        for (const auto& split : {std::vector<uint32_t>{1}, {7}, {5, 4}, {3, 3, 3}, {2, 1, 6}, {1000, 3}}) {
            CAPTURE(split.size());
            CAPTURE(split[0]);
            const Hierarchy h = build(mesh, split);
            check_numbering(h, split.size());
            REQUIRE(h.leaf_of_face.size() == mesh.face_count());
            for (uint32_t leaf : h.leaf_of_face) {
                REQUIRE(leaf >= h.first_leaf());
                REQUIRE(leaf < h.patch_count());
            }
            const auto faces = faces_of_patches(h);
            for (uint32_t p = 1; p < h.patch_count(); ++p) CHECK(edge_connected(mesh, faces[p]));
        }
    }
}

TEST_CASE("hierarchy: about as many patches as asked for, of about the same size") {
    // Sections of the thin torus and of the tube have two border rings.
    for (const Soup& soup : {bumpy_sphere(4, 1), grid(30, 30, 1, 1), torus(50, 24, 2, 0.8),
                             torus(200, 6, 10, 0.3), prism(6, 200, 100)}) {
        const Mesh mesh = mesh_of(soup);
        const Hierarchy h = build(mesh, {12, 6});
        const uint32_t first = h.level_begin[2] - h.level_begin[1],
                       second = h.level_begin[3] - h.level_begin[2];
        CHECK(first >= 10);
        CHECK(first <= 12);
        CHECK(second >= 5 * first);
        CHECK(second <= 6 * first);
        const auto faces = faces_of_patches(h);
        for (uint32_t p = 1; p < h.level_begin[2]; ++p)
            CHECK(faces[p].size() <= 4 * mesh.face_count() / first); // Poisson disks: no giant among them
    }
}

TEST_CASE("hierarchy: the same for 1, 2 and 4 threads, another for another seed" * doctest::skip(SANITIZED)) {
    for (const auto& [name, soup] : surfaces()) {
        const auto& surface_name = name; // clang 14 captures no structured binding
        CAPTURE(surface_name);
        const Mesh mesh = mesh_of(soup);
        const Hierarchy one = build(mesh, {4, 4}, 5, 1);
        for (uint32_t threads : {1u, 2u, 4u}) CHECK(same(one, build(mesh, {4, 4}, 5, threads)));
        if (mesh.face_count() < 20) continue;
        CHECK(!same(one, build(mesh, {4, 4}, 6)));
        CHECK(!same(one, build(mesh, {4, 4}, 5 + (uint64_t{1} << 63)))); // all 64 bits count
    }
}

TEST_CASE("hierarchy: other metrics split, too, also with edges of no length") {
    const Mesh mesh = mesh_of(grid(12, 12, 1, 1));
    std::vector<double> cost = edge_lengths(mesh);
    for (size_t e = 0; e < cost.size(); e += 2) cost[e] = 0;
    for (const auto& costs : {edge_lengths(mesh), cost, std::vector<double>(cost.size(), 0.0)}) {
        const EdgeGraphMetric metric(mesh, costs);
        Workers workers(metric, 2, {});
        const Hierarchy h = build_hierarchy(mesh, {{5, 3}, 4, 1}, workers);
        check_numbering(h, 2);
        const auto faces = faces_of_patches(h);
        for (uint32_t p = 1; p < h.patch_count(); ++p) CHECK(edge_connected(mesh, faces[p]));
    }
}

TEST_CASE("hierarchy: a cancelled build ends with CANCELLED") {
    const Mesh mesh = mesh_of(bumpy_sphere(3, 1));
    const ExactMetric metric(mesh);
    Workers workers(metric, 2, [](double, const char*) { return false; });
    CHECK(failure_of([&] { build_hierarchy(mesh, {{8, 4}, 4, 1}, workers); }) == GEOIDX_ERROR_CANCELLED);
}

// The edge graph, with the numbers of its solvers and of their solves; before each solve it calls a function.
class CountedMetric final : public Metric {
public:
    explicit CountedMetric(
        const Mesh& mesh, std::function<void()> before_solve = [] {})
        : edges_(mesh, edge_lengths(mesh)), vertex_count_(mesh.vertex_count()),
          before_solve_(std::move(before_solve)) {}
    std::unique_ptr<FieldSolver> make_solver() const override {
        ++solvers;
        return std::make_unique<Solver>(*this);
    }

    mutable std::atomic<int> solvers = 0, solves = 0;

private:
    class Solver final : public FieldSolver {
    public:
        explicit Solver(const CountedMetric& metric)
            : FieldSolver(metric.vertex_count_), metric_(metric), edges_(metric.edges_.make_solver()) {}

    private:
        void run(const FieldRequest& request) override {
            ++metric_.solves;
            metric_.before_solve_();
            edges_->solve(request);
            for (const uint32_t v : edges_->reached()) improve(v, edges_->distance(v), edges_->nearest(v));
        }

        const CountedMetric& metric_;
        std::unique_ptr<FieldSolver> edges_;
    };

    const EdgeGraphMetric edges_;
    const uint32_t vertex_count_;
    const std::function<void()> before_solve_;
};

TEST_CASE("hierarchy: what splits large patches ends when the build is cancelled") {
    const Mesh mesh = mesh_of(grid(60, 50, 3, 1));
    REQUIRE(mesh.face_count() > HierarchyOptions::LARGE_PATCH);
    const ExactMetric metric(mesh);
    const auto solves = [&](const ProgressFunction& progress, std::function<void()> before_solve) {
        const auto rough = std::make_shared<CountedMetric>(mesh, std::move(before_solve));
        Workers workers(metric, 1, progress);
        const auto failure = failure_of([&] {
            build_hierarchy(mesh, {{8, 4}, 4, 1, {}, {}, rough}, workers);
        });
        CHECK(failure == (progress ? GEOIDX_ERROR_CANCELLED : GEOIDX_OK));
        return rough->solves.load();
    };
    const int all = solves({}, [] {});
    REQUIRE(all > 10);
    // Solves wait for a progress function that says no, and a little longer, so that workers know it.
    std::atomic<bool> is_refused = false;
    const auto refuse = [&](double, const char*) { return !(is_refused = true); };
    const auto wait = [&] {
        while (!is_refused) std::this_thread::yield();
        std::this_thread::sleep_for(std::chrono::milliseconds(10));
    };
    CHECK(solves(refuse, wait) < all / 2);
}

TEST_CASE("hierarchy: rough distances split large patches, and no others") {
    for (const Soup& soup : {bumpy_sphere(5, 1), torus(80, 40, 2, 0.8), grid(60, 50, 3, 1)}) {
        const Mesh mesh = mesh_of(soup);
        REQUIRE(mesh.face_count() > HierarchyOptions::LARGE_PATCH);
        const ExactMetric metric(mesh);
        const auto build_with = [&](std::shared_ptr<const Metric> rough, uint32_t threads) {
            Workers workers(metric, threads, {});
            return build_hierarchy(mesh, {{12, 6}, 4, 1, {}, {}, std::move(rough)}, workers);
        };
        const auto rough = std::make_shared<FastMarchingMetric>(mesh, edge_lengths(mesh));
        const Hierarchy h = build_with(rough, 1);
        CHECK(same(h, build_with(rough, 2)));
        check_numbering(h, 2);
        const uint32_t first = h.level_begin[2] - 1;
        CHECK(first >= 10);
        CHECK(first <= 12);
        const auto faces = faces_of_patches(h);
        for (uint32_t p = 1; p < h.patch_count(); ++p) CHECK(edge_connected(mesh, faces[p]));
        for (uint32_t p = 1; p <= first; ++p) CHECK(faces[p].size() <= 4 * mesh.face_count() / first);
        const auto counted = std::make_shared<CountedMetric>(mesh);
        build_with(counted, 2);
        CHECK(counted->solvers == 1); // the whole mesh; its patches are small
    }
}

TEST_CASE("hierarchy: roots of lengths split long and narrow triangles, where borders get much shorter" *
          doctest::skip(SANITIZED)) {
    const auto build_with = [](const Mesh& mesh, bool by_roots, uint32_t threads) {
        const ExactMetric metric(mesh);
        Workers workers(metric, threads, {});
        HierarchyOptions options{{5, 5}};
        if (by_roots) options.root_metric = root_metric(mesh);
        return build_hierarchy(mesh, options, workers);
    };
    const auto border_vertices = [](const Mesh& mesh, const Hierarchy& h) {
        const auto leaves = leaves_at_vertices(mesh, h);
        uint32_t count = 0;
        for (size_t v = 0; v < leaves.size(); ++v) count += leaves[v].size() > 1;
        return count;
    };
    for (const Soup& soup : {grid(200, 10, 200, 400), grid(12, 150, 12 * 60, 150)}) {
        const Mesh narrow = mesh_of(soup);
        const Hierarchy h = build_with(narrow, true, 1);
        check_numbering(h, 2);
        CHECK(same(h, build_with(narrow, true, 2)));
        const auto faces = faces_of_patches(h);
        for (uint32_t p = 1; p < h.patch_count(); ++p) CHECK(edge_connected(narrow, faces[p]));
        CHECK(10 * border_vertices(narrow, h) < 9 * border_vertices(narrow, build_with(narrow, false, 1)));
    }
    for (const Soup& soup : {bumpy_sphere(4, 1), torus(60, 30, 2, 0.8), grid(40, 30, 1, 1)}) {
        const Mesh round = mesh_of(soup);
        CHECK(same(build_with(round, true, 1), build_with(round, false, 1)));
    }
}

// The part that gets all seeds of one split and the part that gets them of the other need not be the same.
TEST_CASE("hierarchy: roots of lengths leave surfaces of several parts no fewer patches") {
    const Mesh mesh = mesh_of(joined(joined(grid(120, 6, 120, 240), grid(6, 120, 5, 5)), grid(9, 9, 100, 1)));
    const ExactMetric metric(mesh);
    Workers workers(metric, 1, {});
    for (uint64_t seed = 0; seed < 40; seed += sparse(1)) {
        HierarchyOptions options{{4}, 4, seed};
        const Hierarchy by_metric = build_hierarchy(mesh, options, workers);
        options.root_metric = root_metric(mesh);
        CHECK(build_hierarchy(mesh, options, workers).patch_count() >= by_metric.patch_count());
    }
}

TEST_CASE("split_patch: a part of the mesh, into a partition of just its faces") {
    for (const auto& [name, soup] : surfaces()) {
        const auto& surface_name = name; // clang 14 captures no structured binding
        CAPTURE(surface_name);
        const Mesh mesh = mesh_of(soup);
        const ExactMetric metric(mesh);
        const auto solver = metric.make_solver();
        Faces faces;
        for (uint32_t f = 0; f < mesh.face_count(); ++f)
            if (f % 16 < 9 || f == 0) faces.push_back(f); // scattered: parts of many components
        const auto lengths = edge_lengths(mesh);
        const Components components = components_of(mesh);
        const Splitting splitting{mesh, lengths, components.of_vertex, 2};
        for (uint32_t count : {1u, 3u, 10u, 500u}) {
            Random random(count);
            Faces together;
            for (const Faces& patch : split_patch(splitting, faces, count, *solver, random).patches) {
                CHECK(edge_connected(mesh, patch));
                together.insert(together.end(), patch.begin(), patch.end());
            }
            std::sort(together.begin(), together.end());
            CHECK(together == faces);
        }
    }
}

TEST_CASE("hierarchy: in proportion, a patch twice as large has twice the children") {
    const Mesh mesh = mesh_of(jittered_grid(40, 5)); // discs only: nothing is split further
    const ExactMetric metric(mesh);
    Workers workers(metric, 1, {});
    // Without relaxation patches are of very different sizes.
    const Hierarchy h = build_hierarchy(mesh, {{6, 10}, 0, 3, {1, 1}}, workers);
    std::vector<uint32_t> faces(h.patch_count(), 0);
    for (uint32_t leaf : h.leaf_of_face) ++faces[h.parent[leaf]];
    uint32_t fewest = UINT32_MAX, most = 0;
    for (uint32_t p = 1; p < h.first_leaf(); ++p) {
        const double expected = 60.0 * faces[p] / mesh.face_count();
        const uint32_t children = h.child_begin[p + 1] - h.child_begin[p];
        CAPTURE(expected);
        CHECK(std::abs(children - expected) <=
              0.5 + 0.2 * expected); // rounding, and seeds that fall together
        fewest = std::min(fewest, children);
        most = std::max(most, children);
    }
    CHECK(most > fewest);
}

TEST_CASE("automatic_split: what the caller gives is kept, the rest fills up to small leaves") {
    const std::vector<uint32_t> given{17, 0, 5};
    const auto split = automatic_split(1000000, 4, given, GRAPH_SPLIT);
    REQUIRE(split.size() == 4);
    CHECK(split[0] == 17);
    CHECK(split[2] == 5);
    CHECK(split[1] == split[3]);
    CHECK(split[1] > 1);
    CHECK(automatic_split(50, 2, std::vector<uint32_t>{3, 4}, GRAPH_SPLIT) == std::vector<uint32_t>{3, 4});
    CHECK(automatic_split(10, 100, {}, GRAPH_SPLIT).size() == GEOIDX_MAX_LEVELS);
    // The levels that are named are meant, also where their number is automatic.
    CHECK(automatic_split(50, 0, std::vector<uint32_t>{3, 4, 0, 0}, GRAPH_SPLIT) ==
          std::vector<uint32_t>{3, 4});
    // Levels asked for are levels, also of a small mesh.
    for (uint32_t count : automatic_split(3000, 8, {}, GRAPH_SPLIT)) CHECK(count >= 2);
    for (uint32_t level_count : {0u, 1u, 2u, 3u, 8u})
        for (uint32_t vertices : {1u, 3u, 100u, 5000u, 50000u, 1000000u, UINT32_MAX - 1}) {
            const auto counts = automatic_split(vertices, level_count, {}, GRAPH_SPLIT);
            REQUIRE(!counts.empty());
            CHECK(counts.size() <= GEOIDX_MAX_LEVELS);
            if (level_count) CHECK(counts.size() == level_count);
            double leaves = 1;
            for (uint32_t count : counts) {
                CHECK(count >= 1);
                leaves *= count;
            }
            // The design's leaves have 64 vertices or some more; rounding each of up to 8 factors moves that.
            if (level_count == 0) {
                CHECK(vertices / leaves <= 256);
                if (vertices >= 5000) CHECK(vertices / leaves >= 32);
            }
        }
    CHECK(automatic_split(1, 0, {}, GRAPH_SPLIT) == std::vector<uint32_t>{1});
    // No more levels than needed, also where the leaves are a power of the largest split.
    CHECK(automatic_split(64 * 36, 0, {}, OVERLAY_SPLIT) == std::vector<uint32_t>{6, 6});
    CHECK(automatic_split(64 * 216, 0, {}, OVERLAY_SPLIT) == std::vector<uint32_t>{6, 6, 6});
    CHECK(automatic_split(64 * 216 + 1, 0, {}, OVERLAY_SPLIT).size() == 4);
    // More levels for more vertices, never fewer.
    size_t before = 1;
    for (uint32_t vertices = 100; vertices < 100000000; vertices *= 2) {
        const size_t levels = automatic_split(vertices, 0, {}, GRAPH_SPLIT).size();
        CHECK(levels >= before);
        before = levels;
    }
    CHECK(before > 2);
}
