// A second reader of index files, written from format/SPEC.md alone, against the library's answers. No code
// of format/ or src/ is used here: where the two differ, SPEC.md or the library is wrong.

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <map>
#include <queue>
#include <set>

#include <png.h>
#include <xxhash.h>
#include <zstd.h>

#include "tests/capi/calls.h"

using namespace geodesic::test;

namespace {

constexpr double UNREACHED = std::numeric_limits<double>::infinity();
constexpr uint32_t UNUSED = 0xFFFFFFFF;

// ---- Conventions, header, section table, codecs

class Numbers {
public:
    explicit Numbers(Bytes bytes) : bytes_(std::move(bytes)) {}

    uint64_t unsigned_integer(size_t size) {
        REQUIRE(next_ + size <= bytes_.size());
        uint64_t value = 0;
        for (size_t i = 0; i < size; ++i)
            value |= static_cast<uint64_t>(std::to_integer<uint8_t>(bytes_[next_ + i])) << (8 * i);
        next_ += size;
        return value;
    }
    uint32_t u32() { return static_cast<uint32_t>(unsigned_integer(4)); }
    uint64_t u64() { return unsigned_integer(8); }
    float f32() {
        const uint32_t bits = u32();
        float value;
        std::memcpy(&value, &bits, sizeof value);
        return value;
    }
    double f64() {
        const uint64_t bits = u64();
        double value;
        std::memcpy(&value, &bits, sizeof value);
        return value;
    }
    std::vector<uint32_t> u32s(size_t count) {
        std::vector<uint32_t> values(count);
        for (uint32_t& value : values) value = u32();
        return values;
    }
    std::vector<uint32_t> u32_planes(size_t count) {
        const Bytes planes = bytes(4 * count);
        std::vector<uint32_t> values(count);
        for (size_t i = 0; i < planes.size(); ++i)
            values[i % count] |= std::to_integer<uint32_t>(planes[i]) << (8 * (i / count));
        return values;
    }
    Bytes bytes(size_t count) {
        REQUIRE(next_ + count <= bytes_.size());
        const auto begin = bytes_.begin() + static_cast<std::ptrdiff_t>(next_);
        next_ += count;
        return {begin, begin + static_cast<std::ptrdiff_t>(count)};
    }
    size_t remaining() const { return bytes_.size() - next_; }

private:
    Bytes bytes_;
    size_t next_ = 0;
};

uint64_t checksum(const Bytes& bytes) { return XXH3_64bits(bytes.data(), bytes.size()); }

struct SectionRecord {
    uint32_t codec;
    uint64_t raw_size;
    Bytes stored;
};

class IndexFile {
public:
    explicit IndexFile(const Bytes& file) {
        Numbers header(file);
        const Bytes magic = header.bytes(8);
        REQUIRE(std::memcmp(magic.data(), "\x89GIDX\r\n\x1A", 8) == 0);
        CHECK(header.unsigned_integer(2) == 2);
        header.unsigned_integer(2);
        CHECK(header.u32() == 0);
        header.u32();
        const uint32_t section_count = header.u32();
        CHECK(header.u64() == file.size());
        fingerprint = header.u64();
        const uint64_t header_checksum = header.u64();
        Bytes covered(file.begin(), file.begin() + 48 + 48 * std::ptrdiff_t{section_count});
        std::fill(covered.begin() + 40, covered.begin() + 48, std::byte{0});
        CHECK(checksum(covered) == header_checksum);
        uint64_t end = covered.size();
        for (uint32_t i = 0; i < section_count; ++i) end = read_record(file, header, end);
        CHECK(end == file.size());
    }

    Numbers bytes(const std::string& tag) const {
        const SectionRecord& section = sections_.at(tag);
        REQUIRE(section.codec == 1);
        Bytes raw(section.raw_size);
        REQUIRE(ZSTD_getFrameContentSize(section.stored.data(), section.stored.size()) == raw.size());
        REQUIRE(ZSTD_decompress(raw.data(), raw.size(), section.stored.data(), section.stored.size()) ==
                raw.size());
        return Numbers(std::move(raw));
    }

