#include "src/mesh/intake.h"

#include <bit>
#include <cfloat>
#include <cmath>
#include <cstring>
#include <limits>
#include <map>
#include <set>
#include <string>

#include <doctest/doctest.h>

#include "tests/support/meshes.h"
#include "tests/support/oracles.h"

using namespace geodesic;
using namespace geodesic::test;

namespace {

using Triangles = std::vector<std::array<uint32_t, 3>>;

Soup square() {
    Soup soup;
    soup.positions = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
    soup.triangles = {{0, 1, 2}, {0, 2, 3}};
    return soup;
}

Intake take_in(const Soup& soup, double weld_tolerance = 0) {
    return geodesic::take_in(view_of(soup), {weld_tolerance});
}

geoidx_status refusal(const geoidx_mesh& mesh, std::string* detail, double weld_tolerance = 0) {
    detail->clear();
    return failure_of([&] { geodesic::take_in(mesh, {weld_tolerance, true}); }, detail);
}

bool contains(const std::string& text, const std::string& part) {
    return text.find(part) != std::string::npos;
}

// Whether the number stands in the text as a word of its own.
bool names(const std::string& text, uint64_t number) {
    const std::string digits = std::to_string(number);
    for (size_t at = text.find(digits); at != std::string::npos; at = text.find(digits, at + 1)) {
        const bool begins = at == 0 || !std::isdigit(static_cast<unsigned char>(text[at - 1]));
        const size_t end = at + digits.size();
        if (begins && (end == text.size() || !std::isdigit(static_cast<unsigned char>(text[end]))))
            return true;
    }
    return false;
}

// The faces of an intake as sets of the caller's ids, in order.
std::vector<std::set<uint32_t>> faces_by_id(const Intake& intake) {
    std::vector<std::set<uint32_t>> faces;
    for (const auto& face : intake.mesh.faces) {
        faces.emplace_back();
        for (uint32_t v : face) faces.back().insert(intake.id_of_vertex[v]);
    }
    return faces;
}

// What must hold of the two numberings, whatever the mesh.
void check_ids(const Intake& intake, const Soup& soup) {
    REQUIRE(intake.vertex_of_id.size() == soup.positions.size());
    REQUIRE(intake.id_of_vertex.size() == intake.mesh.vertex_count());
    std::vector<uint8_t> used(intake.mesh.vertex_count(), 0);
    for (const auto& face : intake.mesh.faces)
        for (uint32_t v : face) used.at(v) = 1;
    for (uint32_t v = 0; v < intake.mesh.vertex_count(); ++v) {
        CHECK(used[v]);
        const uint32_t id = intake.id_of_vertex[v];
        CHECK(intake.vertex_of_id[id] == v);
        CHECK(intake.mesh.positions[v] == soup.positions[id]);
    }
}

}

TEST_CASE("intake: a clean mesh keeps its vertices, faces and winding, in another order") {
    const Soup soup = torus(7, 5, 2, 0.5);
    const Intake intake = take_in(soup);
    CHECK(intake.mesh.vertex_count() == soup.vertex_count());
    CHECK(intake.mesh.face_count() == soup.triangles.size());
    REQUIRE(intake.face_of_triangle.size() == soup.triangles.size());
    check_ids(intake, soup);
    std::set<uint32_t> faces;
    for (size_t t = 0; t < soup.triangles.size(); ++t) {
        faces.insert(intake.face_of_triangle[t]);
        for (size_t k = 0; k < 3; ++k)
            CHECK(intake.id_of_vertex[intake.mesh.faces[intake.face_of_triangle[t]][k]] ==
                  soup.triangles[t][k]);
    }
    CHECK(faces.size() == soup.triangles.size());
    // 35 vertices, 70 faces: 105 edges, two faces each (a torus).
    CHECK(intake.mesh.edge_count() == 105);
}

