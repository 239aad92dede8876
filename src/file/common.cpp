// The sections that both engines have.
#include <cmath>
#include <numeric>
#include <string>

#include "format/bytes.h"
#include "src/base/number_text.h"
#include "src/base/numbers.h"
#include "src/file/sections.h"
#include "src/mesh/intake.h"

namespace geodesic {

namespace {

constexpr uint64_t MAX_BYTES = uint64_t{1} << 40; // of one section of numbers

// ---- META

constexpr uint64_t META_BYTES = 184;

std::vector<std::byte> meta_bytes(const Description& meta) {
    format::ByteWriter writer;
    writer.u64(meta.id_count);
    writer.u64(meta.triangle_count);
    writer.u64(meta.seed);
    writer.u32(meta.metric);
    writer.f32(meta.bound_scale);
    writer.f64(meta.delta);
    writer.f64(meta.bounding_box_diagonal);
    writer.u32(meta.error.sources);
    for (double value :
         {meta.error.mean, meta.error.signed_mean, meta.error.p99, meta.error.p999, meta.error.max})
        writer.f64(value);
    writer.u64(meta.metric_fingerprint);
    writer.u32(meta.metric_flags);
    writer.u32(meta.engine);
    writer.f64(meta.error.mean_at_vertices);
    writer.u32(meta.codec);
    for (const MeanAndMax& of_class : meta.error.by_distance) {
        writer.f64(of_class.mean);
        writer.f64(of_class.max);
    }
    writer.f64(meta.error.several.mean);
    writer.f64(meta.error.several.max);
    return writer.take();
}

void check_meta(const Description& meta) {
    const auto corrupt = [](const std::string& detail) { refuse_as_corrupt("section META: " + detail); };
    if (meta.engine > GEOIDX_ENGINE_OVERLAY)
        corrupt("engine " + std::to_string(meta.engine) + " is not known");
    if (meta.codec > GEOIDX_CODEC_MAPPED ||
        (meta.codec != GEOIDX_CODEC_LOSSLESS && meta.engine == GEOIDX_ENGINE_GRAPH))
        corrupt("codec " + std::to_string(meta.codec) + " does not go with engine " +
                std::to_string(meta.engine));
    if (meta.id_count == 0 || meta.id_count > UINT32_MAX - 1)
        corrupt("the mesh has " + std::to_string(meta.id_count) + " vertices");
    if (!(meta.bound_scale >= 0 && meta.bound_scale <= 1))
        corrupt("the bound scale is " + number_text(meta.bound_scale) + ", not in 0 .. 1");
    if (!(meta.delta >= 0 && meta.delta <= 100))
        corrupt("delta is " + number_text(meta.delta) + ", not in 0 .. 100");
    if (!(meta.bounding_box_diagonal >= 0) || !std::isfinite(meta.bounding_box_diagonal))
        corrupt("the diagonal is " + number_text(meta.bounding_box_diagonal));
    for (double error : {meta.error.mean, meta.error.signed_mean, meta.error.p99, meta.error.p999,
                         meta.error.max, meta.error.mean_at_vertices})
        if (std::isnan(error)) corrupt("a measured error is NaN");
    const auto& [near_by, middle, far_off] = meta.error.by_distance;
    for (const MeanAndMax& error : {near_by, middle, far_off, meta.error.several})
        if (std::isnan(error.mean) || std::isnan(error.max)) corrupt("a measured error is NaN");
}

void read_meta(const format::Container& container, Description& meta) {
    const auto bytes = container.read_bytes(TAG_META, META_BYTES);
    format::ByteReader reader(bytes, "section META");
    meta.mesh_fingerprint = container.mesh_fingerprint();
    meta.format_minor = container.version_minor();
    meta.id_count = reader.u64();
    meta.triangle_count = reader.u64();
    meta.seed = reader.u64();
    meta.metric = reader.u32();
    meta.bound_scale = reader.f32();
    meta.delta = reader.f64();
    meta.bounding_box_diagonal = reader.f64();
    meta.error.sources = reader.u32();
    for (double* value :
         {&meta.error.mean, &meta.error.signed_mean, &meta.error.p99, &meta.error.p999, &meta.error.max})
        *value = reader.f64();
    meta.metric_fingerprint = reader.u64();
    meta.metric_flags = reader.u32();
    meta.engine = reader.u32();
    meta.error.mean_at_vertices = reader.f64();
    meta.codec = reader.u32();
    for (MeanAndMax& of_class : meta.error.by_distance) {
        of_class.mean = reader.f64();
        of_class.max = reader.f64();
    }
    meta.error.several.mean = reader.f64();
    meta.error.several.max = reader.f64();
    reader.expect_end();
    check_meta(meta);
}

// ---- The mesh that META describes

void require_mesh_of(const Description& about, const geoidx_mesh& mesh) {
    if (mesh.vertex_count != about.id_count || mesh.triangle_count != about.triangle_count)
        throw Error(GEOIDX_ERROR_MESH_MISMATCH,
                    "the index was built from a mesh of " + std::to_string(about.id_count) +
                        " vertices and " + std::to_string(about.triangle_count) +
                        " triangles, this one has " + std::to_string(mesh.vertex_count) + " and " +
                        std::to_string(mesh.triangle_count));
    if (mesh_fingerprint(mesh) != about.mesh_fingerprint)
        throw Error(GEOIDX_ERROR_MESH_MISMATCH,
                    "the index was built from a mesh with other positions or triangles");
}

// ---- HIER

std::vector<std::byte> hierarchy_bytes(const StoredIndex& stored) {
    format::ByteWriter writer;
    writer.u32(stored.level_count);
    writer.u64(stored.child_count.size());
    writer.u32_array(stored.child_count);
    return writer.take();
}

// Patches have numbers of 32 bits, and so has the sum of two counts of them.
constexpr uint64_t MOST_PATCHES = uint64_t{1} << 31;

// Returns the number of leaves. Refuses more than `patch_room` patches besides the root, since the section
// BORD has numbers for each of them.
uint32_t read_hierarchy(const format::Container& container, uint64_t patch_room, StoredIndex& stored) {
    const auto bytes = container.read_bytes(TAG_HIERARCHY, MAX_BYTES);
    format::ByteReader reader(bytes, "section HIER");
    stored.level_count = reader.u32();
    if (stored.level_count == 0 || stored.level_count > GEOIDX_MAX_LEVELS)
        refuse_as_corrupt("section HIER: " + std::to_string(stored.level_count) + " levels");
    const uint64_t inner_count = reader.count(UINT32_MAX - 1, sizeof(uint32_t));
    uint64_t patches = 1, of_level = 1;
    for (uint32_t l = 0; l < stored.level_count; ++l) {
        uint64_t of_next_level = 0;
        for (uint64_t p = 0; p < of_level; ++p) {
            const uint32_t children = reader.u32();
            if (children == 0 || children > patch_room || patches + children > patch_room + 1 ||
                patches + children > MOST_PATCHES)
                refuse_as_corrupt("section HIER: patch " + std::to_string(stored.child_count.size()) +
                                  " has " + std::to_string(children) + " children");
            stored.child_count.push_back(children);
            of_next_level += children;
            patches += children;
        }
        of_level = of_next_level;
    }
    reader.expect_end();
    if (stored.child_count.size() != inner_count)
        refuse_as_corrupt("section HIER: " + std::to_string(inner_count) +
                          " inner patches are named, but there are " +
                          std::to_string(stored.child_count.size()));
    return static_cast<uint32_t>(of_level);
}

// ---- VERT

std::vector<std::byte> vertex_bytes(const StoredIndex& stored) {
    format::ByteWriter writer;
    writer.u64(stored.positions.size());
    writer.u32_planes(stored.number_of_id);
    return writer.take();
}

// Returns the vertex count, for which nothing is allocated before POSI is known to hold as many positions.
uint32_t read_vertices(const format::Container& container, StoredIndex& stored) {
    const uint64_t id_count = stored.description.id_count;
    const auto bytes = container.read_bytes(TAG_VERTICES, sizeof(uint64_t) + id_count * sizeof(uint32_t));
    format::ByteReader reader(bytes, "section VERT");
    const uint64_t vertex_count = reader.u64();
    if (reader.remaining() != id_count * sizeof(uint32_t))
        refuse_as_corrupt("section VERT does not hold " + std::to_string(id_count) + " numbers");
    if (vertex_count >= NONE)
        refuse_as_corrupt("section VERT: " + std::to_string(vertex_count) + " vertices");
    stored.number_of_id.resize(id_count);
    reader.u32_planes(stored.number_of_id);
    for (uint32_t number : stored.number_of_id)
        if (number != NONE && number >= vertex_count)
            refuse_as_corrupt("section VERT: vertex number " + std::to_string(number) + " of " +
                              std::to_string(vertex_count));
    return static_cast<uint32_t>(vertex_count);
}

// ---- BORD

std::vector<std::byte> border_bytes(const StoredIndex& stored) {
    format::ByteWriter writer;
    writer.u32_array(stored.owned_count);
    writer.u32_array(stored.internal_count);
    writer.u32_array(stored.border_size);
    writer.u32_planes(stored.border);
    return writer.take();
}

// Reads `count` numbers and returns their sum plus `sum`, which must stay below NONE.
uint64_t read_counts(format::ByteReader& reader, size_t count, uint64_t sum, std::vector<uint32_t>& counts) {
    for (size_t i = 0; i < count; ++i) {
        counts.push_back(reader.u32());
        sum += counts.back();
        if (sum >= NONE) refuse_as_corrupt("section BORD: counts add up to more than 2^32 - 2");
    }
    return sum;
}

// Refuses a vertex that is on one border twice, since a vertex has a single position on a border.
void refuse_repeated(const StoredIndex& stored, uint64_t border_vertex_count) {
    std::vector<uint32_t> last_patch(border_vertex_count, 0);
    size_t next = 0;
    for (uint32_t p = 1; p <= stored.border_size.size(); ++p)
        for (uint32_t i = 0; i < stored.border_size[p - 1]; ++i) {
            const uint32_t v = stored.border[next++];
            if (last_patch[v] == p)
                refuse_as_corrupt("section BORD: vertex number " + std::to_string(v) +
                                  " stands twice on the border of patch " + std::to_string(p));
            last_patch[v] = p;
        }
}

void read_borders(std::span<const std::byte> bytes, uint32_t leaf_count, StoredIndex& stored) {
    format::ByteReader reader(bytes, "section BORD");
    const size_t inner_count = stored.child_count.size();
    const uint64_t border_vertices = read_counts(reader, inner_count, 0, stored.owned_count);
    const uint64_t vertices = read_counts(reader, leaf_count, border_vertices, stored.internal_count);
    if (vertices != stored.positions.size())
        refuse_as_corrupt("section BORD: borders and leaves hold " + std::to_string(vertices) +
                          " vertices of " + std::to_string(stored.positions.size()));
    const uint64_t entries = read_counts(reader, inner_count + leaf_count - 1, 0, stored.border_size);
    if (reader.remaining() != entries * sizeof(uint32_t))
        refuse_as_corrupt("section BORD does not hold " + std::to_string(entries) + " border vertices");
    stored.border.resize(entries);
    reader.u32_planes(stored.border);
    for (uint32_t v : stored.border)
        if (v >= border_vertices)
            refuse_as_corrupt("section BORD: vertex number " + std::to_string(v) + " is no border vertex");
    refuse_repeated(stored, border_vertices);
}

}

void write_common(const StoredIndex& stored, format::ContainerWriter& writer) {
    writer.add_bytes(TAG_META, meta_bytes(stored.description));
    writer.add_bytes(TAG_HIERARCHY, hierarchy_bytes(stored));
    writer.add_bytes(TAG_VERTICES, vertex_bytes(stored));
    write_positions(stored, writer);
    writer.add_bytes(TAG_BORDERS, border_bytes(stored));
}

void read_common(const format::Container& container, const ReadOptions& options, StoredIndex& stored) {
    about_section(TAG_META, [&] { read_meta(container, stored.description); });
    if (options.max_vertices != 0 && stored.description.id_count > options.max_vertices)
        throw Error(GEOIDX_ERROR_LIMIT,
                    "the mesh of the index has " + std::to_string(stored.description.id_count) +
                        " vertices, more than the " + std::to_string(options.max_vertices) +
                        " that max_vertices allows");
    if (options.mesh) require_mesh_of(stored.description, *options.mesh);
    const auto border_bytes = container.read_bytes(TAG_BORDERS, MAX_BYTES);
    const uint64_t patch_room = border_bytes.size() / sizeof(uint32_t);
    const uint32_t leaf_count =
        about_section(TAG_HIERARCHY, [&] { return read_hierarchy(container, patch_room, stored); });
    const uint32_t vertex_count =
        about_section(TAG_VERTICES, [&] { return read_vertices(container, stored); });
    about_section(TAG_POSITIONS, [&] { read_positions(container, vertex_count, options, stored); });
    about_section(TAG_BORDERS, [&] { read_borders(border_bytes, leaf_count, stored); });
}

}
