// Pairs that an index holds besides its tables: every query from a vertex answers them.
#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>

#include "tests/capi/refusals.h"
#include "tests/index/told_issues.h"
#include "tests/query/planted_pairs.h"

using namespace geodesic::test;
using geodesic::TAG_MEASURED_PAIRS;
using geodesic::TAG_STEEP_EDGES;
namespace format = geodesic::format;

namespace {

const TestMesh& mesh() {
    static const TestMesh made = hills(SIDE, SIDE);
    return made;
}

const Bytes& plain_file() {
    static const Bytes file = [] {
        auto options = build_options();
        options.engine = GEOIDX_ENGINE_OVERLAY;
        return without_section(save(build(mesh(), options).get()), TAG_STEEP_EDGES);
    }();
    return file;
}

// Pairs of neighbouring patches, of one patch and of opposite corners: shorter and longer than tables say.
const std::vector<Planted>& planted() {
    static const std::vector<Planted> pairs = [] {
        const auto index = open(plain_file());
        std::vector<Planted> made;
        for (const auto& [a, b, share] : {std::tuple{at(3, 4), at(5, 4), 0.5f},
                                          {at(3, 4), at(20, 30), 2.0f},
                                          {at(0, 0), at(SIDE - 1, SIDE - 1), 0.75f},
                                          {at(12, 12), at(13, 12), 3.0f}})
            made.push_back({a, b, share * sssd(index.get(), a, b)});
        return made;
    }();
    return pairs;
}

Bytes section_of(std::span<const Planted> pairs) {
    format::ByteWriter writer;
    writer.u64(pairs.size());
    for (const float error : {0.5f, 0.25f, 0.0f}) writer.f32(error);
    write_planted(pairs, numbers_of_ids(plain_file(), mesh().vertex_count()), writer);
    return writer.take();
}

Bytes with_pairs(const Bytes& section) {
    return geodesic::test::with_section(plain_file(), TAG_MEASURED_PAIRS, section);
}

const Bytes& file_with_pairs() {
    static const Bytes file = with_pairs(section_of(planted()));
    return file;
}

void check_pair_queries(const geoidx* index) {
    const auto query = query_of(index);
    for (const auto& [a, b, distance] : planted())
        for (const auto& [from, to] : {std::pair{a, b}, {b, a}}) {
            CHECK(sssd(index, from, to) == distance);
            require_success(geoidx_query_prepare(query.get(), from));
            const uint32_t targets[] = {to, from};
            float answers[2];
            require_success(geoidx_query_prepared(query.get(), targets, 2, answers));
            CHECK(answers[0] == distance);
            CHECK(answers[1] == 0);
        }
}

void check_fields(const geoidx* index) {
    const auto query = query_of(index);
    const uint32_t count = mesh().vertex_count();
    std::vector<uint32_t> sources;
    for (const Planted& pair : planted()) sources.push_back(pair.a);
    while (sources.size() < 20) sources.push_back(static_cast<uint32_t>(sources.size()) * 7);
    std::vector<float> batch(size_t{20} * count), matrix(20 * 20);
    require_success(geoidx_query_ssad_batch(query.get(), sources.data(), 20, batch.data(), batch.size()));
    for (size_t i = 0; i < planted().size(); ++i) {
        const auto& [a, b, distance] = planted()[i];
        CHECK(msad(index, a, count)[b] == distance);
        CHECK(msad(index, b, count)[a] == distance);
        CHECK(batch[i * count + b] == distance);
    }
    for (size_t i = 0; i < planted().size(); ++i) sources[10 + i] = planted()[i].b;
    require_success(geoidx_query_matrix(query.get(), sources.data(), 20, sources.data(), 20, matrix.data(),
                                        matrix.size()));
    for (size_t i = 0; i < planted().size(); ++i) {
        CHECK(matrix[i * 20 + 10 + i] == planted()[i].distance);
        CHECK(matrix[(10 + i) * 20 + i] == planted()[i].distance);
    }
}

// Of vertices as points, alone or given twice, and of the nearest of some targets.
void check_points_and_targets(const geoidx* index) {
    const auto query = query_of(index);
    const geoidx_mesh view = mesh().view();
    geoidx_surface* made = nullptr;
    require_success(geoidx_surface_create(&view, nullptr, &made));
    const SurfaceHandle surface(made);
    const uint32_t count = mesh().vertex_count();
    for (const auto& [a, b, distance] : planted()) {
        geoidx_surface_point twice[2], target;
        require_success(geoidx_vertex_point(made, a, &twice[0]));
        require_success(geoidx_vertex_point(made, b, &target));
        twice[1] = twice[0];
        float answer = -1;
        require_success(geoidx_query_point_sssd(query.get(), made, &twice[0], &target, &answer));
        CHECK(answer == distance);
        std::vector<float> field(count);
        std::vector<uint32_t> nearest(count);
        for (const uint32_t sources : {1u, 2u}) {
            require_success(
                geoidx_query_point_msad(query.get(), made, twice, sources, nullptr, field.data(), count));
            CHECK(field[b] == distance);
            require_success(geoidx_query_point_nearest_sources(query.get(), made, twice, sources, nullptr,
                                                               nearest.data(), field.data(), count));
            CHECK(field[b] == distance);
            CHECK(nearest[b] == 0);
        }
        std::vector<uint32_t> targets{b};
        for (const uint32_t more : {0u, 700u}) { // few are asked for as pairs, many in sweeps
            while (targets.size() < more) targets.push_back(static_cast<uint32_t>(targets.size()) * 2);
            std::vector<uint32_t> positions(targets.size());
            std::vector<float> distances(targets.size());
            uint32_t found = 0;
            require_success(geoidx_query_nearest_targets(
                query.get(), a, targets.data(), static_cast<uint32_t>(targets.size()), positions.data(),
                distances.data(), static_cast<uint32_t>(targets.size()), &found));
            REQUIRE(found == targets.size());
            CHECK(std::ranges::is_sorted(distances));
            CHECK(distances[static_cast<size_t>(std::ranges::find(positions, 0u) - positions.begin())] ==
                  distance);
        }
    }
}

// Infinite if the vertex is not found.
float distance_within(geoidx_query* query, std::span<const uint32_t> sources, float radius, uint32_t vertex) {
    return found_within(query, sources, radius, mesh().vertex_count())[vertex];
}

}

