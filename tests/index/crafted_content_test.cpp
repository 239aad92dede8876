// Index files with right checksums and wrong content, one field at a time.

#include <cmath>
#include <numeric>
#include <random>
#include <set>
#include <tuple>

#include "tests/capi/counting_allocator.h"
#include "tests/capi/refusals.h"
#include "tests/format/helpers.h"
#include "tests/index/taken_apart.h"
#include "tests/index/told_issues.h"

using namespace geodesic;
using namespace geodesic::test;

namespace {

constexpr uint32_t UNREACHABLE_NUMBER = UINT32_MAX;

struct Original {
    Bytes file;
    TakenApart parts;
    uint64_t fingerprint;

    Original() {
        auto options = build_options(GEOIDX_METRIC_EDGES, 2);
        options.patches[0] = options.patches[1] = 3;
        const auto index = shared_index(hills(9, 8), options);
        file = save(index.get());
        fingerprint = info_of(index.get()).mesh_fingerprint;
        parts = take_apart(file);
        take_tables_apart(file, parts);
    }
};

const Original& original() {
    static const Original the_original;
    return the_original;
}

Bytes with(const std::function<void(TakenApart&)>& change) {
    TakenApart parts = original().parts;
    change(parts);
    return put_together(parts, original().parts, original().fingerprint);
}

// Opens with an allocator that notes the largest request; verify must agree with open.
geoidx_status status_of_file(const Bytes& file) {
    CountingAllocator allocator;
    geoidx_open_options options;
    geoidx_open_options_init(&options);
    options.allocator = allocator.get();
    geoidx* index = nullptr;
    const geoidx_status status = geoidx_open_memory(file.data(), file.size(), &options, &index);
    CHECK((status == GEOIDX_OK) == (index != nullptr));
    geoidx_close(index);
    CHECK(allocator.blocks() == 0);
    CHECK(allocator.largest() < 1 << 20);
    CHECK(geoidx_verify(file.data(), file.size(), nullptr, nullptr) == status);
    return status;
}

void check_corrupt(const std::string& what, const std::function<void(TakenApart&)>& change) {
    CAPTURE(what);
    CHECK(status_of_file(with(change)) == GEOIDX_ERROR_CORRUPT);
    CHECK(std::string(geoidx_last_error()).size() > 0);
}

}

TEST_CASE("a file of a later minor version opens, says so, and is saved as one of this version") {
    const Bytes later = format::test::patched(original().file, format::test::MINOR, 7, 2);
    const auto index = open(later);
    CHECK(info_of(index.get()).format_minor == 7);
    const Bytes saved = save(index.get());
    CHECK(saved == original().file);
    CHECK(info_of(open(saved).get()).format_minor == info_of(open(original().file).get()).format_minor);
    CHECK(info_of(open(saved).get()).format_minor < 7);
}

TEST_CASE("the parts put together unchanged are the original file") {
    CHECK(with([](TakenApart&) {}) == original().file);
    REQUIRE(original().parts.leaf_count() >= 4);
    REQUIRE(original().parts.inner_count >= 3);
}