TEST_CASE("intake: float and double positions at any stride") {
    const Soup soup = cube(3); // thirds are not floats
    std::vector<float> rounded;
    Soup as_float = soup;
    for (auto& p : as_float.positions)
        for (int k = 0; k < 3; ++k) {
            rounded.push_back(static_cast<float>(p[k]));
            p[k] = static_cast<double>(rounded.back());
        }
    for (const uint32_t type : {uint32_t{GEOIDX_POSITION_FLOAT}, uint32_t{GEOIDX_POSITION_DOUBLE}}) {
        const bool is_float = type == GEOIDX_POSITION_FLOAT;
        const size_t packed = is_float ? 12 : 24;
        const void* numbers = is_float ? static_cast<const void*>(rounded.data()) : soup.positions.data();
        const Soup& expected = is_float ? as_float : soup;
        // 0: packed; an odd stride puts positions at addresses that no float may have.
        for (const size_t stride : {size_t{0}, packed, packed + 1, packed + 4, size_t{100}}) {
            CAPTURE(type);
            CAPTURE(stride);
            const size_t step = stride ? stride : packed;
            // Not a byte behind the last position: the sanitizers see any read beyond it.
            std::vector<std::byte> bytes(step * (soup.positions.size() - 1) + packed, std::byte{0xFF});
            for (size_t i = 0; i < soup.positions.size(); ++i)
                std::memcpy(bytes.data() + i * step, static_cast<const std::byte*>(numbers) + i * packed,
                            packed);
            geoidx_mesh view = view_of(soup);
            view.position_type = type;
            view.positions = bytes.data();
            view.position_stride = static_cast<uint32_t>(stride);
            const Intake intake = geodesic::take_in(view, {});
            check_ids(intake, expected);
            CHECK(intake.mesh.vertex_count() == expected.vertex_count());
            CHECK(intake.mesh.face_count() == expected.triangles.size());
            CHECK(intake.fingerprint == mesh_fingerprint(view_of(expected)));
        }
        geoidx_mesh view = view_of(soup);
        view.position_type = type;
        view.position_stride = static_cast<uint32_t>(packed - 1);
        std::string detail;
        CHECK(refusal(view, &detail) == GEOIDX_ERROR_INVALID_ARGUMENT);
        CHECK(names(detail, packed - 1));
    }
}

TEST_CASE("intake: equal positions are one vertex, the first; the others answer through it") {
    Soup soup = square();
    // The second triangle with corners of its own, as in a file without shared vertices.
    soup.positions = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 0, 0}, {1, 1, 0}, {0, 1, 0}};
    soup.triangles = {{0, 1, 2}, {3, 4, 5}};
    const Intake intake = take_in(soup);
    check_ids(intake, soup);
    CHECK(intake.mesh.vertex_count() == 4);
    CHECK(intake.mesh.edge_count() == 5);
    CHECK(intake.vertex_of_id[3] == intake.vertex_of_id[0]);
    CHECK(intake.vertex_of_id[4] == intake.vertex_of_id[2]);
    CHECK(faces_by_id(intake) == std::vector<std::set<uint32_t>>{{0, 1, 2}, {0, 2, 5}});
}

TEST_CASE("intake: a first copy that no triangle uses still stands for the used one") {
    Soup soup = square();
    soup.positions.insert(soup.positions.begin(), Eigen::Vector3d(1, 1, 0));
    soup.triangles = {{1, 2, 3}, {1, 3, 4}};
    const Intake intake = take_in(soup);
    check_ids(intake, soup);
    CHECK(intake.vertex_of_id[0] == intake.vertex_of_id[3]);
    CHECK(intake.vertex_of_id[0] != NONE);
    CHECK(intake.mesh.vertex_count() == 4);
}

TEST_CASE("intake: minus zero is zero, the next number is not") {
    Soup soup = square();
    soup.positions.push_back({-0.0, -0.0, -0.0});
    soup.positions.push_back({0.0, -0.0, std::numeric_limits<double>::denorm_min()});
    soup.triangles = {{0, 1, 2}, {4, 2, 3}, {5, 1, 3}};
    const Intake intake = take_in(soup);
    CHECK(intake.vertex_of_id[4] == intake.vertex_of_id[0]);
    CHECK(intake.vertex_of_id[5] != intake.vertex_of_id[0]);
    CHECK(intake.mesh.vertex_count() == 5);
}

