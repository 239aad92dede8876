#include <array>
#include <bit>
#include <cctype>
#include <numeric>

#include "tools/mesh_io/mesh_io.h"
#include "tools/mesh_io/polygons.h"
#include "tools/mesh_io/text_scanner.h"

namespace geodesic::tools {

namespace {

constexpr size_t HEADER_SIZE = 84;
constexpr size_t TRIANGLE_SIZE = 50;

uint32_t little_endian_u32(std::string_view bytes, size_t offset) {
    uint32_t value = 0;
    for (size_t i = 4; i-- > 0;) value = value << 8 | static_cast<unsigned char>(bytes[offset + i]);
    return value;
}

uint64_t size_of_binary(std::string_view bytes) {
    return HEADER_SIZE + uint64_t{TRIANGLE_SIZE} * little_endian_u32(bytes, HEADER_SIZE - 4);
}

bool equals_ignoring_case(std::string_view word, std::string_view lower_case) {
    if (word.size() != lower_case.size()) return false;
    for (size_t i = 0; i < word.size(); ++i)
        if (std::tolower(static_cast<unsigned char>(word[i])) != lower_case[i]) return false;
    return true;
}

// Some programs begin binary files with "solid" too. The size decides; only where it does not fit, the word.
bool is_ascii(std::string_view bytes) {
    if (bytes.size() >= HEADER_SIZE && size_of_binary(bytes) == bytes.size()) return false;
    std::string_view rest = bytes.substr(0, bytes.find_first_of("\r\n"));
    if (!equals_ignoring_case(take_word(rest), "solid")) return false;
    return bytes.substr(0, 1024).find('\0') == std::string_view::npos;
}

std::vector<uint32_t> every_vertex_once(size_t vertex_count) {
    std::vector<uint32_t> triangles(vertex_count);
    std::iota(triangles.begin(), triangles.end(), 0u);
    return triangles;
}

TriangleMesh read_binary(std::string_view bytes) {
    if (bytes.size() < HEADER_SIZE)
        throw MeshFileError("byte " + std::to_string(bytes.size()) + ": the file ends within the STL header");
    if (size_of_binary(bytes) > bytes.size())
        throw MeshFileError("byte " + std::to_string(bytes.size()) + ": the file ends before the last of " +
                            std::to_string(little_endian_u32(bytes, HEADER_SIZE - 4)) + " triangles");
    const size_t triangle_count = little_endian_u32(bytes, HEADER_SIZE - 4);
    if (triangle_count > MAX_VERTICES / 3) throw MeshFileError("byte 80: too many triangles");
    TriangleMesh mesh;
    mesh.positions.reserve(9 * triangle_count);
    for (size_t triangle = 0; triangle < triangle_count; ++triangle)
        for (size_t i = 3; i < 12; ++i) { // the first three numbers are the normal
            const size_t offset = HEADER_SIZE + TRIANGLE_SIZE * triangle + 4 * i;
            mesh.positions.push_back(std::bit_cast<float>(little_endian_u32(bytes, offset)));
        }
    mesh.triangles = every_vertex_once(mesh.vertex_count());
    return mesh;
}

void read_vertex(const TextScanner& scanner, std::string_view line, std::vector<double>& positions) {
    for (int axis = 0; axis < 3; ++axis) {
        const std::string_view word = take_word(line);
        if (word.empty()) scanner.fail("a vertex needs three coordinates");
        const auto number = to_number(word);
        if (!number) scanner.fail("coordinate " + quoted(word) + " is not a number");
        positions.push_back(*number);
    }
}

bool is_structure(std::string_view word) {
    for (const auto* known : {"solid", "facet", "outer", "endfacet", "endsolid", "color"})
        if (equals_ignoring_case(word, known)) return true;
    return false;
}

TriangleMesh read_ascii(std::string_view bytes) {
    TextScanner scanner(bytes);
    TriangleMesh mesh;
    std::string_view line;
    bool ended = false;
    while (scanner.next_line(line)) {
        const std::string_view word = take_word(line);
        if (word.empty()) continue;
        ended = equals_ignoring_case(word, "endsolid");
        if (equals_ignoring_case(word, "vertex")) {
            read_vertex(scanner, line, mesh.positions);
        } else if (equals_ignoring_case(word, "endloop")) {
            if (mesh.positions.size() != 9 * (mesh.triangles.size() / 3 + 1))
                scanner.fail("a facet needs three vertices");
            mesh.triangles.resize(mesh.vertex_count());
        } else if (!is_structure(word)) {
            scanner.fail(quoted(word) + " is no word of an STL file");
        }
    }
    if (!ended) scanner.fail("the file ends before 'endsolid'");
    if (mesh.triangles.size() != mesh.vertex_count()) scanner.fail("the last facet is not complete");
    if (mesh.vertex_count() > MAX_VERTICES) scanner.fail("too many triangles");
    mesh.triangles = every_vertex_once(mesh.vertex_count());
    return mesh;
}

}

TriangleMesh read_stl(std::string_view bytes) {
    return is_ascii(bytes) ? read_ascii(bytes) : read_binary(bytes);
}

}
