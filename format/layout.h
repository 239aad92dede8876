#pragma once

// Where the fields of header and section table stand in the file, and the checks of both.

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "format/bytes.h"
#include "format/container.h"

namespace geodesic::format {

// A section may unpack to at most this many times its stored size, so that a small file cannot ask for much
// memory.
inline constexpr std::uint64_t MAX_PACKING = 1032; // the most that deflate can do

// As in PNG, a byte over 127 that is no text, and both line ends, which show a file transferred as text.
inline constexpr std::array<unsigned char, 8> MAGIC = {0x89, 'G', 'I', 'D', 'X', 0x0D, 0x0A, 0x1A};

// Bytes from the start of the file.
inline constexpr std::uint64_t MAJOR_OFFSET = 8;
inline constexpr std::uint64_t INCOMPATIBLE_FLAGS_OFFSET = 12;
inline constexpr std::uint64_t SECTION_COUNT_OFFSET = 20;
inline constexpr std::uint64_t FILE_SIZE_OFFSET = 24;
inline constexpr std::uint64_t CHECKSUM_OFFSET = 40;
inline constexpr std::uint64_t HEADER_SIZE = 48;
inline constexpr std::uint64_t SECTION_RECORD_SIZE = 48;
inline constexpr std::uint64_t SECTION_ALIGNMENT = 64;

struct Header {
    std::uint16_t version_major = FORMAT_MAJOR;
    std::uint16_t version_minor = FORMAT_MINOR;
    std::uint32_t incompatible_flags = 0;
    std::uint32_t compatible_flags = 0;
    std::uint32_t section_count = 0;
    std::uint64_t file_size = 0;
    std::uint64_t mesh_fingerprint = 0;
    std::uint64_t checksum = 0; // of header and section table, this field taken as 0
};

void write_header(ByteWriter& writer, const Header& header);
void write_section_record(ByteWriter& writer, const Section& section);

// The checksum that belongs into a header, from the bytes of header and section table.
std::uint64_t header_checksum(std::span<const std::byte> header_and_table);

constexpr std::uint64_t align_section(std::uint64_t offset) {
    return (offset + SECTION_ALIGNMENT - 1) / SECTION_ALIGNMENT * SECTION_ALIGNMENT;
}
constexpr std::uint64_t table_end(std::uint32_t section_count) {
    return HEADER_SIZE + SECTION_RECORD_SIZE * section_count;
}

struct Layout {
    Header header;
    std::vector<Section> sections;
};

// Told of each problem. It throws to stop at it, or returns to go on where that is possible.
using Report = std::function<void(Issue)>;

// Those of the checks below that need no more than the start of the file, at least its first HEADER_SIZE
// bytes if it has as many. Nothing is returned when what is behind the header cannot be read.
std::optional<Header> examine_header(std::span<const std::byte> start, std::optional<std::uint64_t> file_size,
                                     const Report& report);

// All checks of SPEC.md that need no decoding, in its order. What it returns is complete only when nothing
// was reported.
Layout examine(std::span<const std::byte> file, std::span<const std::uint32_t> known_tags,
               const Report& report);

}
