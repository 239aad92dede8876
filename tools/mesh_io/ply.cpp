#include <array>
#include <bit>
#include <cmath>

#include "tools/mesh_io/mesh_io.h"
#include "tools/mesh_io/ply_header.h"
#include "tools/mesh_io/polygons.h"
#include "tools/mesh_io/text_scanner.h"

namespace geodesic::tools {

namespace {

// Reads the values of an ascii body. A binary type needs two bytes there, too: a digit and a separator.
class AsciiValues {
public:
    AsciiValues(std::string_view bytes, const PlyHeader& header)
        : scanner_(bytes.substr(header.size)), lines_before_(header.line_count) {}

    double next(PlyType) {
        const std::string_view word = scanner_.next_word();
        if (word.empty()) fail("the file ends too early");
        const auto number = to_number(word);
        if (!number) fail(quoted(word) + " is not a number");
        return *number;
    }
    void skip(uint64_t count, PlyType type) {
        for (uint64_t i = 0; i < count; ++i) next(type);
    }
    bool can_hold(uint64_t count, PlyType) const {
        return count <= (uint64_t{scanner_.bytes_left()} + 1) / 2;
    }

    [[noreturn]] void fail(const std::string& why) const {
        throw MeshFileError("line " + std::to_string(lines_before_ + scanner_.line_number()) + ": " + why);
    }

private:
    TextScanner scanner_;
    size_t lines_before_;
};

class BinaryValues {
public:
    BinaryValues(std::string_view bytes, const PlyHeader& header)
        : bytes_(bytes), offset_(header.size), big_endian_(header.encoding == PlyEncoding::big_endian) {}

    double next(PlyType type) {
        const uint64_t bits = take_bits(size_of(type));
        switch (type) {
        case PlyType::int8:
            return static_cast<int8_t>(bits);
        case PlyType::int16:
            return static_cast<int16_t>(bits);
        case PlyType::int32:
            return static_cast<int32_t>(bits);
        case PlyType::float32:
            return std::bit_cast<float>(static_cast<uint32_t>(bits));
        case PlyType::float64:
            return std::bit_cast<double>(bits);
        default:
            return static_cast<double>(bits);
        }
    }
    void skip(uint64_t count, PlyType type) {
        if (!can_hold(count, type)) fail("the file ends too early");
        offset_ += static_cast<size_t>(count) * size_of(type);
    }
    bool can_hold(uint64_t count, PlyType type) const {
        return count <= (bytes_.size() - offset_) / size_of(type);
    }

    [[noreturn]] void fail(const std::string& why) const {
        throw MeshFileError("byte " + std::to_string(offset_) + ": " + why);
    }

private:
    uint64_t take_bits(size_t size) {
        if (bytes_.size() - offset_ < size) fail("the file ends too early");
        uint64_t bits = 0;
        for (size_t i = 0; i < size; ++i) {
            const size_t place = big_endian_ ? i : size - 1 - i;
            bits = bits << 8 | static_cast<unsigned char>(bytes_[offset_ + place]);
        }
        offset_ += size;
        return bits;
    }

