#include "tools/commands/picture_output.h"

#include <charconv>

#include "tools/failure.h"
#include "tools/picture/png.h"

namespace geodesic::tools {

namespace {

bool parse_side(std::string_view word, int& side) {
    const auto [stop, error] = std::from_chars(word.data(), word.data() + word.size(), side);
    return error == std::errc{} && stop == word.data() + word.size() && side >= 16 && side <= 16384;
}

}

CLI::Option* add_picture_options(CLI::App& command, PictureOutput& output) {
    CLI::Option* png = command.add_option("--png", output.file, "picture of the distances to write");
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

PictureOptions picture_options(const PictureOutput& output) {
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

std::vector<unsigned char> encode_picture(const PictureOutput& output, const Image& image) {
    try {
        return encode_png(image);
    } catch (const std::runtime_error& error) {
        throw Failure(output.file + ": " + error.what());
    }
}

}