    // The matrices' entries, each with its own shape checked.
    std::vector<std::vector<float>> matrices(const std::string& tag,
                                             const std::vector<std::pair<uint32_t, uint32_t>>& shapes) const {
        const SectionRecord& section = sections_.at(tag);
        REQUIRE(section.codec == 2);
        Numbers stored(section.stored);
        REQUIRE(stored.u32() == shapes.size());
        std::vector<uint64_t> lengths;
        for (size_t i = 0; i < shapes.size(); ++i) lengths.push_back(stored.u64());
        std::vector<std::vector<float>> result;
        uint64_t raw_size = 0;
        for (size_t i = 0; i < shapes.size(); ++i) {
            result.push_back(decode(stored.bytes(lengths[i]), shapes[i].first, shapes[i].second));
            raw_size += 4 * result.back().size();
        }
        CHECK(stored.remaining() == 0);
        CHECK(raw_size == section.raw_size);
        return result;
    }

    uint64_t fingerprint = 0;

private:
    uint64_t read_record(const Bytes& file, Numbers& header, uint64_t previous_end) {
        const Bytes tag = header.bytes(4);
        SectionRecord section;
        section.codec = header.u32();
        CHECK(header.u32() == 0);
        CHECK(header.u32() == 0);
        const uint64_t offset = header.u64(), stored_size = header.u64();
        section.raw_size = header.u64();
        const uint64_t stored_checksum = header.u64();
        CHECK(offset == (previous_end + 63) / 64 * 64);
        REQUIRE(offset + stored_size <= file.size());
        for (uint64_t i = previous_end; i < offset; ++i) CHECK(file[i] == std::byte{0});
        const auto begin = file.begin() + static_cast<std::ptrdiff_t>(offset);
        section.stored.assign(begin, begin + static_cast<std::ptrdiff_t>(stored_size));
        CHECK(checksum(section.stored) == stored_checksum);
        sections_[std::string(reinterpret_cast<const char*>(tag.data()), 4)] = std::move(section);
        return offset + stored_size;
    }

    static std::vector<float> decode(const Bytes& stream, uint32_t rows, uint32_t cols) {
        png_image image{};
        image.version = PNG_IMAGE_VERSION;
        REQUIRE(png_image_begin_read_from_memory(&image, stream.data(), stream.size()) != 0);
        REQUIRE(image.height == rows);
        REQUIRE(image.width == cols);
        REQUIRE(image.format == PNG_FORMAT_RGBA);
        std::vector<uint8_t> pixels(PNG_IMAGE_SIZE(image));
        REQUIRE(png_image_finish_read(&image, nullptr, pixels.data(), 0, nullptr) != 0);
        std::vector<float> values;
        for (size_t i = 0; i < pixels.size(); i += 4) {
            const uint32_t bits = uint32_t{pixels[i]} << 24 | uint32_t{pixels[i + 1]} << 16 |
                                  uint32_t{pixels[i + 2]} << 8 | pixels[i + 3];
            float value;
            std::memcpy(&value, &bits, sizeof value);
            values.push_back(value);
        }
        return values;
    }

    std::map<std::string, SectionRecord> sections_;
};

// ---- Sections of an index

struct Arc {
    uint32_t to;
    float length;
};

struct Table {
    std::vector<uint32_t> rows, cols; // vertex numbers
    std::vector<float> entries;       // rows x cols
};

struct IndependentIndex {
    uint64_t id_count, triangle_count, seed, fingerprint;
    uint32_t metric;
    float bound_scale;
    uint64_t metric_fingerprint;
    uint32_t metric_flags;
    double delta, diagonal;
    std::vector<uint32_t> parent, first_child, child_count, level_begin;
    uint32_t inner_count, patch_count, border_vertex_count;
    std::vector<uint32_t> number_of_id;
    double position_step;
    std::array<double, 3> position_origin;
    std::vector<int32_t> positions;
    std::vector<std::vector<uint32_t>> owned, internal, border; // per patch
    std::vector<Table> border_table, border_internal_table, internal_table;

