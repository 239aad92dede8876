#include "format/bytes.h"

#include <cmath>
#include <limits>

#include <doctest/doctest.h>

#include "format/checksum.h"
#include "tests/format/helpers.h"

using namespace geodesic;
using namespace geodesic::format;
using namespace geodesic::format::test;

TEST_CASE("numbers are written with the least significant byte first") {
    ByteWriter writer;
    writer.u8(0x01);
    writer.u16(0x0203);
    writer.u32(0x04050607);
    writer.u64(0x08090A0B0C0D0E0F);
    writer.i32(-2);
    writer.f32(1.0F);
    writer.f64(-2.0);
    CHECK(writer.size() == 31);
    CHECK(writer.take() == bytes_of({0x01, 0x03, 0x02, 0x07, 0x06, 0x05, 0x04, 0x0F, 0x0E, 0x0D, 0x0C,
                                     0x0B, 0x0A, 0x09, 0x08, 0xFE, 0xFF, 0xFF, 0xFF, 0x00, 0x00, 0x80,
                                     0x3F, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0xC0}));
    CHECK(writer.size() == 0);
}

TEST_CASE("what is written is read back, and then nothing is left") {
    const std::vector<std::uint32_t> integers = {0, 1, 0xFFFFFFFF};
    const std::vector<float> floats = floats_of(awkward_bits());
    ByteWriter writer;
    writer.u8(255);
    writer.u16(65535);
    writer.u32(0xFFFFFFFF);
    writer.u64(std::numeric_limits<std::uint64_t>::max());
    writer.i32(std::numeric_limits<std::int32_t>::min());
    writer.f32(-0.0F);
    writer.f64(std::numeric_limits<double>::denorm_min());
    writer.bytes(bytes_of({7, 8}));
    writer.u32_array(integers);
    writer.f32_array(floats);
    const Bytes bytes = writer.take();

    ByteReader reader(bytes);
    CHECK(reader.u8() == 255);
    CHECK(reader.u16() == 65535);
    CHECK(reader.u32() == 0xFFFFFFFF);
    CHECK(reader.u64() == std::numeric_limits<std::uint64_t>::max());
    CHECK(reader.i32() == std::numeric_limits<std::int32_t>::min());
    CHECK(std::signbit(reader.f32()));
    CHECK(reader.f64() == std::numeric_limits<double>::denorm_min());
    const auto raw = reader.bytes(2);
    CHECK(Bytes(raw.begin(), raw.end()) == bytes_of({7, 8}));
    std::vector<std::uint32_t> integers_read(integers.size());
    reader.u32_array(integers_read);
    CHECK(integers_read == integers);
    std::vector<float> floats_read(floats.size());
    reader.f32_array(floats_read);
    CHECK(bits_of(floats_read) == awkward_bits());
    CHECK_NOTHROW(reader.expect_end());
}

TEST_CASE("reading past the end is refused and names what ended") {
    const Bytes bytes = bytes_of({1, 2, 3});
    ByteReader reader(bytes, "the list of patches");
    CHECK(reader.u8() == 1);
    std::string message;
    CHECK(status_of([&] { reader.u32(); }, &message) == GEOIDX_ERROR_CORRUPT);
    CHECK(message.find("the list of patches") != std::string::npos);
    CHECK(reader.remaining() == 2);
    std::vector<float> values(1);
    CHECK(status_of([&] { reader.f32_array(values); }) == GEOIDX_ERROR_CORRUPT);
    CHECK(status_of([&] { reader.bytes(std::numeric_limits<std::uint64_t>::max()); }) ==
          GEOIDX_ERROR_CORRUPT);
    CHECK(reader.u16() == 0x0302);
    CHECK(status_of([&] { reader.u8(); }) == GEOIDX_ERROR_CORRUPT);
}

TEST_CASE("bytes left over are refused") {
    const Bytes bytes = bytes_of({1, 2});
    ByteReader reader(bytes);
    reader.u8();
    CHECK(status_of([&] { reader.expect_end(); }) == GEOIDX_ERROR_CORRUPT);
}

TEST_CASE("a count is believed only when as many elements can follow and the limit allows it") {
    const auto count = [](std::uint64_t stated, std::size_t following, std::uint64_t max,
                          std::uint64_t size) {
        Bytes bytes(8 + following);
        put(bytes, 0, stated, 8);
        std::uint64_t result = stated;
        const geoidx_status status = status_of([&] { result = ByteReader(bytes).count(max, size); });
        CHECK(result == stated);
        return status;
    };
    CHECK(count(3, 12, 3, 4) == GEOIDX_OK);
    CHECK(count(3, 11, 3, 4) == GEOIDX_ERROR_CORRUPT);
    CHECK(count(3, 12, 2, 4) == GEOIDX_ERROR_CORRUPT);
    CHECK(count(0, 0, 0, 4) == GEOIDX_OK);
    // 2^62 elements of 4 bytes are 0 bytes in 64-bit arithmetic.
    CHECK(count(std::uint64_t{1} << 62, 100, std::numeric_limits<std::uint64_t>::max(), 4) ==
          GEOIDX_ERROR_CORRUPT);
}

TEST_CASE("the checksum of nothing is the published one") {
    // From the test vectors of xxHash: XXH3_64bits of no bytes with seed 0.
    CHECK(checksum({}) == 0x2D06800538D394C2);
}
