// Edges along which fields are lowered: every query that gives distances of a field does so, against a plain
// rendering of the rule in format/SPEC.md.

#include "tests/capi/refusals.h"
#include "tests/index/told_issues.h"
#include "tests/query/planted_pairs.h"
#include "tests/support/sanitized.h"

using namespace geodesic::test;
using geodesic::TAG_MEASURED_PAIRS;
using geodesic::TAG_STEEP_EDGES;
namespace format = geodesic::format;

namespace {

// Two sheets, so that some vertices are in no reach of a source.
const TestMesh& two_sheets() {
    static const TestMesh made = [] {
        TestMesh both = hills(SIDE, SIDE);
        append(both, hills(7, 6), 2 * SIDE);
        return both;
    }();
    return made;
}

SurfaceHandle surface_of_two_sheets() {
    const geoidx_mesh view = two_sheets().view();
    geoidx_surface* made = nullptr;
    require_success(geoidx_surface_create(&view, nullptr, &made));
    return SurfaceHandle(made);
}

const Bytes& file_without_edges() {
    static const Bytes file =
        without_section(save(build(two_sheets(), default_options()).get()), TAG_STEEP_EDGES);
    return file;
}

// Edges all over the mesh, and a chain of them, along which most fields change by more than they say.
const std::vector<Planted>& steep_planted() {
    static const std::vector<Planted> edges = [] {
        std::vector<Planted> made = planted_edges(two_sheets(), 23);
        for (uint32_t x = 0; x < 12; ++x) made.push_back({at(x, 20), at(x + 1, 20), 0.5f});
        const auto ends = [](const Planted& edge) { return std::pair(edge.a, edge.b); };
        std::ranges::stable_sort(made, {}, ends);
        const auto are_same = [&](const Planted& a, const Planted& b) { return ends(a) == ends(b); };
        made.erase(std::unique(made.begin(), made.end(), are_same), made.end());
        return made;
    }();
    return edges;
}

Bytes steep_section_of(std::span<const Planted> edges) {
    return steep_section(edges, numbers_of_ids(file_without_edges(), two_sheets().vertex_count()));
}

const Bytes& file_with_edges() {
    static const Bytes file =
        with_section(file_without_edges(), TAG_STEEP_EDGES, steep_section_of(steep_planted()));
    return file;
}

struct Field {
    std::vector<float> distance;
    std::vector<uint32_t> source{};
};

// Until no edge is steep, the end of one that is farther is lowered.
void lower(Field& field) {
    for (bool is_lowered = true; is_lowered;) {
        is_lowered = false;
        for (const auto& [a, b, most] : steep_planted())
            for (const auto& [from, to] : {std::pair{a, b}, {b, a}})
                if (const float way = field.distance[from] + most; way < field.distance[to]) {
                    field.distance[to] = way;
                    if (!field.source.empty()) field.source[to] = field.source[from];
                    is_lowered = true;
                }
    }
}

std::vector<float> lowered(std::vector<float> distance) {
    Field field{std::move(distance)};
    lower(field);
    return field.distance;
}

std::vector<float> within(std::vector<float> field, float radius) {
    for (float& distance : field)
        if (distance > radius) distance = INFINITE;
    return field;
}

Bytes with_measured(const Bytes& file, std::span<const Planted> measured) {
    format::ByteWriter writer;
    writer.u64(measured.size());
    for (uint32_t i = 0; i < 3; ++i) writer.f32(0);
    write_planted(measured, numbers_of_ids(file_without_edges(), two_sheets().vertex_count()), writer);
    return with_section(file, TAG_MEASURED_PAIRS, writer.take());
}

std::vector<uint32_t> some_sources() {
    std::vector<uint32_t> sources;
    for (uint32_t v = 3; v < two_sheets().vertex_count(); v += 97) sources.push_back(v);
    sources.push_back(two_sheets().vertex_count() - 1); // on the other sheet
    return sources;
}

}

TEST_CASE("steep edges: fields are lowered along them, from every form of file" * doctest::skip(SANITIZED)) {
    const auto plain = open(file_without_edges());
    const uint32_t count = two_sheets().vertex_count();
    std::vector<std::vector<float>> expected;
    for (const uint32_t source : some_sources()) {
        const auto before = msad(plain.get(), source, count);
        expected.push_back(lowered(before));
        CHECK(expected.back() != before);
    }
    Bytes file = file_with_edges();
    for (const uint32_t codec :
         {GEOIDX_CODEC_PACKED, GEOIDX_CODEC_MAPPED, GEOIDX_CODEC_LOSSLESS, GEOIDX_CODEC_PACKED}) {
        CAPTURE(codec);
        file = save(open(file).get(), codec);
        const auto index = open(file);
        for (size_t i = 0; i < expected.size(); ++i)
            CHECK(msad(index.get(), some_sources()[i], count) == expected[i]);
    }
    CHECK(file == save(open(file_with_edges()).get()));
}