TEST_CASE("measured pairs: every query from one vertex answers them, from every form of file") {
    const auto index = open(file_with_pairs());
    REQUIRE(sssd(open(plain_file()).get(), planted()[0].a, planted()[0].b) != planted()[0].distance);
    Bytes file = file_with_pairs();
    for (const uint32_t codec :
         {GEOIDX_CODEC_PACKED, GEOIDX_CODEC_MAPPED, GEOIDX_CODEC_LOSSLESS, GEOIDX_CODEC_PACKED}) {
        CAPTURE(codec);
        file = save(open(file).get(), codec);
        const auto opened = open(file);
        check_pair_queries(opened.get());
        check_fields(opened.get());
        check_points_and_targets(opened.get());
    }
    CHECK(file == save(index.get()));
}

TEST_CASE("measured pairs: they are within a radius by what was measured") {
    const auto index = open(file_with_pairs());
    const auto query = query_of(index.get());
    const uint32_t count = mesh().vertex_count();
    for (const auto& [a, b, distance] : planted())
        for (const float share : {0.999f, 1.0f, 1.001f, 4.0f}) {
            const float radius = share * distance, expected = share < 1 ? INFINITE : distance;
            CHECK(distance_within(query.get(), {&a, 1}, radius, b) == expected);
            std::vector<float> field(count);
            require_success(geoidx_query_msad_within(query.get(), &a, 1, radius, field.data(), count));
            CHECK(field[b] == expected);
        }
}

TEST_CASE("measured pairs: several sources have the least of what each of them has alone") {
    const auto index = open(file_with_pairs());
    const auto query = query_of(index.get());
    const uint32_t count = mesh().vertex_count();
    for (const auto& [a, b, distance] : planted()) {
        const uint32_t sources[] = {at(SIDE - 1, 0), a};
        const float other = msad(index.get(), sources[0], count)[b], least = std::min(other, distance);
        std::vector<uint32_t> nearest(count);
        std::vector<float> field(count);
        for (const uint32_t threads : {1u, 3u}) {
            require_success(geoidx_query_set_threads(query.get(), threads));
            require_success(geoidx_query_msad(query.get(), sources, 2, field.data(), count));
            CHECK(field[b] == least);
            for (const float share : {0.9f, 1.1f}) {
                require_success(
                    geoidx_query_msad_within(query.get(), sources, 2, share * least, field.data(), count));
                CHECK(field[b] == (share < 1 ? INFINITE : least));
            }
        }
        require_success(
            geoidx_query_nearest_sources(query.get(), sources, 2, nearest.data(), field.data(), count));
        CHECK(field[b] == least);
        CHECK(nearest[b] == (distance < other ? 1 : 0));
        CHECK(distance_within(query.get(), sources, INFINITE, b) == least);
    }
}

TEST_CASE("measured pairs: a section that breaks a rule is refused") {
    constexpr size_t BEGIN = 20; // of the pairs
    const Bytes good = section_of(planted());
    REQUIRE(open_status(with_pairs(good)) == GEOIDX_OK);
    REQUIRE(open_status(with_pairs(Bytes(BEGIN))) == GEOIDX_OK); // no pair at all
    const auto refused = [&](const char* what, size_t plane, size_t pair, uint32_t value) {
        CAPTURE(what);
        const Bytes file = with_pairs(with_value(good, BEGIN, plane, pair, value));
        CHECK(open_status(file) == GEOIDX_ERROR_CORRUPT);
        check_told(file, GEOIDX_ISSUE_PAIR, "PAIR");
    };
    refused("a vertex and itself", 1, 0, 0);
    refused("a second vertex that is not there", 1, 0, 1 << 20);
    refused("a first vertex that is not there", 0, 1, UINT32_MAX - 5);
    refused("descending order", 0, 1, UINT32_MAX);
    for (const float distance : {0.0f, -1.0f, INFINITE, NOT_A_NUMBER})
        refused("distance", 2, 2, std::bit_cast<uint32_t>(distance));
    const std::vector<Planted> twice{planted()[0], planted()[0]};
    CHECK(open_status(with_pairs(section_of(twice))) == GEOIDX_ERROR_CORRUPT);
    for (const float error : {-1.0f, INFINITE, NOT_A_NUMBER}) {
        Bytes section = good;
        std::memcpy(section.data() + 8, &error, sizeof error);
        CHECK(open_status(with_pairs(section)) == GEOIDX_ERROR_CORRUPT);
    }
    Bytes longer = good, shorter = good;
    longer.push_back(std::byte{0});
    shorter.pop_back();
    for (const Bytes& section : {longer, shorter, Bytes(BEGIN - 1)})
        CHECK(open_status(with_pairs(section)) == GEOIDX_ERROR_CORRUPT);
}
