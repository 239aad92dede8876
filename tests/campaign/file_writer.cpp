#include <span>
#include <utility>

#include <xxhash.h>

#include "format/bytes.h"
#include "format/container.h"
#include "tests/campaign/file_content.h"

namespace geodesic::file_campaign {

namespace {

uint64_t fingerprint_of(const FileContent& content) {
    format::ByteWriter bytes;
    for (const double coordinate : content.mesh_positions) bytes.f32(static_cast<float>(coordinate) + 0.f);
    const auto positions = bytes.take();
    const uint64_t first = XXH3_64bits(positions.data(), positions.size());
    bytes.u32_array(content.triangles);
    const auto triangles = bytes.take();
    return XXH3_64bits_withSeed(triangles.data(), triangles.size(), first);
}

class Writer {
public:
    explicit Writer(const FileContent& content)
        : content_(content), container_(content.has_positions ? 0x5EED : fingerprint_of(content)) {}

    void add(const char (&tag)[5], format::ByteWriter& bytes) {
        const auto raw = bytes.take();
        raw_size_ += raw.size();
        if (content_.is_canonical)
            container_.add_bytes(format::make_tag(tag), raw);
        else
            container_.add_raw(format::make_tag(tag), raw);
    }

    // Packed: every entry is far off its prediction, whatever that is. Every second matrix may be folded, or
    // all, or none.
    void add_packed(const char (&tag)[5], const std::vector<Matrix>& matrices, const auto& is_folded) {
        format::ByteWriter near, far;
        for (size_t m = 0; m < matrices.size(); ++m)
            for (const float value : is_folded(m) ? unfolded(matrices[m]) : matrices[m].values) {
                near.u8(0x80);
                far.u16(value == NO_PATH
                            ? 0xffff
                            : static_cast<uint16_t>(static_cast<uint32_t>(value) >> content_.shift));
                raw_size_ += sizeof(float);
            }
        near.bytes(far.take());
        const auto raw = near.take();
        if (content_.is_canonical)
            container_.add_images(format::make_tag(tag), raw);
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
    // The rows below a diagonal from the first on.
    static std::vector<float> unfolded(const Matrix& folded) {
        const uint32_t size = folded.rows + folded.rows + (folded.cols > 2 * folded.rows ? 1 : 0);
        std::vector<std::span<const float>> rows(size);
        std::span<const float> left(folded.values);
        for (uint32_t line = 0; line < folded.rows; ++line)
            for (const uint32_t row : {size - 1 - line, line + size % 2}) {
                rows[row] = left.first(row);
                left = left.subspan(row);
            }
        std::vector<float> values;
        for (const auto& row : rows) values.insert(values.end(), row.begin(), row.end());
        return values;
    }

    const FileContent& content_;
    format::ContainerWriter container_;
    uint64_t raw_size_ = 0;
};

void add_meta(const FileContent& content, Writer& writer) {
    format::ByteWriter bytes;
    bytes.u64(content.id_count());
    bytes.u64(content.triangles.size() / 3);
    bytes.u64(7); // seed
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
    bytes.u32(content.is_packed ? 0 : 1);
    for (int error = 0; error < 8; ++error) bytes.f64(0); // near, middle, far, several sources
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
    bytes.u32_planes(content.number_of_id);
    writer.add("VERT", bytes);
}

uint64_t checksum_of_positions(const FileContent& content) {
    format::ByteWriter bytes;
    for (const auto& position : content.positions)
        for (const int32_t coordinate : position) bytes.i32(coordinate);
    const auto coordinates = bytes.take();
    return XXH3_64bits(coordinates.data(), coordinates.size());
}

void add_positions(const FileContent& content, Writer& writer) {
    format::ByteWriter bytes;
    bytes.f32(content.position_step);
    for (const double coordinate : content.position_origin) bytes.f64(coordinate);
    bytes.u64(checksum_of_positions(content));
    std::vector<uint32_t> differences;
    std::array<int32_t, 3> last{};
    for (const auto& position : content.positions)
        for (size_t k = 0; k < 3; ++k) {
            const int32_t difference = position[k] - std::exchange(last[k], position[k]);
            differences.push_back(
                static_cast<uint32_t>(difference < 0 ? -2 * difference - 1 : 2 * difference));
        }
    if (content.has_positions) bytes.u32_planes(differences);
    writer.add("POSI", bytes);
}

void add_borders(const FileContent& content, Writer& writer) {
    format::ByteWriter bytes;
    bytes.u32_array(content.owned);
    bytes.u32_array(content.internal);
    for (uint32_t p = 1; p < content.patch_count(); ++p)
        bytes.u32(static_cast<uint32_t>(content.borders[p].size()));
    std::vector<uint32_t> all;
    for (const auto& border : content.borders) all.insert(all.end(), border.begin(), border.end());
    bytes.u32_planes(all);
    writer.add("BORD", bytes);
}

void add_segments(const FileContent& content, Writer& writer) {
    format::ByteWriter bytes;
    bytes.f32_array(content.quantum);
    for (size_t p = 0; p < content.quantum.size(); ++p) bytes.u8(content.shift);
    writer.add("QUAN", bytes);
    for (const auto& next : content.next) bytes.u32_array(next);
    for (const auto& length : content.segment_length) bytes.f32_array(length);
    for (const auto& [slot, end, length] : content.bridges) {
        bytes.u32(slot);
        bytes.u32(end);
        bytes.f32(length);
    }
    writer.add("SEGM", bytes);
}

}

WrittenFile write_content(const FileContent& content) {
    Writer writer(content);
    add_meta(content, writer);
    add_hierarchy(content, writer);
    add_vertices(content, writer);
    add_positions(content, writer);
    add_borders(content, writer);
    if (content.is_overlay()) {
        add_segments(content, writer);
    } else {
        writer.add("BVBV", content.border_tables);
    }
    if (content.is_packed) {
        writer.add_packed("OVOV", content.overlay_tables, [](size_t m) { return m % 2 == 1; });
        writer.add_packed("BVIV", content.border_internal_tables, [](size_t) { return false; });
        writer.add_packed("IVIV", content.internal_tables, [](size_t) { return true; });
        return writer.finish();
    }
    if (content.is_overlay()) writer.add("OVOV", content.overlay_tables);
    writer.add("BVIV", content.border_internal_tables);
    writer.add("IVIV", content.internal_tables);
    return writer.finish();
}

}
