#include <doctest/doctest.h>

#include "tests/tools/mesh_texts.h"

using namespace geodesic::tools;
using namespace geodesic::tools::test;

namespace {

std::string ply_error(const std::string& bytes) { return error_of(read_ply, bytes); }

std::string header(const std::string& format, const std::string& elements) {
    return "ply\nformat " + format + " 1.0\ncomment nothing\nobj_info nothing\n" + elements + "end_header\n";
}

const std::string PLAIN = "element vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
                          "element face 1\nproperty list uchar int vertex_indices\n";

// Extra elements and properties before, between and after what is read, in mixed types.
const std::string RICH = "element camera 2\nproperty list ushort double pose\nproperty char kind\n"
                         "element vertex 4\nproperty uchar red\nproperty double z\nproperty short x\n"
                         "property list uchar float tail\nproperty float32 y\n"
                         "element face 1\nproperty int16 flag\nproperty list uint32 uint16 vertex_index\n"
                         "property list int8 float64 weights\nelement edge 1\nproperty int a\n";

std::string rich_binary(bool big) {
    std::string bytes = header(big ? "binary_big_endian" : "binary_little_endian", RICH);
    for (uint16_t camera = 0; camera < 2; ++camera) {
        append(bytes, camera, big);
        for (int i = 0; i < camera; ++i) append(bytes, 1.5, big);
        append(bytes, int8_t{-1}, big);
    }
    for (int vertex = 0; vertex < 4; ++vertex) {
        append(bytes, uint8_t{200}, big);
        append(bytes, 0.1 * vertex, big);
        append(bytes, static_cast<int16_t>(-vertex), big);
        append(bytes, uint8_t{1}, big);
        append(bytes, 2.5f, big);
        append(bytes, 0.5f * static_cast<float>(vertex), big);
    }
    append(bytes, int16_t{-5}, big);
    append(bytes, uint32_t{4}, big);
    for (uint16_t id = 4; id-- > 0;) append(bytes, id, big);
    append(bytes, int8_t{1}, big);
    append(bytes, 9.0, big);
    append(bytes, int32_t{77}, big);
    return bytes;
}

void check_rich(const TriangleMesh& mesh) {
    CHECK(mesh.positions == Numbers{0, 0, 0, -1, 0.5, 0.1, -2, 1, 0.1 * 2, -3, 1.5, 0.1 * 3});
    CHECK(mesh.triangles == Ids{3, 2, 1, 3, 1, 0});
}

}

TEST_CASE("ply: ascii") {
    const TriangleMesh mesh = read_ply(header("ascii", PLAIN) + "0 0 0\n1 0 0\n0 1 0.1\n3 0 1 2\n");
    CHECK(mesh.positions == Numbers{0, 0, 0, 1, 0, 0, 0, 1, 0.1});
    CHECK(mesh.triangles == Ids{0, 1, 2});
}

TEST_CASE("ply: ascii with every line end CRLF") {
    std::string text = header("ascii", PLAIN) + "0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n";
    for (size_t at = 0; (at = text.find('\n', at)) != std::string::npos; at += 2) text.insert(at, 1, '\r');
    CHECK(read_ply(text).triangles == Ids{0, 1, 2});
}

TEST_CASE("ply: ascii with other elements, types and orders") {
    check_rich(read_ply(header("ascii", RICH) + "0 -1\n1 1.5 -1\n200 0 0 1 2.5 0\n200 0.1 -1 1 2.5 .5\n"
                                                "200 0.2 -2 1 2.5 1\n200 0.30000000000000004 -3 1 2.5 1.5\n"
                                                "-5 4 3 2 1 0 1 9\n77\n"));
}

TEST_CASE("ply: binary of both byte orders") {
    check_rich(read_ply(rich_binary(false)));
    check_rich(read_ply(rich_binary(true)));
}

