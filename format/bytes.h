#pragma once

// Numbers as little-endian bytes, field by field, so that every host reads and writes the same file.

#include <algorithm>
#include <array>
#include <bit>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "format/error.h"

namespace geodesic::format {

template <std::unsigned_integral T>
T load_little_endian(const std::byte* from) {
    T value = 0;
    for (std::size_t i = 0; i < sizeof(T); ++i) {
        value = static_cast<T>(value | static_cast<T>(std::to_integer<T>(from[i]) << (8 * i)));
    }
    return value;
}

template <std::unsigned_integral T>
void store_little_endian(T value, std::byte* to) {
    for (std::size_t i = 0; i < sizeof(T); ++i) {
        to[i] = static_cast<std::byte>(static_cast<unsigned char>(value >> (8 * i)));
    }
}

// Appends to bytes of its own.
class ByteWriter {
public:
    void u8(std::uint8_t value) { append(value); }
    void u16(std::uint16_t value) { append(value); }
    void u32(std::uint32_t value) { append(value); }
    void u64(std::uint64_t value) { append(value); }
    void i32(std::int32_t value) { append(static_cast<std::uint32_t>(value)); }
    void f32(float value) { append(std::bit_cast<std::uint32_t>(value)); }
    void f64(double value) { append(std::bit_cast<std::uint64_t>(value)); }

    void bytes(std::span<const std::byte> values) {
        bytes_.insert(bytes_.end(), values.begin(), values.end());
    }
    // The elements only: a reader has to know their number.
    void u32_array(std::span<const std::uint32_t> values) {
        std::byte* to = grow(values.size_bytes());
        for (std::size_t i = 0; i < values.size(); ++i) store_little_endian(values[i], to + 4 * i);
    }
    void f32_array(std::span<const float> values) {
        std::byte* to = grow(values.size_bytes());
        for (std::size_t i = 0; i < values.size(); ++i) {
            store_little_endian(std::bit_cast<std::uint32_t>(values[i]), to + 4 * i);
        }
    }
    // All lowest bytes first, then all second ones, and so on: what packs well where neighbours are alike.
    void u32_planes(std::span<const std::uint32_t> values) { planes(values); }
    void u64_planes(std::span<const std::uint64_t> values) { planes(values); }

    std::size_t size() const { return bytes_.size(); }
    // Hands the bytes over and leaves the writer empty.
    std::vector<std::byte> take() { return std::exchange(bytes_, {}); }

private:
    std::byte* grow(std::size_t count) {
        const std::size_t old_size = bytes_.size();
        bytes_.resize(old_size + count);
        return bytes_.data() + old_size;
    }
    template <std::unsigned_integral T>
    void planes(std::span<const T> values) {
        std::byte* to = grow(values.size_bytes());
        for (unsigned byte = 0; byte < sizeof(T); ++byte)
            for (const T value : values) *to++ = static_cast<std::byte>(value >> (8 * byte));
    }
    template <std::unsigned_integral T>
    void append(T value) {
        std::array<std::byte, sizeof(T)> little_endian;
        store_little_endian(value, little_endian.data());
        bytes(little_endian);
    }

    std::vector<std::byte> bytes_;
};

// Reads bytes of someone else's, which must outlive it. Every function that would read past the end throws
// GEOIDX_ERROR_CORRUPT instead, with `name` in the message.
class ByteReader {
public:
    explicit ByteReader(std::span<const std::byte> bytes, std::string name = "data")
        : bytes_(bytes), name_(std::move(name)) {}

    std::uint8_t u8() { return next<std::uint8_t>(); }
    std::uint16_t u16() { return next<std::uint16_t>(); }
    std::uint32_t u32() { return next<std::uint32_t>(); }
    std::uint64_t u64() { return next<std::uint64_t>(); }
    std::int32_t i32() { return static_cast<std::int32_t>(u32()); }
    float f32() { return std::bit_cast<float>(u32()); }
    double f64() { return std::bit_cast<double>(u64()); }

    // A view of the next `count` bytes, valid as long as the bytes given to the constructor.
    std::span<const std::byte> bytes(std::uint64_t count) {
        if (count > remaining()) fail_at_end(count);
        const auto result = bytes_.subspan(position_, static_cast<std::size_t>(count));
        position_ += result.size();
        return result;
    }
    // Fill `values` entirely.
    void u32_array(std::span<std::uint32_t> values) {
        const auto from = bytes(values.size_bytes());
        for (std::size_t i = 0; i < values.size(); ++i) {
            values[i] = load_little_endian<std::uint32_t>(from.data() + 4 * i);
        }
    }
    void f32_array(std::span<float> values) {
        const auto from = bytes(values.size_bytes());
        for (std::size_t i = 0; i < values.size(); ++i) {
            values[i] = std::bit_cast<float>(load_little_endian<std::uint32_t>(from.data() + 4 * i));
        }
    }
    void u32_planes(std::span<std::uint32_t> values) { planes(values); }
    void u64_planes(std::span<std::uint64_t> values) { planes(values); }

    // A u64 count of elements that follow, each at least `element_size` bytes long. Throws when it is over
    // `max` or when the remaining bytes cannot hold as many, so that memory may be allocated for the result.
    std::uint64_t count(std::uint64_t max, std::uint64_t element_size) {
        const std::size_t at = position_;
        const std::uint64_t value = u64();
        if (value > max) fail_count(at, value, "the limit is " + std::to_string(max));
        if (element_size != 0 && value > remaining() / element_size) {
            fail_count(at, value, "only " + std::to_string(remaining()) + " bytes follow");
        }
        return value;
    }

    std::size_t position() const { return position_; }
    std::size_t remaining() const { return bytes_.size() - position_; }

    // Throws unless everything was read.
    void expect_end() const {
        if (remaining() == 0) return;
        throw Error(GEOIDX_ERROR_CORRUPT, name_ + ": " + std::to_string(remaining()) +
                                              " bytes too many, from offset " + std::to_string(position_));
    }

private:
    template <std::unsigned_integral T>
    void planes(std::span<T> values) {
        const std::byte* from = bytes(values.size_bytes()).data();
        std::ranges::fill(values, T{0});
        for (unsigned byte = 0; byte < sizeof(T); ++byte)
            for (T& value : values) value |= std::to_integer<T>(*from++) << (8 * byte);
    }
    template <std::unsigned_integral T>
    T next() {
        return load_little_endian<T>(bytes(sizeof(T)).data());
    }
    [[noreturn]] void fail_at_end(std::uint64_t wanted) const {
        throw Error(GEOIDX_ERROR_CORRUPT, name_ + " ended: " + std::to_string(wanted) +
                                              " bytes wanted at offset " + std::to_string(position_) + ", " +
                                              std::to_string(remaining()) + " left");
    }
    [[noreturn]] void fail_count(std::size_t at, std::uint64_t value, const std::string& reason) const {
        throw Error(GEOIDX_ERROR_CORRUPT, name_ + ": the count at offset " + std::to_string(at) + " is " +
                                              std::to_string(value) + ", " + reason);
    }

    std::span<const std::byte> bytes_;
    std::size_t position_ = 0;
    std::string name_;
};

}
