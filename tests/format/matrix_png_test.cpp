#include "format/matrix_png.h"
#include "format/png_stream.h"

#include <algorithm>
#include <cmath>

#include <doctest/doctest.h>
#include <png.h>
#include <zlib.h>

#include "tests/format/helpers.h"

using namespace geodesic;
using namespace geodesic::format;
using namespace geodesic::format::test;

namespace {

geoidx_status decode_status(const Bytes& png, std::uint32_t rows, std::uint32_t cols) {
    std::vector<float> out(std::size_t{rows} * cols);
    return status_of([&] { decode_png(png, rows, cols, out); });
}

std::vector<float> decoded(const Bytes& png, std::uint32_t rows, std::uint32_t cols) {
    std::vector<float> out(std::size_t{rows} * cols);
    decode_png(png, rows, cols, out);
    return out;
}

// libpng's own reading and writing of a whole image, of which matrix_png.cpp uses nothing.
std::vector<png_byte> pixels_by_libpng(const Bytes& png, std::uint32_t& rows, std::uint32_t& cols) {
    png_image image{};
    image.version = PNG_IMAGE_VERSION;
    REQUIRE(png_image_begin_read_from_memory(&image, png.data(), png.size()) != 0);
    REQUIRE(image.format == PNG_FORMAT_RGBA);
    rows = image.height;
    cols = image.width;
    std::vector<png_byte> pixels(PNG_IMAGE_SIZE(image));
    REQUIRE(png_image_finish_read(&image, nullptr, pixels.data(), 0, nullptr) != 0);
    return pixels;
}

Bytes png_by_libpng(const void* pixels, std::uint32_t rows, std::uint32_t cols, png_uint_32 format) {
    png_image image{};
    image.version = PNG_IMAGE_VERSION;
    image.width = cols;
    image.height = rows;
    image.format = format;
    png_alloc_size_t size = 0;
    REQUIRE(png_image_write_get_memory_size(image, size, 0, pixels, 0, nullptr) != 0);
    Bytes png(size);
    REQUIRE(png_image_write_to_memory(&image, png.data(), &size, 0, pixels, 0, nullptr) != 0);
    png.resize(size);
    return png;
}

Bytes chunk(const char* type, const Bytes& data) {
    Bytes all;
    const auto add_number = [&](std::uint32_t value) {
        for (int shift = 24; shift >= 0; shift -= 8)
            all.push_back(static_cast<std::byte>(value >> shift & 0xFF));
    };
    add_number(static_cast<std::uint32_t>(data.size()));
    for (std::size_t i = 0; i < 4; ++i) all.push_back(static_cast<std::byte>(type[i]));
    all.insert(all.end(), data.begin(), data.end());
    add_number(static_cast<std::uint32_t>(
        crc32(0, reinterpret_cast<const Bytef*>(all.data() + 4), static_cast<uInt>(all.size() - 4))));
    return all;
}

// Changes a byte of the image header and makes its CRC right again.
Bytes with_image_header(Bytes png, std::size_t offset, int value) {
    png.at(offset) = static_cast<std::byte>(value);
    const auto crc = crc32(0, reinterpret_cast<const Bytef*>(png.data() + 12), 17);
    for (std::size_t i = 0; i < 4; ++i) png[29 + i] = static_cast<std::byte>(crc >> (24 - 8 * i) & 0xFF);
    return png;
}

}

TEST_CASE("a matrix comes back bit for bit from its image") {
    const std::vector<std::uint32_t> awkward = awkward_bits();
    CHECK(bits_of(decoded(encode_png(floats_of(awkward), 2, 7), 2, 7)) == awkward);
    CHECK(bits_of(decoded(encode_png(floats_of(awkward), 14, 1), 14, 1)) == awkward);
    const std::vector<std::pair<std::uint32_t, std::uint32_t>> shapes = {{1, 1},   {1, 500},  {500, 1},
                                                                         {30, 30}, {37, 210}, {230, 230}};
    for (const auto& shape : shapes) {
        const std::uint32_t rows = shape.first;
        const std::uint32_t cols = shape.second;
        CAPTURE(rows);
        CAPTURE(cols);
        const auto values = random_floats(std::size_t{rows} * cols, rows + cols);
        CHECK(bits_of(decoded(encode_png(values, rows, cols), rows, cols)) == bits_of(values));
    }
}

