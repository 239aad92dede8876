// Sections of the overlay engine: its tables hold codes, as floats.
#include <cmath>
#include <string>

#include "format/bytes.h"
#include "src/base/numbers.h"
#include "src/file/sections.h"
#include "src/file/tables.h"
#include "src/overlay/codes.h"

namespace geodesic {

namespace {

// ---- Codes as floats, and back

float value_of(uint16_t code) { return code == TableCode::UNREACHED ? INFINITE : static_cast<float>(code); }

std::vector<float> values_of(const std::vector<uint16_t>& codes) {
    std::vector<float> values(codes.size());
    for (size_t i = 0; i < codes.size(); ++i) values[i] = value_of(codes[i]);
    return values;
}

uint16_t code_of(float value) {
    if (value == INFINITE) return TableCode::UNREACHED;
    const auto code = static_cast<uint16_t>(std::min(value, float{TableCode::LARGEST}));
    if (static_cast<float>(code) != value)
        refuse_as_corrupt("a table holds " + std::to_string(value) + ", which is no code of a distance");
    return code;
}

std::vector<uint16_t> codes_of(const std::vector<float>& values) {
    std::vector<uint16_t> codes(values.size());
    for (size_t i = 0; i < values.size(); ++i) codes[i] = code_of(values[i]);
    return codes;
}

// ---- QUAN

std::vector<std::byte> quantum_bytes(const StoredIndex& stored) {
    format::ByteWriter writer;
    writer.f32_array(stored.quantum);
    return writer.take();
}

void read_quanta(const format::Container& container, StoredIndex& stored) {
    const size_t patch_count = stored.border_size.size() + 1;
    const auto bytes = container.read_bytes(TAG_QUANTA, patch_count * sizeof(float));
    format::ByteReader reader(bytes, "section QUAN");
    stored.quantum.resize(patch_count);
    reader.f32_array(stored.quantum);
    reader.expect_end();
    for (float quantum : stored.quantum)
        if (!(quantum >= 0) || !std::isfinite(quantum))
            refuse_as_corrupt("section QUAN: the quantum " + std::to_string(quantum));
}

// ---- SEGM

std::vector<std::byte> segment_bytes(const StoredIndex& stored) {
    format::ByteWriter writer;
    writer.u32_array(stored.segment_end);
    writer.f32_array(stored.segment_length);
    return writer.take();
}

void read_segments(const format::Container& container, StoredIndex& stored) {
    const size_t count = stored.border.size();
    const auto bytes = container.read_bytes(TAG_SEGMENTS, count * (sizeof(uint32_t) + sizeof(float)));
    format::ByteReader reader(bytes, "section SEGM");
    stored.segment_end.resize(count);
    stored.segment_length.resize(count);
    reader.u32_array(stored.segment_end);
    reader.f32_array(stored.segment_length);
    reader.expect_end();
    for (size_t i = 0; i < count; ++i)
        if (stored.segment_end[i] != NONE &&
            (!(stored.segment_length[i] > 0) || !std::isfinite(stored.segment_length[i])))
            refuse_as_corrupt("section SEGM: a segment of length " +
                              std::to_string(stored.segment_length[i]));
}

// ---- OVOV

TableSection overlay_section(const StoredIndex& stored) {
    TableSection section(TAG_OVERLAY_TABLES);
    for (size_t p = 0; p < stored.owned_count.size(); ++p) {
        section.add(stored.owned_count[p], p > 0 ? stored.border_size[p - 1] : 0); // the root has no border
        section.add_below_diagonal(stored.owned_count[p]);
    }
    return section;
}

}

void write_overlay(const StoredIndex& stored, format::ContainerWriter& writer) {
    writer.add_bytes(TAG_QUANTA, quantum_bytes(stored));
    writer.add_bytes(TAG_SEGMENTS, segment_bytes(stored));
    overlay_section(stored).write(values_of(stored.overlay_codes), writer);
    border_internal_section(stored).write(values_of(stored.border_internal_codes), writer);
    internal_section(stored).write(values_of(stored.internal_codes), writer);
}

void read_overlay(const format::Container& container, uint32_t threads, StoredIndex& stored) {
    read_quanta(container, stored);
    read_segments(container, stored);
    stored.overlay_codes = codes_of(overlay_section(stored).read(container, threads));
    stored.border_internal_codes = codes_of(border_internal_section(stored).read(container, threads));
    stored.internal_codes = codes_of(internal_section(stored).read(container, threads));
}

}
