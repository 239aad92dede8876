// PAIR and EDGE: pairs of vertices, which an index of the overlay engine has besides its tables.
#include <algorithm>
#include <bit>
#include <cmath>
#include <string>
#include <utility>

#include "format/bytes.h"
#include "src/base/number_text.h"
#include "src/file/sections.h"

namespace geodesic {

namespace {

constexpr uint64_t BYTES_OF_PAIR = 3 * sizeof(uint32_t), MOST_PAIRS = (uint64_t{1} << 31) - 1;

template <class Value>
std::vector<uint32_t> of_pairs(std::span<const VertexPair> pairs, const Value& value) {
    std::vector<uint32_t> values;
    for (const VertexPair& pair : pairs) values.push_back(value(pair));
    return values;
}

void write_pairs(std::span<const VertexPair> pairs, format::ByteWriter& writer) {
    uint32_t before = 0;
    writer.u32_planes(of_pairs(
        pairs, [&](const VertexPair& pair) { return pair.first - std::exchange(before, pair.first); }));
    writer.u32_planes(of_pairs(pairs, [](const VertexPair& pair) { return pair.second - pair.first; }));
    writer.u32_planes(
        of_pairs(pairs, [](const VertexPair& pair) { return std::bit_cast<uint32_t>(pair.distance); }));
}

void check_pairs(const char* section, std::span<const VertexPair> pairs, size_t vertex_count) {
    const auto corrupt = [&](const VertexPair& pair, const char* what) {
        refuse_as_corrupt(std::string("section ") + section + ": the vertices " + std::to_string(pair.first) +
                          " and " + std::to_string(pair.second) + what);
    };
    const VertexPair* before = nullptr;
    for (const VertexPair& pair : pairs) {
        if (pair.first >= pair.second || pair.second >= vertex_count) corrupt(pair, " are no pair");
        if (before && std::pair(before->first, before->second) >= std::pair(pair.first, pair.second))
            corrupt(pair, " do not follow the pair before");
        if (!(pair.distance > 0) || !std::isfinite(pair.distance)) corrupt(pair, " have no distance");
        before = &pair;
    }
}

uint64_t most_pairs(const StoredIndex& stored) {
    const uint64_t vertices = stored.positions.size();
    return std::min(MOST_PAIRS, vertices * vertices / 2);
}

// The pairs are what is left of the section. Sums of numbers of a corrupt file may wrap around; what comes of
// them is checked in the end.
std::vector<VertexPair> read_pairs(const char* section, uint64_t count, uint64_t most,
                                   const StoredIndex& stored, format::ByteReader& reader) {
    if (count > most || reader.remaining() != count * BYTES_OF_PAIR)
        refuse_as_corrupt(std::string("section ") + section + " does not hold " + std::to_string(count) +
                          " pairs");
    std::vector<uint32_t> steps(count), apart(count), distances(count);
    for (auto* const numbers : {&steps, &apart, &distances}) reader.u32_planes(*numbers);
    std::vector<VertexPair> pairs;
    pairs.reserve(count);
    uint32_t first = 0;
    for (uint64_t i = 0; i < count; ++i) {
        first += steps[i];
        pairs.push_back({first, first + apart[i], std::bit_cast<float>(distances[i])});
    }
    check_pairs(section, pairs, stored.positions.size());
    return pairs;
}

std::vector<std::byte> measured_bytes(const StoredIndex& stored) {
    format::ByteWriter writer;
    writer.u64(stored.measured_pairs.size());
    writer.f32_array(stored.errors_of_measured);
    write_pairs(stored.measured_pairs, writer);
    return writer.take();
}

void read_measured(const format::Container& container, StoredIndex& stored) {
    const auto bytes =
        container.read_bytes(TAG_MEASURED_PAIRS, sizeof(uint64_t) + sizeof stored.errors_of_measured +
                                                     most_pairs(stored) * BYTES_OF_PAIR);
    format::ByteReader reader(bytes, "section PAIR");
    const uint64_t count = reader.u64();
    reader.f32_array(stored.errors_of_measured);
    for (const float error : stored.errors_of_measured)
        if (!(error >= 0) || !std::isfinite(error))
            refuse_as_corrupt("section PAIR: the error " + number_text(error));
    stored.measured_pairs = read_pairs("PAIR", count, most_pairs(stored), stored, reader);
}

std::vector<std::byte> steep_bytes(const StoredIndex& stored) {
    format::ByteWriter writer;
    writer.u64(stored.steep_edges.size());
    write_pairs(stored.steep_edges, writer);
    return writer.take();
}

void read_steep(const format::Container& container, StoredIndex& stored) {
    const uint64_t most = std::min(most_pairs(stored), 3 * stored.description.triangle_count);
    const auto bytes = container.read_bytes(TAG_STEEP_EDGES, sizeof(uint64_t) + most * BYTES_OF_PAIR);
    format::ByteReader reader(bytes, "section EDGE");
    const uint64_t count = reader.u64();
    stored.steep_edges = read_pairs("EDGE", count, most, stored, reader);
}

}

void write_vertex_pairs(const StoredIndex& stored, format::ContainerWriter& writer) {
    if (!stored.measured_pairs.empty()) writer.add_bytes(TAG_MEASURED_PAIRS, measured_bytes(stored));
    if (!stored.steep_edges.empty()) writer.add_bytes(TAG_STEEP_EDGES, steep_bytes(stored));
}

void read_vertex_pairs(const format::Container& container, StoredIndex& stored) {
    if (container.has(TAG_MEASURED_PAIRS))
        about_section(TAG_MEASURED_PAIRS, [&] { read_measured(container, stored); });
    if (container.has(TAG_STEEP_EDGES))
        about_section(TAG_STEEP_EDGES, [&] { read_steep(container, stored); });
}

}
