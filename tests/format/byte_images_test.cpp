// Bytes as gray images.

#include <array>
#include <random>

#include <doctest/doctest.h>

#include "format/byte_images.h"
#include "format/container.h"
#include "tests/format/helpers.h"

using namespace geodesic::format;
using namespace geodesic::format::test;

namespace {

constexpr std::array IMAGE_TAGS{DATA};

Bytes some_bytes(std::size_t size) {
    std::mt19937_64 random(size);
    Bytes bytes(size);
    for (std::byte& byte : bytes) byte = static_cast<std::byte>(random() % 7 * (random() % 7));
    return bytes;
}

}

TEST_CASE("byte images: the bytes come back, whatever their number") {
    for (const std::size_t size :
         {std::size_t{0}, std::size_t{1}, std::size_t{8191}, std::size_t{8192}, BYTE_IMAGE_SIZE - 1,
          BYTE_IMAGE_SIZE, BYTE_IMAGE_SIZE + 1, 3 * BYTE_IMAGE_SIZE + 77}) {
        CAPTURE(size);
        const Bytes bytes = some_bytes(size);
        const auto images = encode_byte_images(bytes);
        CHECK(images.size() == (size + (1 << 18) - 1) / (1 << 18));
        Bytes read(size);
        for (std::size_t i = 0; i < images.size(); ++i) decode_byte_image(images[i], i, read);
        CHECK(read == bytes);
    }
}

TEST_CASE("byte images: as a section they are bytes") {
    const Bytes bytes = some_bytes(BYTE_IMAGE_SIZE + 1000);
    ContainerWriter writer(1);
    writer.add_images(DATA, bytes);
    const Bytes file = writer.finish();
    const auto container = Container::parse(file, IMAGE_TAGS);
    CHECK(container.section(DATA).codec == Codec::ByteImages);
    CHECK(container.read_bytes(DATA, bytes.size()) == bytes);
    CHECK(status_of([&] { container.read_bytes(DATA, bytes.size() - 1); }) == GEOIDX_ERROR_CORRUPT);
    CHECK(status_of([&] { container.read_matrices(DATA, {}); }) == GEOIDX_ERROR_CORRUPT);
}

TEST_CASE("byte images: another size or number than the raw size says is refused") {
    const auto images = encode_byte_images(some_bytes(2 * BYTE_IMAGE_SIZE + 10));
    const auto status = [&](std::span<const Bytes> given, std::uint64_t raw_size) {
        ContainerWriter writer(1);
        writer.add_encoded_images(DATA, Codec::ByteImages, given, raw_size);
        const Bytes file = writer.finish();
        return status_of([&] { Container::parse(file, IMAGE_TAGS).read_bytes(DATA, raw_size); });
    };
    const std::uint64_t size = 2 * BYTE_IMAGE_SIZE + 10;
    CHECK(status(images, size) == GEOIDX_OK);
    CHECK(status(images, size - 1) == GEOIDX_ERROR_CORRUPT);
    CHECK(status(images, size + 1) == GEOIDX_ERROR_CORRUPT);
    CHECK(status(images, 2 * BYTE_IMAGE_SIZE) == GEOIDX_ERROR_CORRUPT);
    CHECK(status(std::span(images).first(2), size) == GEOIDX_ERROR_CORRUPT);
    CHECK(status(std::vector<Bytes>{images[0], images[2], images[1]}, size) == GEOIDX_ERROR_CORRUPT);
    CHECK(status({}, 0) == GEOIDX_OK);
}