TEST_CASE("crafted META") {
    const auto set = [](auto field, auto value) {
        return [field, value](TakenApart& parts) { parts.meta.*field = value; };
    };
    using Meta = TakenApart::Meta;
    for (uint64_t count :
         {uint64_t{0}, uint64_t{71}, uint64_t{73}, uint64_t{UINT32_MAX}, uint64_t{1} << 62, UINT64_MAX})
        check_corrupt("id count", set(&Meta::id_count, count));
    for (float scale : {-1e-6f, 1.0001f, 1e30f, INFINITE, NOT_A_NUMBER, -INFINITE})
        check_corrupt("bound scale", set(&Meta::bound_scale, scale));
    for (double delta : {-1.0, 100.1, double{INFINITE}, double{NOT_A_NUMBER}})
        check_corrupt("delta", set(&Meta::delta, delta));
    for (double diagonal : {-1.0, double{INFINITE}, double{NOT_A_NUMBER}})
        check_corrupt("diagonal", set(&Meta::diagonal, diagonal));
    for (size_t i = 0; i < 5; ++i)
        check_corrupt("error", [i](TakenApart& parts) { parts.meta.errors[i] = double{NOT_A_NUMBER}; });
    check_corrupt("error", [](TakenApart& parts) { parts.meta.error_at_vertices = double{NOT_A_NUMBER}; });
    for (size_t i = 0; i < 8; ++i)
        check_corrupt("error",
                      [i](TakenApart& parts) { parts.meta.errors_by_kind[i] = double{NOT_A_NUMBER}; });
    for (uint32_t engine : {1u, 2u, UINT32_MAX}) check_corrupt("engine", set(&Meta::engine, engine));
    check_corrupt("bytes too many",
                  [](TakenApart& parts) { parts.extra_bytes[TAG_META] = Bytes(1, std::byte{0}); });
}

TEST_CASE("crafted HIER") {
    for (uint32_t levels : {0u, 1u, 3u, 8u, 9u, 1u << 31, UINT32_MAX})
        check_corrupt("level count", [&](TakenApart& parts) { parts.level_count = levels; });
    const uint64_t inner = original().parts.inner_count;
    for (uint64_t count :
         {uint64_t{0}, inner - 1, inner + 1, uint64_t{UINT32_MAX}, uint64_t{1} << 61, UINT64_MAX})
        check_corrupt("inner count", [&](TakenApart& parts) { parts.inner_count = count; });
    for (size_t patch = 0; patch < inner; ++patch)
        for (uint32_t change : {0u, 1u, 1000u, 1u << 30, UINT32_MAX})
            check_corrupt("child count", [&](TakenApart& parts) {
                parts.children[patch] = change == 1 ? parts.children[patch] + 1 : change;
            });
    check_corrupt("a patch too few", [](TakenApart& parts) { parts.children.pop_back(); });
    check_corrupt("a patch too many", [](TakenApart& parts) { parts.children.push_back(1); });
    check_corrupt("children moved to another parent", [](TakenApart& parts) {
        ++parts.children[1];
        --parts.children[2];
    });
    check_corrupt("bytes too many",
                  [](TakenApart& parts) { parts.extra_bytes[TAG_HIERARCHY] = Bytes(3, std::byte{0}); });
}

TEST_CASE("crafted VERT and POSI") {
    const auto vertices = static_cast<uint32_t>(original().parts.vertex_count);
    for (uint64_t count :
         {uint64_t{0}, uint64_t{vertices} - 1, uint64_t{vertices} + 1, uint64_t{UINT32_MAX} - 1,
          uint64_t{UINT32_MAX}, uint64_t{1} << 32, uint64_t{1} << 62, UINT64_MAX})
        check_corrupt("vertex count", [&](TakenApart& parts) { parts.vertex_count = count; });
    for (uint32_t number : {vertices, vertices + 1, UINT32_MAX - 1})
        for (size_t id : {size_t{0}, original().parts.number_of_id.size() - 1})
            check_corrupt("vertex number", [&](TakenApart& parts) { parts.number_of_id[id] = number; });
    check_corrupt("an id too few", [](TakenApart& parts) { parts.number_of_id.pop_back(); });
    check_corrupt("an id too many", [](TakenApart& parts) { parts.number_of_id.push_back(0); });
    for (float step : {INFINITE, -INFINITE, NOT_A_NUMBER, -1.f, 0.f})
        check_corrupt("position step", [&](TakenApart& parts) { parts.position_step = step; });
    for (double coordinate : {double{INFINITE}, double{-INFINITE}, double{NOT_A_NUMBER}})
        for (size_t k : {size_t{0}, size_t{2}})
            check_corrupt("origin", [&](TakenApart& parts) { parts.position_origin[k] = coordinate; });
    check_corrupt("checksum", [](TakenApart& parts) { ++parts.position_checksum; });
    check_corrupt("another position", [](TakenApart& parts) { parts.coordinates.back() ^= 2; });
    check_corrupt("a coordinate below 0", [](TakenApart& parts) { parts.coordinates[0] = 1; });
    // 2^24 and -2^24, 2^31 - 1 and -2^31 steps from the coordinate before.
    for (uint32_t difference : {1u << 25, (1u << 25) - 1, UINT32_MAX - 1, UINT32_MAX})
        for (size_t i : {size_t{0}, original().parts.coordinates.size() - 1})
            check_corrupt("position", [&](TakenApart& parts) { parts.coordinates[i] = difference; });
    check_corrupt("a coordinate too few", [](TakenApart& parts) { parts.coordinates.pop_back(); });
    check_corrupt("a coordinate too many", [](TakenApart& parts) { parts.coordinates.push_back(0); });
}

