// Files without positions: they open with the mesh, hold the same as files with positions, and are refused
// without the mesh, with another one, and where what they hold is wrong.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <functional>
#include <limits>
#include <map>
#include <span>

#include "src/index/section_tags.h"
#include "tests/capi/calls.h"
#include "tests/capi/refusals.h"
#include "tests/index/changed_section.h"
#include "tests/index/forms.h"
#include "tests/index/taken_apart.h"
#include "tests/index/told_issues.h"
#include "tests/support/sanitized.h"
#include "tests/support/temporary_directory.h"

using namespace geodesic;
using namespace geodesic::test;

namespace {

constexpr uint32_t NONE_LEFT_OUT = 0, NO_POSITIONS = GEOIDX_SAVE_NO_POSITIONS;

geoidx_build_options exact_options(uint32_t engine) {
    auto options = build_options(GEOIDX_METRIC_EXACT, 2);
    options.engine = engine;
    return options;
}

// Leaves positions out and takes them from the mesh again, in each form.
void check_round_trip(const geoidx* built, const TestMesh& mesh) {
    std::map<uint32_t, std::array<Bytes, 2>> files; // of each form, with positions and without
    for (uint32_t codec : CODECS) files[codec] = {save(built, codec), save(built, codec, NO_POSITIONS)};
    for (uint32_t codec : CODECS) {
        CAPTURE(codec);
        const auto& [with, without] = files[codec];
        CHECK(without.size() <= with.size()); // sections begin at multiples of 64
        const auto opened = open(without, mesh);
        CHECK(info_of(opened.get()).file_flags == NO_POSITIONS);
        CHECK(info_of(open(with).get()).file_flags == 0);
        CHECK(save(opened.get(), nullptr) == without);
        for (uint32_t other : CODECS)
            for (uint32_t flags : {NONE_LEFT_OUT, NO_POSITIONS})
                CHECK(save(opened.get(), other, flags) == files[other][flags]);
        CHECK(save(open(with).get(), codec, NO_POSITIONS) == without);
        CHECK(told_issues(without).empty());
        check_same_answers(opened.get(), built, mesh.vertex_count());
    }
}

// A small index of the graph engine, whose file can be taken apart, and one of the overlay engine.
const TestMesh& small_hills() {
    static const TestMesh mesh = hills(9, 8);
    return mesh;
}

Bytes small_file(uint32_t engine, uint32_t flags) {
    return save(build(small_hills(), exact_options(engine)).get(), GEOIDX_CODEC_PACKED, flags);
}

// So many entries that they are rounded, in two parts.
const TestMesh& rounded_mesh() {
    static const TestMesh mesh = [] {
        TestMesh two_parts = torus(44, 26);
        append(two_parts, hills(14, 13), 9);
        return two_parts;
    }();
    return mesh;
}

const geoidx* rounded_index() {
    static const IndexHandle index = [] {
        auto options = exact_options(GEOIDX_ENGINE_OVERLAY);
        options.level_count = 0;
        return build(rounded_mesh(), options);
    }();
    return index.get();
}

geoidx_status status_with_mesh(const Bytes& file) { return open_status(file, small_hills().view()); }

// The small file without positions, with something else changed.
Bytes with_changes(const std::function<void(TakenApart&)>& change) {
    static const Bytes file = small_file(GEOIDX_ENGINE_GRAPH, NO_POSITIONS);
    TakenApart parts = take_apart(file);
    take_tables_apart(file, parts);
    const TakenApart original = parts;
    change(parts);
    return put_together(parts, original, format::Container::parse(file, INDEX_TAGS).mesh_fingerprint());
}

// Opening and verifying find the same.
void check_corrupt(uint32_t number, const char* tag, const std::function<void(TakenApart&)>& change) {
    const Bytes file = with_changes(change);
    CHECK(status_with_mesh(file) == GEOIDX_ERROR_CORRUPT);
    check_told(file, number, tag);
}

// The position of each number, from a file of the graph engine that has them.
std::vector<std::array<double, 3>> positions_in(const TakenApart& parts) {
    std::vector<std::array<double, 3>> positions(parts.vertex_count);
    std::array<int64_t, 3> last{};
    for (size_t i = 0; i < parts.coordinates.size(); ++i) {
        const int64_t stored = parts.coordinates[i];
        last[i % 3] += stored % 2 ? -(stored + 1) / 2 : stored / 2;
        positions[i / 3][i % 3] =
            parts.position_origin[i % 3] + double{parts.position_step} * static_cast<double>(last[i % 3]);
    }
    return positions;
}

}

