#pragma once

// Images in memory to PNG streams and back, over libpng. What the pixels mean is for others: matrix_png.h and
// byte_images.h.

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace geodesic::format {

// The largest width and height that PNG can say; the smallest are 1.
inline constexpr std::uint32_t MAX_PNG_SIDE = 0x7fffffff;

enum class Pixel { Gray8, Rgba8 };

struct PngImage {
    std::uint32_t height = 0, width = 0;
    Pixel kind = Pixel::Gray8;

    std::uint64_t row_size() const { return std::uint64_t{width} * (kind == Pixel::Gray8 ? 1 : 4); }
};

enum class Filter { None, Paeth };

struct Compression {
    Filter filter = Filter::None;
    bool seeks_repeats = false; // or packs frequencies only
};

// Throws GEOIDX_ERROR_LIMIT for a side that is 0 or over MAX_PNG_SIDE.
void check_sides(const PngImage& image);

// `pixels` are height x row_size() bytes, row by row. The same pixels give the same bytes. Throws
// GEOIDX_ERROR_LIMIT for a side out of range and GEOIDX_ERROR_INTERNAL for another number of bytes.
std::vector<std::byte> write_png(std::span<const std::byte> pixels, const PngImage& image,
                                 Compression compression);

// Fills `pixels` from a PNG of exactly this size and kind, not interlaced, with nothing after its end.
// Anything else is GEOIDX_ERROR_CORRUPT and leaves `pixels` with unspecified values. Chunks that a decoder
// may ignore are ignored. Needs the memory of a few rows. Throws for sides and sizes as write_png.
void read_png(std::span<const std::byte> png, const PngImage& image, std::span<std::byte> pixels);

}
