#pragma once

// A run of bytes as 8-bit gray PNG images: 8192 pixels wide and 32 high, a byte each, row by row, as
// long as there are so many bytes, and then one image of a single row with the rest. Bytes whose frequencies
// differ, as those of small residuals do, are packed well, and nothing else is looked for in them. Rows are
// long, since libpng inflates one row a call, and zlib decodes the last 257 bytes of a call by a slower loop.

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace geodesic::format {

inline constexpr std::uint32_t BYTE_IMAGE_WIDTH = 8192, BYTE_IMAGE_HEIGHT = 32;
inline constexpr std::uint64_t BYTE_IMAGE_SIZE = std::uint64_t{BYTE_IMAGE_WIDTH} * BYTE_IMAGE_HEIGHT;

constexpr std::uint64_t byte_image_count(std::uint64_t size) {
    return size / BYTE_IMAGE_SIZE + (size % BYTE_IMAGE_SIZE > 0);
}

// One stream an image.
std::vector<std::vector<std::byte>> encode_byte_images(std::span<const std::byte> bytes);

// Fills the bytes of image number `index` of a run, of which `run` is the whole. Throws as read_png does.
void decode_byte_image(std::span<const std::byte> png, std::uint64_t index, std::span<std::byte> run);

}
