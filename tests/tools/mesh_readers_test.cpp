#include <array>
#include <cmath>
#include <utility>

#include <doctest/doctest.h>

#include "tests/tools/mesh_texts.h"

using namespace geodesic::tools;
using namespace geodesic::tools::test;

namespace {

const std::string OBJ_TRIANGLE = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";

}

TEST_CASE("obj: vertices keep their order, the unused ones too") {
    const TriangleMesh mesh = read_obj("v 0 0 0\nv 9 9 9\nv 1 0 0\nv 0 1 0\nf 1 3 4\n");
    CHECK(mesh.positions == Numbers{0, 0, 0, 9, 9, 9, 1, 0, 0, 0, 1, 0});
    CHECK(mesh.triangles == Ids{0, 2, 3});
}

TEST_CASE("obj: polygons are cut in the file's order") {
    const TriangleMesh mesh = read_obj("v 0 0 0\nv 5 0 0\nv 6 1 0\nv 0 1 0\nv -1 .5 0\nf 2 3 4 5 1\n");
    CHECK(mesh.triangles == Ids{1, 2, 3, 1, 3, 4, 1, 4, 0});
}

namespace {

// Sum of the areas of the triangles: the area of the polygon if they do not overlap.
double area_of(const TriangleMesh& mesh) {
    double area = 0;
    for (size_t t = 0; t < mesh.triangles.size(); t += 3) {
        const auto at = [&](size_t corner, size_t axis) {
            return mesh.positions[3 * size_t{mesh.triangles[t + corner]} + axis];
        };
        double normal[3];
        for (size_t k = 0; k < 3; ++k) {
            const size_t u = (k + 1) % 3, v = (k + 2) % 3;
            normal[k] =
                (at(1, u) - at(0, u)) * (at(2, v) - at(0, v)) - (at(1, v) - at(0, v)) * (at(2, u) - at(0, u));
        }
        area += 0.5 * std::hypot(normal[0], normal[1], normal[2]);
    }
    return area;
}

}

TEST_CASE(
    "polygons with reflex corners are divided inside, whatever plane they lie in and corner they begin at") {
    // An L of area 7; a chevron of area 2; a comb of area 14; winding both ways.
    const std::vector<std::pair<double, std::vector<std::array<double, 2>>>> shapes = {
        {7, {{0, 0}, {4, 0}, {4, 1}, {1, 1}, {1, 4}, {0, 4}}},
        {2, {{0, 0}, {2, -2}, {1, 0}, {2, 2}}},
        {14,
         {{0, 0},
          {7, 0},
          {7, 2},
          {6, 2},
          {6, 1},
          {5, 1},
          {5, 2},
          {4, 2},
          {4, 1},
          {3, 1},
          {3, 3},
          {2, 3},
          {2, 1},
          {1, 1},
          {1, 4},
          {0, 4}}}};
    for (const auto& [area, shape] : shapes)
        for (size_t begin = 0; begin < shape.size(); ++begin)
            for (const std::array<size_t, 3>& axes :
                 {std::array<size_t, 3>{0, 1, 2}, {1, 2, 0}, {2, 0, 1}, {1, 0, 2}}) {
                std::string text, face = "f";
                for (size_t i = 0; i < shape.size(); ++i) {
                    double p[3];
                    p[axes[0]] = shape[i][0] + 100;
                    p[axes[1]] = shape[i][1];
                    p[axes[2]] = 7;
                    text += "v " + std::to_string(p[0]) + ' ' + std::to_string(p[1]) + ' ' +
                            std::to_string(p[2]) + '\n';
                    face += ' ' + std::to_string((begin + i) % shape.size() + 1);
                }
                const TriangleMesh mesh = read_obj(text + face + '\n');
                CHECK(mesh.triangle_count() == shape.size() - 2);
                CHECK(area_of(mesh) == doctest::Approx(area));
            }
}