TEST_CASE("intake: degenerate triangles are dropped, before and after welding") {
    Soup soup = square();
    soup.positions.push_back({1, 0, 0}); // vertex 1 again
    soup.triangles = {{0, 0, 1}, {0, 1, 2}, {1, 4, 2}, {0, 2, 3}, {3, 3, 3}, {4, 3, 1}};
    const Intake intake = take_in(soup);
    CHECK(faces_by_id(intake) == std::vector<std::set<uint32_t>>{{0, 1, 2}, {0, 2, 3}});
    CHECK(intake.face_of_triangle == std::vector<uint32_t>{NONE, intake.face_of_triangle[1], NONE,
                                                           intake.face_of_triangle[3], NONE,
                                                           intake.face_of_triangle[5]});
    CHECK(intake.face_of_triangle.size() == 6);
    check_ids(intake, soup);

    soup.triangles = {{0, 0, 1}, {1, 4, 2}};
    std::string detail;
    CHECK(refusal(view_of(soup), &detail) == GEOIDX_ERROR_BAD_MESH);
    CHECK(contains(detail, "degenerate"));
}

TEST_CASE("intake: of duplicate triangles the first stays, in its place and with its winding") {
    Soup soup = square();
    soup.positions.push_back({1, 1, 0}); // vertex 2 again
    soup.triangles = {{0, 3, 2}, {0, 1, 2}, {2, 0, 3}, {2, 1, 0}, {4, 0, 1}, {0, 1, 2}, {3, 4, 0}};
    const Intake intake = take_in(soup);
    REQUIRE(intake.mesh.face_count() == 2);
    const uint32_t a = intake.face_of_triangle[0], b = intake.face_of_triangle[1];
    CHECK(intake.face_of_triangle == std::vector<uint32_t>{a, b, a, b, b, b, a});
    for (size_t k = 0; k < 3; ++k) {
        CHECK(intake.id_of_vertex[intake.mesh.faces[a][k]] == soup.triangles[0][k]);
        CHECK(intake.id_of_vertex[intake.mesh.faces[b][k]] == soup.triangles[1][k]);
    }
}

TEST_CASE("intake: collinear corners make a triangle, not a degenerate one") {
    Soup soup = square();
    soup.positions.push_back({0.5, 0, 0});
    soup.triangles.push_back({0, 4, 1});
    const Intake intake = take_in(soup);
    CHECK(intake.mesh.face_count() == 3);
    CHECK(intake.vertex_of_id[4] != NONE);
}

TEST_CASE("intake: vertices that no triangle uses keep their ids and have no vertex") {
    Soup soup = square();
    for (auto& triangle : soup.triangles)
        for (uint32_t& id : triangle) id += 2;
    soup.positions.insert(soup.positions.begin(), {{50, 0, 0}, {60, 0, 0}});
    soup.positions.push_back({70, 0, 0});
    const Intake intake = take_in(soup);
    check_ids(intake, soup);
    for (uint32_t id : {0u, 1u, 6u}) CHECK(intake.vertex_of_id[id] == NONE);
    for (uint32_t id = 2; id < 6; ++id) CHECK(intake.id_of_vertex.at(intake.vertex_of_id[id]) == id);
    // Of the used vertices only.
    CHECK(intake.bounding_box_diagonal == doctest::Approx(std::sqrt(2.0)).epsilon(1e-15));
}

TEST_CASE("intake: a vertex that only dropped triangles use is unused") {
    Soup soup = square();
    soup.positions.push_back({5, 5, 5});
    soup.triangles.push_back({4, 4, 0});
    CHECK(take_in(soup).vertex_of_id[4] == NONE);
}

TEST_CASE("intake: components, boundaries, genus, fans that meet and any winding are taken as they are") {
    for (const Soup& soup :
         {joined(sphere(1), grid(2, 3, 1, 1)), torus(5, 4, 2, 0.5), pinched_sheets(2), moebius(9, 2),
          with_mixed_winding(sphere(2), 3), with_flipped_winding(cube(2)), annulus(8, 2)}) {
        Soup moved = soup; // so that components do not touch by chance
        const Intake intake = take_in(moved);
        CHECK(intake.mesh.face_count() == moved.triangles.size());
        check_ids(intake, moved);
    }
}

