// Sections of the overlay engine, but for its tables.
#include <cmath>
#include <string>

#include "format/bytes.h"
#include "src/base/number_text.h"
#include "src/base/numbers.h"
#include "src/file/sections.h"
#include "src/overlay/tables/codes.h"

namespace geodesic {

namespace {

// ---- QUAN

std::vector<std::byte> quantum_bytes(const StoredIndex& stored) {
    format::ByteWriter writer;
    writer.f32_array(stored.quantum);
    for (const uint8_t shift : stored.shift) writer.u8(shift);
    return writer.take();
}

void read_quanta(const format::Container& container, StoredIndex& stored) {
    const size_t patch_count = stored.border_size.size() + 1;
    const auto bytes = container.read_bytes(TAG_QUANTA, patch_count * (sizeof(float) + sizeof(uint8_t)));
    format::ByteReader reader(bytes, "section QUAN");
    stored.quantum.resize(patch_count);
    reader.f32_array(stored.quantum);
    for (size_t p = 0; p < patch_count; ++p) {
        stored.shift.push_back(reader.u8());
        if (stored.shift.back() > TableCode::MOST_SHIFT)
            refuse_as_corrupt("section QUAN: the shift " + std::to_string(stored.shift.back()));
    }
    reader.expect_end();
    for (float quantum : stored.quantum)
        if (!std::isfinite(quantum) || std::signbit(quantum))
            refuse_as_corrupt("section QUAN: the quantum " + number_text(quantum));
}

// ---- SEGM

std::vector<std::byte> segment_bytes(const StoredIndex& stored) {
    const auto& [end, length, bridges] = stored.segments;
    format::ByteWriter writer;
    writer.u32_array(end);
    writer.f32_array(length);
    for (const Bridge& bridge : bridges) {
        writer.u32(bridge.slot);
        writer.u32(bridge.end);
        writer.f32(bridge.length);
    }
    return writer.take();
}

void require_length(float length) {
    if (!(length > 0) || !std::isfinite(length))
        refuse_as_corrupt("section SEGM: a segment of length " + number_text(length));
}

void read_bridges(format::ByteReader& reader, std::vector<Bridge>& bridges) {
    while (reader.remaining() > 0) {
        const uint32_t slot = reader.u32(), end = reader.u32();
        bridges.push_back({slot, end, reader.f32()});
        require_length(bridges.back().length);
    }
}

void read_segments(const format::Container& container, StoredIndex& stored) {
    constexpr size_t OF_SLOT = sizeof(uint32_t) + sizeof(float),
                     OF_BRIDGE = 2 * sizeof(uint32_t) + sizeof(float);
    auto& [end, length, bridges] = stored.segments;
    const size_t count = stored.border.size();
    const auto bytes = container.read_bytes(TAG_SEGMENTS, count * (OF_SLOT + OF_BRIDGE));
    format::ByteReader reader(bytes, "section SEGM");
    end.resize(count);
    length.resize(count);
    reader.u32_array(end);
    reader.f32_array(length);
    for (size_t i = 0; i < count; ++i)
        if (end[i] != NONE) require_length(length[i]);
    read_bridges(reader, bridges);
}

}

void write_overlay(const StoredIndex& stored, format::ContainerWriter& writer) {
    writer.add_bytes(TAG_QUANTA, quantum_bytes(stored));
    writer.add_bytes(TAG_SEGMENTS, segment_bytes(stored));
    write_vertex_pairs(stored, writer);
    switch (stored.description.codec) {
    case GEOIDX_CODEC_PACKED:
        return write_packed_tables(stored, writer);
    case GEOIDX_CODEC_MAPPED:
        return write_mapped_tables(stored, writer);
    default:
        return write_lossless_tables(stored, writer);
    }
}

void read_overlay(const format::Container& container, const ReadOptions& options, StoredIndex& stored) {
    about_section(TAG_QUANTA, [&] { read_quanta(container, stored); });
    about_section(TAG_SEGMENTS, [&] { read_segments(container, stored); });
    read_vertex_pairs(container, stored);
    switch (stored.description.codec) {
    case GEOIDX_CODEC_PACKED:
        return read_packed_tables(container, options, stored);
    case GEOIDX_CODEC_MAPPED:
        return read_mapped_tables(container, stored);
    default:
        return read_lossless_tables(container, options.threads, stored);
    }
}

}