TEST_CASE("an index of a metric that is not known answers pairs, but has no paths") {
    const auto index = open(with([](TakenApart&parts) { parts.meta.metric = 4; })),
               known = open(original().file);
    CHECK(sssd(index.get(), 5, 60) == sssd(known.get(), 5, 60));
    const TestMesh mesh = hills(9, 8);
    const geoidx_mesh view = mesh.view();
    geoidx_surface* made = nullptr;
    require_success(geoidx_surface_create(&view, nullptr, &made));
    const SurfaceHandle surface(made);
    const QueryHandle query = query_of(index.get());
    geoidx_surface_point from, to;
    require_success(geoidx_vertex_point(surface.get(), 5, &from));
    require_success(geoidx_vertex_point(surface.get(), 60, &to));
    double length = 0;
    check_refused(geoidx_query_path(query.get(), surface.get(), &from, &to, GEOIDX_PATH_STRAIGHT, &length),
                  GEOIDX_ERROR_INVALID_ARGUMENT, "metric 4");
}

TEST_CASE("an id may be made unreachable, and then is") {
    const auto index = open(with([](TakenApart& parts) { parts.number_of_id[5] = UNREACHABLE_NUMBER; }));
    CHECK(sssd(index.get(), 5, 6) == INFINITE);
    CHECK(msad(index.get(), 0, 72)[5] == INFINITE);
}

TEST_CASE("numbers that no id has are added vertices, and all others are answered as before") {
    const auto whole = open(original().file);
    const auto all = static_cast<uint32_t>(original().parts.vertex_count);
    for (const uint32_t ids : {72u, 40u, 1u}) {
        const auto fewer = open(with([&](TakenApart& parts) {
            parts.number_of_id.resize(ids);
            parts.meta.id_count = ids;
        }));
        const geoidx_info info = info_of(fewer.get());
        const std::set<uint32_t> named(original().parts.number_of_id.begin(),
                                       original().parts.number_of_id.begin() + ids);
        CHECK(info.vertex_count == ids);
        CHECK(info.welded_vertex_count == named.size());
        CHECK(info.added_vertex_count == all - named.size());
        const auto expected = msad(whole.get(), 0, 72), answered = msad(fewer.get(), 0, ids);
        CHECK(answered == std::vector(expected.begin(), expected.begin() + ids));
        for (uint32_t v = 0; v < ids; ++v) CHECK(sssd(fewer.get(), 0, v) == sssd(whole.get(), 0, v));
    }
}

