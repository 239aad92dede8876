#include "bench/other_codings.h"

#include <cmath>
#include <csetjmp>
#include <new>

#include <png.h>
#include <zstd.h>

#include "tools/failure.h"

namespace geodesic::bench {

namespace {

std::vector<float> distances_of(std::span<const CodeTable> tables) {
    std::vector<float> distances;
    for (const CodeTable& table : tables)
        for (const float code : table.codes)
            distances.push_back(std::isinf(code) ? code : code * table.quantum);
    return distances;
}

// PNG puts the higher byte of a pixel first. Where there is no path, the pixel is white.
std::vector<unsigned char> pixels_of(const CodeTable& table) {
    std::vector<unsigned char> pixels;
    for (const float code : table.codes) {
        const unsigned pixel = std::isinf(code) ? 0xFFFF : static_cast<unsigned>(code);
        pixels.push_back(static_cast<unsigned char>(pixel >> 8));
        pixels.push_back(static_cast<unsigned char>(pixel & 0xFF));
    }
    return pixels;
}

void count_bytes(png_structp png, png_bytep, size_t size) {
    *static_cast<uint64_t*>(png_get_io_ptr(png)) += size;
}

// When libpng fails, it leaves this function by longjmp, so no object in it may have a destructor.
bool write_png(png_structp png, png_infop info, uint32_t rows, uint32_t columns,
               const unsigned char* pixels) {
    if (setjmp(png_jmpbuf(png)) != 0) return false;
    png_set_IHDR(png, info, columns, rows, 16, PNG_COLOR_TYPE_GRAY, PNG_INTERLACE_NONE,
                 PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
    png_set_filter(png, PNG_FILTER_TYPE_BASE, PNG_FILTER_PAETH);
    png_set_compression_level(png, 9);
    png_write_info(png, info);
    for (uint32_t r = 0; r < rows; ++r) png_write_row(png, pixels + size_t{2} * columns * r);
    png_write_end(png, nullptr);
    return true;
}

uint64_t gray_png_bytes(const CodeTable& table) {
    const std::vector<unsigned char> pixels = pixels_of(table);
    uint64_t bytes = 0;
    png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, nullptr, nullptr, nullptr);
    png_infop info = png ? png_create_info_struct(png) : nullptr;
    png_set_write_fn(png, &bytes, count_bytes, nullptr);
    const bool written = info && write_png(png, info, table.rows, table.columns, pixels.data());
    png_destroy_write_struct(&png, &info);
    if (!written) throw std::bad_alloc();
    return bytes;
}

}

uint64_t bytes_as_float_zstd(std::span<const CodeTable> tables) {
    const std::vector<float> distances = distances_of(tables);
    const size_t size = distances.size() * sizeof(float);
    std::vector<unsigned char> frame(ZSTD_compressBound(size));
    const size_t bytes = ZSTD_compress(frame.data(), frame.size(), distances.data(), size, 19);
    if (ZSTD_isError(bytes)) throw tools::Failure(std::string("zstd: ") + ZSTD_getErrorName(bytes));
    return bytes;
}

uint64_t bytes_as_gray_png(std::span<const CodeTable> tables) {
    uint64_t bytes = 0;
    for (const CodeTable& table : tables) bytes += gray_png_bytes(table);
    return bytes;
}

}
