#pragma once

#include <array>
#include <functional>
#include <map>

#include "format/bytes.h"
#include "format/container.h"
#include "src/file/sections.h"
#include "tests/capi/calls.h"

namespace geodesic::test {

// The content of an index file as numbers that a test can change; put_together makes a file of it whose
// checksums are right. Follows SPEC.md, apart from src/index.
struct TakenApart {
    struct Meta {
        uint64_t id_count, triangle_count, seed;
        uint32_t metric;
        float bound_scale;
        double delta, diagonal;
        uint32_t error_sources;
        double errors[5];
        uint64_t metric_fingerprint;
        uint32_t metric_flags, engine;
        double error_at_vertices;
        uint32_t codec;
        double errors_by_kind[8]; // near, middle, far, several sources: mean and largest
    } meta;
    uint32_t level_count;
    uint64_t inner_count;
    std::vector<uint32_t> children; // per inner patch
    uint64_t vertex_count;
    std::vector<uint32_t> number_of_id;
    float position_step;
    std::array<double, 3> position_origin;
    uint64_t position_checksum;
    std::vector<uint32_t> coordinates; // as they are stored: folded differences
    std::vector<uint32_t> owned, internal, border_sizes, border;
    std::map<uint32_t, std::vector<float>> tables; // by tag, the matrices back to back
    uint32_t missing_tag = 0;                      // a section to leave out
    std::map<uint32_t, Bytes> extra_bytes; // appended to the section's bytes; of PAIR and EDGE, all bytes

