#include <array>
#include <istream>
#include <streambuf>

#include <tiny_obj_loader.h>

#include "tools/mesh_io/mesh_io.h"
#include "tools/mesh_io/polygons.h"
#include "tools/mesh_io/text_scanner.h"

namespace geodesic::tools {

namespace {

// Hands tinyobjloader one line at a time, so that a callback knows which line it is about. Lines continued by
// a backslash are joined and comments removed, neither of which tinyobjloader does in a face.
class LineByLine final : public std::streambuf {
public:
    explicit LineByLine(std::string_view text) : scanner_(text) {}

    std::string_view line() const { return {line_.data(), line_.size() - 1}; }
    size_t line_number() const { return first_line_number_; }

    [[noreturn]] void fail(const std::string& why) const {
        throw MeshFileError("line " + std::to_string(first_line_number_) + ": " + why);
    }

protected:
    int_type underflow() override {
        std::string_view part;
        if (!scanner_.next_filled_line(part)) return traits_type::eof();
        first_line_number_ = scanner_.line_number();
        line_.assign(part);
        while (line_.ends_with('\\') && scanner_.next_line(part)) {
            line_.back() = ' ';
            line_.append(part.substr(0, part.find('#')));
        }
        line_.append(is_empty_face() ? " 0" : "");
        // The blank makes a keyword of a 'v' that stands alone, which would be skipped otherwise.
        line_.append(" \n");
        setg(line_.data(), line_.data(), line_.data() + line_.size());
        return traits_type::to_int_type(line_.front());
    }

private:
    // tinyobjloader reports no face without vertices; one with too few it does.
    bool is_empty_face() const {
        std::string_view rest = line_;
        return take_word(rest) == "f" && take_word(rest).empty();
    }

    TextScanner scanner_;
    std::string line_;
    size_t first_line_number_ = 0;
};

// The highest index used so far and its line: a face may come before its vertices.
struct HighestIndex {
    uint32_t index = 0;
    size_t line_number = 0;
};

struct ObjMesh {
    explicit ObjMesh(std::string_view bytes) : lines(bytes) {}

    LineByLine lines;
    TriangleMesh mesh;
    HighestIndex highest;
    Polygons polygons;
    std::vector<uint32_t> polygon;
};

// tinyobjloader reads "nan", "1,5" and missing numbers as 0 and decimals a few units in the last place off,
// so the numbers are taken from the line itself.
std::array<double, 3> position_of(const LineByLine& lines) {
    std::string_view rest = lines.line();
    take_word(rest);
    std::array<double, 3> position{};
    for (double& coordinate : position) {
        const std::string_view word = take_word(rest);
        if (word.empty()) lines.fail("a vertex needs three coordinates");
        const auto number = to_number(word);
        if (!number) lines.fail("coordinate " + quoted(word) + " is not a number");
        coordinate = *number;
    }
    return position;
}

void on_vertex(void* user, double, double, double, double) {
    ObjMesh& obj = *static_cast<ObjMesh*>(user);
    if (obj.mesh.vertex_count() >= MAX_VERTICES) obj.lines.fail("too many vertices");
    const auto position = position_of(obj.lines);
    obj.mesh.positions.insert(obj.mesh.positions.end(), position.begin(), position.end());
}

// tinyobjloader reads what is no number as 0 and lets large ones wrap around; the word shows it.
void require_same_index(const LineByLine& lines, std::string_view word, int index) {
    const auto written = to_integer(word.substr(0, word.find('/')));
    if (!written) lines.fail(quoted(word) + " is not a vertex of a face");
    if (*written != index) lines.fail("vertex index " + quoted(word) + " is out of range");
}

uint32_t zero_based(ObjMesh& obj, int index) {
    const auto count = static_cast<int64_t>(obj.mesh.vertex_count());
    const int64_t vertex = index > 0 ? index - int64_t{1} : count + index;
    if (index == 0) obj.lines.fail("vertex index 0, but the first vertex is 1");
    if (vertex < 0) obj.lines.fail(out_of_range(std::to_string(index), obj.mesh.vertex_count()));
    return static_cast<uint32_t>(vertex);
}

void on_face(void* user, tinyobj::index_t* indices, int index_count) {
    ObjMesh& obj = *static_cast<ObjMesh*>(user);
    if (index_count < 3) obj.lines.fail("a face needs three vertices");
    std::string_view words = obj.lines.line();
    take_word(words);
    obj.polygon.clear();
    for (int i = 0; i < index_count; ++i) {
        require_same_index(obj.lines, take_word(words), indices[i].vertex_index);
        const uint32_t vertex = zero_based(obj, indices[i].vertex_index);
        if (vertex > obj.highest.index) obj.highest = {vertex, obj.lines.line_number()};
        obj.polygon.push_back(vertex);
    }
    obj.polygons.add(obj.polygon);
}

void require_known_vertices(const ObjMesh& obj) {
    if (obj.polygons.empty() || obj.highest.index < obj.mesh.vertex_count()) return;
    throw MeshFileError(
        "line " + std::to_string(obj.highest.line_number) + ": " +
        out_of_range(std::to_string(obj.highest.index + uint64_t{1}), obj.mesh.vertex_count()));
}

}

TriangleMesh read_obj(std::string_view bytes) {
    constexpr std::string_view BYTE_ORDER_MARK = "\xEF\xBB\xBF";
    if (bytes.starts_with(BYTE_ORDER_MARK)) bytes.remove_prefix(BYTE_ORDER_MARK.size());
    ObjMesh obj(bytes);
    std::istream stream(&obj.lines);
    tinyobj::callback_t callbacks;
    callbacks.vertex_cb = on_vertex;
    callbacks.index_cb = on_face;
    std::string warnings;
    std::string errors;
    if (!tinyobj::LoadObjWithCallback(stream, callbacks, &obj, nullptr, &warnings, &errors))
        throw MeshFileError(errors.substr(0, errors.find('\n')));
    require_known_vertices(obj);
    obj.mesh.triangles = triangulate(obj.polygons, obj.mesh.positions);
    return std::move(obj.mesh);
}

}