TEST_CASE("a matrix of distances comes back bit for bit and smaller") {
    constexpr std::uint32_t SIDE = 64;
    std::vector<float> values;
    for (std::uint32_t row = 0; row < SIDE; ++row) {
        for (std::uint32_t col = 0; col < SIDE; ++col) {
            const double angle = (static_cast<double>(row) - col) * 3.14159265358979 / SIDE;
            values.push_back(static_cast<float>(std::abs(std::sin(angle))));
        }
    }
    const Bytes png = encode_png(values, SIDE, SIDE);
    CHECK(png.size() < 4 * values.size());
    CHECK(bits_of(decoded(png, SIDE, SIDE)) == bits_of(values));
}

TEST_CASE("R, G, B and A are the bytes of a float from the most significant on, one row of pixels a row") {
    // 1.0 is 3F800000, -2.5 is C0200000, the smallest subnormal 00000001, a NaN with a payload 7FC0ABCD.
    const auto values =
        floats_of(std::vector<std::uint32_t>{0x3F800000, 0xC0200000, 0x00000001, 0x7FC0ABCD, 0, 0x80000000});
    REQUIRE(values[0] == 1.0F);
    REQUIRE(values[1] == -2.5F);
    std::uint32_t rows = 0;
    std::uint32_t cols = 0;
    const auto pixels = pixels_by_libpng(encode_png(values, 2, 3), rows, cols);
    CHECK(rows == 2);
    CHECK(cols == 3);
    CHECK(pixels == std::vector<png_byte>{0x3F, 0x80, 0,    0,    0xC0, 0x20, 0, 0, 0,    0, 0, 1,
                                          0x7F, 0xC0, 0xAB, 0xCD, 0,    0,    0, 0, 0x80, 0, 0, 0});
}

TEST_CASE("an image that another program wrote is read") {
    const std::vector<png_byte> pixels = {0x3F, 0x80, 0, 0, 0xC0, 0x20, 0, 0, 0x7F, 0x80, 0, 0};
    const auto values = decoded(png_by_libpng(pixels.data(), 1, 3, PNG_FORMAT_RGBA), 1, 3);
    CHECK(bits_of(values) == std::vector<std::uint32_t>{0x3F800000, 0xC0200000, 0x7F800000});
}

TEST_CASE("the same matrix gives the same image") {
    const auto values = random_floats(400, 3);
    CHECK(encode_png(values, 20, 20) == encode_png(values, 20, 20));
}

// libpng passes over chunks that it does not know. What is read of the one in front would be taken for the
// size, and the rows behind it have twice as many bytes.
TEST_CASE("an image with another chunk in front of its size is refused") {
    constexpr std::uint32_t ROWS = 5, COLS = 7;
    const Bytes expected = encode_png(random_floats(ROWS * COLS, 1), ROWS, COLS);
    const std::vector<std::uint16_t> wide(4 * ROWS * COLS, 0x4141);
    const Bytes hidden = png_by_libpng(wide.data(), ROWS, COLS, PNG_FORMAT_LINEAR_RGB_ALPHA);
    Bytes png(expected.begin(), expected.begin() + 8);
    const Bytes in_front = chunk("aaAa", {expected.begin() + 16, expected.begin() + 29});
    png.insert(png.end(), in_front.begin(), in_front.end());
    png.insert(png.end(), hidden.begin() + 8, hidden.end());
    CHECK(decode_status(png, ROWS, COLS) == GEOIDX_ERROR_CORRUPT);
    CHECK(decode_status(hidden, ROWS, COLS) == GEOIDX_ERROR_CORRUPT);
}

TEST_CASE("an image cut at any length is refused") {
    const Bytes png = encode_png(random_floats(35, 1), 5, 7);
    for (std::size_t length = 0; length < png.size(); ++length) {
        CAPTURE(length);
        CHECK(decode_status({png.begin(), png.begin() + static_cast<std::ptrdiff_t>(length)}, 5, 7) ==
              GEOIDX_ERROR_CORRUPT);
    }
}