TEST_CASE("steep edges: a batch has the bits of single fields") {
    const auto index = open(file_with_edges());
    const auto query = query_of(index.get());
    const uint32_t count = two_sheets().vertex_count();
    const auto sources = some_sources();
    REQUIRE(sources.size() > 16);
    std::vector<float> batch(sources.size() * count);
    require_success(geoidx_query_ssad_batch(
        query.get(), sources.data(), static_cast<uint32_t>(sources.size()), batch.data(), batch.size()));
    for (size_t i = 0; i < sources.size(); ++i) {
        const auto begin = batch.begin() + static_cast<std::ptrdiff_t>(i * count);
        CHECK(std::vector(begin, begin + count) == msad(index.get(), sources[i], count));
    }
}

TEST_CASE("steep edges: within a radius are the bits of a whole field") {
    const auto index = open(file_with_edges());
    const auto query = query_of(index.get());
    const uint32_t count = two_sheets().vertex_count();
    for (const uint32_t source : some_sources()) {
        const auto field = msad(index.get(), source, count);
        for (const float radius : {0.0f, 1.5f, 4.0f, 11.0f, 30.0f, INFINITE}) {
            CAPTURE(radius);
            CHECK(found_within(query.get(), {&source, 1}, radius, count) == within(field, radius));
            std::vector<float> found(count);
            require_success(geoidx_query_msad_within(query.get(), &source, 1, radius, found.data(), count));
            CHECK(found == within(field, radius));
        }
    }
}

TEST_CASE("steep edges: several sources, and which of them is the nearest") {
    const auto plain = open(file_without_edges()), index = open(file_with_edges());
    const auto query = query_of(index.get()), plain_query = query_of(plain.get());
    const uint32_t count = two_sheets().vertex_count();
    const std::vector<uint32_t> sources{5, 700, 1111, 1599};
    Field expected{std::vector<float>(count), std::vector<uint32_t>(count)}, found = expected;
    const auto ask = [&](geoidx_query* of, Field& field) {
        require_success(geoidx_query_nearest_sources(of, sources.data(), 4, field.source.data(),
                                                     field.distance.data(), count));
    };
    ask(plain_query.get(), expected);
    const Field before = expected;
    lower(expected);
    CHECK(before.distance != expected.distance);
    CHECK(before.source != expected.source);
    for (const uint32_t threads : {1u, 3u}) {
        require_success(geoidx_query_set_threads(query.get(), threads));
        ask(query.get(), found);
        CHECK(found.distance == expected.distance);
        CHECK(found.source == expected.source);
        CHECK(msad(index.get(), sources, count) == expected.distance);
    }
}

TEST_CASE("steep edges: fields of points are lowered, pairs of vertices are not") {
    const auto plain = open(file_without_edges()), index = open(file_with_edges());
    const auto query = query_of(index.get()), plain_query = query_of(plain.get());
    const uint32_t count = two_sheets().vertex_count();
    const SurfaceHandle surface = surface_of_two_sheets();
    const geoidx_surface_point point{100, 0, {0.5, 0.25, 0.25}};
    std::vector<float> before(count), after(count);
    require_success(
        geoidx_query_point_msad(plain_query.get(), surface.get(), &point, 1, nullptr, before.data(), count));
    require_success(
        geoidx_query_point_msad(query.get(), surface.get(), &point, 1, nullptr, after.data(), count));
    CHECK(after != before);
    const auto expected = lowered(before);
    for (uint32_t v = 0; v < count; ++v) {
        CHECK(after[v] <= before[v]);
        if (before[v] > 5) CHECK(after[v] == expected[v]); // nearer ones are known by other ways, too
    }
    for (uint32_t v = 0; v < count; v += 13) CHECK(sssd(index.get(), 800, v) == sssd(plain.get(), 800, v));
}

TEST_CASE("steep edges: measured distances are lowered, too, but not those of pairs") {
    const std::vector<Planted> measured{{at(4, 20), at(30, 33), 60}, {at(4, 20), at(5, 20), 7}};
    const auto plain = open(with_measured(file_without_edges(), measured)),
               index = open(with_measured(file_with_edges(), measured));
    const auto query = query_of(index.get());
    const uint32_t count = two_sheets().vertex_count();
    for (const auto& [a, b, distance] : measured)
        for (const uint32_t source : {a, b}) {
            const auto before = msad(plain.get(), source, count), field = msad(index.get(), source, count);
            CHECK(field == lowered(before));
            CHECK(found_within(query.get(), {&source, 1}, 9, count) == within(field, 9));
            CHECK(sssd(index.get(), a, b) == distance);
        }
    CHECK(msad(index.get(), at(4, 20), count)[at(5, 20)] < 1); // of 7
}

