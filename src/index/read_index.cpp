#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "format/bytes.h"
#include "src/index/derived_tables.h"
#include "src/index/folded_triangle.h"
#include "src/index/index_file.h"
#include "src/index/index_sections.h"
#include "src/index/rings.h"
#include "src/index/table_rows.h"

namespace geodesic {

namespace {

constexpr uint64_t MAX_BYTES = uint64_t{1} << 40; // of one section of numbers
constexpr uint64_t META_BYTES = 116;

[[noreturn]] void corrupt(const std::string& detail) { throw Error(GEOIDX_ERROR_CORRUPT, detail); }

void read_meta(const format::Container& container, Index& index) {
    const auto bytes = container.read_bytes(TAG_META, META_BYTES);
    format::ByteReader reader(bytes, "section META");
    index.mesh_fingerprint = container.mesh_fingerprint();
    index.id_count = reader.u64();
    index.triangle_count = reader.u64();
    index.seed = reader.u64();
    index.metric = reader.u32();
    index.bound_scale = reader.f32();
    index.delta = reader.f64();
    index.bounding_box_diagonal = reader.f64();
    index.error.sources = reader.u32();
    for (double* value :
         {&index.error.mean, &index.error.signed_mean, &index.error.p99, &index.error.p999, &index.error.max})
        *value = reader.f64();
    index.metric_fingerprint = reader.u64();
    index.metric_flags = reader.u32();
    index.engine = reader.u32();
    index.error.mean_at_vertices = reader.f64();
    reader.expect_end();
    if (index.engine > GEOIDX_ENGINE_OVERLAY)
        corrupt("section META: engine " + std::to_string(index.engine) + " is not known");
    if (index.id_count == 0 || index.id_count > UINT32_MAX - 1)
        corrupt("section META: the mesh has " + std::to_string(index.id_count) + " vertices");
    if (!(index.bound_scale >= 0 && index.bound_scale <= 1))
        corrupt("section META: the bound scale is " + std::to_string(index.bound_scale) + ", not in 0 .. 1");
    if (!(index.delta >= 0 && index.delta <= 100))
        corrupt("section META: delta is " + std::to_string(index.delta) + ", not in 0 .. 100");
    if (!(index.bounding_box_diagonal >= 0) || !std::isfinite(index.bounding_box_diagonal))
        corrupt("section META: the diagonal is " + std::to_string(index.bounding_box_diagonal));
    for (double error : {index.error.mean, index.error.signed_mean, index.error.p99, index.error.p999,
                         index.error.max, index.error.mean_at_vertices})
        if (std::isnan(error)) corrupt("section META: a measured error is NaN");
}

// Patches level by level from the numbers of children. `patch_room`: more patches than the section BORD, as
// it was decoded, has entries cannot be.
void read_hierarchy(const format::Container& container, uint64_t patch_room, Index& index) {
    const auto bytes = container.read_bytes(TAG_HIERARCHY, MAX_BYTES);
    format::ByteReader reader(bytes, "section HIER");
    const uint32_t level_count = reader.u32();
    if (level_count == 0 || level_count > GEOIDX_MAX_LEVELS)
        corrupt("section HIER: " + std::to_string(level_count) + " levels");
    const uint64_t inner_count = reader.count(UINT32_MAX - 1, sizeof(uint32_t));
    index.parent.assign(1, NONE);
    index.level_begin.assign({0, 1});
    for (uint32_t l = 0; l < level_count; ++l) {
        for (uint32_t p = index.level_begin[l]; p < index.level_begin[l + 1]; ++p) {
            const uint32_t children = reader.u32();
            if (children == 0 || children > patch_room || index.parent.size() + children > patch_room + 1)
                corrupt("section HIER: patch " + std::to_string(p) + " has " + std::to_string(children) +
                        " children");
            index.child_begin.push_back(static_cast<uint32_t>(index.parent.size()));
            index.parent.insert(index.parent.end(), children, p);
        }
        index.level_begin.push_back(static_cast<uint32_t>(index.parent.size()));
    }
    reader.expect_end();
    if (index.first_leaf() != inner_count)
        corrupt("section HIER: " + std::to_string(inner_count) + " inner patches are named, but there are " +
                std::to_string(index.first_leaf()));
    index.child_begin.resize(size_t{index.patch_count()} + 1, index.patch_count());
}

void read_vertices(const format::Container& container, Index& index) {
    const auto bytes =
        container.read_bytes(TAG_VERTICES, sizeof(uint64_t) + index.id_count * sizeof(uint32_t));
    format::ByteReader reader(bytes, "section VERT");
    const uint64_t vertex_count = reader.u64();
    if (reader.remaining() != index.id_count * sizeof(uint32_t))
        corrupt("section VERT does not hold " + std::to_string(index.id_count) + " numbers");
    if (vertex_count > index.id_count)
        corrupt("section VERT: " + std::to_string(vertex_count) + " distinct vertices of " +
                std::to_string(index.id_count));
    index.number_of_id.resize(index.id_count);
    reader.u32_array(index.number_of_id);
    for (uint32_t number : index.number_of_id)
        if (number != NONE && number >= vertex_count)
            corrupt("section VERT: vertex number " + std::to_string(number) + " of " +
                    std::to_string(vertex_count));
    index.positions.resize(vertex_count);
}

void read_positions(const format::Container& container, Index& index) {
    const uint64_t size = uint64_t{index.vertex_count()} * 3 * sizeof(float);
    const auto bytes = container.read_bytes(TAG_POSITIONS, size);
    format::ByteReader reader(bytes, "section POSI");
    for (auto& position : index.positions) {
        reader.f32_array(position);
        for (float coordinate : position)
            if (!std::isfinite(coordinate)) corrupt("section POSI: a position is not finite");
    }
    reader.expect_end();
}

// Reads `count` sizes of consecutive ranges and fills begin[0 .. count].
void read_ranges(format::ByteReader& reader, uint32_t count, uint64_t first, Array<uint32_t>& begin) {
    uint64_t end = first;
    begin.assign(1, static_cast<uint32_t>(end));
    for (uint32_t i = 0; i < count; ++i) {
        end += reader.u32();
        if (end >= NONE) corrupt("section BORD: counts add up to more than 2^32 - 2");
        begin.push_back(static_cast<uint32_t>(end));
    }
}

// A vertex has one place on a border: derive() keeps no second one.
void refuse_repeated(const Index& index) {
    std::vector<uint32_t> patch_seen(index.border_vertex_count(), NONE);
    for (uint32_t p = 0; p < index.patch_count(); ++p)
        for (uint32_t v : index.border_of(p)) {
            if (patch_seen[v] == p)
                corrupt("section BORD: vertex number " + std::to_string(v) +
                        " stands twice on the border of patch " + std::to_string(p));
            patch_seen[v] = p;
        }
}

void read_borders(std::span<const std::byte> bytes, Index& index) {
    format::ByteReader reader(bytes, "section BORD");
    read_ranges(reader, index.first_leaf(), 0, index.owned_begin);
    index.owned_begin.resize(size_t{index.patch_count()} + 1, index.owned_begin.back());
    read_ranges(reader, index.patch_count() - index.first_leaf(), index.owned_begin.back(),
                index.internal_begin);
    if (index.internal_begin.back() != index.vertex_count())
        corrupt("section BORD: borders and leaves hold " + std::to_string(index.internal_begin.back()) +
                " vertices of " + std::to_string(index.vertex_count()));
    read_ranges(reader, index.patch_count() - 1, 0, index.border_begin);
    index.border_begin.insert(index.border_begin.begin(), 0); // the root has no border
    if (reader.remaining() != uint64_t{index.border_begin.back()} * sizeof(uint32_t))
        corrupt("section BORD does not hold " + std::to_string(index.border_begin.back()) +
                " border vertices");
    index.border.resize(index.border_begin.back());
    reader.u32_array(index.border);
    for (uint32_t v : index.border)
        if (v >= index.border_vertex_count())
            corrupt("section BORD: vertex number " + std::to_string(v) + " is no border vertex");
    refuse_repeated(index);
}

// Where the matrices of one section go. The section's size is compared before anything is allocated.
class MatrixReader {
public:
    void add(uint32_t rows, uint32_t cols) {
        if (rows == 0 || cols == 0) return;
        shapes_.push_back({rows, cols});
        entries_ += uint64_t{rows} * cols;
    }
    void add_folded(uint32_t size) {
        const FoldedShape shape = folded_shape(size);
        add(shape.rows, shape.cols);
    }