    explicit IndependentIndex(const Bytes& bytes) {
        const IndexFile file(bytes);
        fingerprint = file.fingerprint;
        read_meta(file.bytes("META"));
        read_hierarchy(file.bytes("HIER"));
        Numbers vertices = file.bytes("VERT");
        const uint64_t vertex_count = vertices.u64();
        number_of_id = vertices.u32_planes(id_count);
        CHECK(vertices.remaining() == 0);
        Numbers coordinates = file.bytes("POSI");
        position_step = double{coordinates.f32()};
        for (double& coordinate : position_origin) coordinate = coordinates.f64();
        const uint64_t checksum = coordinates.u64();
        for (const uint32_t stored : coordinates.u32_planes(3 * vertex_count)) {
            const int32_t half = static_cast<int32_t>(stored / 2), difference = stored % 2 ? -half - 1 : half;
            positions.push_back(difference + (positions.size() < 3 ? 0 : positions[positions.size() - 3]));
        }
        CHECK(coordinates.remaining() == 0);
        CHECK(checksum == XXH3_64bits(positions.data(), 4 * positions.size()));
        read_borders(file.bytes("BORD"), vertex_count);
        border_table = folded_tables(file, "BVBV", border);
        internal_table = folded_tables(file, "IVIV", internal);
        read_border_internal_tables(file);
    }

    void read_meta(Numbers meta) {
        id_count = meta.u64();
        triangle_count = meta.u64();
        seed = meta.u64();
        metric = meta.u32();
        bound_scale = meta.f32();
        delta = meta.f64();
        diagonal = meta.f64();
        meta.u32();
        for (int i = 0; i < 5; ++i) CHECK(!std::isnan(meta.f64()));
        metric_fingerprint = meta.u64();
        metric_flags = meta.u32();
        CHECK(meta.u32() == GEOIDX_ENGINE_GRAPH);
        CHECK(!std::isnan(meta.f64()));
        CHECK(meta.u32() == 1); // lossless
        for (int i = 0; i < 8; ++i) CHECK(!std::isnan(meta.f64()));
        CHECK(meta.remaining() == 0);
    }

    void read_hierarchy(Numbers hierarchy) {
        const uint32_t levels = hierarchy.u32();
        inner_count = static_cast<uint32_t>(hierarchy.u64());
        child_count = hierarchy.u32s(inner_count);
        CHECK(hierarchy.remaining() == 0);
        patch_count = 1;
        parent = {UNUSED};
        level_begin = {0, 1};
        for (uint32_t level = 0; level < levels; ++level) {
            for (uint32_t p = level_begin[level]; p < level_begin[level + 1]; ++p) {
                first_child.push_back(patch_count);
                parent.insert(parent.end(), child_count[p], p);
                patch_count += child_count[p];
            }
            level_begin.push_back(patch_count);
        }
        CHECK(level_begin[levels] == inner_count);
    }

    void read_borders(Numbers numbers, uint64_t vertex_count) {
        const auto owned_count = numbers.u32s(inner_count);
        const auto internal_count = numbers.u32s(patch_count - inner_count);
        const auto border_size = numbers.u32s(patch_count - 1);
        owned.resize(patch_count);
        internal.resize(patch_count);
        border.resize(patch_count);
        uint32_t next = 0;
        for (uint32_t p = 0; p < inner_count; ++p)
            for (uint32_t i = 0; i < owned_count[p]; ++i) owned[p].push_back(next++);
        border_vertex_count = next;
        for (uint32_t p = inner_count; p < patch_count; ++p)
            for (uint32_t i = 0; i < internal_count[p - inner_count]; ++i) internal[p].push_back(next++);
        CHECK(next == vertex_count);
        const auto all = numbers.u32_planes(numbers.remaining() / 4);
        auto first = all.begin();
        for (uint32_t p = 1; p < patch_count; ++p) {
            REQUIRE(border_size[p - 1] <= all.end() - first);
            border[p].assign(first, first + border_size[p - 1]);
            first += border_size[p - 1];
        }
        CHECK(first == all.end());
        CHECK(numbers.remaining() == 0);
    }