namespace {

// The most triangles that one corner of a polygon has, and the smallest of their areas.
struct Cut {
    size_t most_at_a_corner;
    double smallest_area;
};

Cut check_cut(const std::vector<std::array<double, 2>>& shape, size_t begin) {
    std::string text, face = "f";
    for (size_t i = 0; i < shape.size(); ++i) {
        text += "v " + std::to_string(shape[i][0]) + " 0 " + std::to_string(shape[i][1]) + '\n';
        face += ' ' + std::to_string((begin + i) % shape.size() + 1);
    }
    TriangleMesh mesh = read_obj(text + face + '\n');
    CHECK(mesh.triangle_count() == shape.size() - 2);
    double area = 0; // of the polygon
    for (size_t i = 0; i < shape.size(); ++i) {
        const auto &a = shape[i], &b = shape[(i + 1) % shape.size()];
        area += (a[0] * b[1] - a[1] * b[0]) / 2;
    }
    CHECK(area_of(mesh) == doctest::Approx(area).epsilon(1e-5));
    Cut cut{0, area};
    std::vector<size_t> count(shape.size());
    const Ids all = mesh.triangles;
    for (size_t t = 0; t < all.size(); t += 3) {
        mesh.triangles = {all[t], all[t + 1], all[t + 2]};
        cut.smallest_area = std::min(cut.smallest_area, area_of(mesh));
        for (size_t k = 0; k < 3; ++k)
            cut.most_at_a_corner = std::max(cut.most_at_a_corner, ++count[all[t + k]]);
    }
    return cut;
}

// Corners on each of the sides of a polygon, so many pieces a side.
std::vector<std::array<double, 2>> with_pieces(const std::vector<std::array<double, 2>>& shape,
                                               const std::vector<size_t>& pieces) {
    std::vector<std::array<double, 2>> result;
    for (size_t i = 0; i < shape.size(); ++i)
        for (size_t k = 0; k < pieces[i]; ++k) {
            const double t = static_cast<double>(k) / static_cast<double>(pieces[i]);
            const auto &a = shape[i], &b = shape[(i + 1) % shape.size()];
            result.push_back({a[0] + t * (b[0] - a[0]), a[1] + t * (b[1] - a[1])});
        }
    return result;
}

}

TEST_CASE("a convex polygon is cut into halves: no corner has many triangles") {
    for (const size_t corners : {6u, 7u, 30u, 1000u}) {
        CAPTURE(corners);
        std::vector<std::array<double, 2>> circle;
        for (size_t i = 0; i < corners; ++i) {
            const double turned = 6.283185307179586 * static_cast<double>(i) / static_cast<double>(corners);
            circle.push_back({100 * std::cos(turned), 100 * std::sin(turned)});
        }
        const Cut cut = check_cut(circle, 1);
        CHECK(static_cast<double>(cut.most_at_a_corner) <= 2 * std::log2(static_cast<double>(corners)) + 1);
    }
}

TEST_CASE("corners on the straight sides of a convex polygon make no triangles without area") {
    const std::vector<std::array<double, 2>> triangle{{0, 0}, {6, 0}, {0, 6}},
        square{{0, 0}, {6, 0}, {6, 6}, {0, 6}}, kite{{0, 0}, {4, 1}, {5, 5}, {1, 4}};
    const std::vector<std::vector<size_t>> pieces{{1, 1, 1, 1}, {2, 1, 1, 1}, {5, 1, 1, 1}, {5, 4, 1, 1},
                                                  {5, 1, 4, 1}, {1, 3, 3, 3}, {3, 3, 3, 3}, {9, 2, 7, 1}};
    for (const auto& shape : {triangle, square, kite})
        for (const auto& of_sides : pieces) {
            const auto cut_sides = with_pieces(shape, of_sides);
            for (size_t begin = 0; begin < cut_sides.size(); ++begin) {
                CAPTURE(shape.size());
                CAPTURE(cut_sides.size());
                CAPTURE(begin);
                CHECK(check_cut(cut_sides, begin).smallest_area > 0.01);
            }
        }
}

TEST_CASE("a polygon that crosses itself or has no area still gives its triangles") {
    CHECK(read_obj("v 0 0 0\nv 1 1 0\nv 1 0 0\nv 0 1 0\nf 1 2 3 4\n").triangle_count() == 2);
    CHECK(read_obj("v 0 0 0\nv 1 0 0\nv 2 0 0\nv 3 0 0\nf 1 3 2 4\n").triangle_count() == 2);
    CHECK(read_obj("v 0 0 0\nv 1 0 0\nv 1 1 0\nf 1 2 3 2 1\n").triangle_count() == 3);
}

