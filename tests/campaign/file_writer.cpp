#include "format/bytes.h"
#include "format/container.h"
#include "tests/campaign/file_content.h"

namespace geodesic::file_campaign {

namespace {

class Writer {
public:
    explicit Writer(const FileContent& content) : content_(content), container_(0x5EED) {}

    void add(const char (&tag)[5], format::ByteWriter& bytes) {
        const auto raw = bytes.take();
        raw_size_ += raw.size();
        if (content_.is_canonical)
            container_.add_bytes(format::make_tag(tag), raw);
        else
            container_.add_raw(format::make_tag(tag), raw);
    }

    void add(const char (&tag)[5], const std::vector<Matrix>& matrices) {
        std::vector<format::MatrixView> views;
        format::ByteWriter bytes;
        for (const Matrix& matrix : matrices) {
            if (matrix.values.empty()) continue;
            views.push_back({matrix.values, matrix.rows, matrix.cols});
            if (!content_.is_canonical) bytes.f32_array(matrix.values);
            raw_size_ += matrix.values.size() * sizeof(float);
        }
        if (content_.is_canonical)
            container_.add_matrices(format::make_tag(tag), views);
        else
            container_.add_raw(format::make_tag(tag), bytes.take());
    }

    WrittenFile finish() { return {container_.finish(), raw_size_}; }

private:
    const FileContent& content_;
    format::ContainerWriter container_;
    uint64_t raw_size_ = 0;
};

void add_meta(const FileContent& content, Writer& writer) {
    format::ByteWriter bytes;
    bytes.u64(content.id_count());
    bytes.u64(content.id_count()); // triangles
    bytes.u64(7);                  // seed
    bytes.u32(content.metric);
    bytes.f32(content.bound_scale);
    bytes.f64(content.delta);
    bytes.f64(content.diagonal);
    bytes.u32(0); // sources of the measured errors
    for (int error = 0; error < 5; ++error) bytes.f64(0);
    bytes.u64(0); // what decides the metric
    bytes.u32(content.metric_flags);
    bytes.u32(content.engine);
    bytes.f64(0); // the error at vertices
    writer.add("META", bytes);
}

void add_hierarchy(const FileContent& content, Writer& writer) {
    format::ByteWriter bytes;
    bytes.u32(content.level_count());
    bytes.u64(content.inner_count());
    bytes.u32_array(content.children);
    writer.add("HIER", bytes);
}

void add_vertices(const FileContent& content, Writer& writer) {
    format::ByteWriter bytes;
    bytes.u64(content.vertex_count());
    bytes.u32_array(content.number_of_id);
    writer.add("VERT", bytes);
    for (const auto& position : content.positions) bytes.f32_array(position);
    writer.add("POSI", bytes);
}

void add_borders(const FileContent& content, Writer& writer) {
    format::ByteWriter bytes;
    bytes.u32_array(content.owned);
    bytes.u32_array(content.internal);
    for (uint32_t p = 1; p < content.patch_count(); ++p)
        bytes.u32(static_cast<uint32_t>(content.borders[p].size()));
    for (const auto& border : content.borders) bytes.u32_array(border);
    writer.add("BORD", bytes);
}

void add_segments(const FileContent& content, Writer& writer) {
    format::ByteWriter bytes;
    bytes.f32_array(content.quantum);
    writer.add("QUAN", bytes);
    for (const auto& next : content.next) bytes.u32_array(next);
    for (const auto& length : content.segment_length) bytes.f32_array(length);
    writer.add("SEGM", bytes);
}

}

WrittenFile write_content(const FileContent& content) {
    Writer writer(content);
    add_meta(content, writer);
    add_hierarchy(content, writer);
    add_vertices(content, writer);
    add_borders(content, writer);
    if (content.is_overlay()) {
        add_segments(content, writer);
        writer.add("OVOV", content.overlay_tables);
    } else {
        writer.add("BVBV", content.border_tables);
    }
    writer.add("BVIV", content.border_internal_tables);
    writer.add("IVIV", content.internal_tables);
    return writer.finish();
}

}