    uint32_t leaf_count() const { return static_cast<uint32_t>(internal.size()); }
};

inline TakenApart take_apart(std::span<const std::byte> file) {
    const auto container = format::Container::parse(file, INDEX_TAGS);
    const auto bytes = [&](uint32_t tag) { return container.read_bytes(tag, UINT64_MAX); };
    TakenApart parts;
    const auto meta_bytes = bytes(TAG_META);
    format::ByteReader meta(meta_bytes);
    parts.meta.id_count = meta.u64();
    parts.meta.triangle_count = meta.u64();
    parts.meta.seed = meta.u64();
    parts.meta.metric = meta.u32();
    parts.meta.bound_scale = meta.f32();
    parts.meta.delta = meta.f64();
    parts.meta.diagonal = meta.f64();
    parts.meta.error_sources = meta.u32();
    for (double& error : parts.meta.errors) error = meta.f64();
    parts.meta.metric_fingerprint = meta.u64();
    parts.meta.metric_flags = meta.u32();
    parts.meta.engine = meta.u32();
    parts.meta.error_at_vertices = meta.f64();
    parts.meta.codec = meta.u32();
    for (double& error : parts.meta.errors_by_kind) error = meta.f64();

    const auto hierarchy_bytes = bytes(TAG_HIERARCHY);
    format::ByteReader hierarchy(hierarchy_bytes);
    parts.level_count = hierarchy.u32();
    parts.inner_count = hierarchy.u64();
    parts.children.resize(parts.inner_count);
    hierarchy.u32_array(parts.children);
    uint64_t patches = 1;
    for (uint32_t count : parts.children) patches += count;

    const auto vertex_bytes = bytes(TAG_VERTICES);
    format::ByteReader vertices(vertex_bytes);
    parts.vertex_count = vertices.u64();
    parts.number_of_id.resize(parts.meta.id_count);
    vertices.u32_planes(parts.number_of_id);
    const auto position_bytes = bytes(TAG_POSITIONS);
    format::ByteReader positions(position_bytes);
    parts.position_step = positions.f32();
    for (double& coordinate : parts.position_origin) coordinate = positions.f64();
    parts.position_checksum = positions.u64();
    parts.coordinates.resize(positions.remaining() / 4); // none where positions are left out
    positions.u32_planes(parts.coordinates);

    const auto border_bytes = bytes(TAG_BORDERS);
    format::ByteReader borders(border_bytes);
    parts.owned.resize(parts.inner_count);
    parts.internal.resize(patches - parts.inner_count);
    parts.border_sizes.resize(patches - 1);
    for (auto* sizes : {&parts.owned, &parts.internal, &parts.border_sizes}) borders.u32_array(*sizes);
    parts.border.resize(borders.remaining() / 4);
    borders.u32_planes(parts.border);
    return parts;
}

// Rows and columns of the matrices of one section, as SPEC.md orders them.
inline std::vector<std::pair<uint32_t, uint32_t>> shapes_of(const TakenApart& parts, uint32_t tag) {
    std::vector<std::pair<uint32_t, uint32_t>> shapes;
    const auto folded = [&](uint32_t size) {
        if (size > 1) shapes.push_back({size / 2, size % 2 ? size : size - 1});
    };
    const size_t first_leaf = parts.border_sizes.size() - parts.leaf_count();
    if (tag == TAG_BORDER_TABLES)
        for (uint32_t size : parts.border_sizes) folded(size);
    if (tag == TAG_INTERNAL_TABLES)
        for (uint32_t size : parts.internal) folded(size);
    if (tag == TAG_BORDER_INTERNAL_TABLES)
        for (size_t i = 0; i < parts.internal.size(); ++i)
            if (parts.border_sizes[first_leaf + i] && parts.internal[i])
                shapes.push_back({parts.border_sizes[first_leaf + i], parts.internal[i]});
    return shapes;
}

inline void take_tables_apart(std::span<const std::byte> file, TakenApart& parts) {
    const auto container = format::Container::parse(file, INDEX_TAGS);
    for (uint32_t tag : {TAG_BORDER_TABLES, TAG_BORDER_INTERNAL_TABLES, TAG_INTERNAL_TABLES}) {
        size_t entries = 0;
        for (const auto& [rows, cols] : shapes_of(parts, tag)) entries += size_t{rows} * cols;
        auto& values = parts.tables[tag];
        values.resize(entries);
        std::vector<format::MatrixTarget> targets;
        size_t next = 0;
        for (const auto& [rows, cols] : shapes_of(parts, tag)) {
            targets.push_back({std::span(values).subspan(next, size_t{rows} * cols), rows, cols});
            next += size_t{rows} * cols;
        }
        container.read_matrices(tag, targets);
    }
}

// `shapes` of the tables: of the unchanged parts, so that a count can be changed without its tables.
inline Bytes put_together(const TakenApart& parts, const TakenApart& shapes, uint64_t fingerprint = 1) {
    format::ContainerWriter writer(fingerprint);
    const auto add = [&](uint32_t tag, format::ByteWriter& bytes) {
        if (tag == parts.missing_tag) return;
        if (const auto extra = parts.extra_bytes.find(tag); extra != parts.extra_bytes.end())
            bytes.bytes(extra->second);
        writer.add_bytes(tag, bytes.take());
    };
    format::ByteWriter bytes;
    bytes.u64(parts.meta.id_count);
    bytes.u64(parts.meta.triangle_count);
    bytes.u64(parts.meta.seed);
    bytes.u32(parts.meta.metric);
    bytes.f32(parts.meta.bound_scale);
    bytes.f64(parts.meta.delta);
    bytes.f64(parts.meta.diagonal);
    bytes.u32(parts.meta.error_sources);
    for (double error : parts.meta.errors) bytes.f64(error);
    bytes.u64(parts.meta.metric_fingerprint);
    bytes.u32(parts.meta.metric_flags);
    bytes.u32(parts.meta.engine);
    bytes.f64(parts.meta.error_at_vertices);
    bytes.u32(parts.meta.codec);
    for (double error : parts.meta.errors_by_kind) bytes.f64(error);
    add(TAG_META, bytes);
    bytes.take();
    bytes.u32(parts.level_count);
    bytes.u64(parts.inner_count);
    bytes.u32_array(parts.children);
    add(TAG_HIERARCHY, bytes);
    bytes.take();
    bytes.u64(parts.vertex_count);
    bytes.u32_planes(parts.number_of_id);
    add(TAG_VERTICES, bytes);
    bytes.take();
    bytes.f32(parts.position_step);
    for (const double coordinate : parts.position_origin) bytes.f64(coordinate);
    bytes.u64(parts.position_checksum);
    bytes.u32_planes(parts.coordinates);
    add(TAG_POSITIONS, bytes);
    bytes.take();
    for (const auto* numbers : {&parts.owned, &parts.internal, &parts.border_sizes})
        bytes.u32_array(*numbers);
    bytes.u32_planes(parts.border);
    add(TAG_BORDERS, bytes);
    for (const uint32_t tag : {TAG_MEASURED_PAIRS, TAG_STEEP_EDGES})
        if (parts.extra_bytes.contains(tag)) {
            bytes.take();
            add(tag, bytes);
        }
    for (uint32_t tag : {TAG_BORDER_TABLES, TAG_BORDER_INTERNAL_TABLES, TAG_INTERNAL_TABLES}) {
        if (tag == parts.missing_tag) continue;
        std::vector<format::MatrixView> matrices;
        const std::span<const float> values(parts.tables.at(tag));
        size_t next = 0;
        for (const auto& [rows, cols] : shapes_of(shapes, tag)) {
            matrices.push_back({values.subspan(next, size_t{rows} * cols), rows, cols});
            next += size_t{rows} * cols;
        }
        writer.add_matrices(tag, matrices);
    }
    return writer.finish();
}

}