TEST_CASE("crafted BORD") {
    const TakenApart& good = original().parts;
    using Sizes = std::vector<uint32_t> TakenApart::*;
    for (Sizes sizes : {&TakenApart::owned, &TakenApart::internal, &TakenApart::border_sizes})
        for (size_t i = 0; i < (good.*sizes).size(); ++i)
            for (uint32_t change : {1u, UINT32_MAX, 1u << 31, 1000000u})
                check_corrupt("a count", [&](TakenApart& parts) { (parts.*sizes)[i] += change; });
    uint32_t border_count = 0;
    for (uint32_t count : good.owned) border_count += count;
    for (uint32_t number : {border_count, border_count + 1, UINT32_MAX})
        for (size_t i : {size_t{0}, good.border.size() - 1})
            check_corrupt("border vertex", [&](TakenApart& parts) { parts.border[i] = number; });
    check_corrupt("a border vertex too few", [](TakenApart& parts) { parts.border.pop_back(); });
    check_corrupt("a border vertex too many", [](TakenApart& parts) { parts.border.push_back(0); });
    check_corrupt("counts that wrap around together", [](TakenApart& parts) {
        parts.owned[0] += 1u << 31;
        parts.owned[1] += 1u << 31;
    });
    check_corrupt("a vertex moved from one owner to another",
                  [](TakenApart& parts) { ++parts.owned[1], --parts.owned[0]; });
    check_corrupt("a vertex of the borders made internal", [](TakenApart& parts) {
        --parts.owned.back();
        ++parts.internal[0];
    });
    check_corrupt("a vertex moved from one leaf to another", [](TakenApart& parts) {
        ++parts.internal[0];
        --parts.internal[1];
    });
    check_corrupt("a place moved from one border to the next", [](TakenApart& parts) {
        ++parts.border_sizes[0];
        --parts.border_sizes[1];
    });
}

TEST_CASE("a border vertex that is not in the overlay of the patch's parent is refused") {
    const TakenApart& good = original().parts;
    const uint32_t first_child = 1 + good.children[0]; // of patch 1, on level 2
    size_t begin = 0;
    for (uint32_t p = 1; p < first_child; ++p) begin += good.border_sizes[p - 1];
    // The last border vertex that an inner patch of level 1 owns, put on the border of a child of another.
    uint32_t foreign = 0;
    for (uint32_t count : good.owned) foreign += count;
    REQUIRE(good.owned.back() > 0);
    REQUIRE(good.border_sizes[first_child - 1] > 0);
    check_corrupt("border vertex of a cousin", [&](TakenApart& parts) { parts.border[begin] = foreign - 1; });
    // A vertex that a level-1 patch owns, on the border of a level-1 patch.
    check_corrupt("border vertex of a child", [&](TakenApart& parts) { parts.border[0] = foreign - 1; });
}

TEST_CASE("a vertex that stands twice on one border is refused") {
    check_corrupt("twice", [](TakenApart& parts) { parts.border[1] = parts.border[0]; });
}

TEST_CASE("crafted tables") {
    for (uint32_t tag : {TAG_BORDER_TABLES, TAG_BORDER_INTERNAL_TABLES, TAG_INTERNAL_TABLES}) {
        REQUIRE(original().parts.tables.at(tag).size() > 10);
        for (float entry : {NOT_A_NUMBER, -1.0f, -INFINITE, -1e-40f})
            for (size_t i : {size_t{0}, original().parts.tables.at(tag).size() - 1})
                check_corrupt("entry", [&](TakenApart& parts) { parts.tables.at(tag)[i] = entry; });
    }
}

