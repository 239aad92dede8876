#include "tools/mesh_io/mesh_io.h"
#include "tools/mesh_io/polygons.h"
#include "tools/mesh_io/text_scanner.h"

namespace geodesic::tools {

namespace {

struct Counts {
    uint64_t vertices = 0;
    uint64_t faces = 0;
};

bool is_keyword(std::string_view word) { return word.ends_with("OFF"); }

// Normals, colours and texture coordinates come after the position, so they need no attention.
void require_known_keyword(const TextScanner& scanner, std::string_view word, std::string_view rest) {
    for (const char c : word.substr(0, word.size() - 3))
        if (c != 'S' && c != 'T' && c != 'C' && c != 'N')
            scanner.fail(quoted(word) + ": only three-dimensional OFF files are known");
    if (take_word(rest) == "BINARY") scanner.fail("binary OFF files are not known");
}

template <class Source>
uint64_t take_count(const Source& scanner, std::string_view& line, const char* what) {
    const std::string_view word = take_word(line);
    const auto count = to_integer(word);
    if (!count || *count < 0) scanner.fail(std::string("the number of ") + what + " is missing or bad");
    return static_cast<uint64_t>(*count);
}

// The keyword may be missing, and the counts may follow it on the same line. `line` is what follows the
// counts on theirs.
Counts read_header(TextScanner& scanner, std::string_view& line) {
    if (!scanner.next_filled_line(line)) throw MeshFileError("the file is empty");
    std::string_view after = line;
    const std::string_view word = take_word(after);
    if (is_keyword(word)) {
        require_known_keyword(scanner, word, after);
        line = after;
        if (take_word(after).empty() && !scanner.next_filled_line(line))
            scanner.fail("the file ends before the number of vertices");
    } else if (!to_integer(word)) {
        scanner.fail("not an OFF file, it begins with " + quoted(word));
    }
    Counts counts;
    counts.vertices = take_count(scanner, line, "vertices");
    counts.faces = take_count(scanner, line, "faces");
    take_word(line); // the number of edges, which may be missing
    return counts;
}

// Vertices and faces: each has a line of its own or, where all of the file is on one line, follows the one
// before.
class Elements {
public:
    Elements(TextScanner& scanner, std::string_view after_counts) : scanner_(scanner), line_(after_counts) {
        TextScanner ahead = scanner;
        std::string_view ignored;
        on_one_line_ = has_words() && !ahead.next_filled_line(ignored);
    }

    size_t bytes_left() const { return on_one_line_ ? line_.size() : scanner_.bytes_left(); }

    // Goes to the next one, whose words are then to be taken from line(); false at the end of the file.
    bool next() { return on_one_line_ ? has_words() : scanner_.next_filled_line(line_); }
    std::string_view& line() { return line_; }

    [[noreturn]] void fail(const std::string& why) const { scanner_.fail(why); }

private:
    bool has_words() const {
        std::string_view rest = line_;
        return !take_word(rest).empty();
    }

    TextScanner& scanner_;
    std::string_view line_;
    bool on_one_line_;
};

// A vertex takes at least six bytes ("0 0 0" and a line end, which the last line may lack), a face eight.
void require_plausible(const Elements& elements, const Counts& counts) {
    const uint64_t bytes = uint64_t{elements.bytes_left()} + 1;
    if (counts.vertices > MAX_VERTICES || counts.vertices > bytes / 6)
        elements.fail(std::to_string(counts.vertices) + " vertices are more than the file can hold");
    if (counts.faces > bytes / 8)
        elements.fail(std::to_string(counts.faces) + " faces are more than the file can hold");
}

void read_vertex(Elements& elements, uint64_t vertex, std::vector<double>& positions) {
    if (!elements.next()) elements.fail("the file ends before vertex " + std::to_string(vertex));
    for (int axis = 0; axis < 3; ++axis) {
        const std::string_view word = take_word(elements.line());
        if (word.empty()) elements.fail("a vertex needs three coordinates");
        const auto number = to_number(word);
        if (!number) elements.fail("coordinate " + quoted(word) + " is not a number");
        positions.push_back(*number);
    }
}

uint32_t take_index(Elements& elements, uint64_t vertex_count) {
    const std::string_view word = take_word(elements.line());
    if (word.empty()) elements.fail("the face has fewer vertices than it says");
    const auto index = to_integer(word);
    if (!index) elements.fail("vertex index " + quoted(word) + " is not a number");
    if (*index < 0 || static_cast<uint64_t>(*index) >= vertex_count)
        elements.fail(out_of_range(std::to_string(*index), vertex_count));
    return static_cast<uint32_t>(*index);
}

void read_face(Elements& elements, uint64_t face, uint64_t vertex_count, Polygons& polygons,
               std::vector<uint32_t>& polygon) {
    if (!elements.next()) elements.fail("the file ends before face " + std::to_string(face));
    const uint64_t corners = take_count(elements, elements.line(), "vertices of the face");
    if (corners < 3) elements.fail("a face needs three vertices");
    polygon.clear();
    for (uint64_t corner = 0; corner < corners; ++corner)
        polygon.push_back(take_index(elements, vertex_count));
    polygons.add(polygon);
}

}

TriangleMesh read_off(std::string_view bytes) {
    TextScanner scanner(without_byte_order_mark(bytes));
    std::string_view after_counts;
    const Counts counts = read_header(scanner, after_counts);
    Elements elements(scanner, after_counts);
    require_plausible(elements, counts);
    TriangleMesh mesh;
    mesh.positions.reserve(3 * counts.vertices);
    for (uint64_t vertex = 0; vertex < counts.vertices; ++vertex)
        read_vertex(elements, vertex, mesh.positions);
    Polygons polygons;
    std::vector<uint32_t> polygon;
    for (uint64_t face = 0; face < counts.faces; ++face)
        read_face(elements, face, counts.vertices, polygons, polygon);
    mesh.triangles = triangulate(polygons, mesh.positions);
    return mesh;
}

}
