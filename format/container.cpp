#include "format/container.h"

#include <algorithm>

#include "format/byte_images.h"
#include "format/bytes.h"
#include "format/layout.h"
#include "format/matrix_png.h"
#include "format/zstd_codec.h"

namespace geodesic::format {
namespace {

[[noreturn]] void fail_corrupt(std::uint32_t tag, const std::string& what) {
    throw Error(GEOIDX_ERROR_CORRUPT, "section " + tag_text(tag) + ": " + what, tag);
}

std::uint64_t raw_size_of(std::span<const MatrixTarget> matrices) {
    std::uint64_t size = 0;
    for (const MatrixTarget& matrix : matrices) size += matrix.values.size_bytes();
    return size;
}

[[noreturn]] void throw_issue(const Issue& issue) {
    throw Error(issue.status, issue.message + " (byte " + std::to_string(issue.offset) + ")");
}

// Returns what decode() returns. An error of it that names no section is one of this section's stored bytes.
template <class Decode>
decltype(auto) decode_section(std::uint32_t tag, const Decode& decode) {
    try {
        return decode();
    } catch (Error& error) {
        if (error.section != 0) throw;
        error.section = tag;
        error.is_undecodable = true;
        throw;
    }
}

// Runs decode(), and says in its error which image of which section is meant.
template <class Decode>
void decode_image(std::uint32_t tag, std::size_t index, const Decode& decode) {
    decode_section(tag, [&] {
        try {
            decode();
        } catch (const Error& error) {
            throw Error(error.status, "section " + tag_text(tag) + ", image " + std::to_string(index) + ": " +
                                          error.what());
        }
    });
}

}

std::string tag_text(std::uint32_t tag) {
    constexpr char DIGITS[] = "0123456789abcdef";
    std::string text = "'";
    for (int i = 0; i < 4; ++i) {
        const std::uint32_t byte = tag >> (8 * i) & 0xFF;
        if (byte >= 0x20 && byte < 0x7F) {
            text += static_cast<char>(byte);
        } else {
            text += {'\\', 'x', DIGITS[byte >> 4], DIGITS[byte & 15]};
        }
    }
    return text + "'";
}

std::vector<std::byte> unpack_bytes(const StoredBytes& stored, std::uint32_t tag) {
    if (stored.codec == Codec::Raw) return {stored.bytes.begin(), stored.bytes.end()};
    if (stored.codec != Codec::Zstd) fail_corrupt(tag, "it holds matrices, expected bytes");
    return decode_section(
        tag, [&] { return decompress_zstd(stored.bytes, stored.raw_size, "section " + tag_text(tag)); });
}

Container Container::parse(std::span<const std::byte> file, std::span<const std::uint32_t> known_tags) {
    Layout layout = examine(file, known_tags, throw_issue);
    Container container;
    container.file_ = file;
    container.version_minor_ = layout.header.version_minor;
    container.mesh_fingerprint_ = layout.header.mesh_fingerprint;
    container.sections_ = std::move(layout.sections);
    return container;
}

std::uint64_t checked_file_size(std::span<const std::byte> start, std::optional<std::uint64_t> file_size) {
    return examine_header(start, file_size, throw_issue)->file_size;
}

bool has_valid_header(std::span<const std::byte> start, std::optional<std::uint64_t> file_size) {
    bool is_valid = true;
    examine_header(start, file_size, [&](const Issue&) { is_valid = false; });
    return is_valid;
}

std::vector<Issue> inspect(std::span<const std::byte> file, std::span<const std::uint32_t> known_tags) {
    std::vector<Issue> issues;
    examine(file, known_tags, [&](Issue issue) { issues.push_back(std::move(issue)); });
    return issues;
}

const Section* Container::find(std::uint32_t tag) const {
    const auto found = std::ranges::find(sections_, tag, &Section::tag);
    return found == sections_.end() ? nullptr : &*found;
}

const Section& Container::section(std::uint32_t tag) const {
    const Section* found = find(tag);
    if (found == nullptr) fail_corrupt(tag, "missing");
    return *found;
}

std::span<const std::byte> Container::stored_bytes(const Section& section) const {
    return file_.subspan(static_cast<std::size_t>(section.offset),
                         static_cast<std::size_t>(section.stored_size));
}

std::vector<std::byte> Container::read_bytes(std::uint32_t tag, std::uint64_t max_raw_size,
                                             const ShareOut& share_out) const {
    const Section& found = section(tag);
    if (found.raw_size > max_raw_size) {
        fail_corrupt(tag, std::to_string(found.raw_size) + " raw bytes, the limit here is " +
                              std::to_string(max_raw_size));
    }
    if (found.codec == Codec::ByteImages) return read_images(found, share_out);
    return unpack_bytes({found.codec, found.raw_size, stored_bytes(found)}, tag);
}

std::span<const std::byte> Container::view_bytes(std::uint32_t tag) const {
    const Section& found = section(tag);
    if (found.codec != Codec::Raw) fail_corrupt(tag, "it is not stored raw");
    return stored_bytes(found);
}

StoredBytes Container::view_stored(std::uint32_t tag) const {
    const Section& found = section(tag);
    if (found.codec != Codec::Raw && found.codec != Codec::Zstd)
        fail_corrupt(tag, "it holds images, expected bytes that are raw or zstd");
    return {found.codec, found.raw_size, stored_bytes(found)};
}

std::vector<std::byte> Container::read_images(const Section& section, const ShareOut& share_out) const {
    const auto streams = png_streams(section.tag, byte_image_count(section.raw_size));
    std::vector<std::byte> raw(static_cast<std::size_t>(section.raw_size));
    share_out(streams.size(), [&](std::size_t i) {
        decode_image(section.tag, i, [&] { decode_byte_image(streams[i], i, raw); });
    });
    return raw;
}

void Container::one_after_the_other(std::size_t count, const std::function<void(std::size_t)>& decode) {
    for (std::size_t i = 0; i < count; ++i) decode(i);
}

void Container::read_matrices(std::uint32_t tag, std::span<const MatrixTarget> matrices,
                              const ShareOut& share_out) const {
    const Section& found = section(tag);
    if (found.raw_size != raw_size_of(matrices)) {
        fail_corrupt(tag, std::to_string(found.raw_size) + " raw bytes, expected matrices of " +
                              std::to_string(raw_size_of(matrices)));
    }
    if (found.codec == Codec::Png) {
        const auto streams = png_streams(tag, matrices.size());
        share_out(streams.size(), [&](std::size_t i) {
            const MatrixTarget& matrix = matrices[i];
            decode_image(tag, i, [&] { decode_png(streams[i], matrix.rows, matrix.cols, matrix.values); });
        });
        return;
    }
    if (found.codec == Codec::ByteImages) fail_corrupt(tag, "it holds images of bytes, expected matrices");
    const std::vector<std::byte> raw = read_bytes(tag, found.raw_size);
    ByteReader reader(raw, "section " + tag_text(tag));
    for (const MatrixTarget& matrix : matrices) reader.f32_array(matrix.values);
}

std::vector<std::span<const std::byte>> Container::png_streams(std::uint32_t tag, std::uint64_t count) const {
    const Section& found = section(tag);
    if (found.codec != Codec::Png && found.codec != Codec::ByteImages)
        fail_corrupt(tag, "it does not hold images");
    return decode_section(tag, [&] {
        ByteReader reader(stored_bytes(found), "section " + tag_text(tag));
        const std::uint32_t stored_count = reader.u32();
        if (stored_count != count) {
            fail_corrupt(tag, std::to_string(stored_count) + " images, expected " + std::to_string(count));
        }
        ByteReader lengths(reader.bytes(8 * std::uint64_t{stored_count}), "section " + tag_text(tag));
        std::vector<std::span<const std::byte>> streams;
        streams.reserve(stored_count);
        for (std::uint32_t i = 0; i < stored_count; ++i) streams.push_back(reader.bytes(lengths.u64()));
        reader.expect_end();
        return streams;
    });
}

}