TEST_CASE("an image with any changed bit is refused") {
    const Bytes png = encode_png(random_floats(35, 2), 5, 7);
    for (std::size_t bit = 0; bit < 8 * png.size(); ++bit) {
        CAPTURE(bit);
        Bytes changed = png;
        changed[bit / 8] ^= static_cast<std::byte>(1 << bit % 8);
        CHECK(decode_status(changed, 5, 7) == GEOIDX_ERROR_CORRUPT);
    }
}

TEST_CASE("an image of another size is refused") {
    const Bytes png = encode_png(random_floats(35, 4), 5, 7);
    CHECK(decode_status(png, 7, 5) == GEOIDX_ERROR_CORRUPT);
    CHECK(decode_status(png, 5, 6) == GEOIDX_ERROR_CORRUPT);
    CHECK(decode_status(png, 5, 8) == GEOIDX_ERROR_CORRUPT);
    CHECK(decode_status(png, 4, 7) == GEOIDX_ERROR_CORRUPT);
    CHECK(decode_status(png, 6, 7) == GEOIDX_ERROR_CORRUPT);
    CHECK(decode_status(png, MAX_PNG_SIDE, 0) == GEOIDX_ERROR_LIMIT);
}

TEST_CASE("an image with fewer or more rows than its header says is refused") {
    const Bytes png = encode_png(random_floats(35, 5), 5, 7);
    REQUIRE(decode_status(with_image_header(png, 23, 5), 5, 7) == GEOIDX_OK);
    CHECK(decode_status(with_image_header(png, 23, 6), 6, 7) == GEOIDX_ERROR_CORRUPT);
    CHECK(decode_status(with_image_header(png, 23, 4), 4, 7) == GEOIDX_ERROR_CORRUPT);
    CHECK(decode_status(with_image_header(png, 19, 6), 5, 6) == GEOIDX_ERROR_CORRUPT);
}

TEST_CASE("an image that is not plain 8-bit RGBA is refused") {
    const std::vector<png_uint_16> pixels(4 * 35, 1000);
    const std::vector<png_uint_32> formats = {PNG_FORMAT_GRAY, PNG_FORMAT_GA, PNG_FORMAT_RGB,
                                              PNG_FORMAT_LINEAR_RGB_ALPHA, PNG_FORMAT_LINEAR_Y};
    for (const png_uint_32 format : formats) {
        CAPTURE(format);
        CHECK(decode_status(png_by_libpng(pixels.data(), 5, 7, format), 5, 7) == GEOIDX_ERROR_CORRUPT);
    }
    const Bytes png = encode_png(random_floats(35, 6), 5, 7);
    constexpr std::size_t INTERLACE = 28;
    CHECK(decode_status(with_image_header(png, INTERLACE, 1), 5, 7) == GEOIDX_ERROR_CORRUPT);
}

TEST_CASE("bytes after the end of an image are refused") {
    Bytes png = encode_png(random_floats(35, 7), 5, 7);
    png.push_back(std::byte{0});
    CHECK(decode_status(png, 5, 7) == GEOIDX_ERROR_CORRUPT);
}

TEST_CASE("a matrix without rows or columns is refused") {
    std::vector<float> none;
    CHECK(status_of([&] { encode_png(none, 0, 5); }) == GEOIDX_ERROR_LIMIT);
    CHECK(status_of([&] { encode_png(none, 5, 0); }) == GEOIDX_ERROR_LIMIT);
    CHECK(status_of([&] { decode_png({}, 0, 0, none); }) == GEOIDX_ERROR_LIMIT);
    CHECK(status_of([&] { encode_png(none, 0x80000000, 1); }) == GEOIDX_ERROR_LIMIT);
}

TEST_CASE("values that do not fill the matrix are refused") {
    std::vector<float> values(6);
    CHECK(status_of([&] { encode_png(values, 2, 2); }) == GEOIDX_ERROR_INTERNAL);
    const Bytes png = encode_png(values, 2, 3);
    CHECK(status_of([&] { decode_png(png, 2, 2, values); }) == GEOIDX_ERROR_INTERNAL);
}