TEST_CASE("matrices of another shape, and too many or too few, are refused") {
    const TakenApart& good = original().parts;
    for (uint32_t tag : {TAG_BORDER_TABLES, TAG_BORDER_INTERNAL_TABLES, TAG_INTERNAL_TABLES}) {
        const auto file_with = [&](const std::function<void(std::vector<format::MatrixView>&)>& change) {
            format::ContainerWriter writer(original().fingerprint);
            const auto container = format::Container::parse(original().file, INDEX_TAGS);
            for (const format::Section& section : container.sections()) {
                if (section.codec != format::Codec::Png) {
                    writer.add_bytes(section.tag, container.read_bytes(section.tag, UINT64_MAX));
                    continue;
                }
                std::vector<format::MatrixView> matrices;
                const std::span<const float> values(good.tables.at(section.tag));
                size_t next = 0;
                for (const auto& [rows, cols] : shapes_of(good, section.tag)) {
                    matrices.push_back({values.subspan(next, size_t{rows} * cols), rows, cols});
                    next += size_t{rows} * cols;
                }
                if (section.tag == tag) change(matrices);
                writer.add_matrices(section.tag, matrices);
            }
            return writer.finish();
        };
        CHECK(status_of_file(file_with([](auto&) {})) == GEOIDX_OK);
        CHECK(status_of_file(file_with([](auto& matrices) { matrices.pop_back(); })) == GEOIDX_ERROR_CORRUPT);
        CHECK(status_of_file(file_with([](auto& matrices) { matrices.push_back(matrices[0]); })) ==
              GEOIDX_ERROR_CORRUPT);
        // Transposed: as many entries, another shape.
        CHECK(status_of_file(file_with([](auto& matrices) {
                  for (auto& matrix : matrices) {
                      if (matrix.rows == matrix.cols) continue;
                      std::swap(matrix.rows, matrix.cols);
                      return;
                  }
                  FAIL("all matrices are square");
              })) == GEOIDX_ERROR_CORRUPT);
        // Two as one: as many entries, another number of matrices.
        CHECK(status_of_file(file_with([](auto& matrices) {
                  const auto entries =
                      static_cast<uint32_t>(matrices[0].values.size() + matrices[1].values.size());
                  matrices[0] = {{matrices[0].values.data(), entries}, 1, entries};
                  matrices.erase(matrices.begin() + 1);
              })) == GEOIDX_ERROR_CORRUPT);
    }
}

TEST_CASE("a section that is missing is refused") {
    const auto container = format::Container::parse(original().file, INDEX_TAGS);
    for (const format::Section& section : container.sections()) {
        const uint32_t tag = section.tag;
        CAPTURE(format::tag_text(tag));
        check_corrupt("missing", [&](TakenApart& parts) { parts.missing_tag = tag; });
    }
}

// A zstd frame of a few bytes that states `content` and holds nothing.
static Bytes hollow_frame(uint64_t content) {
    Bytes frame = format::test::bytes_of({0x28, 0xB5, 0x2F, 0xFD, 0xC0, 0x00});
    frame.resize(14);
    format::test::put(frame, 6, content, 8);
    for (int byte : {0x01, 0x00, 0x00}) frame.push_back(static_cast<std::byte>(byte));
    return frame;
}

// The original with sections of bytes replaced: `victim` is a hollow frame that claims `claimed` bytes, and
// others are what change(tag, bytes) makes of them. Sections of matrices are empty.
template <class Change>
static Bytes with_hollow_section(uint32_t victim, uint64_t claimed, const Change& change) {
    format::ContainerWriter writer(1);
    const auto container = format::Container::parse(original().file, INDEX_TAGS);
    size_t position = 0;
    for (size_t i = 0; i < container.sections().size(); ++i) {
        const uint32_t tag = container.sections()[i].tag;
        if (tag == victim) {
            position = i;
            writer.add_raw(tag, hollow_frame(claimed));
        } else if (container.sections()[i].codec == format::Codec::Png) {
            writer.add_matrices(tag, {});
        } else {
            writer.add_bytes(tag, change(tag, container.read_bytes(tag, UINT64_MAX)));
        }
    }
    Bytes file = writer.finish();
    format::test::put(file, format::test::record(position) + format::test::CODEC, 1, 4);
    format::test::put(file, format::test::record(position) + format::test::RAW_SIZE, claimed, 8);
    format::test::reseal(file);
    return file;
}

