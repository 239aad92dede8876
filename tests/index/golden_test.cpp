// Golden files: one of each form, one of rounded distances, one with added vertices, two without positions,
// one with the mesh, one with measured pairs and one with these and steep edges, which every later version of
// the library must open (SPEC.md, "Versions").
#include <algorithm>
#include <fstream>
#include <iterator>
#include <utility>

#include "format/container.h"
#include "src/index/section_tags.h"
#include "tests/capi/calls.h"

using namespace geodesic;
using namespace geodesic::test;

namespace {

struct Golden {
    const char* name;
    uint32_t engine, codec;
    uint32_t columns; // of its sheet
    uint32_t flags = 0;
    double target_error = 0; // over 0: there are added vertices
    bool keeps_mesh = false;
    double height = 1; // over 1: so rough that there are measured pairs
};

constexpr Golden GOLDEN[] = {
    {"packed", GEOIDX_ENGINE_OVERLAY, GEOIDX_CODEC_PACKED, 15},
    {"lossless", GEOIDX_ENGINE_OVERLAY, GEOIDX_CODEC_LOSSLESS, 15},
    {"mapped", GEOIDX_ENGINE_OVERLAY, GEOIDX_CODEC_MAPPED, 15},
    {"graph", GEOIDX_ENGINE_GRAPH, GEOIDX_CODEC_LOSSLESS, 15},
    {"rounded", GEOIDX_ENGINE_OVERLAY, GEOIDX_CODEC_PACKED, 34},
    {"added", GEOIDX_ENGINE_OVERLAY, GEOIDX_CODEC_PACKED, 15, 0, 1e-4},
    {"no_positions", GEOIDX_ENGINE_OVERLAY, GEOIDX_CODEC_PACKED, 15, GEOIDX_SAVE_NO_POSITIONS},
    {"added_no_positions", GEOIDX_ENGINE_OVERLAY, GEOIDX_CODEC_PACKED, 15, GEOIDX_SAVE_NO_POSITIONS, 1e-4},
    {"with_mesh", GEOIDX_ENGINE_OVERLAY, GEOIDX_CODEC_PACKED, 15, 0, 0, true},
    {"measured_pairs", GEOIDX_ENGINE_OVERLAY, GEOIDX_CODEC_PACKED, 15, 0, 0, false, 16},
    {"steep_edges", GEOIDX_ENGINE_OVERLAY, GEOIDX_CODEC_PACKED, 34, 0, 0, false, 16}};

std::string path_of(const Golden& golden) {
    return std::string(GEOIDX_GOLDEN_FOLDER "/") + golden.name + ".geoidx";
}

Bytes content_of(const Golden& golden) {
    std::ifstream file(path_of(golden), std::ios::binary);
    REQUIRE(file.good());
    const std::vector<char> chars((std::istreambuf_iterator<char>(file)), {});
    Bytes bytes(chars.size());
    std::ranges::transform(chars, bytes.begin(), [](char c) { return static_cast<std::byte>(c); });
    return bytes;
}

// A jagged sheet and a small one apart from it. All coordinates are short binary fractions, so that every
// machine makes the same mesh.
TestMesh mesh_of(const Golden& golden) {
    TestMesh mesh = grid(golden.columns, golden.columns - 1);
    append(mesh, grid(4, 3), 40);
    for (size_t v = 0; v < mesh.positions.size() / 3; ++v)
        mesh.positions[3 * v + 2] = static_cast<double>((v * 7 + v / 5 * 3) % 9) / 32 * golden.height;
    return mesh;
}

geoidx_build_options options_of(const Golden& golden) {
    auto options = build_options(GEOIDX_METRIC_EXACT, 2);
    options.engine = golden.engine;
    options.target_error = golden.target_error;
    options.store_mesh = golden.keeps_mesh;
    return options;
}

// That of the mesh which the index keeps has its vertices in their places.
void check_surface(const geoidx* index, const geoidx_mesh& mesh) {
    geoidx_surface* made = nullptr;
    require_success(geoidx_surface_of_index(index, nullptr, &made));
    const SurfaceHandle surface(made);
    const auto* const positions = static_cast<const double*>(mesh.positions);
    for (uint32_t v = 0; v < mesh.vertex_count; ++v) {
        geoidx_surface_point point{};
        require_success(geoidx_vertex_point(made, v, &point));
        const uint32_t* const corners = mesh.triangles + 3 * size_t{point.triangle};
        const auto corner = std::ranges::max_element(point.weights) - point.weights;
        CHECK(corners[corner] == v);
        double distance = -1;
        require_success(geoidx_closest_point(made, positions + 3 * size_t{v}, &point, &distance));
        CHECK(distance == 0);
    }
}

}