    std::vector<Table> folded_tables(const IndexFile& file, const std::string& tag,
                                     const std::vector<std::vector<uint32_t>>& vertices) const {
        std::vector<std::pair<uint32_t, uint32_t>> shapes;
        for (const auto& list : vertices) {
            const auto n = static_cast<uint32_t>(list.size());
            if (n > 1) shapes.push_back(n % 2 == 0 ? std::pair{n / 2, n - 1} : std::pair{(n - 1) / 2, n});
        }
        const auto matrices = file.matrices(tag, shapes);
        std::vector<Table> tables;
        size_t used = 0;
        for (const auto& list : vertices) {
            Table table{list, list, std::vector<float>(list.size() * list.size(), 0)};
            if (list.size() > 1) unfold(matrices[used++], list.size(), table.entries);
            tables.push_back(std::move(table));
        }
        return tables;
    }

    static void unfold(const std::vector<float>& matrix, size_t n, std::vector<float>& entries) {
        auto next = matrix.begin();
        const auto take_row = [&](size_t row) {
            for (size_t column = 0; column < row; ++column)
                entries[row * n + column] = entries[column * n + row] = *next++;
        };
        for (size_t line = 0; line < n / 2; ++line) {
            take_row(n - 1 - line);
            take_row(n % 2 == 0 ? line : line + 1);
        }
        CHECK(next == matrix.end());
    }

    void read_border_internal_tables(const IndexFile& file) {
        std::vector<std::pair<uint32_t, uint32_t>> shapes;
        border_internal_table.resize(patch_count);
        for (uint32_t p = inner_count; p < patch_count; ++p)
            if (!border[p].empty() && !internal[p].empty())
                shapes.push_back(
                    {static_cast<uint32_t>(border[p].size()), static_cast<uint32_t>(internal[p].size())});
        const auto matrices = file.matrices("BVIV", shapes);
        size_t used = 0;
        for (uint32_t p = inner_count; p < patch_count; ++p)
            if (!border[p].empty() && !internal[p].empty())
                border_internal_table[p] = {border[p], internal[p], matrices[used++]};
    }

    // ---- Distances from the tables

    std::vector<const Table*> all_tables() const {
        std::vector<const Table*> tables;
        for (uint32_t p = 1; p < patch_count; ++p)
            tables.insert(tables.end(), {&border_table[p], &border_internal_table[p], &internal_table[p]});
        return tables;
    }

    uint32_t leaf_of(uint32_t number) const {
        for (uint32_t p = inner_count; p < patch_count; ++p)
            if (std::count(internal[p].begin(), internal[p].end(), number)) return p;
        FAIL("not an internal vertex");
        return UNUSED;
    }

    uint32_t entry_patch(uint32_t number) const {
        if (number >= border_vertex_count) return parent[leaf_of(number)];
        for (uint32_t p = 0; p < inner_count; ++p)
            if (std::count(owned[p].begin(), owned[p].end(), number)) return p;
        FAIL("not a border vertex");
        return UNUSED;
    }

    // The tables that SSSD may use for two vertices that no table has in common.
    std::vector<const Table*> allowed_tables(uint32_t a, uint32_t b) const {
        std::vector<uint32_t> way_a, way_b;
        for (uint32_t p = entry_patch(a); p != UNUSED; p = parent[p]) way_a.push_back(p);
        for (uint32_t p = entry_patch(b); p != UNUSED; p = parent[p]) way_b.push_back(p);
        const uint32_t common = *std::find_first_of(way_a.begin(), way_a.end(), way_b.begin(), way_b.end());
        std::set<uint32_t> allowed;
        for (const auto* way : {&way_a, &way_b})
            for (uint32_t p : *way) {
                allowed.insert(p);
                if (p == common) break;
            }
        std::vector<const Table*> tables;
        for (uint32_t p : allowed)
            for (uint32_t i = 0; i < child_count[p]; ++i) tables.push_back(&border_table[first_child[p] + i]);
        if (common != 0) tables.push_back(&border_table[common]);
        for (uint32_t v : {a, b})
            if (v >= border_vertex_count) tables.push_back(&border_internal_table[leaf_of(v)]);
        return tables;
    }