TEST_CASE("intake: an edge with more than two triangles is refused on request, the first one named") {
    Soup soup = square();
    soup.positions.insert(soup.positions.end(),
                          {{0, 0, 1}, {9, 0, 0}, {9, 1, 0}, {9, 0, 1}, {9, 1, 1}, {9, 2, 2}});
    soup.triangles.push_back({2, 0, 4}); // the diagonal has three
    // Ids 5 .. 9, further on: four triangles at the edge 5-6.
    for (const uint32_t third : {7u, 8u, 9u}) soup.triangles.push_back({5, 6, third});
    soup.triangles.push_back({6, 5, 1});
    std::string detail;
    CHECK(refusal(view_of(soup), &detail) == GEOIDX_ERROR_BAD_MESH);
    CAPTURE(detail);
    CHECK(names(detail, 0));
    CHECK(names(detail, 2));
    CHECK(names(detail, 3)); // triangles there
    CHECK(!names(detail, 5));

    const Intake intake = take_in(soup);
    check_ids(intake, soup);
    const auto vertex = [&](uint32_t id) { return intake.vertex_of_id[id]; };
    CHECK(intake.mesh.edge_faces[find_edge(intake.mesh, vertex(0), vertex(2))].size() == 3);
    CHECK(intake.mesh.edge_faces[find_edge(intake.mesh, vertex(5), vertex(6))].size() == 4);

    // A duplicate is dropped before edges are counted.
    soup.triangles = {{0, 1, 2}, {0, 2, 3}, {2, 0, 1}};
    CHECK(refusal(view_of(soup), &detail) == GEOIDX_OK);
}

TEST_CASE("intake: an edge that welding gives a third triangle is named by the caller's ids") {
    Soup soup = square();
    for (auto& triangle : soup.triangles)
        for (uint32_t& id : triangle) id += 1;
    soup.positions.insert(soup.positions.begin(), Eigen::Vector3d(7, 7, 7)); // unused: ids shift by one
    soup.positions.insert(soup.positions.end(), {{0, 0, 0}, {1, 1, 0}, {0, 0, 1}});
    soup.triangles.push_back({5, 6, 7});
    std::string detail;
    CHECK(refusal(view_of(soup), &detail) == GEOIDX_ERROR_BAD_MESH);
    CAPTURE(detail);
    CHECK(names(detail, 1));
    CHECK(names(detail, 3));
}

TEST_CASE("intake: NaN and infinite positions name the vertex, also an unused one") {
    const double inf = std::numeric_limits<double>::infinity();
    for (const double bad : {std::nan(""), inf, -inf})
        for (int k = 0; k < 3; ++k)
            for (const uint32_t type : {uint32_t{GEOIDX_POSITION_FLOAT}, uint32_t{GEOIDX_POSITION_DOUBLE}}) {
                Soup soup = square();
                for (int i = 0; i < 10; ++i) soup.positions.push_back({1, 2, 3});
                soup.positions[12][k] = bad;
                std::vector<float> floats;
                for (const auto& p : soup.positions)
                    for (int j = 0; j < 3; ++j) floats.push_back(static_cast<float>(p[j]));
                geoidx_mesh view = view_of(soup);
                view.position_type = type;
                if (type == GEOIDX_POSITION_FLOAT) view.positions = floats.data();
                std::string detail;
                CHECK(refusal(view, &detail) == GEOIDX_ERROR_BAD_MESH);
                CHECK(names(detail, 12));
            }
}

TEST_CASE("intake: an index out of range names triangle and index") {
    for (const uint32_t bad : {4u, 5u, UINT32_MAX - 1, UINT32_MAX})
        for (size_t corner = 0; corner < 3; ++corner) {
            Soup soup = square();
            soup.triangles[1][corner] = bad;
            std::string detail;
            CHECK(refusal(view_of(soup), &detail) == GEOIDX_ERROR_BAD_MESH);
            CHECK(names(detail, 1));
            CHECK(names(detail, bad));
        }
}