// What the file claims is compared with what is stored before memory is asked for: OUT_OF_MEMORY, or a crash
// of the sanitizer, would show that it was not.
TEST_CASE("hostile sizes are refused before memory is allocated for them") {
    for (uint32_t victim : {TAG_META, TAG_HIERARCHY, TAG_VERTICES, TAG_POSITIONS, TAG_BORDERS}) {
        CAPTURE(format::tag_text(victim));
        const Bytes file =
            with_hollow_section(victim, uint64_t{1} << 39, [](uint32_t, Bytes bytes) { return bytes; });
        CHECK(status_of_file(file) == GEOIDX_ERROR_CORRUPT);
    }
}

TEST_CASE("a hierarchy of more patches than the file has room for is refused before it is made") {
    // BORD claims a terabyte, HIER that the root has 2^31 children.
    const Bytes file = with_hollow_section(TAG_BORDERS, uint64_t{1} << 40, [](uint32_t tag, Bytes bytes) {
        if (tag != TAG_HIERARCHY) return bytes;
        format::ByteWriter writer;
        writer.u32(1);
        writer.u64(1);
        writer.u32(1u << 31);
        return Bytes(writer.take());
    });
    CHECK(status_of_file(file) == GEOIDX_ERROR_CORRUPT);
}

// Content that no check can tell from an honest file must still not crash or hang queries: any distances that
// are not negative, however they contradict each other.
TEST_CASE("tables of nonsense distances give answers without NaN") {
    std::vector<float> values;
    for (float value : {0.0f, 1e-45f, 1e-38f, 1.0f, 1e30f, 3.4e38f, INFINITE}) values.push_back(value);
    for (uint32_t seed = 0; seed < 12; ++seed) {
        std::mt19937 random(seed);
        const auto index = open(with([&](TakenApart& parts) {
            for (auto& [tag, table] : parts.tables)
                for (float& entry : table)
                    entry = seed < values.size() ? values[seed] : values[random() % values.size()];
            parts.meta.bound_scale = seed % 2 ? 1.0f : 0.0f;
        }));
        for (uint32_t a = 0; a < 72; a += 5) {
            for (float distance : msad(index.get(), a, 72)) CHECK(distance >= 0);
            for (uint32_t b = 0; b < 72; ++b) {
                const float there = sssd(index.get(), a, b);
                CHECK(there >= 0);
                CHECK(there == sssd(index.get(), b, a));
            }
        }
    }
}

// Numbers are those of SPEC.md.
TEST_CASE("wrong content is told by the number of its section, where the section begins") {
    const auto vertices = static_cast<uint32_t>(original().parts.vertex_count);
    check_told(with([](TakenApart& parts) { parts.meta.bound_scale = 2; }), 101, "META");
    check_told(with([](TakenApart& parts) { parts.level_count = 9; }), 102, "HIER");
    check_told(with([&](TakenApart& parts) { parts.number_of_id[0] = vertices; }), 103, "VERT");
    check_told(with([](TakenApart& parts) { parts.position_step = -1; }), 104, "POSI");
    check_told(with([&](TakenApart& parts) { parts.border[0] = vertices; }), 105, "BORD");
    const std::tuple<uint32_t, uint32_t, const char*> tables[] = {
        {TAG_BORDER_TABLES, 106, "BVBV"},
        {TAG_BORDER_INTERNAL_TABLES, 107, "BVIV"},
        {TAG_INTERNAL_TABLES, 108, "IVIV"},
    };
    for (const auto& [tag, number, name] : tables)
        check_told(with([tag = tag](TakenApart& parts) { parts.tables.at(tag)[0] = -1; }), number, name);
}

