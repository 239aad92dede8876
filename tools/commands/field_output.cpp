#include "tools/commands/field_output.h"

#include <bit>
#include <charconv>

#include "tools/failure.h"
#include "tools/output_file.h"
#include "tools/picture/png.h"
#include "tools/picture/render.h"

namespace geodesic::tools {

namespace {

std::vector<unsigned char> little_endian(std::span<const float> distances) {
    std::vector<unsigned char> bytes;
    bytes.reserve(4 * distances.size());
    for (const float distance : distances) {
        const auto bits = std::bit_cast<uint32_t>(distance);
        for (int shift = 0; shift < 32; shift += 8)
            bytes.push_back(static_cast<unsigned char>(bits >> shift));
    }
    return bytes;
}

bool parse_side(std::string_view word, int& side) {
    const auto [stop, error] = std::from_chars(word.data(), word.data() + word.size(), side);
    return error == std::errc{} && stop == word.data() + word.size() && side >= 16 && side <= 16384;
}

PictureOptions picture_options(const FieldOutput& output) {
    PictureOptions options;
    const std::string_view size = output.size;
    const size_t cross = size.find('x');
    if (cross == std::string_view::npos || !parse_side(size.substr(0, cross), options.width) ||
        !parse_side(size.substr(cross + 1), options.height))
        throw CLI::ValidationError("--size: '" + output.size +
                                   "' is not WIDTHxHEIGHT with sides of 16 to 16384");
    options.isolines = output.isolines;
    options.up = output.up == "x" ? UpAxis::x : output.up == "z" ? UpAxis::z : UpAxis::y;
    return options;
}

std::vector<unsigned char> encode(const FieldOutput& output, const Image& image) {
    try {
        return encode_png(image);
    } catch (const std::runtime_error& error) {
        throw Failure(output.picture + ": " + error.what());
    }
}

}

CLI::Option* add_field_options(CLI::App& command, FieldOutput& output) {
    command.add_option("-o,--output", output.numbers, "file to write: a little-endian float32 per vertex")
        ->required();
    CLI::Option* png = command.add_option("--png", output.picture, "picture of the distances to write");
    command.add_option("--size", output.size, "of the picture, WIDTHxHEIGHT")
        ->needs(png)
        ->capture_default_str();
    command.add_option("--isolines", output.isolines, "number of lines of equal distance in the picture")
        ->needs(png)
        ->check(CLI::Range(0, 10000))
        ->capture_default_str();
    command.add_option("--up", output.up, "axis that points up in the picture")
        ->needs(png)
        ->check(CLI::IsMember({"x", "y", "z"}))
        ->capture_default_str();
    return png;
}

void require_writable(const FieldOutput& output, std::span<const std::string> inputs) {
    picture_options(output);
    require_writable(output.numbers, inputs);
    if (output.picture.empty()) return;
    require_writable(output.picture, inputs);
    if (is_same_path(output.picture, output.numbers))
        throw Failure(output.picture + ": is both -o and --png");
}

void write_field(const FieldOutput& output, std::span<const float> distances, const TriangleMesh* mesh,
                 std::span<const uint32_t> sources) {
    std::vector<unsigned char> picture;
    if (mesh && !output.picture.empty())
        picture = encode(output, render_field(*mesh, distances, sources, picture_options(output)));
    write_file(output.numbers, little_endian(distances));
    if (!picture.empty()) write_file(output.picture, picture);
}

}