    std::string_view bytes_;
    size_t offset_;
    bool big_endian_;
};

template <class Values>
uint64_t next_list_count(Values& values, const PlyProperty& property) {
    const double count = values.next(*property.count_type);
    if (!(count >= 0) || count > double{MAX_VERTICES} ||
        count != static_cast<double>(static_cast<uint64_t>(count)))
        values.fail("a list of '" + property.name + "' has a bad length");
    if (!values.can_hold(static_cast<uint64_t>(count), property.type))
        values.fail("a list of '" + property.name + "' is longer than the file");
    return static_cast<uint64_t>(count);
}

template <class Values>
void skip_property(Values& values, const PlyProperty& property) {
    values.skip(property.count_type ? next_list_count(values, property) : 1, property.type);
}

// The elements' shortest possible form must fit into the file.
template <class Values>
void require_plausible(const Values& values, const PlyElement& element) {
    for (const PlyProperty& property : element.properties)
        if (!values.can_hold(element.count, property.count_type.value_or(property.type)))
            values.fail(std::to_string(element.count) + " of '" + element.name +
                        "' are more than the file can hold");
}

int axis_of(const PlyProperty& property) {
    if (property.count_type) return -1;
    return property.name == "x" ? 0 : property.name == "y" ? 1 : property.name == "z" ? 2 : -1;
}

bool is_polygon(const PlyProperty& property) {
    return property.count_type && (property.name == "vertex_indices" || property.name == "vertex_index");
}

template <class Values>
void require_axes(const Values& values, const PlyElement& element) {
    std::array<int, 3> found{};
    for (const PlyProperty& property : element.properties)
        if (const int axis = axis_of(property); axis >= 0) ++found[static_cast<size_t>(axis)];
    if (found != std::array<int, 3>{1, 1, 1})
        values.fail("the vertices need the properties x, y and z, once each");
}

template <class Values>
void read_vertices(Values& values, const PlyElement& element, TriangleMesh& mesh) {
    require_axes(values, element);
    if (element.count > MAX_VERTICES) values.fail("too many vertices");
    mesh.positions.resize(3 * element.count);
    for (uint64_t vertex = 0; vertex < element.count; ++vertex)
        for (const PlyProperty& property : element.properties) {
            const int axis = axis_of(property);
            if (axis < 0) {
                skip_property(values, property);
            } else {
                mesh.positions[3 * vertex + static_cast<size_t>(axis)] = values.next(property.type);
            }
        }
}

template <class Values>
void read_polygon(Values& values, const PlyProperty& property, uint64_t vertex_count,
                  std::vector<uint32_t>& polygon) {
    const uint64_t corners = next_list_count(values, property);
    if (corners < 3) values.fail("a face needs three vertices");
    polygon.clear();
    for (uint64_t corner = 0; corner < corners; ++corner) {
        const double index = values.next(property.type);
        if (index != std::floor(index)) values.fail("a vertex index of a face is not a whole number");
        if (!(index >= 0 && index < static_cast<double>(vertex_count))) {
            const auto whole = static_cast<int64_t>(index >= -1e15 && index <= 1e15 ? index : -1);
            values.fail(out_of_range(std::to_string(whole), vertex_count));
        }
        polygon.push_back(static_cast<uint32_t>(index));
    }
}

template <class Values>
void read_faces(Values& values, const PlyElement& element, uint64_t vertex_count, Polygons& polygons) {
    std::vector<uint32_t> polygon;
    for (uint64_t face = 0; face < element.count; ++face)
        for (const PlyProperty& property : element.properties) {
            if (is_polygon(property)) {
                read_polygon(values, property, vertex_count, polygon);
                polygons.add(polygon);
            } else {
                skip_property(values, property);
            }
        }
}

template <class Values>
void skip_element(Values& values, const PlyElement& element) {
    if (element.properties.empty()) return;
    for (uint64_t i = 0; i < element.count; ++i)
        for (const PlyProperty& property : element.properties) skip_property(values, property);
}

uint64_t vertex_count_of(const PlyHeader& header) {
    const PlyElement* vertices = nullptr;
    for (const PlyElement& element : header.elements) {
        if (element.name != "vertex") continue;
        if (vertices) throw MeshFileError("the header has two elements named 'vertex'");
        vertices = &element;
    }
    if (!vertices) throw MeshFileError("the header has no element 'vertex'");
    return vertices->count;
}

template <class Values>
TriangleMesh read_body(Values values, const PlyHeader& header) {
    const uint64_t vertex_count = vertex_count_of(header);
    TriangleMesh mesh;
    Polygons polygons;
    for (const PlyElement& element : header.elements) {
        require_plausible(values, element);
        if (element.name == "vertex") {
            read_vertices(values, element, mesh);
        } else if (element.name == "face" && !element.properties.empty()) {
            read_faces(values, element, vertex_count, polygons);
        } else {
            skip_element(values, element);
        }
    }
    mesh.triangles = triangulate(polygons, mesh.positions);
    return mesh;
}

}

TriangleMesh read_ply(std::string_view bytes) {
    const PlyHeader header = read_ply_header(bytes);
    if (header.encoding == PlyEncoding::ascii) return read_body(AsciiValues(bytes, header), header);
    return read_body(BinaryValues(bytes, header), header);
}

}