TEST_CASE("no positions: an index is the same again, by both engines and in each form" *
          doctest::skip(SANITIZED)) {
    for (const NamedMesh& of : mesh_zoo())
        for (uint32_t engine : ENGINES) {
            CAPTURE(of.name);
            CAPTURE(engine);
            check_round_trip(build(of.mesh, exact_options(engine)).get(), of.mesh);
        }
}

TEST_CASE("no positions: an index whose tables are rounded, of two parts, is the same again" *
          doctest::skip(SANITIZED)) {
    REQUIRE(info_of(rounded_index()).table_entries >= 65536);
    check_round_trip(rounded_index(), rounded_mesh());
}

TEST_CASE("no positions: the section has 36 bytes and the added vertices, and the file is as much shorter") {
    const auto built = shared_index(small_hills(), exact_options(GEOIDX_ENGINE_OVERLAY));
    const uint64_t added = info_of(built.get()).added_vertex_count;
    CHECK(added > 0);
    std::map<std::string, uint64_t> sizes[2];
    for (uint32_t flags : {NONE_LEFT_OUT, NO_POSITIONS}) {
        const auto opened = open(save(built.get(), GEOIDX_CODEC_PACKED, flags), small_hills());
        geoidx_section sections[16];
        uint32_t count = 0;
        require_success(geoidx_get_sections(opened.get(), sections, 16, &count));
        REQUIRE(count <= 16);
        for (const geoidx_section& section : std::span(sections).first(count))
            sizes[flags][section.tag] = section.raw_size;
    }
    CHECK(sizes[NO_POSITIONS]["POSI"] == 36 + 12 * added);
    CHECK(sizes[NONE_LEFT_OUT]["POSI"] == 36 + 12 * (small_hills().vertex_count() + added));
    CHECK(sizes[NO_POSITIONS].size() == sizes[NONE_LEFT_OUT].size());
    for (const auto& [tag, size] : sizes[0])
        if (tag != "POSI") CHECK(sizes[NO_POSITIONS][tag] == size);
}

TEST_CASE("no positions: welded vertices are where the first of them is" * doctest::skip(SANITIZED)) {
    for (const double apart : {0.02, 0.05}) {
        TestMesh mesh = seam(15, 11);
        const uint32_t first_copy = mesh.vertex_count() - 11;
        for (uint32_t copy = first_copy; copy < mesh.vertex_count(); ++copy)
            mesh.positions[3 * size_t{copy}] += apart;
        mesh.add_vertex(mesh.positions[0], mesh.positions[1] + apart, 0); // used by no triangle
        for (uint32_t engine : ENGINES) {
            auto options = exact_options(engine);
            options.weld_tolerance = 0.06;
            const auto built = shared_index(mesh, options);
            REQUIRE(info_of(built.get()).welded_vertex_count == 15 * 11);
            check_round_trip(built.get(), mesh);
            if (engine != GEOIDX_ENGINE_GRAPH) continue;
            const TakenApart parts = take_apart(save(built.get()));
            REQUIRE(double{parts.position_step} < apart / 2);
            const auto positions = positions_in(parts);
            for (uint32_t id = 0; id < 15 * 11; ++id) // copies have larger ids
                for (size_t k = 0; k < 3; ++k)
                    CHECK(
                        std::abs(positions[parts.number_of_id[id]][k] - mesh.positions[3 * size_t{id} + k]) <=
                        0.501 * double{parts.position_step});
        }
    }
}

TEST_CASE("no positions: an unused vertex may have the lowest id of a vertex") {
    TestMesh mesh;
    mesh.add_vertex(0.01, 0, 0); // welded to the corner of the grid
    append(mesh, grid(9, 8, 0.2), 0);
    auto options = exact_options(GEOIDX_ENGINE_OVERLAY);
    options.weld_tolerance = 0.02;
    check_round_trip(build(mesh, options).get(), mesh);
}