TEST_CASE("obj: every form of a face's corner") {
    for (const char* face :
         {"f 1/1 2/2 3/3", "f 1//1 2//2 3//3", "f 1/1/1 2/2/2 3/3/3", "f -3 -2 -1", "f\t1  2\t3 ",
          "f 1 2 3 # a comment", "f 1 2 \\\n 3", "f -3//-1 -2//-1 -1//-1"}) {
        CAPTURE(face);
        const TriangleMesh mesh =
            read_obj(std::string("v 0 0 0\nv 1 0 0\nv 0 1 0\nvn 0 0 1\nvt 0 0\n") + face + "\n");
        CHECK(mesh.triangles == Ids{0, 1, 2});
    }
}

TEST_CASE("obj: a negative index counts back from the face's own line") {
    const TriangleMesh mesh = read_obj("v 0 0 0\nv 1 0 0\nv 0 1 0\nf -3 -2 -1\nv 2 2 2\nf -3 -2 -1\n");
    CHECK(mesh.triangles == Ids{0, 1, 2, 1, 2, 3});
}

TEST_CASE("obj: a face may come before its vertices") {
    CHECK(read_obj("f 1 2 3\nv 0 0 0\nv 1 0 0\nv 0 1 0\n").triangles == Ids{0, 1, 2});
}

TEST_CASE("obj: line ends, colours, byte order mark, other statements") {
    const TriangleMesh mesh =
        read_obj("\xEF\xBB\xBFv 0 0 0 .1 .2 .3\r\nv 1 0 0 1 1 1\r\no name\r\ng a b\r\nusemtl m\r\n"
                 "mtllib none.mtl\r\ns off\r\n\r\n  v 0 1 0 1.0\r\nl 1 2\r\nf 1 2 3\r");
    CHECK(mesh.positions == Numbers{0, 0, 0, 1, 0, 0, 0, 1, 0});
    CHECK(mesh.triangles == Ids{0, 1, 2});
}

TEST_CASE("obj: positions are the nearest doubles of what is written") {
    const TriangleMesh mesh =
        read_obj("v 0.1234567890123456 1e-3 -123456.789012345\nv +1 2. .5\nv 0 0 0\nf 1 2 3\n");
    CHECK(mesh.positions[0] == 0.1234567890123456);
    CHECK(mesh.positions[1] == 1e-3);
    CHECK(mesh.positions[2] == -123456.789012345);
    CHECK(mesh.positions[3] == 1);
}

TEST_CASE("obj: NaN and infinity are kept for the library to refuse") {
    const TriangleMesh mesh = read_obj("v nan 0 0\nv 0 inf 0\nv 0 0 1e999\nf 1 2 3\n");
    CHECK(std::isnan(mesh.positions[0]));
    CHECK(std::isinf(mesh.positions[4]));
    CHECK(std::isinf(mesh.positions[8]));
}

TEST_CASE("obj: errors name the line") {
    CHECK(contains(error_of(read_obj, OBJ_TRIANGLE + "f 1 2 4\n"), "line 5: vertex index 4 is out of range"));
    CHECK(
        contains(error_of(read_obj, OBJ_TRIANGLE + "f 1 2 -4\n"), "line 5: vertex index -4 is out of range"));
    CHECK(contains(error_of(read_obj, OBJ_TRIANGLE + "f 1 2 0\n"), "line 5"));
    CHECK(contains(error_of(read_obj, OBJ_TRIANGLE + "f 1 2 4294967297\n"), "line 5"));
    CHECK(contains(error_of(read_obj, OBJ_TRIANGLE + "f 1 2 99999999999999999999\n"), "line 5"));
    CHECK(contains(error_of(read_obj, OBJ_TRIANGLE + "f 1 2 x\n"), "'x'"));
    CHECK(contains(error_of(read_obj, OBJ_TRIANGLE + "f 1 2 3x\n"), "'3x'"));
    CHECK(contains(error_of(read_obj, OBJ_TRIANGLE + "f 1 2\n"), "line 5: a face needs three vertices"));
    CHECK(contains(error_of(read_obj, OBJ_TRIANGLE + "f\n"), "line 5: a face needs three vertices"));
    CHECK(contains(error_of(read_obj, "v 0 0\n"), "line 1: a vertex needs three coordinates"));
    CHECK(contains(error_of(read_obj, "\nv\n"), "line 2: a vertex needs three coordinates"));
    CHECK(contains(error_of(read_obj, "v 0 1,5 0\n"), "line 1: coordinate '1,5' is not a number"));
}

