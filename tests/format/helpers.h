#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <initializer_list>
#include <random>
#include <span>
#include <string>
#include <vector>

#include <xxhash.h>

#include "format/container.h"
#include "format/error.h"

namespace geodesic::format::test {

using Bytes = std::vector<std::byte>;

inline constexpr std::uint32_t DATA = make_tag("DATA");

// The status that `action` fails with, GEOIDX_OK when it does not. Any other exception ends the test.
template <typename Action>
geoidx_status status_of(Action&& action, std::string* message = nullptr) {
    try {
        action();
        return GEOIDX_OK;
    } catch (const Error& error) {
        if (message != nullptr) *message = error.what();
        return error.status;
    }
}

inline Bytes bytes_of(std::initializer_list<int> values) {
    Bytes bytes;
    for (const int value : values) bytes.push_back(static_cast<std::byte>(value));
    return bytes;
}

// Not compressible, the same in every run.
inline Bytes random_bytes(std::size_t size, unsigned seed) {
    std::mt19937 generator(seed);
    Bytes bytes(size);
    for (std::byte& byte : bytes) byte = static_cast<std::byte>(generator() & 0xFF);
    return bytes;
}

// Floats of any bits at all, signaling NaNs among them.
inline std::vector<float> random_floats(std::size_t count, unsigned seed) {
    std::vector<float> values(count);
    const Bytes bits = random_bytes(4 * count, seed);
    std::memcpy(values.data(), bits.data(), bits.size());
    return values;
}

inline std::vector<std::uint32_t> bits_of(std::span<const float> values) {
    std::vector<std::uint32_t> bits(values.size());
    std::memcpy(bits.data(), values.data(), values.size_bytes());
    return bits;
}

inline std::vector<float> floats_of(std::span<const std::uint32_t> bits) {
    std::vector<float> values(bits.size());
    std::memcpy(values.data(), bits.data(), bits.size_bytes());
    return values;
}

// Zeros of both signs, subnormals, the largest finite, infinities, quiet and signaling NaNs with payloads.
inline std::vector<std::uint32_t> awkward_bits() {
    return {0x00000000, 0x80000000, 0x00000001, 0x807FFFFF, 0x00800000, 0x7F7FFFFF, 0x7F800000,
            0xFF800000, 0x7FC00000, 0xFFC12345, 0x7F800001, 0xFFBFFFFF, 0x3F800000, 0xC0200000};
}

// Little-endian, written apart from the code under test.
inline void put(Bytes& bytes, std::size_t offset, std::uint64_t value, std::size_t size) {
    for (std::size_t i = 0; i < size; ++i)
        bytes.at(offset + i) = static_cast<std::byte>(value >> (8 * i) & 0xFF);
}

inline std::uint64_t get(const Bytes& bytes, std::size_t offset, std::size_t size) {
    std::uint64_t value = 0;
    for (std::size_t i = size; i-- > 0;)
        value = value << 8 | std::to_integer<std::uint64_t>(bytes.at(offset + i));
    return value;
}

// Where the fields stand, as SPEC.md has it.
constexpr std::size_t MAJOR = 8, MINOR = 10, INCOMPATIBLE = 12, COMPATIBLE = 16, SECTION_COUNT = 20,
                      FILE_SIZE = 24, HEADER_CHECKSUM = 40, TABLE = 48;
constexpr std::size_t RECORD_SIZE = 48, CODEC = 4, FLAGS = 8, RESERVED = 12, OFFSET = 16, STORED_SIZE = 24,
                      RAW_SIZE = 32, CHECKSUM = 40;

inline std::size_t record(std::size_t index) { return TABLE + RECORD_SIZE * index; }

// Makes the header's checksum right again after a change, so that the rule behind it is reached.
inline void reseal(Bytes& file) {
    const std::size_t covered = TABLE + RECORD_SIZE * static_cast<std::size_t>(get(file, SECTION_COUNT, 4));
    put(file, HEADER_CHECKSUM, 0, 8);
    put(file, HEADER_CHECKSUM, XXH3_64bits(file.data(), std::min(covered, file.size())), 8);
}

inline Bytes patched(Bytes file, std::size_t offset, std::uint64_t value, std::size_t size) {
    put(file, offset, value, size);
    reseal(file);
    return file;
}

}