// For who changes the format: geoidx_tests -tc="golden files: written*" --no-skip makes them anew.
TEST_CASE("golden files: written" * doctest::skip()) {
    for (const Golden& golden : GOLDEN) {
        geoidx_save_options options;
        geoidx_save_options_init(&options);
        options.codec = golden.codec;
        options.flags = golden.flags;
        const auto built = build(mesh_of(golden), options_of(golden));
        require_success(geoidx_save(built.get(), path_of(golden).c_str(), &options));
    }
}

TEST_CASE("golden files: they open, belong to their mesh and answer near the truth") {
    for (const Golden& golden : GOLDEN) {
        CAPTURE(std::string(golden.name));
        const TestMesh of = mesh_of(golden);
        const uint32_t count = of.vertex_count();
        const auto metric = solver(of, build_options());
        const Bytes file = content_of(golden);
        CHECK(geoidx_verify(file.data(), file.size(), nullptr, nullptr) == GEOIDX_OK);
        const geoidx_mesh view = of.view();
        geoidx_open_options options;
        geoidx_open_options_init(&options);
        options.expected_mesh = &view;
        geoidx* opened = nullptr;
        require_success(geoidx_open(path_of(golden).c_str(), &options, &opened));
        const IndexHandle index(opened);
        const geoidx_info info = info_of(index.get());
        CHECK(info.engine == golden.engine);
        CHECK(info.codec == golden.codec);
        CHECK(info.file_flags == golden.flags);
        CHECK(info.format_major == 2);
        CHECK((golden.target_error > 0) == (info.added_vertex_count > 0));
        CHECK((info.has_mesh == 1) == golden.keeps_mesh);
        const auto container = format::Container::parse(file, INDEX_TAGS);
        CHECK(container.has(TAG_MEASURED_PAIRS) == (golden.height > 1));
        CHECK(container.has(TAG_STEEP_EDGES) == (golden.height > 1 && golden.columns > 30));
        if (golden.keeps_mesh) check_surface(index.get(), view);
        CHECK((golden.columns > 30) == (info.table_entries >= 65536)); // distances are rounded
        double sum = 0;
        uint64_t distances = 0, apart = 0;
        for (uint32_t source = 0; source < count; source += 17) {
            const auto exact = metric_distances(metric.get(), source, count);
            const auto found = msad(index.get(), source, count);
            for (uint32_t v = 0; v < count; ++v) {
                CHECK(std::isinf(exact[v]) == std::isinf(found[v]));
                if (std::isinf(exact[v])) {
                    ++apart;
                } else if (v != source) {
                    const double error = std::abs(double{found[v]} - exact[v]) / exact[v];
                    CHECK(error < 0.45);
                    sum += error;
                    ++distances;
                    if (v % 10 == 0) CHECK(std::abs(sssd(index.get(), source, v) / exact[v] - 1) < 0.45);
                }
            }
        }
        CHECK(sum / static_cast<double>(distances) < 0.02);
        CHECK(apart > 100);
    }
}

TEST_CASE("golden files: the forms of one index answer the same bits") {
    const uint32_t count = mesh_of(GOLDEN[0]).vertex_count();
    constexpr std::pair<size_t, size_t> SAME[] = {{0, 1}, {0, 2}, {0, 6}, {5, 7}, {0, 8}};
    for (const auto& [a, b] : SAME) {
        const auto one = open(content_of(GOLDEN[a]), mesh_of(GOLDEN[a]));
        const auto other = open(content_of(GOLDEN[b]), mesh_of(GOLDEN[b]));
        for (uint32_t source = 0; source < count; source += 9) {
            CHECK(msad(other.get(), source, count) == msad(one.get(), source, count));
            CHECK(sssd(other.get(), source, count / 2) == sssd(one.get(), source, count / 2));
        }
    }
}