TEST_CASE("off: plain, with counts on the first line, without keyword, with comments") {
    for (const char* head :
         {"OFF\n3 1 0\n", "OFF 3 1 0\n", "3 1 0\n", "# c\nOFF # c\n\n3 1 # c\n", "OFF\r\n3 1 3\r\n"}) {
        CAPTURE(head);
        const TriangleMesh mesh =
            read_off(std::string(head) + "0 0 0\n# between\n1 0 0\n0 1 0.5\n\n3 0 1 2\n");
        CHECK(mesh.positions == Numbers{0, 0, 0, 1, 0, 0, 0, 1, 0.5});
        CHECK(mesh.triangles == Ids{0, 1, 2});
    }
}

TEST_CASE("off: with a byte order mark, and on one line") {
    for (const char* text : {"\xEF\xBB\xBFOFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0.5\n3 0 1 2\n",
                             "OFF 3 1 0 0 0 0 1 0 0 0 1 0.5 3 0 1 2\n", "3 1 0 0 0 0 1 0 0 0 1 0.5 3 0 1 2",
                             "# c\nOFF\n3 1 3 0 0 0 1 0 0 0 1 0.5 3 0 1 2 # c\n\n"}) {
        CAPTURE(text);
        const TriangleMesh mesh = read_off(text);
        CHECK(mesh.positions == Numbers{0, 0, 0, 1, 0, 0, 0, 1, 0.5});
        CHECK(mesh.triangles == Ids{0, 1, 2});
    }
    CHECK(read_off("OFF 4 2 0 0 0 0 1 0 0 1 1 0 0 1 0 3 0 1 2 3 0 2 3").triangles == Ids{0, 1, 2, 0, 2, 3});
    CHECK(contains(error_of(read_off, "OFF 3 4 0 0 0 0 1 0 0 0 1 0.5\n"), "more than the file can hold"));
    CHECK(contains(error_of(read_off, "OFF 3 1 0 0.00 0.00 0.00 1 0 0 0 1 0.5\n"), "ends before face 0"));
    CHECK(contains(error_of(read_off, "OFF 3 1 0 0.00 0.00 0.00 1 0 0 0 1 0.5 3 0 1\n"), "fewer vertices"));
    CHECK(contains(error_of(read_off, "OFF 3 1 0 0.00 0.00 0.00 1 0 0 0 1 0.5 3 0 1 3\n"), "vertex index 3"));
}

TEST_CASE("off: extra columns are ignored, polygons are cut") {
    const TriangleMesh mesh = read_off("STCNOFF\n4 1 0\n0 0 0 1 0 0 9 9\n1 0 0 1 0 0 9 9\n1 1 0 1 0 0 9 9\n0 "
                                       "1 0 1 0 0 9 9\n4 0 1 2 3 255 0 0\n");
    CHECK(mesh.positions == Numbers{0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0});
    CHECK(mesh.triangles == Ids{0, 1, 2, 0, 2, 3});
    CHECK(read_off("COFF 3 1 0\n0 0 0 255 0 0 255\n1 0 0 1 1 1 1\n0 1 0 1 1 1 1\n3 2 1 0\n").triangles ==
          Ids{2, 1, 0});
}

TEST_CASE("off: malformed files") {
    CHECK(contains(error_of(read_off, ""), "empty"));
    CHECK(contains(error_of(read_off, "hello\n"), "line 1: not an OFF file"));
    CHECK(contains(error_of(read_off, "4OFF\n3 1 0\n"), "three-dimensional"));
    CHECK(contains(error_of(read_off, "OFF BINARY\n"), "binary"));
    CHECK(contains(error_of(read_off, "OFF\n"), "ends"));
    CHECK(contains(error_of(read_off, "OFF\n3\n"), "number of faces"));
    CHECK(contains(error_of(read_off, "OFF\n-3 1 0\n"), "number of vertices"));
    CHECK(contains(error_of(read_off, "OFF\n4000000000 1 0\n0 0 0\n"), "more than the file can hold"));
    CHECK(contains(error_of(read_off, "OFF\n1 4000000000 0\n0 0 0\n"), "more than the file can hold"));
    CHECK(contains(error_of(read_off, "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1\n3 0 1 2\n"), "line 5"));
    CHECK(
        contains(error_of(read_off, "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 3\n"), "line 6: vertex index 3"));
    CHECK(contains(error_of(read_off, "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 -1\n"),
                   "line 6: vertex index -1"));
    CHECK(contains(error_of(read_off, "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n9999999999 0 1 2\n"),
                   "fewer vertices"));
    CHECK(contains(error_of(read_off, "OFF\n3 2 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n"), "ends before face 1"));
}