// A measured pair tells that the far end of the chain is near to a point beside the other vertex.
TEST_CASE("steep edges: fields of points are lowered from what is known besides tables, too") {
    const uint32_t count = two_sheets().vertex_count(), near = at(34, 20), far = at(6, 20);
    const std::vector<Planted> measured{{near, far, 2}};
    const auto plain = open(with_measured(file_without_edges(), measured)),
               index = open(with_measured(file_with_edges(), measured));
    const auto query = query_of(index.get()), plain_query = query_of(plain.get());
    const SurfaceHandle surface = surface_of_two_sheets();
    geoidx_surface_point twice[2];
    require_success(geoidx_vertex_point(surface.get(), near, &twice[0]));
    for (double& weight : twice[0].weights) weight = weight > 0 ? 0.98 : 0.01;
    twice[1] = twice[0];
    const auto field_of = [&](geoidx_query* of, uint32_t sources) {
        std::vector<float> field(count);
        require_success(
            geoidx_query_point_msad(of, surface.get(), twice, sources, nullptr, field.data(), count));
        return field;
    };
    const auto before = field_of(plain_query.get(), 1), after = field_of(query.get(), 1);
    REQUIRE(before[far] < 2.1f);
    REQUIRE(before[at(5, 20)] > 20);
    CHECK(after[at(0, 20)] < 6);
    CHECK(after == lowered(before));
    CHECK(field_of(query.get(), 2) == after);
    std::vector<uint32_t> vertices(count);
    std::vector<float> distances(count), found(count, INFINITE);
    uint32_t found_count = 0;
    require_success(geoidx_query_point_within(query.get(), surface.get(), twice, 1, nullptr, 9,
                                              vertices.data(), distances.data(), count, &found_count));
    for (uint32_t i = 0; i < found_count; ++i) found[vertices[i]] = distances[i];
    CHECK(found == within(after, 9));
}

TEST_CASE("steep edges: what nothing but such an edge leads to is found, however far it is") {
    const uint32_t count = two_sheets().vertex_count(), other = SIDE * SIDE + 3;
    const std::vector<Planted> bridge{{at(7, 7), other, 500}};
    const auto index = open(with_section(file_without_edges(), TAG_STEEP_EDGES, steep_section_of(bridge)));
    const auto query = query_of(index.get());
    std::vector<uint32_t> targets(800, other), positions(800);
    std::vector<float> distances(800);
    uint32_t found = 0;
    require_success(geoidx_query_nearest_targets(query.get(), at(7, 7), targets.data(), 800, positions.data(),
                                                 distances.data(), 800, &found));
    CHECK(found == 800);
    CHECK(distances[0] == 500);
    CHECK(msad(index.get(), at(7, 7), count)[other] == 500);
}

TEST_CASE("steep edges: a section that breaks a rule is refused") {
    constexpr size_t BEGIN = 8; // of the edges
    const Bytes good = steep_section_of(steep_planted());
    const auto file_with = [](const Bytes& section) {
        return geodesic::test::with_section(file_without_edges(), TAG_STEEP_EDGES, section);
    };
    REQUIRE(open_status(file_with(good)) == GEOIDX_OK);
    REQUIRE(open_status(file_with(Bytes(BEGIN))) == GEOIDX_OK); // no edge at all
    const auto refused = [&](const char* what, const Bytes& section) {
        CAPTURE(what);
        CHECK(open_status(file_with(section)) == GEOIDX_ERROR_CORRUPT);
        check_told(file_with(section), GEOIDX_ISSUE_EDGE, "EDGE");
    };
    refused("a vertex and itself", with_value(good, BEGIN, 1, 0, 0));
    refused("a second vertex that is not there", with_value(good, BEGIN, 1, 0, 1 << 20));
    refused("a first vertex that is not there", with_value(good, BEGIN, 0, 1, UINT32_MAX - 5));
    refused("descending order", with_value(good, BEGIN, 0, 1, UINT32_MAX));
    for (const float most : {0.0f, -1.0f, INFINITE, NOT_A_NUMBER})
        refused("what ends may differ by", with_value(good, BEGIN, 2, 2, std::bit_cast<uint32_t>(most)));
    refused("an edge twice", steep_section_of(std::vector<Planted>{steep_planted()[0], steep_planted()[0]}));
    Bytes longer = good, shorter = good;
    longer.push_back(std::byte{0});
    shorter.pop_back();
    for (const Bytes& section : {longer, shorter, Bytes(BEGIN - 1)}) refused("size", section);
}
