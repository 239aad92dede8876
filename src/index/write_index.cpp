#include <limits>

#include "format/bytes.h"
#include "format/matrix_png.h"
#include "src/index/folded_triangle.h"
#include "src/index/index_file.h"
#include "src/index/index_sections.h"
#include "src/index/rings.h"

namespace geodesic {

namespace {

std::vector<std::byte> meta_bytes(const Index& index) {
    format::ByteWriter writer;
    writer.u64(index.id_count);
    writer.u64(index.triangle_count);
    writer.u64(index.seed);
    writer.u32(index.metric);
    writer.f32(index.bound_scale);
    writer.f64(index.delta);
    writer.f64(index.bounding_box_diagonal);
    writer.u32(index.error.sources);
    for (double value :
         {index.error.mean, index.error.signed_mean, index.error.p99, index.error.p999, index.error.max})
        writer.f64(value);
    writer.u64(index.metric_fingerprint);
    writer.u32(index.metric_flags);
    writer.u32(index.engine);
    writer.f64(index.error.mean_at_vertices);
    return writer.take();
}

std::vector<std::byte> hierarchy_bytes(const Index& index) {
    format::ByteWriter writer;
    writer.u32(index.level_count());
    writer.u64(index.first_leaf());
    for (uint32_t p = 0; p < index.first_leaf(); ++p)
        writer.u32(index.child_begin[p + 1] - index.child_begin[p]);
    return writer.take();
}

std::vector<std::byte> vertex_bytes(const Index& index) {
    format::ByteWriter writer;
    writer.u64(index.vertex_count());
    writer.u32_array(index.number_of_id);
    return writer.take();
}

std::vector<std::byte> position_bytes(const Index& index) {
    format::ByteWriter writer;
    for (const auto& position : index.positions) writer.f32_array(position);
    return writer.take();
}

std::vector<std::byte> border_bytes(const Index& index) {
    format::ByteWriter writer;
    for (uint32_t p = 0; p < index.first_leaf(); ++p)
        writer.u32(index.owned_begin[p + 1] - index.owned_begin[p]);
    for (uint32_t leaf = index.first_leaf(); leaf < index.patch_count(); ++leaf)
        writer.u32(index.internal_size(leaf));
    for (uint32_t p = 1; p < index.patch_count(); ++p) writer.u32(index.border_size(p));
    writer.u32_array(index.border);
    return writer.take();
}

// Matrices as PNG streams, with the sum of their raw sizes.
struct Images {
    std::vector<std::vector<std::byte>> streams;
    uint64_t raw_size = 0;

