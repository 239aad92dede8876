// Sections of the overlay engine, but for its tables.
#include <algorithm>
#include <bit>
#include <cmath>
#include <string>
#include <utility>

#include "format/bytes.h"
#include "src/base/numbers.h"
#include "src/file/sections.h"
#include "src/overlay/codes.h"

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

// ---- PAIR

template <class Value>
std::vector<uint32_t> of_pairs(const StoredIndex& stored, const Value& value) {
    std::vector<uint32_t> values;
    for (const MeasuredPair& pair : stored.measured_pairs) values.push_back(value(pair));
    return values;
}

std::vector<std::byte> pair_bytes(const StoredIndex& stored) {
    format::ByteWriter writer;
    writer.u64(stored.measured_pairs.size());
    writer.f32_array(stored.errors_of_measured);
    uint32_t before = 0;
    writer.u32_planes(of_pairs(
        stored, [&](const MeasuredPair& pair) { return pair.first - std::exchange(before, pair.first); }));
    writer.u32_planes(of_pairs(stored, [](const MeasuredPair& pair) { return pair.second - pair.first; }));
    writer.u32_planes(
        of_pairs(stored, [](const MeasuredPair& pair) { return std::bit_cast<uint32_t>(pair.distance); }));
    return writer.take();
}

void check_pairs(const StoredIndex& stored) {
    const auto corrupt = [](const MeasuredPair& pair, const char* what) {
        refuse_as_corrupt("section PAIR: the vertices " + std::to_string(pair.first) + " and " +
                          std::to_string(pair.second) + what);
    };
    const MeasuredPair* before = nullptr;
    for (const MeasuredPair& pair : stored.measured_pairs) {
        if (pair.first >= pair.second || pair.second >= stored.positions.size())
            corrupt(pair, " are no pair");
        if (before && std::pair(before->first, before->second) >= std::pair(pair.first, pair.second))
            corrupt(pair, " do not follow the pair before");
        if (!(pair.distance > 0) || !std::isfinite(pair.distance)) corrupt(pair, " have no distance");
        before = &pair;
    }
}

// The numbers are added up modulo 2^32, so that what a file with other numbers makes is refused afterwards.
void read_pairs(const format::Container& container, StoredIndex& stored) {
    constexpr uint64_t BYTES_OF_PAIR = 3 * sizeof(uint32_t), MOST_PAIRS = (uint64_t{1} << 31) - 1;
    const uint64_t vertices = stored.positions.size();
    const uint64_t most_pairs = std::min(MOST_PAIRS, vertices * vertices / 2);
    const auto bytes = container.read_bytes(
        TAG_MEASURED_PAIRS, sizeof(uint64_t) + sizeof stored.errors_of_measured + most_pairs * BYTES_OF_PAIR);
    format::ByteReader reader(bytes, "section PAIR");
    const uint64_t count = reader.u64();
    reader.f32_array(stored.errors_of_measured);
    for (const float error : stored.errors_of_measured)
        if (!(error >= 0) || !std::isfinite(error))
            refuse_as_corrupt("section PAIR: the error " + std::to_string(error));
    if (count > most_pairs || reader.remaining() != count * BYTES_OF_PAIR)
        refuse_as_corrupt("section PAIR does not hold " + std::to_string(count) + " pairs");
    std::vector<uint32_t> steps(count), apart(count), distances(count);
    for (auto* const numbers : {&steps, &apart, &distances}) reader.u32_planes(*numbers);
    stored.measured_pairs.reserve(count);
    uint32_t first = 0;
    for (uint64_t i = 0; i < count; ++i) {
        first += steps[i];
        stored.measured_pairs.push_back({first, first + apart[i], std::bit_cast<float>(distances[i])});
    }
    check_pairs(stored);
}

}

void write_overlay(const StoredIndex& stored, format::ContainerWriter& writer) {
    writer.add_bytes(TAG_QUANTA, quantum_bytes(stored));
    writer.add_bytes(TAG_SEGMENTS, segment_bytes(stored));
    if (!stored.measured_pairs.empty()) writer.add_bytes(TAG_MEASURED_PAIRS, pair_bytes(stored));
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
    if (container.has(TAG_MEASURED_PAIRS))
        about_section(TAG_MEASURED_PAIRS, [&] { read_pairs(container, stored); });
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