TEST_CASE("no positions: those of the mesh must have the precision that the index was built with" *
          doctest::skip(SANITIZED)) {
    TestMesh mesh = grid(20, 20, 0.2);
    for (double& coordinate : mesh.positions) coordinate += 1e6 / 7; // floats are 1/64 apart, steps 1/128
    const FloatMesh floats(mesh);
    const TestMesh widened{{floats.positions.begin(), floats.positions.end()}, mesh.triangles};
    const auto bare = [](const geoidx_mesh& built) {
        geoidx* index = nullptr;
        const auto options = exact_options(GEOIDX_ENGINE_OVERLAY);
        require_success(geoidx_build(&built, &options, &index));
        return save(IndexHandle(index).get(), GEOIDX_CODEC_PACKED, NO_POSITIONS);
    };
    const Bytes of_doubles = bare(mesh.view()), of_floats = bare(floats.view());
    CHECK(open_status(of_doubles, mesh.view()) == GEOIDX_OK);
    CHECK(open_status(of_floats, floats.view()) == GEOIDX_OK);
    CHECK(open_status(of_floats, widened.view()) == GEOIDX_OK);
    for (const geoidx_mesh& other : {floats.view(), widened.view()})
        check_refused(open_status(of_doubles, other), GEOIDX_ERROR_MESH_MISMATCH, "precision");
    check_refused(open_status(of_floats, mesh.view()), GEOIDX_ERROR_MESH_MISMATCH, "precision");
}

TEST_CASE("no positions: without the mesh there is no index, and it is said why") {
    const TemporaryDirectory directory;
    for (uint32_t engine : ENGINES)
        for (uint32_t codec : CODECS) {
            const auto built = shared_index(small_hills(), exact_options(engine));
            const Bytes file = save(built.get(), codec, NO_POSITIONS);
            check_refused(open_status(file), GEOIDX_ERROR_INVALID_ARGUMENT, "no positions");
            CHECK(last_error_contains("expected_mesh"));
            const std::string path = (directory.path() / "bare.geoidx").string();
            geoidx_save_options how;
            geoidx_save_options_init(&how);
            how.codec = codec;
            how.flags = NO_POSITIONS;
            require_success(geoidx_save(built.get(), path.c_str(), &how));
            geoidx* index = not_null();
            check_refused(geoidx_open(path.c_str(), nullptr, &index), GEOIDX_ERROR_INVALID_ARGUMENT,
                          "expected_mesh");
            CHECK(index == nullptr);
            const geoidx_mesh view = small_hills().view();
            const auto expected = expecting(view);
            require_success(geoidx_open(path.c_str(), &expected, &index));
            CHECK(save(IndexHandle(index).get(), codec) == save(built.get(), codec));
        }
}

TEST_CASE("no positions: another mesh is refused before anything is taken from it") {
    const Bytes file = small_file(GEOIDX_ENGINE_OVERLAY, NO_POSITIONS);
    TestMesh other = small_hills();
    const float moved = std::nextafter(static_cast<float>(other.positions[31]), 100.0f);
    other.positions[31] = double{moved};
    CHECK(open_status(file, other.view()) == GEOIDX_ERROR_MESH_MISMATCH);
    other = small_hills();
    std::swap(other.triangles[0], other.triangles[1]);
    CHECK(open_status(file, other.view()) == GEOIDX_ERROR_MESH_MISMATCH);
    CHECK(open_status(file, one_triangle().view()) == GEOIDX_ERROR_MESH_MISMATCH);
    other = small_hills();
    other.positions[0] = std::numeric_limits<double>::quiet_NaN();
    CHECK(open_status(file, other.view()) == GEOIDX_ERROR_BAD_MESH);
    geoidx_mesh empty = small_hills().view();
    empty.positions = nullptr;
    CHECK(open_status(file, empty) == GEOIDX_ERROR_INVALID_ARGUMENT);
}

TEST_CASE("no positions: flags of saving are checked, and a shorter struct has none") {
    const auto built = shared_index(small_hills(), exact_options(GEOIDX_ENGINE_OVERLAY));
    geoidx_save_options options;
    geoidx_save_options_init(&options);
    CHECK(options.flags == 0);
    uint64_t size = 0;
    for (uint32_t flags : {4u, 5u, 0x80000000u}) {
        options.flags = flags;
        check_refused(geoidx_save_memory(built.get(), &options, nullptr, 0, &size),
                      GEOIDX_ERROR_INVALID_ARGUMENT, "flags");
    }
    options.flags = NO_POSITIONS;
    CHECK(save(built.get(), &options) == save(built.get(), GEOIDX_CODEC_PACKED, NO_POSITIONS));
    CHECK(save(built.get(), &options) != save(built.get()));
    options.struct_size = 8;
    CHECK(save(built.get(), &options) == save(built.get()));
}