    std::vector<double> shortest(uint32_t source, const std::vector<const Table*>& tables) const {
        std::vector<std::vector<Arc>> arcs(positions.size() / 3);
        for (const Table* table : tables)
            for (size_t i = 0; i < table->rows.size(); ++i)
                for (size_t j = 0; j < table->cols.size(); ++j) {
                    const float length = table->entries[i * table->cols.size() + j];
                    arcs[table->rows[i]].push_back({table->cols[j], length});
                    arcs[table->cols[j]].push_back({table->rows[i], length});
                }
        std::vector<double> distance(arcs.size(), UNREACHED);
        std::priority_queue<std::pair<double, uint32_t>> queue; // of negative distances
        distance[source] = 0;
        queue.push({0, source});
        while (!queue.empty()) {
            const auto [negative, v] = queue.top();
            queue.pop();
            if (-negative > distance[v]) continue;
            for (const Arc& arc : arcs[v])
                if (const double d = distance[v] + double{arc.length}; d < distance[arc.to]) {
                    distance[arc.to] = d;
                    queue.push({-d, arc.to});
                }
        }
        return distance;
    }

    // The entry that a table has for two vertices, -1 if none has both.
    float entry(uint32_t a, uint32_t b) const {
        for (const Table* table : all_tables())
            for (const auto& [row, col] : {std::pair{a, b}, std::pair{b, a}}) {
                const auto i = std::find(table->rows.begin(), table->rows.end(), row);
                const auto j = std::find(table->cols.begin(), table->cols.end(), col);
                if (i != table->rows.end() && j != table->cols.end())
                    return table->entries[static_cast<size_t>(i - table->rows.begin()) * table->cols.size() +
                                          static_cast<size_t>(j - table->cols.begin())];
            }
        return -1;
    }

    double straight(uint32_t a, uint32_t b) const {
        double square = 0;
        for (size_t k = 0; k < 3; ++k) {
            const double difference = position_step * (positions[3 * a + k] - positions[3 * b + k]);
            square += difference * difference;
        }
        return std::sqrt(square);
    }
};

struct Written {
    std::string name;
    TestMesh mesh;
    geoidx_build_options options;
};

std::vector<Written> files() {
    auto pruned = build_options(GEOIDX_METRIC_EXACT, 2, 3);
    pruned.seed = 0x123456789ABCDEF0;
    auto one_patch = build_options(GEOIDX_METRIC_EXACT, 1);
    one_patch.patches[0] = 1;
    return {
        {"exact, two levels", hills(13, 12), build_options(GEOIDX_METRIC_EXACT, 2)},
        {"pruned, closed", torus(16, 9), pruned},
        {"edges, three levels, components", components_and_unused(), build_options(GEOIDX_METRIC_EDGES, 3)},
        {"one patch", grid(6, 5), one_patch},
        {"seam", seam(13, 11), build_options(GEOIDX_METRIC_EXACT, 1)}};
}

bool close(double a, double b) { return a == b || std::abs(a - b) <= 1e-6 * std::abs(b); }

}

TEST_CASE("independent reader: what the file says of mesh and options") {
    for (const Written& written : files()) {
        CAPTURE(written.name);
        const auto handle = shared_index(written.mesh, written.options);
        const IndependentIndex index(save(handle.get()));
        CHECK(index.id_count == written.mesh.vertex_count());
        CHECK(index.triangle_count == written.mesh.triangle_count());
        CHECK(index.seed == written.options.seed);
        CHECK(index.metric == written.options.metric);
        CHECK(index.delta == written.options.delta);
        CHECK(index.level_begin.size() == written.options.level_count + 2);
        std::vector<float> rounded;
        for (const double coordinate : written.mesh.positions)
            rounded.push_back(coordinate == 0 ? 0.0f : static_cast<float>(coordinate));
        const uint64_t first = XXH3_64bits(rounded.data(), 4 * rounded.size());
        CHECK(index.fingerprint ==
              XXH3_64bits_withSeed(written.mesh.triangles.data(), 4 * written.mesh.triangles.size(), first));
        const geoidx_info info = info_of(handle.get());
        CHECK(index.border_vertex_count == info.border_vertex_count);
        for (uint32_t l = 1; l <= written.options.level_count; ++l)
            CHECK(index.level_begin[l + 1] - index.level_begin[l] == info.patch_count[l - 1]);
        CHECK(index.position_step > 0);
        for (size_t k = 0; k < 3; ++k) {
            double least = UNREACHED;
            for (const uint32_t id : written.mesh.triangles)
                least = std::min(least, written.mesh.positions[3 * id + k]);
            CHECK(index.position_origin[k] == least);
        }
        std::set<uint32_t> used(written.mesh.triangles.begin(), written.mesh.triangles.end());
        for (uint32_t id = 0; id < index.id_count; ++id) {
            const uint32_t number = index.number_of_id[id];
            CHECK((number == UNUSED) == !used.contains(id));
            if (number == UNUSED) continue;
            for (size_t k = 0; k < 3; ++k)
                CHECK(std::abs(index.position_step * index.positions[3 * number + k] +
                               index.position_origin[k] - written.mesh.positions[3 * id + k]) <=
                      0.501 * index.position_step);
        }
    }
}

