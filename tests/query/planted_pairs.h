#pragma once

#include <algorithm>
#include <bit>
#include <limits>
#include <map>
#include <span>
#include <utility>
#include <vector>

#include "format/bytes.h"
#include "tests/index/changed_section.h"

namespace geodesic::test {

// Vertices of hills of so many rows and columns.
inline constexpr uint32_t SIDE = 40;

inline uint32_t at(uint32_t x, uint32_t y) { return x + y * SIDE; }

// Two vertices of the caller's and a distance of theirs, to be put into a file by a test.
struct Planted {
    uint32_t a, b;
    float distance;
};

inline std::vector<uint32_t> numbers_of_ids(std::span<const std::byte> file, uint32_t id_count) {
    const auto bytes = format::Container::parse(file, INDEX_TAGS).read_bytes(TAG_VERTICES, UINT64_MAX);
    format::ByteReader reader(bytes, "VERT");
    reader.u64();
    std::vector<uint32_t> numbers(id_count);
    reader.u32_planes(numbers);
    return numbers;
}

// What the sections PAIR and EDGE have of their pairs, as format/SPEC.md has it.
inline void write_planted(std::span<const Planted> pairs, std::span<const uint32_t> number_of_id,
                          format::ByteWriter& writer) {
    std::multimap<std::pair<uint32_t, uint32_t>, float> distance_of;
    for (const auto& [a, b, distance] : pairs)
        distance_of.emplace(std::minmax(number_of_id[a], number_of_id[b]), distance);
    std::vector<uint32_t> steps, apart, distances;
    uint32_t before = 0;
    for (const auto& [numbers, distance] : distance_of) {
        steps.push_back(numbers.first - before);
        apart.push_back(numbers.second - numbers.first);
        distances.push_back(std::bit_cast<uint32_t>(distance));
        before = numbers.first;
    }
    for (const auto* planes : {&steps, &apart, &distances}) writer.u32_planes(*planes);
}

// The section EDGE of these.
inline Bytes steep_section(std::span<const Planted> edges, std::span<const uint32_t> number_of_id) {
    format::ByteWriter writer;
    writer.u64(edges.size());
    write_planted(edges, number_of_id, writer);
    return writer.take();
}

// Every so many-th edge of a mesh, along which most fields change by more than it says.
inline std::vector<Planted> planted_edges(const TestMesh& mesh, uint32_t step) {
    std::vector<Planted> planted;
    uint32_t i = 0;
    for (const auto& [a, b] : edges_of(mesh))
        if (i++ % step == 0) planted.push_back({a, b, 0.6f * static_cast<float>(mesh.straight(a, b))});
    return planted;
}

// The section with one value of a pair changed, if `pairs_begin` bytes precede the pairs: plane 0 is that of
// the steps, 1 how far numbers are apart, 2 the distances.
inline Bytes with_value(Bytes section, size_t pairs_begin, size_t plane, size_t pair, uint32_t value) {
    const size_t pairs = (section.size() - pairs_begin) / 12;
    for (size_t byte = 0; byte < 4; ++byte)
        section[pairs_begin + (plane * 4 + byte) * pairs + pair] =
            static_cast<std::byte>(value >> 8 * byte & 0xff);
    return section;
}

// The distances that geoidx_query_within finds, in ascending order; infinite of vertices that it does not.
inline std::vector<float> found_within(geoidx_query* query, std::span<const uint32_t> sources, float radius,
                                       uint32_t vertex_count) {
    constexpr float FAR = std::numeric_limits<float>::infinity();
    std::vector<uint32_t> vertices(vertex_count);
    std::vector<float> distances(vertex_count), field(vertex_count, FAR);
    uint32_t count = 0;
    require_success(geoidx_query_within(query, sources.data(), static_cast<uint32_t>(sources.size()), radius,
                                        vertices.data(), distances.data(), vertex_count, &count));
    CHECK(std::is_sorted(distances.begin(), distances.begin() + count));
    for (uint32_t i = 0; i < count; ++i) field[vertices[i]] = distances[i];
    return field;
}

}