    void add(std::span<const float> values, uint32_t rows, uint32_t cols) {
        streams.push_back(format::encode_png(values, rows, cols));
        raw_size += values.size_bytes();
    }
};

template <class Entry>
void add_folded(Images& images, uint32_t size, const Entry& entry) {
    if (size < 2) return;
    std::vector<float> values;
    for_each_folded(size, [&](uint32_t i, uint32_t j) { values.push_back(entry(i, j)); });
    const FoldedShape shape = folded_shape(size);
    images.add(values, shape.rows, shape.cols);
}

Images border_images(const Index& index) {
    Images images;
    for (uint32_t p = 1; p < index.patch_count(); ++p)
        add_folded(images, index.border_size(p),
                   [&](uint32_t i, uint32_t j) { return index.border_row(p, i)[j]; });
    return images;
}

// value(leaf, i, j): the entry of position i of the border and internal vertex j.
template <class Value>
Images crossing_images(const Index& index, const Value& value) {
    Images images;
    std::vector<float> values;
    for (uint32_t leaf = index.first_leaf(); leaf < index.patch_count(); ++leaf) {
        const uint32_t rows = index.border_size(leaf), cols = index.internal_size(leaf);
        if (!rows || !cols) continue;
        values.clear();
        for (uint32_t i = 0; i < rows; ++i)
            for (uint32_t j = 0; j < cols; ++j) values.push_back(value(leaf, i, j));
        images.add(values, rows, cols);
    }
    return images;
}

template <class Value>
Images internal_images(const Index& index, const Value& value) {
    Images images;
    for (uint32_t leaf = index.first_leaf(); leaf < index.patch_count(); ++leaf)
        add_folded(images, index.internal_size(leaf),
                   [&](uint32_t i, uint32_t j) { return value(index.internal_place(leaf, i, j)); });
    return images;
}

// ---- The overlay engine's: codes, as floats

float code_value(uint16_t code) {
    return code == OverlayTables::UNREACHED ? std::numeric_limits<float>::infinity()
                                            : static_cast<float>(code);
}

std::vector<std::byte> quantum_bytes(const Index& index) {
    format::ByteWriter writer;
    writer.f32_array(index.overlay_tables.quantum);
    return writer.take();
}

std::vector<std::byte> segment_bytes(const Index& index) {
    format::ByteWriter writer;
    const BorderSegments segments = segments_of_rings(index);
    writer.u32_array(segments.next);
    writer.f32_array(segments.length);
    return writer.take();
}

// Of each inner patch: from what it owns to its border, then among what it owns.
Images overlay_images(const Index& index) {
    Images images;
    std::vector<float> values;
    for (uint32_t p = 0; p < index.first_leaf(); ++p) {
        const uint32_t border = index.border_size(p), owned = index.inner_size(p);
        const auto entry = [&](uint32_t i, uint32_t j) { return code_value(index.overlay_code(p, i, j)); };
        values.clear();
        for (uint32_t i = 0; i < owned; ++i)
            for (uint32_t j = 0; j < border; ++j) values.push_back(entry(border + i, j));
        if (!values.empty()) images.add(values, owned, border);
        add_folded(images, owned, [&](uint32_t i, uint32_t j) { return entry(border + i, border + j); });
    }
    return images;
}

void add_images(format::ContainerWriter& writer, uint32_t tag, const Images& images) {
    writer.add_encoded_matrices(tag, images.streams, images.raw_size);
}

}

std::vector<std::byte> write_index(const Index& index) {
    format::ContainerWriter writer(index.mesh_fingerprint);
    writer.add_bytes(TAG_META, meta_bytes(index));
    writer.add_bytes(TAG_HIERARCHY, hierarchy_bytes(index));
    writer.add_bytes(TAG_VERTICES, vertex_bytes(index));
    writer.add_bytes(TAG_POSITIONS, position_bytes(index));
    writer.add_bytes(TAG_BORDERS, border_bytes(index));
    if (index.engine == GEOIDX_ENGINE_OVERLAY) {
        writer.add_bytes(TAG_QUANTA, quantum_bytes(index));
        writer.add_bytes(TAG_SEGMENTS, segment_bytes(index));
        add_images(writer, TAG_OVERLAY_TABLES, overlay_images(index));
        add_images(writer, TAG_CROSSING_TABLES,
                   crossing_images(index, [&](uint32_t leaf, uint32_t i, uint32_t j) {
                       return code_value(index.crossing_code(leaf, i, j));
                   }));
        add_images(writer, TAG_INTERNAL_TABLES, internal_images(index, [&](uint64_t place) {
                       return code_value(index.overlay_tables.internal_tables[place]);
                   }));
    } else {
        add_images(writer, TAG_BORDER_TABLES, border_images(index));
        add_images(writer, TAG_CROSSING_TABLES,
                   crossing_images(index, [&](uint32_t leaf, uint32_t i, uint32_t j) {
                       return index.crossing_tables[index.crossing_place(leaf, i, j)];
                   }));
        add_images(writer, TAG_INTERNAL_TABLES,
                   internal_images(index, [&](uint64_t place) { return index.internal_tables[place]; }));
    }
    return writer.finish();
}

}