TEST_CASE("ply: faces may come before the vertices") {
    const std::string swapped = "element face 1\nproperty list uchar int vertex_indices\nelement vertex 3\n"
                                "property float x\nproperty float y\nproperty float z\n";
    CHECK(read_ply(header("ascii", swapped) + "3 2 1 0\n0 0 0\n1 0 0\n0 1 0\n").triangles == Ids{2, 1, 0});
}

TEST_CASE("ply: a binary file cut off anywhere is an error") {
    const std::string bytes = rich_binary(false);
    for (size_t length = 0; length < bytes.size(); ++length) {
        CAPTURE(length);
        CHECK(ply_error(bytes.substr(0, length)) != "");
    }
}

TEST_CASE("ply: malformed headers") {
    CHECK(contains(ply_error(""), "not a PLY file"));
    CHECK(contains(ply_error("plyx\n"), "not a PLY file"));
    CHECK(contains(ply_error("ply\nformat ascii 2.0\n"), "line 2"));
    CHECK(contains(ply_error("ply\nformat octal 1.0\n"), "'octal'"));
    CHECK(contains(ply_error("ply\nelement vertex -1\n"), "line 2"));
    CHECK(contains(ply_error("ply\nproperty float x\n"), "before the first element"));
    CHECK(contains(ply_error("ply\nelement vertex 1\nproperty quad x\n"), "'quad'"));
    CHECK(contains(ply_error("ply\nwhatever\n"), "line 2: 'whatever'"));
    CHECK(contains(ply_error("ply\nend_header\n"), "no 'format'"));
    CHECK(contains(ply_error(header("ascii", "")), "no element 'vertex'"));
    CHECK(contains(
        ply_error(header("ascii", "element vertex 1\nproperty float x\nproperty float y\n") + "1 2\n"),
        "x, y and z"));
    CHECK(contains(ply_error(header("ascii", "element vertex 0\n" + PLAIN)), "two elements"));
}

TEST_CASE("ply: counts are held against the size of the file before memory is asked for") {
    const std::string axes = "property float x\nproperty float y\nproperty float z\n";
    for (const char* format : {"ascii", "binary_little_endian"}) {
        CHECK(contains(ply_error(header(format, "element vertex 4000000000\n" + axes) + "0 0 0\n"),
                       "than the file"));
        CHECK(contains(ply_error(header(format, "element vertex 9223372036854775807\n" + axes)),
                       "than the file"));
        CHECK(read_ply(header(format, "element nothing 9223372036854775807\nelement vertex 0\n" + axes))
                  .positions.empty());
    }
    std::string bytes =
        header("binary_little_endian",
               "element vertex 0\n" + axes + "element face 1\nproperty list uint int vertex_indices\n");
    append(bytes, uint32_t{4000000000}, false);
    CHECK(contains(ply_error(bytes), "longer than the file"));
}

TEST_CASE("ply: malformed bodies") {
    const std::string start = header("ascii", PLAIN) + "0 0 0\n1 0 0\n";
    CHECK(contains(ply_error(start + "0 1 b\n3 0 1 2\n"), "line 14: 'b' is not a number"));
    CHECK(contains(ply_error(start + "0 1 0\n3 0 1 3\n"), "line 15: vertex index 3 is out of range"));
    CHECK(contains(ply_error(start + "0 1 0\n3 0 1 -1\n"), "vertex index -1 is out of range"));
    for (const char* index : {"1.5", "nan"})
        CHECK(contains(ply_error(start + "0 1 0\n3 0 1 " + index + "\n"), "not a whole number"));
    CHECK(contains(ply_error(start + "0 1 0\n3 0 1 1.5\n"), "line 15"));
    CHECK(contains(ply_error(start + "0 1 0\n3 0 1 nan\n"), "line 15"));
    CHECK(contains(ply_error(start + "0 1 0\n2 0 1\n"), "needs three vertices"));
    CHECK(contains(ply_error(start + "0 1 0\n-3 0 1 2\n"), "bad length"));
    CHECK(contains(ply_error(start + "0 1 0\n3 0 1\n"), "longer than the file"));
}