TEST_CASE("stl: ascii in any case, several solids") {
    const std::string facet = "FACET normal 0 0 1\n outer loop\n  vertex 0 0 0\n  VERTEX 1 0 0\n  vertex 0 1 "
                              "0.25\n endloop\n endfacet\n";
    const TriangleMesh mesh =
        read_stl("solid a # b\r\n" + facet + "endsolid a\nsolid vertex\n" + facet + "endsolid\n");
    CHECK(mesh.vertex_count() == 6);
    CHECK(mesh.positions[8] == 0.25);
    CHECK(mesh.triangles == Ids{0, 1, 2, 3, 4, 5});
}

TEST_CASE("stl: binary, also where it begins with 'solid'") {
    for (const char* title : {"made by a test", "solid made by a test"}) {
        std::string bytes = title;
        bytes.resize(80, ' ');
        append(bytes, uint32_t{2});
        for (int triangle = 0; triangle < 2; ++triangle) {
            for (int i = 0; i < 12; ++i) append(bytes, static_cast<float>(i + triangle));
            append(bytes, uint16_t{7});
        }
        const TriangleMesh mesh = read_stl(bytes);
        CHECK(mesh.positions == Numbers{3, 4, 5, 6, 7, 8, 9, 10, 11, 4, 5, 6, 7, 8, 9, 10, 11, 12});
        CHECK(mesh.triangles == Ids{0, 1, 2, 3, 4, 5});
        for (const size_t length : {size_t{0}, size_t{5}, size_t{83}, size_t{84}, bytes.size() - 1})
            CHECK(error_of(read_stl, bytes.substr(0, length)) != "");
    }
}

TEST_CASE("stl: malformed files") {
    CHECK(contains(
        error_of(read_stl,
                 "solid\nfacet\nouter loop\nvertex 0 0 0\nvertex 0 0 1\nendloop\nendfacet\nendsolid\n"),
        "line 6: a facet needs three vertices"));
    CHECK(contains(error_of(read_stl, "solid\nfacet\nouter loop\nvertex 0 0\n"), "line 4"));
    CHECK(contains(error_of(read_stl, "solid\nfacet\nouter loop\nvertex 0 0 b\n"), "'b' is not a number"));
    CHECK(contains(error_of(read_stl, "solid\nfacet\nouter loop\nvertex 0 0 1\nendsolid\n"), "not complete"));
    CHECK(contains(error_of(read_stl, "solid\nfacet\n"), "endsolid"));
    CHECK(contains(error_of(read_stl, "solid\nnonsense\n"), "line 2: 'nonsense'"));
}

TEST_CASE("mesh files are known by extension, else by how they begin") {
    CHECK(mesh_format("a/b.c/MESH.ObJ", "") == MeshFormat::obj);
    CHECK(mesh_format("mesh.ply", "") == MeshFormat::ply);
    CHECK(mesh_format("mesh.OFF", "") == MeshFormat::off);
    CHECK(mesh_format("mesh.Stl", "") == MeshFormat::stl);
    CHECK(mesh_format("a.obj/mesh", "ply\r\nformat") == MeshFormat::ply);
    CHECK(mesh_format("mesh", "NOFF\n") == MeshFormat::off);
    CHECK(mesh_format("mesh.txt", "solid x\n") == MeshFormat::stl);
    CHECK(mesh_format("mesh", "hello") == MeshFormat::unknown);
}

TEST_CASE("read_mesh names the file") {
    CHECK(contains(error_of(read_mesh, "/nowhere/mesh.obj"), "/nowhere/mesh.obj: No such file"));
    CHECK(contains(error_of(read_mesh, "/tmp"), "/tmp: is a directory"));
    CHECK(contains(error_of(read_mesh, "/dev/null"), ".obj, .ply, .off, .stl"));
}
