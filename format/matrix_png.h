#pragma once

// One float32 matrix as one RGBA8888 PNG, one float a pixel, without loss: -0, infinities and the payloads of
// NaNs included. Entry (row, col) is the pixel in line `row` and column `col`. Its R, G, B and A are the
// bytes of the float from the most significant to the least: R holds the sign and the upper 7 bits of the
// exponent.

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace geodesic::format {

// `values` is rows x cols, row by row. The same values give the same bytes. Throws GEOIDX_ERROR_LIMIT for a
// side that PNG cannot say and GEOIDX_ERROR_INTERNAL when rows x cols is not the number of values.
std::vector<std::byte> encode_png(std::span<const float> values, std::uint32_t rows, std::uint32_t cols);

// Fills `out`, rows x cols, from a PNG of exactly this size: 8-bit RGBA, not interlaced, nothing after its
// end. Anything else is GEOIDX_ERROR_CORRUPT and leaves `out` with unspecified values. Chunks that a decoder
// may ignore are ignored. Needs the memory of a few rows. Throws for sides and sizes as encode_png.
void decode_png(std::span<const std::byte> png, std::uint32_t rows, std::uint32_t cols, std::span<float> out);

}
