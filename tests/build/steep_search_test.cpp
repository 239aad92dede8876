// That in no field the distances of neighbours differ by more than 1.05 times the length of their edge.
#include <cmath>

#include "tests/build/large_rough_sheet.h"
#include "tests/support/sanitized.h"

using namespace geodesic::test;
using geodesic::TAG_STEEP_EDGES;

namespace {

constexpr double STEEPEST_EDGE = 1.05;

// Two parts, a vertex that nothing uses, a triangle without area and one that is there twice.
TestMesh dirty_sheets() {
    TestMesh mesh = rough_sheet(smaller(26, 22), 16);
    append(mesh, rough_sheet(13, 5), 60);
    mesh.add_vertex(1, 2, 3);
    mesh.add_triangle(4, 4, 5);
    mesh.add_triangle(mesh.triangles[0], mesh.triangles[1], mesh.triangles[2]);
    return mesh;
}

// Of the fields of all vertices, or of every step-th one.
uint64_t count_steep(const geoidx* index, const TestMesh& mesh, uint32_t step) {
    const auto edges = edges_of(mesh);
    uint64_t steep = 0;
    for (uint32_t source = 0; source < mesh.vertex_count(); source += step) {
        const auto field = msad(index, source, mesh.vertex_count());
        for (const auto& [a, b] : edges)
            steep += std::abs(double{field[a]} - double{field[b]}) > STEEPEST_EDGE * mesh.straight(a, b);
    }
    return steep;
}

}

TEST_CASE("steep search: no field has a steep edge" * doctest::skip(SANITIZED)) {
    for (const TestMesh& mesh : {hills(30, 20), torus(36, 14), dirty_sheets()}) {
        const auto index = shared_index(mesh, default_options());
        CHECK(count_steep(index.get(), mesh, 1) == 0);
    }
}

TEST_CASE("steep search: there are some where fields are not lowered" * doctest::skip(SANITIZED)) {
    const TestMesh& mesh = large_rough_sheet();
    const Bytes& file = file_of_large_rough_sheet();
    const Bytes as_they_are = without_section(file, TAG_STEEP_EDGES);
    CHECK(count_steep(open(as_they_are).get(), mesh, 3) > 0);
    const Bytes by_tables = without_section(as_they_are, geodesic::TAG_MEASURED_PAIRS);
    CHECK(count_steep(open(by_tables).get(), mesh, 3) > 20);
    CHECK(count_steep(open(file).get(), mesh, 3) == 0);
}

// Of more vertices than are compared at first.
TEST_CASE("steep search, wrong pairs: threads change no bit of the file" * doctest::skip(SANITIZED)) {
    const Bytes& file = file_of_large_rough_sheet();
    const auto sections = geodesic::format::Container::parse(file, geodesic::INDEX_TAGS);
    REQUIRE(sections.has(TAG_STEEP_EDGES));
    REQUIRE(sections.has(geodesic::TAG_MEASURED_PAIRS));
    CHECK(save(build(large_rough_sheet(), default_options(1)).get()) == file);
}

TEST_CASE("steep search: where distances are no lengths of ways over triangles, nothing is lowered") {
    const TestMesh mesh = rough_sheet(24, 16);
    auto options = default_options();
    options.metric = GEOIDX_METRIC_EDGES;
    const Bytes file = save(build(mesh, options).get());
    CHECK(!geodesic::format::Container::parse(file, geodesic::INDEX_TAGS).has(TAG_STEEP_EDGES));
}
