#include <algorithm>
#include <limits>

#include "format/byte_images.h"
#include "format/bytes.h"
#include "format/checksum.h"
#include "format/container.h"
#include "format/layout.h"
#include "format/matrix_png.h"
#include "format/zstd_codec.h"

namespace geodesic::format {

PackedBytes pack_bytes(std::span<const std::byte> raw) {
    auto packed = compress_zstd(raw);
    if (raw.size() / MAX_PACKING > packed.size()) return {Codec::Raw, raw.size(), {raw.begin(), raw.end()}};
    return {Codec::Zstd, raw.size(), std::move(packed)};
}

void ContainerWriter::add_bytes(std::uint32_t tag, std::span<const std::byte> raw, std::uint32_t flags) {
    if (packing_ == Packing::None) return add_raw(tag, raw, flags);
    PackedBytes packed = pack_bytes(raw);
    add(tag, packed.codec, flags, std::move(packed.bytes), packed.raw_size);
}

void ContainerWriter::add_raw(std::uint32_t tag, std::span<const std::byte> raw, std::uint32_t flags) {
    add(tag, Codec::Raw, flags, {raw.begin(), raw.end()}, raw.size());
}

void ContainerWriter::add_stored(std::uint32_t tag, const StoredBytes& stored, std::uint32_t flags) {
    add(tag, stored.codec, flags, {stored.bytes.begin(), stored.bytes.end()}, stored.raw_size);
}

void ContainerWriter::add_matrices(std::uint32_t tag, std::span<const MatrixView> matrices,
                                   std::uint32_t flags) {
    std::vector<std::vector<std::byte>> pngs;
    std::uint64_t raw_size = 0;
    for (const MatrixView& matrix : matrices) {
        pngs.push_back(encode_png(matrix.values, matrix.rows, matrix.cols));
        raw_size += matrix.values.size_bytes();
    }
    add_encoded_images(tag, Codec::Png, pngs, raw_size, flags);
}

void ContainerWriter::add_images(std::uint32_t tag, std::span<const std::byte> raw, std::uint32_t flags) {
    add_encoded_images(tag, Codec::ByteImages, encode_byte_images(raw), raw.size(), flags);
}

void ContainerWriter::add_encoded_images(std::uint32_t tag, Codec codec,
                                         std::span<const std::vector<std::byte>> pngs, std::uint64_t raw_size,
                                         std::uint32_t flags) {
    if (pngs.size() > std::numeric_limits<std::uint32_t>::max()) {
        throw Error(GEOIDX_ERROR_LIMIT,
                    "section " + tag_text(tag) + ": " + std::to_string(pngs.size()) + " images are too many");
    }
    ByteWriter writer;
    writer.u32(static_cast<std::uint32_t>(pngs.size()));
    for (const auto& png : pngs) writer.u64(png.size());
    for (const auto& png : pngs) writer.bytes(png);
    add(tag, codec, flags, writer.take(), raw_size);
}

void ContainerWriter::add(std::uint32_t tag, Codec codec, std::uint32_t flags, std::vector<std::byte> stored,
                          std::uint64_t raw_size) {
    const auto same_tag = [&](const Section& other) { return other.tag == tag; };
    if (std::ranges::any_of(sections_, same_tag)) {
        throw Error(GEOIDX_ERROR_INTERNAL, "section " + tag_text(tag) + " is written twice");
    }
    if (sections_.size() == MAX_SECTIONS) {
        throw Error(GEOIDX_ERROR_LIMIT, "more than " + std::to_string(MAX_SECTIONS) + " sections");
    }
    sections_.push_back({.tag = tag,
                         .codec = codec,
                         .flags = flags,
                         .stored_size = stored.size(),
                         .raw_size = raw_size,
                         .checksum = checksum(stored)});
    stored_.push_back(std::move(stored));
}

std::vector<std::byte> ContainerWriter::finish() {
    Header header{.section_count = static_cast<std::uint32_t>(sections_.size()),
                  .mesh_fingerprint = mesh_fingerprint_};
    header.file_size = table_end(header.section_count);
    for (Section& section : sections_) {
        section.offset = align_section(header.file_size);
        header.file_size = section.offset + section.stored_size;
    }
    ByteWriter writer;
    write_header(writer, header);
    for (const Section& section : sections_) write_section_record(writer, section);
    std::vector<std::byte> file = writer.take();
    store_little_endian(header_checksum(file), file.data() + CHECKSUM_OFFSET);
    file.resize(static_cast<std::size_t>(header.file_size));
    for (std::size_t i = 0; i < sections_.size(); ++i) {
        std::ranges::copy(stored_[i], file.begin() + static_cast<std::ptrdiff_t>(sections_[i].offset));
    }
    return file;
}

}