TEST_CASE("a section that is too long or too short is told by its number") {
    const std::tuple<uint32_t, uint32_t, const char*> sections[] = {
        {TAG_META, 101, "META"},      {TAG_HIERARCHY, 102, "HIER"}, {TAG_VERTICES, 103, "VERT"},
        {TAG_POSITIONS, 104, "POSI"}, {TAG_BORDERS, 105, "BORD"},
    };
    for (const auto& [tag, number, name] : sections)
        check_told(with([tag = tag](TakenApart& parts) { parts.extra_bytes[tag] = Bytes(1); }), number, name);
    check_told(with([](TakenApart& parts) { parts.children.pop_back(); }), 102, "HIER");
    check_told(with([](TakenApart& parts) { parts.number_of_id.pop_back(); }), 103, "VERT");
    check_told(with([](TakenApart& parts) { parts.coordinates.pop_back(); }), 104, "POSI");
    check_told(with([](TakenApart& parts) { parts.border.pop_back(); }), 105, "BORD");
}

TEST_CASE("sections that only the overlay engine has are refused with the graph engine") {
    check_told(with([](TakenApart& parts) { parts.extra_bytes[TAG_MEASURED_PAIRS] = Bytes(20); }), 114,
               "PAIR");
    check_told(with([](TakenApart& parts) { parts.extra_bytes[TAG_STEEP_EDGES] = Bytes(8); }), 115, "EDGE");
}

TEST_CASE("borders that contradict the hierarchy are told by the number of BORD") {
    // The last border vertex belongs to the last inner patch, so that it cannot be on the border of patch 1.
    const TakenApart& good = original().parts;
    const auto border_vertices = std::accumulate(good.owned.begin(), good.owned.end(), 0u);
    REQUIRE(good.owned.back() > 0);
    check_told(with([&](TakenApart& parts) { parts.border[0] = border_vertices - 1; }), 105, "BORD");
    // The last vertex of the root is said to be patch 1's, although it is on a border of the root's children.
    const auto moved = with([](TakenApart& parts) {
        --parts.owned[0];
        ++parts.owned[1];
    });
    check_told(moved, 105, "BORD");
}

TEST_CASE("a section that is missing is told by its number, at the beginning") {
    const std::tuple<uint32_t, uint32_t> sections[] = {
        {TAG_META, 101},
        {TAG_HIERARCHY, 102},
        {TAG_VERTICES, 103},
        {TAG_POSITIONS, 104},
        {TAG_BORDERS, 105},
        {TAG_BORDER_TABLES, 106},
        {TAG_BORDER_INTERNAL_TABLES, 107},
        {TAG_INTERNAL_TABLES, 108},
    };
    for (const auto& [tag, number] : sections) {
        const auto told = told_issues(with([tag = tag](TakenApart& parts) { parts.missing_tag = tag; }));
        REQUIRE(told.size() == 1);
        CHECK(told[0].number == number);
        CHECK(told[0].offset == 0);
    }
}

TEST_CASE("stored bytes that cannot be decoded are told by one number, where the section begins") {
    const auto unchanged = [](uint32_t, Bytes bytes) { return bytes; };
    for (const auto& [tag, size, name] :
         {std::tuple(TAG_META, 184, "META"), std::tuple(TAG_BORDERS, 4000, "BORD")})
        check_told(with_hollow_section(tag, static_cast<uint64_t>(size), unchanged), 100, name);

    // The signature of the first PNG, behind the count and the lengths.
    for (const char* name : {"BVBV", "BVIV", "IVIV"}) {
        Bytes file = original().file;
        const uint64_t begin = begin_of_section(file, name);
        const uint64_t count = format::test::get(file, begin, 4);
        file[begin + 4 + 8 * count] ^= std::byte{1};
        for (size_t i = 0; i < 8; ++i) {
            const size_t record = format::test::record(i);
            if (format::test::get(file, record + format::test::OFFSET, 8) != begin) continue;
            const uint64_t size = format::test::get(file, record + format::test::STORED_SIZE, 8);
            const uint64_t checksum = XXH3_64bits(file.data() + begin, size);
            file = format::test::patched(file, record + format::test::CHECKSUM, checksum, 8);
        }
        check_told(file, 100, name);
    }
}