TEST_CASE("intake: empty and oversized meshes are refused before an array is read") {
    const Soup soup = square();
    std::string detail;
    const auto refused = [&](auto change) {
        geoidx_mesh view = view_of(soup);
        change(view);
        return refusal(view, &detail);
    };
    CHECK(refused([](auto& m) { m.vertex_count = 0; }) == GEOIDX_ERROR_BAD_MESH);
    CHECK(refused([](auto& m) { m.triangle_count = 0; }) == GEOIDX_ERROR_BAD_MESH);
    // 2^32 - 1 is one too many; the arrays are far shorter.
    for (const uint64_t count : {(uint64_t{1} << 32) - 1, uint64_t{1} << 32, UINT64_MAX}) {
        CHECK(refused([&](auto& m) { m.vertex_count = count; }) == GEOIDX_ERROR_LIMIT);
        CHECK(names(detail, count));
        CHECK(refused([&](auto& m) { m.triangle_count = count; }) == GEOIDX_ERROR_LIMIT);
        CHECK(names(detail, count));
    }
    CHECK(refused([](auto& m) { m.positions = nullptr; }) == GEOIDX_ERROR_INVALID_ARGUMENT);
    CHECK(refused([](auto& m) { m.triangles = nullptr; }) == GEOIDX_ERROR_INVALID_ARGUMENT);
    CHECK(refused([](auto& m) { m.position_type = 2; }) == GEOIDX_ERROR_INVALID_ARGUMENT);
}

TEST_CASE("intake: a weld tolerance must be a finite number, not negative") {
    const Soup soup = square();
    std::string detail;
    for (const double bad : {-1e-300, -1.0, std::nan(""), std::numeric_limits<double>::infinity()})
        CHECK(refusal(view_of(soup), &detail, bad) == GEOIDX_ERROR_INVALID_ARGUMENT);
    CHECK(refusal(view_of(soup), &detail, -0.0) == GEOIDX_OK);
}

TEST_CASE("intake: a coordinate that no float holds is refused, wherever it is") {
    const Soup near = square();
    std::string detail;
    for (const double sign : {1.0, -1.0})
        for (const double size : {std::nextafter(double{FLT_MAX}, INFINITY), 1e39, DBL_MAX}) {
            CAPTURE(size);
            Soup soup = near;
            soup.positions.push_back({0, sign * size, 0}); // that no triangle uses
            CHECK(refusal(view_of(soup), &detail) == GEOIDX_ERROR_BAD_MESH);
            CHECK(names(detail, 4));
            for (auto& position : soup.positions)
                position = {sign * size, 1e37 * position[0], 1e37 * position[1]};
            CHECK(refusal(view_of(soup), &detail) == GEOIDX_ERROR_BAD_MESH); // though distances would fit
            CHECK(names(detail, 0));
        }
    Soup largest = near;
    largest.positions.push_back({double{FLT_MAX}, -double{FLT_MAX}, 0});
    CHECK(refusal(view_of(largest), &detail) == GEOIDX_OK);
}

TEST_CASE("intake: a mesh whose distances would overflow a float is refused") {
    Soup soup = square();
    soup.positions[2] = {double{FLT_MAX}, double{FLT_MAX}, 0};
    std::string detail;
    CHECK(refusal(view_of(soup), &detail) == GEOIDX_ERROR_BAD_MESH);
    CHECK(contains(detail, "bounding box"));
    soup.positions[2] = {double{FLT_MAX}, 1, 0};
    soup.positions[1] = {-double{FLT_MAX}, 1, 0};
    CHECK(refusal(view_of(soup), &detail) == GEOIDX_ERROR_BAD_MESH);
    CHECK(contains(detail, "bounding box"));
}

TEST_CASE("intake: the fingerprint changes with any number") {
    const Soup soup = cube(1);
    const uint64_t original = mesh_fingerprint(view_of(soup));
    CHECK(take_in(soup).fingerprint == original);
    CHECK(mesh_fingerprint(view_of(Soup(soup))) == original); // not of the addresses
    std::set<uint64_t> seen{original};
    for (size_t i = 0; i < soup.positions.size(); ++i)
        for (int k = 0; k < 3; ++k) {
            Soup changed = soup;
            changed.positions[i][k] =
                static_cast<double>(std::nextafter(static_cast<float>(changed.positions[i][k]), 2.0f));
            CHECK(seen.insert(mesh_fingerprint(view_of(changed))).second);
        }
    for (size_t f = 0; f < soup.triangles.size(); ++f) {
        Soup changed = soup;
        std::swap(changed.triangles[f][0], changed.triangles[f][1]);
        CHECK(seen.insert(mesh_fingerprint(view_of(changed))).second);
    }
    Soup longer = soup;
    longer.positions.push_back({0, 0, 0});
    CHECK(seen.insert(mesh_fingerprint(view_of(longer))).second);
    Soup shorter = soup;
    shorter.triangles.pop_back();
    CHECK(seen.insert(mesh_fingerprint(view_of(shorter))).second);
}
