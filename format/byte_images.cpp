#include "format/byte_images.h"

#include <algorithm>

#include "format/png_stream.h"

namespace geodesic::format {
namespace {

// Where an image's bytes begin in the run, and how many they are.
struct Part {
    std::size_t begin, size;
};

Part part_of(std::uint64_t index, std::uint64_t run_size) {
    const std::uint64_t begin = index * BYTE_IMAGE_SIZE;
    return {static_cast<std::size_t>(begin),
            static_cast<std::size_t>(std::min(BYTE_IMAGE_SIZE, run_size - begin))};
}

PngImage image_of(std::size_t size) {
    if (size == BYTE_IMAGE_SIZE) return {BYTE_IMAGE_HEIGHT, BYTE_IMAGE_WIDTH, Pixel::Gray8};
    return {1, static_cast<std::uint32_t>(size), Pixel::Gray8};
}

}

std::vector<std::vector<std::byte>> encode_byte_images(std::span<const std::byte> bytes) {
    std::vector<std::vector<std::byte>> streams;
    for (std::uint64_t i = 0; i < byte_image_count(bytes.size()); ++i) {
        const auto [begin, size] = part_of(i, bytes.size());
        streams.push_back(write_png(bytes.subspan(begin, size), image_of(size), {}));
    }
    return streams;
}

void decode_byte_image(std::span<const std::byte> png, std::uint64_t index, std::span<std::byte> run) {
    const auto [begin, size] = part_of(index, run.size());
    read_png(png, image_of(size), run.subspan(begin, size));
}

}
