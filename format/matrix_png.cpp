#include "format/matrix_png.h"

#include <array>
#include <bit>
#include <cstring>
#include <string>

#include "format/error.h"
#include "format/png_stream.h"

namespace geodesic::format {
namespace {

constexpr std::size_t BYTES_PER_PIXEL = 4;

// Written out because std::byteswap is of C++23 and this holds on any host.
void pack(float value, std::byte* pixel) {
    const auto bits = std::bit_cast<std::uint32_t>(value);
    for (int i = 0; i < 4; ++i) pixel[i] = static_cast<std::byte>(bits >> (24 - 8 * i));
}

// In place: the pixel was read into the memory of the float that it stands for.
void unpack(float& value) {
    std::array<unsigned char, BYTES_PER_PIXEL> pixel;
    std::memcpy(pixel.data(), &value, pixel.size());
    const std::uint32_t bits = std::uint32_t{pixel[0]} << 24 | std::uint32_t{pixel[1]} << 16 |
                               std::uint32_t{pixel[2]} << 8 | std::uint32_t{pixel[3]};
    std::memcpy(&value, &bits, sizeof bits);
}

PngImage image_of(std::size_t value_count, std::uint32_t rows, std::uint32_t cols) {
    const PngImage image{rows, cols, Pixel::Rgba8};
    check_sides(image);
    if (value_count != std::uint64_t{rows} * cols)
        throw Error(GEOIDX_ERROR_INTERNAL, "a matrix of " + std::to_string(rows) + " rows x " +
                                               std::to_string(cols) + " columns with " +
                                               std::to_string(value_count) + " values");
    return image;
}

// Measured on distance matrices of smooth surfaces: the Paeth filter leaves the fewest bytes at any size, and
// of what it leaves only the frequencies can be packed, so that searching for repeats costs time and space
// for nothing. But a small symmetric matrix holds nearly every entry twice within the 32 KiB that deflate
// looks back.
Compression compression_of(const PngImage& image) {
    constexpr std::uint64_t SIZE_WORTH_SEARCHING = 5 * 32768;
    return {Filter::Paeth,
            image.height == image.width && image.height * (1 + image.row_size()) <= SIZE_WORTH_SEARCHING};
}

}

std::vector<std::byte> encode_png(std::span<const float> values, std::uint32_t rows, std::uint32_t cols) {
    const PngImage image = image_of(values.size(), rows, cols);
    std::vector<std::byte> pixels(BYTES_PER_PIXEL * values.size());
    for (std::size_t i = 0; i < values.size(); ++i) pack(values[i], &pixels[BYTES_PER_PIXEL * i]);
    return write_png(pixels, image, compression_of(image));
}

void decode_png(std::span<const std::byte> png, std::uint32_t rows, std::uint32_t cols,
                std::span<float> out) {
    read_png(png, image_of(out.size(), rows, cols), std::as_writable_bytes(out));
    for (float& value : out) unpack(value);
}

}
