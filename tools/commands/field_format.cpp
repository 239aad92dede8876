#include "tools/commands/field_format.h"

#include <bit>
#include <charconv>
#include <cmath>
#include <string>

#include "tools/mesh_io/mesh_io.h"
#include "tools/picture/colour_map.h"

namespace geodesic::tools {

namespace {

using Bytes = std::vector<unsigned char>;

// Byte by byte: g++ 12 sees overruns in insert() that are not there.
void append_text(Bytes& bytes, std::string_view text) {
    for (const char c : text) bytes.push_back(static_cast<unsigned char>(c));
}

template <class Bits>
void append_little_endian(Bytes& bytes, Bits bits) {
    for (size_t i = 0; i < sizeof bits; ++i) bytes.push_back(static_cast<unsigned char>(bits >> (8 * i)));
}

void append_numbers(Bytes& bytes, std::span<const float> distances) {
    bytes.reserve(bytes.size() + 4 * distances.size());
    for (const float distance : distances) append_little_endian(bytes, std::bit_cast<uint32_t>(distance));
}

Bytes f32_file(std::span<const float> distances) {
    Bytes bytes;
    append_numbers(bytes, distances);
    return bytes;
}

// With the digits that bring the same float back.
Bytes csv_file(std::span<const float> distances) {
    Bytes bytes;
    append_text(bytes, "vertex,distance\n");
    std::array<char, 64> line;
    char* const end = line.data() + line.size();
    for (size_t v = 0; v < distances.size(); ++v) {
        char* stop = std::to_chars(line.data(), end, v).ptr;
        *stop++ = ',';
        stop = std::to_chars(stop, end, distances[v]).ptr; // "inf" where it is infinite
        *stop++ = '\n';
        append_text(bytes, {line.data(), stop});
    }
    return bytes;
}

// The header is padded with blanks so that the numbers begin at a multiple of 64 bytes.
Bytes npy_file(std::span<const float> distances) {
    constexpr std::string_view MAGIC{"\x93NUMPY\x01\x00", 8};
    std::string header =
        "{'descr': '<f4', 'fortran_order': False, 'shape': (" + std::to_string(distances.size()) + ",), }";
    const size_t unpadded = MAGIC.size() + sizeof(uint16_t) + header.size() + 1;
    header.append((64 - unpadded % 64) % 64, ' ').append(1, '\n');
    Bytes bytes;
    append_text(bytes, MAGIC);
    append_little_endian(bytes, static_cast<uint16_t>(header.size()));
    append_text(bytes, header);
    append_numbers(bytes, distances);
    return bytes;
}

std::string ply_header(const TriangleMesh& mesh) {
    return "ply\nformat binary_little_endian 1.0\ncomment geodesic distances by geoidx\nelement vertex " +
           std::to_string(mesh.vertex_count()) +
           "\nproperty double x\nproperty double y\nproperty double z\nproperty float distance\n"
           "property uchar red\nproperty uchar green\nproperty uchar blue\nelement face " +
           std::to_string(mesh.triangle_count()) + "\nproperty list uchar uint vertex_indices\nend_header\n";
}

float largest_finite(std::span<const float> distances) {
    float largest = 0;
    for (const float distance : distances)
        if (std::isfinite(distance)) largest = std::max(largest, distance);
    return largest;
}

void append_colour(Bytes& bytes, Colour linear) {
    const Colour srgb = srgb_from_linear(linear);
    for (const double part : {srgb.x, srgb.y, srgb.z})
        bytes.push_back(static_cast<unsigned char>(std::lround(255 * part)));
}

Bytes ply_file(std::span<const float> distances, const TriangleMesh& mesh) {
    Bytes bytes;
    append_text(bytes, ply_header(mesh));
    bytes.reserve(bytes.size() + 31 * mesh.vertex_count() + 13 * mesh.triangle_count());
    const ColourMap colour_map;
    const float largest = largest_finite(distances);
    for (size_t v = 0; v < distances.size(); ++v) {
        for (size_t axis = 0; axis < 3; ++axis)
            append_little_endian(bytes, std::bit_cast<uint64_t>(mesh.positions[3 * v + axis]));
        append_little_endian(bytes, std::bit_cast<uint32_t>(distances[v]));
        append_colour(bytes, colour_map.of_distance(distances[v], largest));
    }
    for (size_t corner = 0; corner < mesh.triangles.size(); ++corner) {
        if (corner % 3 == 0) bytes.push_back(3);
        append_little_endian(bytes, mesh.triangles[corner]);
    }
    return bytes;
}

}

std::optional<FieldFormat> field_format_of_name(std::string_view name) {
    for (size_t i = 0; i < FIELD_FORMAT_NAMES.size(); ++i)
        if (name == FIELD_FORMAT_NAMES[i]) return static_cast<FieldFormat>(i);
    return std::nullopt;
}

std::optional<FieldFormat> field_format_of_file(std::string_view path) {
    return field_format_of_name(lower_case_extension(path));
}

std::vector<unsigned char> encode_field(FieldFormat format, std::span<const float> distances,
                                        const TriangleMesh* mesh) {
    switch (format) {
    case FieldFormat::csv:
        return csv_file(distances);
    case FieldFormat::npy:
        return npy_file(distances);
    case FieldFormat::ply:
        return ply_file(distances, *mesh);
    case FieldFormat::f32:
        break;
    }
    return f32_file(distances);
}

}