TEST_CASE("no positions: what contradicts the format is refused with the mesh, and by verify") {
    REQUIRE(with_changes([](TakenApart&) {}) == small_file(GEOIDX_ENGINE_GRAPH, NO_POSITIONS));
    const uint32_t vertices = small_hills().vertex_count();
    for (float step : {0.f, -1.f, std::numeric_limits<float>::infinity()})
        check_corrupt(104, "POSI", [&](TakenApart& parts) { parts.position_step = step; });
    check_corrupt(104, "POSI", [](TakenApart& parts) { parts.position_origin[1] = NOT_A_NUMBER; });
    check_corrupt(104, "POSI", [](TakenApart& parts) { parts.extra_bytes[TAG_POSITIONS] = Bytes(1); });
    check_corrupt(104, "POSI", [](TakenApart& parts) { parts.coordinates.resize(3); });
    check_corrupt(104, "POSI", [&](TakenApart& parts) { parts.coordinates.resize(3 * vertices - 3); });
    check_corrupt(104, "POSI", [&](TakenApart& parts) { parts.coordinates.resize(3 * vertices); });
    check_corrupt(104, "POSI", [](TakenApart& parts) { parts.missing_tag = TAG_POSITIONS; });
    // A number that no id has is an added vertex, whose position is not there.
    check_corrupt(104, "POSI", [](TakenApart& parts) { parts.number_of_id[5] = parts.number_of_id[6]; });
    check_corrupt(104, "POSI", [&](TakenApart& parts) { parts.vertex_count = vertices + 1; });
    for (uint64_t count : {uint64_t{UINT32_MAX}, uint64_t{1} << 32, UINT64_MAX})
        check_corrupt(103, "VERT", [&](TakenApart& parts) { parts.vertex_count = count; });
}

TEST_CASE("no positions: a checksum, step or origin that is not the mesh's is told with the mesh only") {
    for (const auto& change : std::initializer_list<std::function<void(TakenApart&)>>{
             [](TakenApart& parts) { ++parts.position_checksum; },
             [](TakenApart& parts) { parts.position_step *= 2; },
             [](TakenApart& parts) { parts.position_step = 1e-45f; },
             [](TakenApart& parts) { parts.position_step = 3.4e38f; },
             [](TakenApart& parts) { parts.position_origin[2] += 1; },
             [](TakenApart& parts) { parts.position_origin[0] = -1e308; },
             [](TakenApart& parts) { std::swap(parts.number_of_id[0], parts.number_of_id[9]); }}) {
        const Bytes file = with_changes(change);
        CHECK(status_with_mesh(file) == GEOIDX_ERROR_MESH_MISMATCH);
        CHECK(told_issues(file).empty());
    }
}

TEST_CASE("no positions: verify sees the sizes of packed tables, but not every entry") {
    const Bytes file = save(rounded_index(), GEOIDX_CODEC_PACKED, NO_POSITIONS);
    const geoidx_mesh view = rounded_mesh().view();
    const auto changed = [&](const std::function<void(Bytes&)>& change) {
        return with_changed_section(file, TAG_INTERNAL_TABLES, change);
    };
    CHECK(open_status(changed([](Bytes&) {}), view) == GEOIDX_OK);
    for (const auto& change : std::initializer_list<std::function<void(Bytes&)>>{
             [](Bytes& raw) { raw.pop_back(); }, [](Bytes& raw) { raw.push_back({}); },
             [](Bytes& raw) { raw[0] = std::byte{0x80}; }}) {
        CHECK(open_status(changed(change), view) == GEOIDX_ERROR_CORRUPT);
        check_told(changed(change), 108, "IVIV");
    }
    uint64_t entries = 0; // below the diagonals of the leaves
    for (const uint64_t size : take_apart(file).internal) entries += size * (size - 1) / 2;
    // All entries are far off, and more than a code can be, which no prediction changes.
    const auto over_the_largest = changed([&](Bytes& raw) {
        raw.assign(3 * entries, std::byte{0xfe});
        std::fill_n(raw.begin(), entries, std::byte{0x80});
    });
    CHECK(open_status(over_the_largest, view) == GEOIDX_ERROR_CORRUPT);
    check_told(over_the_largest, 108, "IVIV");
    // Entries below 0, which only their predictions tell.
    const auto below = changed([&](Bytes& raw) { raw.assign(entries, std::byte{0x81}); });
    CHECK(open_status(below, view) == GEOIDX_ERROR_CORRUPT);
    CHECK(told_issues(below).empty());
}
