#include "src/tables/pruning.h"

#include <algorithm>
#include <map>
#include <set>

#include <doctest/doctest.h>

#include "src/metric/window_propagation.h"
#include "src/tables/borders.h"
#include "tests/support/meshes.h"
#include "tests/support/oracles.h"
#include "tests/support/sanitized.h"

using namespace geodesic;
using namespace geodesic::test;

namespace {

using Leaves = std::vector<uint32_t>;

struct Case {
    Mesh mesh;
    ListOfLists<uint32_t> leaves;
    std::vector<uint8_t> stands(double largest_error, uint32_t threads = 1) const {
        const ExactMetric metric(mesh);
        Workers workers(metric, threads, {});
        return merge_border_vertices(mesh, leaves, largest_error, workers);
    }
    Leaves leaves_of(uint32_t v) const { return {leaves[v].begin(), leaves[v].end()}; }
};

std::vector<Case> cases() {
    std::vector<Case> result;
    for (const Soup& soup :
         {bumpy_sphere(3, 1), grid(20, 20, 1, 1), torus(24, 12, 2, 0.7), pinched_sheets(5)}) {
        Case c{mesh_of(soup), {}};
        const ExactMetric metric(c.mesh);
        Workers workers(metric, 1, {});
        const Hierarchy h = build_hierarchy(c.mesh, {{6}, 2, 1}, workers);
        c.leaves = leaves_at_vertices(c.mesh, h);
        result.push_back(std::move(c));
    }
    return result;
}

// Border vertices with the same leaves that hang together over edges.
std::vector<std::vector<uint32_t>> chains(const Case& c) {
    std::vector<uint8_t> seen(c.mesh.vertex_count(), 0);
    std::vector<std::vector<uint32_t>> result;
    for (uint32_t start = 0; start < c.mesh.vertex_count(); ++start) {
        if (seen[start] || c.leaves[start].size() < 2) continue;
        std::vector<uint32_t> chain{start};
        seen[start] = 1;
        for (size_t i = 0; i < chain.size(); ++i)
            for (const auto& [a, b] : c.mesh.edges) {
                if (a != chain[i] && b != chain[i]) continue;
                const uint32_t other = a == chain[i] ? b : a;
                if (seen[other] || c.leaves_of(other) != c.leaves_of(start)) continue;
                seen[other] = 1;
                chain.push_back(other);
            }
        result.push_back(chain);
    }
    return result;
}

}

TEST_CASE("pruning: with no error allowed every vertex stands for itself") {
    for (const Case& c : cases())
        for (double none : {0.0, -0.0, -1.0, 1e-12})
            CHECK(c.stands(none) == std::vector<uint8_t>(c.mesh.vertex_count(), 1));
}

TEST_CASE("pruning: who was merged has a stand-in of its own chain within the error" *
          doctest::skip(SANITIZED)) {
    for (const Case& c : cases()) {
        const auto all_chains = chains(c);
        size_t kept_before = c.mesh.vertex_count();
        for (double largest_error : {0.02, 0.1, 0.3, 1.0}) {
            const auto stands = c.stands(largest_error);
            size_t border = 0, kept = 0;
            for (uint32_t v = 0; v < c.mesh.vertex_count(); ++v)
                if (c.leaves[v].size() < 2) CHECK(stands[v] == 1); // internal vertices are left alone
            for (const auto& chain : all_chains) {
                border += chain.size();
                size_t standing = 0;
                for (uint32_t v : chain) standing += stands[v];
                CHECK(standing >= 1);
                kept += standing;
                for (uint32_t v : chain) {
                    if (stands[v]) continue;
                    const auto d = exact_field(c.mesh, v);
                    double nearest = UNREACHABLE;
                    for (uint32_t w : chain)
                        if (stands[w]) nearest = std::min(nearest, d[w]);
                    CHECK(nearest <= largest_error * (1 + 1e-9));
                }
            }
            CHECK(kept <= kept_before);
            kept_before = kept;
            if (largest_error == 1.0) CHECK(kept < border); // longer than an edge: there is what to merge
        }
    }
}

TEST_CASE("pruning: an error larger than the mesh leaves one vertex of each chain") {
    for (const Case& c : cases()) {
        const auto stands = c.stands(1e6);
        for (const auto& chain : chains(c)) {
            size_t standing = 0;
            for (uint32_t v : chain) standing += stands[v];
            CHECK(standing == 1);
        }
    }
}

TEST_CASE("pruning: a straight border, by hand") {
    // Two leaves meet along x = 4: nine border vertices one apart.
    Case c{mesh_of(grid(8, 8, 8, 8)), {}};
    for (uint32_t v = 0; v < c.mesh.vertex_count(); ++v) {
        const double x = c.mesh.positions[v].x();
        if (x <= 4) c.leaves.items.push_back(1);
        if (x >= 4) c.leaves.items.push_back(2);
        c.leaves.close_list();
    }
    const auto standing = [&](double largest_error) {
        const auto stands = c.stands(largest_error);
        size_t count = 0;
        for (uint32_t v = 0; v < stands.size(); ++v) count += c.leaves[v].size() == 2 && stands[v];
        return count;
    };
    CHECK(standing(0.99) == 9);
    // A stand-in serves its two neighbours at most: at least three, and greedy pairs give five at most.
    CHECK(standing(1.0) >= 3);
    CHECK(standing(1.0) <= 5);
    CHECK(standing(3.99) >=
          2); // nobody in the middle of a line of nine is within less than four of both ends
    CHECK(standing(8.0) == 1);
}

TEST_CASE("pruning: the same for any number of threads") {
    for (const Case& c : cases()) {
        const auto one = c.stands(0.2, 1);
        CHECK(one == c.stands(0.2, 2));
        CHECK(one == c.stands(0.2, 4));
    }
}