    std::vector<float> read(const format::Container& container, uint32_t tag) const {
        if (container.section(tag).raw_size != entries_ * sizeof(float))
            corrupt("section " + format::tag_text(tag) + " does not hold " + std::to_string(entries_) +
                    " table entries");
        std::vector<float> values(entries_);
        std::vector<format::MatrixTarget> targets;
        size_t next = 0;
        for (const auto& [rows, cols] : shapes_) {
            const size_t size = size_t{rows} * cols;
            targets.push_back({std::span(values).subspan(next, size), rows, cols});
            next += size;
        }
        container.read_matrices(tag, targets);
        for (float value : values)
            if (!(value >= 0))
                corrupt("section " + format::tag_text(tag) + " holds a distance that is negative or NaN");
        return values;
    }

private:
    std::vector<FoldedShape> shapes_;
    uint64_t entries_ = 0;
};

MatrixReader crossing_reader(const Index& index) {
    MatrixReader reader;
    for (uint32_t leaf = index.first_leaf(); leaf < index.patch_count(); ++leaf)
        reader.add(index.border_size(leaf), index.internal_size(leaf));
    return reader;
}

MatrixReader internal_reader(const Index& index) {
    MatrixReader reader;
    for (uint32_t leaf = index.first_leaf(); leaf < index.patch_count(); ++leaf)
        reader.add_folded(index.internal_size(leaf));
    return reader;
}

// Calls visit(place in the internal tables, k) for the k-th entry that the file holds.
template <class Visit>
void for_each_internal_pair(const Index& index, const Visit& visit) {
    size_t next = 0;
    for (uint32_t leaf = index.first_leaf(); leaf < index.patch_count(); ++leaf)
        for_each_folded(index.internal_size(leaf),
                        [&](uint32_t i, uint32_t j) { visit(index.internal_place(leaf, i, j), next++); });
}

void read_graph_tables(const format::Container& container, Index& index) {
    MatrixReader border;
    for (uint32_t p = 1; p < index.patch_count(); ++p) border.add_folded(index.border_size(p));
    const auto border_values = border.read(container, TAG_BORDER_TABLES);
    const auto crossing_values = crossing_reader(index).read(container, TAG_CROSSING_TABLES);
    const auto internal_values = internal_reader(index).read(container, TAG_INTERNAL_TABLES);

    allocate_tables(index);
    size_t next = 0;
    for (uint32_t p = 1; p < index.patch_count(); ++p) {
        const uint32_t size = index.border_size(p);
        float* table = index.border_tables.data() + index.border_table_begin[p];
        for_each_folded(size, [&](uint32_t i, uint32_t j) {
            table[size_t{i} * size + j] = table[size_t{j} * size + i] = border_values[next++];
        });
    }
    index.crossing_tables.assign(crossing_values.begin(), crossing_values.end());
    for_each_internal_pair(
        index, [&](uint64_t place, size_t k) { index.internal_tables[place] = internal_values[k]; });
}

uint16_t code_of(float value) {
    if (value == std::numeric_limits<float>::infinity()) return OverlayTables::UNREACHED;
    const auto code = static_cast<uint16_t>(std::min(value, float{OverlayTables::LARGEST}));
    if (static_cast<float>(code) != value)
        corrupt("a table holds " + std::to_string(value) + ", which is no code of a distance");
    return code;
}

// A code for each pair of positions in the overlay of a patch; `values` as the file has them. Of two vertices
// on its border its parent's table knows, which has been placed.
std::vector<uint16_t> overlay_square(const Index& index, uint32_t patch, std::span<const float> values) {
    const uint32_t border = index.border_size(patch), owned = index.inner_size(patch);
    const size_t size = index.overlay_size(patch);
    std::vector<uint16_t> square(size * size, 0);
    const auto set = [&](size_t i, size_t j, uint16_t code) {
        square[i * size + j] = square[j * size + i] = code;
    };
    size_t next = 0;
    for (uint32_t i = 0; i < owned; ++i)
        for (uint32_t j = 0; j < border; ++j) set(size_t{border} + i, j, code_of(values[next++]));
    for_each_folded(owned, [&](uint32_t i, uint32_t j) {
        set(size_t{border} + i, size_t{border} + j, code_of(values[next++]));
    });
    return square;
}

void place_overlay_codes(std::span<const float> values, Index& index) {
    for (uint32_t p = 0; p < index.first_leaf(); ++p) {
        const size_t size = index.overlay_size(p), border = index.border_size(p);
        const size_t entries = index.overlay_entries(p);
        const auto square = overlay_square(index, p, values.first(entries));
        values = values.subspan(entries);
        for (uint32_t child = index.child_begin[p]; child < index.child_begin[p + 1]; ++child)
            fill_outer_table(index, child, [&](uint32_t i, uint32_t j) { return square[i * size + j]; });
        if (p == 0) continue;
        fill_inner_table(index, p, [&](uint32_t i, uint32_t j) { return square[(border + i) * size + j]; });
    }
}

// The file has a row for each border vertex of a leaf.
void place_crossing_codes(std::span<const float> values, Index& index) {
    std::vector<uint16_t> codes(values.size());
    std::ranges::transform(values, codes.begin(), code_of);
    for (uint32_t leaf = index.first_leaf(); leaf < index.patch_count(); ++leaf)
        fill_inner_table(index, leaf, [&](uint32_t i, uint32_t position) {
            return codes[index.crossing_place(leaf, position, i)];
        });
}

void read_overlay_tables(const format::Container& container, Index& index) {
    MatrixReader overlay;
    for (uint32_t p = 0; p < index.first_leaf(); ++p) {
        overlay.add(index.inner_size(p), index.border_size(p));
        overlay.add_folded(index.inner_size(p));
    }
    const auto overlay_values = overlay.read(container, TAG_OVERLAY_TABLES);
    const auto crossing_values = crossing_reader(index).read(container, TAG_CROSSING_TABLES);
    const auto internal_values = internal_reader(index).read(container, TAG_INTERNAL_TABLES);

    allocate_tables(index);
    allocate_overlay_tables(index);
    place_overlay_codes(overlay_values, index);
    place_crossing_codes(crossing_values, index);
    derive_tables(index);
    for_each_internal_pair(index, [&](uint64_t place, size_t k) {
        index.overlay_tables.internal_tables[place] = code_of(internal_values[k]);
    });
}

void read_quanta(const format::Container& container, Index& index) {
    const auto bytes = container.read_bytes(TAG_QUANTA, uint64_t{index.patch_count()} * sizeof(float));
    format::ByteReader reader(bytes, "section QUAN");
    index.overlay_tables.quantum.resize(index.patch_count());
    reader.f32_array(index.overlay_tables.quantum);
    reader.expect_end();
    for (float quantum : index.overlay_tables.quantum)
        if (!(quantum >= 0) || !std::isfinite(quantum))
            corrupt("section QUAN: the quantum " + std::to_string(quantum));
}

void read_segments(const format::Container& container, Index& index) {
    const size_t count = index.border.size();
    const auto bytes = container.read_bytes(TAG_SEGMENTS, count * (sizeof(uint32_t) + sizeof(float)));
    format::ByteReader reader(bytes, "section SEGM");
    BorderSegments segments(count);
    reader.u32_array(segments.next);
    reader.f32_array(segments.length);
    reader.expect_end();
    for (size_t slot = 0; slot < count; ++slot)
        if (segments.next[slot] != NONE &&
            (!(segments.length[slot] > 0) || !std::isfinite(segments.length[slot])))
            corrupt("section SEGM: a segment of length " + std::to_string(segments.length[slot]));
    lay_out_rings(segments, index);
}

void read_tables(const format::Container& container, Index& index) {
    const bool overlay = index.engine == GEOIDX_ENGINE_OVERLAY;
    for (uint32_t tag : {TAG_QUANTA, TAG_SEGMENTS, TAG_OVERLAY_TABLES, TAG_BORDER_TABLES})
        if (container.has(tag) != (overlay == (tag != TAG_BORDER_TABLES)))
            corrupt("section " + format::tag_text(tag) + " does not go with the engine");
    if (!overlay) return read_graph_tables(container, index);
    read_quanta(container, index);
    read_segments(container, index);
    read_overlay_tables(container, index);
}

void read_content(const format::Container& container, Index& index) {
    read_meta(container, index);
    const auto border_bytes = container.read_bytes(TAG_BORDERS, MAX_BYTES);
    read_hierarchy(container, border_bytes.size() / sizeof(uint32_t), index);
    read_vertices(container, index);
    read_positions(container, index);
    read_borders(border_bytes, index);
    derive(index);
    read_tables(container, index);
}

}

void read_index(std::span<const std::byte> file, Index& index) {
    read_content(format::Container::parse(file, INDEX_TAGS), index);
}

std::vector<format::Issue> inspect_index(std::span<const std::byte> file) {
    auto issues = format::inspect(file, INDEX_TAGS);
    if (!issues.empty()) return issues;
    try {
        Index index(std::pmr::get_default_resource());
        read_index(file, index);
    } catch (const Error& error) {
        issues.push_back({error.status, 0, error.what()});
    }
    return issues;
}

}
