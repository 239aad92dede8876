#include "tools/mesh_io/ply_header.h"

#include <array>
#include <utility>

#include "tools/mesh_io/mesh_io.h"
#include "tools/mesh_io/text_scanner.h"

namespace geodesic::tools {

namespace {

PlyType type_of_name(const TextScanner& scanner, std::string_view name) {
    using enum PlyType;
    constexpr std::array<std::pair<std::string_view, PlyType>, 16> NAMES{{{"char", int8},
                                                                          {"int8", int8},
                                                                          {"uchar", uint8},
                                                                          {"uint8", uint8},
                                                                          {"short", int16},
                                                                          {"int16", int16},
                                                                          {"ushort", uint16},
                                                                          {"uint16", uint16},
                                                                          {"int", int32},
                                                                          {"int32", int32},
                                                                          {"uint", uint32},
                                                                          {"uint32", uint32},
                                                                          {"float", float32},
                                                                          {"float32", float32},
                                                                          {"double", float64},
                                                                          {"float64", float64}}};
    for (const auto& [known, type] : NAMES)
        if (name == known) return type;
    scanner.fail("unknown property type " + quoted(name));
}

PlyEncoding read_format(const TextScanner& scanner, std::string_view rest) {
    const std::string_view name = take_word(rest);
    if (take_word(rest) != "1.0") scanner.fail("only version 1.0 of the PLY format is known");
    if (name == "ascii") return PlyEncoding::ascii;
    if (name == "binary_little_endian") return PlyEncoding::little_endian;
    if (name == "binary_big_endian") return PlyEncoding::big_endian;
    scanner.fail("unknown PLY format " + quoted(name));
}

PlyElement read_element(const TextScanner& scanner, std::string_view rest) {
    PlyElement element;
    element.name = take_word(rest);
    const auto count = to_integer(take_word(rest));
    if (!count || *count < 0) scanner.fail("the number of elements is missing or bad");
    element.count = static_cast<uint64_t>(*count);
    return element;
}

PlyProperty read_property(const TextScanner& scanner, std::string_view rest) {
    PlyProperty property;
    std::string_view type = take_word(rest);
    if (type == "list") {
        property.count_type = type_of_name(scanner, take_word(rest));
        type = take_word(rest);
    }
    property.type = type_of_name(scanner, type);
    property.name = take_word(rest);
    if (property.name.empty()) scanner.fail("a property needs a name");
    return property;
}

void read_line(const TextScanner& scanner, std::string_view word, std::string_view rest, PlyHeader& header) {
    if (word == "element") {
        header.elements.push_back(read_element(scanner, rest));
    } else if (word == "property") {
        if (header.elements.empty()) scanner.fail("a property before the first element");
        header.elements.back().properties.push_back(read_property(scanner, rest));
    } else if (!word.empty() && word != "comment" && word != "obj_info") {
        scanner.fail(quoted(word) + " is no word of a PLY header");
    }
}

}

size_t size_of(PlyType type) {
    switch (type) {
    case PlyType::int8:
    case PlyType::uint8:
        return 1;
    case PlyType::int16:
    case PlyType::uint16:
        return 2;
    case PlyType::float64:
        return 8;
    default:
        return 4;
    }
}

PlyHeader read_ply_header(std::string_view bytes) {
    TextScanner scanner(bytes);
    PlyHeader header;
    bool has_format = false;
    std::string_view line;
    if (!scanner.next_line(line) || take_word(line) != "ply")
        throw MeshFileError("not a PLY file, it does not begin with 'ply'");
    while (scanner.next_line(line)) {
        const std::string_view word = take_word(line);
        if (word == "end_header") {
            if (!has_format) scanner.fail("the header has no 'format' line");
            header.size = bytes.size() - scanner.bytes_left();
            header.line_count = scanner.line_number();
            return header;
        }
        if (word == "format") {
            header.encoding = read_format(scanner, line);
            has_format = true;
        } else {
            read_line(scanner, word, line, header);
        }
    }
    scanner.fail("the file ends within the header");
}

}