TEST_CASE("independent reader: borders, overlays and bounds are as SPEC.md has them") {
    for (const Written& written : files()) {
        CAPTURE(written.name);
        const IndependentIndex index(save(build(written.mesh, written.options).get()));
        for (uint32_t p = 1; p < index.patch_count; ++p) {
            const uint32_t parent = index.parent[p];
            std::set<uint32_t> overlay(index.border[parent].begin(), index.border[parent].end());
            overlay.insert(index.owned[parent].begin(), index.owned[parent].end());
            const std::set<uint32_t> border(index.border[p].begin(), index.border[p].end());
            CHECK(border.size() == index.border[p].size());
            CHECK(std::ranges::includes(overlay, border));
        }
        uint64_t undercut = 0;
        for (const auto* tables : {&index.border_table, &index.border_internal_table})
            for (const Table& table : *tables)
                for (size_t i = 0; i < table.rows.size(); ++i)
                    for (size_t j = 0; j < table.cols.size(); ++j)
                        undercut += double{table.entries[i * table.cols.size() + j]} <
                                    double{index.bound_scale} * index.straight(table.rows[i], table.cols[j]) *
                                        (1 - 1e-6);
        CHECK(undercut == 0);
        CHECK(index.metric_flags == (index.metric == 0 ? 1 : 0));
        CHECK(index.metric_fingerprint == 0);
        CHECK(index.bound_scale > 0.99); // no metric here is shorter than the straight line
    }
}

TEST_CASE("independent reader: SSSD and MSAD agree with the library") {
    for (const Written& written : files()) {
        CAPTURE(written.name);
        const auto handle = shared_index(written.mesh, written.options);
        const IndependentIndex index(save(handle.get()));
        const auto count = static_cast<uint32_t>(index.id_count);
        uint64_t of_tables = 0, searched = 0, wrong = 0;
        for (uint32_t a = 1; a < count; a += count / 5) {
            const uint32_t from = index.number_of_id[a];
            const auto answers = msad(handle.get(), a, count);
            std::vector<double> least;
            if (from != UNUSED) least = index.shortest(from, index.all_tables());
            for (uint32_t b = 0; b < count; b += 3) {
                const uint32_t to = index.number_of_id[b];
                const float answer = sssd(handle.get(), a, b);
                if (from == UNUSED || to == UNUSED) {
                    wrong +=
                        double{answer} != (a == b ? 0 : UNREACHED) || double{answers[b]} != double{answer};
                    continue;
                }
                // MSAD uses some tables only, of the edge metric without loss.
                wrong += double{answers[b]} < least[to] * (1 - 1e-6);
                if (written.options.metric == GEOIDX_METRIC_EDGES)
                    wrong += !close(double{answers[b]}, least[to]);
                if (from == to) {
                    wrong += answer != 0;
                } else if (const float entry = index.entry(from, to); entry >= 0 && entry < INFINITY) {
                    wrong += answer != entry; // bit for bit
                    ++of_tables;
                } else if (searched < 40) {
                    const double expected = index.shortest(from, index.allowed_tables(from, to))[to];
                    wrong += !close(double{answer}, expected);
                    searched += expected < UNREACHED;
                }
            }
        }
        CHECK(wrong == 0);
        CHECK(of_tables > 5);
        CHECK((searched > 0 || index.inner_count + 1 == index.patch_count));
    }
}
