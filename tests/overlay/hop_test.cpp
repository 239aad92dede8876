// The hops of the overlay engine, held against the plain loops of plain_hop.h.
#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <utility>

#include "src/overlay/hops/inner_sweep.h"
#include "src/overlay/hops/outer_crossing.h"
#include "src/query/index.h"
#include "tests/overlay/overlay_of.h"
#include "tests/overlay/plain_hop.h"
#include "tests/support/sanitized.h"

using namespace geodesic;
using namespace geodesic::test;

namespace {

// ---- What is hopped over

struct Field {
    uint32_t source;
    std::vector<float> distance; // by number
};

struct Built {
    TestMesh mesh;
    OverlayOf built;
    StoredTables tables;
    std::vector<Field> fields;

    Built(const TestMesh& of, const geoidx_build_options& options)
        : mesh(of), built(of, options), tables(built.index, overlay().numbering) {
        solve(options);
    }
    Built(const TestMesh& of, const geoidx_build_options& options, const StoredIndex& stored)
        : mesh(of), built(stored), tables(built.index, overlay().numbering) {
        solve(options);
    }
    Built(const Built&) = delete; // because the tables refer into the index
    Built& operator=(const Built&) = delete;

    void solve(const geoidx_build_options& options) {
        const auto ids = ids_by_number(built.index);
        const auto metric = solver(mesh, options);
        const auto vertices = static_cast<uint32_t>(ids.size());
        for (uint32_t i = 0; i < 2 * FIELDS_AT_ONCE; ++i) {
            const uint32_t source = i * vertices / (2 * FIELDS_AT_ONCE);
            const auto by_id = metric_distances(metric.get(), ids[source], mesh.vertex_count());
            Field field{source, {}};
            for (const uint32_t id : ids) field.distance.push_back(static_cast<float>(by_id[id]));
            fields.push_back(field);
        }
        for (const float farther : {INFINITE, 1000.f})
            for (uint32_t i = 0; i < FIELDS_AT_ONCE; ++i) add_farther_in_parts(fields[2 * i], farther);
    }

    // The field once more, with parts of all borders out of reach, or farther than all steps.
    void add_farther_in_parts(Field field, float farther) {
        for (size_t k = 0; k < field.distance.size(); ++k)
            if (k % 8 < 3) field.distance[k] += farther;
        fields.push_back(std::move(field));
    }

    const OverlayIndex& overlay() const { return built.overlay(); }
    const Numbering& numbering() const { return overlay().numbering; }
    bool is_source_in(const Field& field, uint32_t patch) const {
        return numbering().is_within(numbering().innermost_patch(field.source), patch);
    }
};

geoidx_build_options options_of(uint32_t metric, std::vector<uint32_t> patches) {
    auto options = build_options(metric, static_cast<uint32_t>(patches.size()));
    std::ranges::copy(patches, options.patches);
    options.target_error = 0; // so that each number has an id, from which distances are solved
    return options;
}

// Without the triangles that lie in any of some circles.
TestMesh with_holes(TestMesh mesh) {
    constexpr double HOLES[][3] = {{6, 6, 2.5}, {18, 7, 3.2}, {8, 17, 3}, {19, 18, 2.2}, {13, 12, 1.6}};
    std::vector<uint32_t> kept;
    for (size_t t = 0; t < mesh.triangles.size(); t += 3) {
        const double* corner = &mesh.positions[3 * size_t{mesh.triangles[t]}];
        if (std::ranges::none_of(
                HOLES, [&](const auto& h) { return std::hypot(corner[0] - h[0], corner[1] - h[1]) < h[2]; }))
            kept.insert(kept.end(), mesh.triangles.begin() + static_cast<std::ptrdiff_t>(t),
                        mesh.triangles.begin() + static_cast<std::ptrdiff_t>(t) + 3);
    }
    mesh.triangles = kept;
    return mesh;
}

// Meshes of 1,400 to 1,800 vertices: on smaller ones nearly all hops are near.
const Built& on_closed() {
    static const Built built(pressed(torus(60, 24), 1.3), options_of(GEOIDX_METRIC_EXACT, {3, 3}));
    return built;
}
const Built& with_open_chains() {
    static const Built built(with_holes(hills(44, 40)), options_of(GEOIDX_METRIC_EXACT, {4, 4}));
    return built;
}
const Built& in_parts() {
    static const Built built = [] {
        TestMesh mesh = components_and_unused();
        append(mesh, hills(30, 28), 400);
        append(mesh, torus(32, 16), 500);
        return Built(mesh, options_of(GEOIDX_METRIC_EXACT, {2, 2, 3}));
    }();
    return built;
}
const Built& with_bridges() {
    static const Built built(pages(5, 13, 24), options_of(GEOIDX_METRIC_EXACT, {4, 3}));
    return built;
}
const Built& along_edges() {
    static const Built built(hills(24, 22), options_of(GEOIDX_METRIC_EDGES, {3, 3}));
    return built;
}

// The same with most of the tables' entries without a path, so that sums of steps often do not count.
Built with_few_paths(const Built& of, const geoidx_build_options& options) {
    StoredIndex stored = restore(of.built.index);
    std::mt19937 random(5);
    for (auto* codes : {&stored.overlay_codes, &stored.border_internal_codes})
        for (uint16_t& code : *codes)
            if (random() % 6 != 0) code = NO_PATH;
    return {of.mesh, options, stored};
}

// ---- The comparison

struct Tally {
    uint64_t hops = 0, near = 0, far = 0, other_by_near = 0, straightened = 0, unreached = 0, without_sum = 0;
    uint64_t wrong = 0, wrong_places = 0;

    void add(const Hop& expected, float answer) {
        const bool is_reached = expected.distance < NOWHERE;
        ++hops;
        near += expected.is_near;
        far += !expected.is_near && is_reached;
        other_by_near += expected.is_other;
        straightened += expected.is_straightened;
        unreached += !is_reached;
        without_sum += !expected.had_sum && is_reached;
        const double difference = std::abs(double{answer} - expected.distance);
        wrong += is_reached ? !(difference <= 1e-5 * expected.distance) : answer != INFINITE;
    }
    void add(const Hop& expected, float answer, uint32_t over) {
        add(expected, answer);
        wrong_places += over != expected.over;
    }
};

PlainHop plain_hop(const StoredBorder& border, const Field& field, float quantum) {
    std::vector<float> distances;
    for (const uint32_t v : border.vertices) distances.push_back(field.distance[v]);
    return {border, distances, quantum, static_cast<uint32_t>(field.distance.size())};
}

// The position on the border of the place that a kernel names.
uint32_t position_of(const OverlayIndex& index, uint32_t patch, uint16_t winner) {
    if (winner == BorderFromSource::NO_PLACE) return NONE;
    return index.rings.position[index.rings.begin[patch] + winner];
}

// The positions on the border that the ways from a source lead over, to each vertex of the parent's overlay
// that is not on the border.
std::vector<uint32_t> crossed_positions(const OverlayIndex& index, uint32_t child, const Field& source) {
    const Rings& rings = index.rings;
    const uint32_t first = rings.begin[child], parent = index.numbering.parent[child];
    std::vector<uint32_t> on_ring, owned;
    for (uint32_t i = 0; i < index.numbering.overlay_size(parent); ++i)
        if (!index.is_on_border(child, i)) {
            const OverlayColumn column = index.overlay_column(parent, i);
            (column.is_owned ? owned : on_ring).push_back(column.number);
        }
    OverlayCrossing crossing(index, std::pmr::get_default_resource());
    const auto border = crossing.begin(child, segments_from(rings, first));
    for (uint32_t k = 0; k < border.size(); ++k) border[k] = source.distance[rings.vertex[first + k]];
    REQUIRE(crossing.finish());
    std::vector<float> ways(on_ring.size() + owned.size());
    std::vector<uint16_t> winners(ways.size());
    crossing.cross_to_ring(on_ring, ways.data(), winners.data());
    crossing.cross_to_owned(owned, ways.data() + on_ring.size(), winners.data() + on_ring.size());
    std::vector<uint32_t> positions;
    for (const uint16_t winner : winners) positions.push_back(position_of(index, child, winner));
    return positions;
}

Tally hop_up(const Built& built) {
    const Numbering& numbering = built.numbering();
    OuterCrossing crossing(built.overlay(), std::pmr::get_default_resource());
    Tally tally;
    for (uint32_t child = 1; child < numbering.patch_count(); ++child) {
        const uint32_t parent = numbering.parent[child];
        const StoredBorder border = built.tables.border(child);
        std::vector<uint32_t> targets; // whose distances are not known
        std::vector<std::vector<uint16_t>> rows;
        for (uint32_t i = 0; i < numbering.overlay_size(parent); ++i) {
            const uint32_t x = numbering.overlay_number(parent, i);
            if (std::ranges::find(border.vertices, x) != border.vertices.end()) continue;
            targets.push_back(x);
            rows.push_back(built.tables.row_up(child, x));
        }
        for (const Field& field : built.fields) {
            if (!built.is_source_in(field, child)) continue;
            const PlainHop plain = plain_hop(border, field, built.tables.quantum(parent));
            auto distance = field.distance;
            const bool is_reached = crossing.begin(child, {distance.data()});
            CHECK(is_reached == plain.is_reached());
            if (!is_reached) continue;
            const auto answers = crossing.cross();
            const auto crossed = crossed_positions(built.overlay(), child, field);
            REQUIRE(answers.size() == rows.size());
            REQUIRE(crossed.size() == rows.size());
            for (uint32_t i = 0; i < rows.size(); ++i) {
                CHECK(crossing.targets()[i] == targets[i]);
                tally.add(plain.over_vertices(rows[i]), answers[i], crossed[i]);
            }
        }
    }
    return tally;
}

std::vector<std::vector<uint16_t>> rows_down(const Built& built, uint32_t patch) {
    std::vector<std::vector<uint16_t>> rows;
    for (uint32_t i = 0; i < built.numbering().inner_size(patch); ++i)
        rows.push_back(built.tables.row_down(patch, built.numbering().first_inner(patch) + i));
    return rows;
}

std::vector<std::vector<float>> middles_down(const Built& built, uint32_t patch) {
    return middle_codes(built.tables.border(patch), rows_down(built, patch),
                        built.tables.between_internal(patch), built.tables.quantum(patch));
}

// Calls hop(patch, rows, plain, sweep) for every source outside of a patch that reaches its border.
template <class OneHop>
void for_each_hop_down(const Built& built, const OneHop& hop) {
    InnerSweep sweep(built.overlay(), 1, std::pmr::get_default_resource());
    for (uint32_t patch = 1; patch < built.numbering().patch_count(); ++patch) {
        const StoredBorder border = built.tables.border(patch);
        const auto rows = rows_down(built, patch);
        for (const Field& field : built.fields) {
            if (built.is_source_in(field, patch)) continue;
            const PlainHop plain = plain_hop(border, field, built.tables.quantum(patch));
            const bool is_begun = sweep.begin(patch, field.distance.data());
            CHECK(is_begun == (plain.is_reached() && !rows.empty()));
            if (is_begun) hop(patch, rows, plain, sweep);
        }
    }
}

Tally hop_down(const Built& built) {
    Tally tally;
    std::vector<std::vector<std::vector<float>>> middles(1);
    for (uint32_t patch = 1; patch < built.numbering().patch_count(); ++patch)
        middles.push_back(middles_down(built, patch));
    for_each_hop_down(built, [&](uint32_t patch, const auto& rows, const PlainHop& plain, InnerSweep& sweep) {
        const auto answers = sweep.cross();
        REQUIRE(answers.size() == rows.size());
        for (size_t i = 0; i < rows.size(); ++i)
            tally.add(plain.over_middles(rows[i], middles[patch][i]), answers[i]);
    });
    return tally;
}

// From FIELDS_AT_ONCE sources side by side, some of which may not reach the border.
Tally hop_down_at_once(const Built& built) {
    const Numbering& numbering = built.numbering();
    InnerSweep sweep(built.overlay(), FIELDS_AT_ONCE, std::pmr::get_default_resource());
    Tally tally;
    for (size_t first = 0; first < built.fields.size(); first += FIELDS_AT_ONCE) {
        std::vector<float> distances;
        for (uint32_t v = 0; v < numbering.vertex_count(); ++v)
            for (size_t i = 0; i < FIELDS_AT_ONCE; ++i)
                distances.push_back(built.fields[first + i].distance[v]);
        for (uint32_t patch = 1; patch < numbering.patch_count(); ++patch) {
            const StoredBorder border = built.tables.border(patch);
            const auto rows = rows_down(built, patch);
            const auto middles = middles_down(built, patch);
            if (!sweep.begin(patch, distances.data())) continue;
            const auto answers = sweep.cross();
            REQUIRE(answers.size() == rows.size() * FIELDS_AT_ONCE);
            for (size_t i = 0; i < FIELDS_AT_ONCE; ++i) {
                const PlainHop plain =
                    plain_hop(border, built.fields[first + i], built.tables.quantum(patch));
                for (size_t r = 0; r < rows.size(); ++r)
                    tally.add(plain.over_middles(rows[r], middles[r]), answers[r * FIELDS_AT_ONCE + i]);
            }
        }
    }
    return tally;
}

struct Tallies {
    Tally up, down, at_once;
    std::array<const Tally*, 3> all() const { return {&up, &down, &at_once}; }
};

void check_answers(const Tally& tally) {
    CHECK(tally.hops > 500);
    CHECK(tally.wrong == 0);
    CHECK(tally.wrong_places == 0);
}

Tallies check_hops(const Built& built) {
    const Tallies tallies{hop_up(built), hop_down(built), hop_down_at_once(built)};
    for (const Tally* tally : tallies.all()) check_answers(*tally);
    return tallies;
}

// The near rule and the ways over segments took part.
void check_rules_applied(const Tallies& tallies) {
    uint64_t other_by_near = 0;
    for (const Tally* tally : tallies.all()) {
        CHECK(tally->near > 100);
        CHECK(tally->far > 100);
        other_by_near += tally->other_by_near;
    }
    CHECK(other_by_near > 0);
    CHECK(tallies.up.straightened > 100);
}

// How many middles are raised.
uint64_t count_raised(const Built& built) {
    uint64_t raised = 0;
    for (uint32_t patch = built.numbering().first_leaf(); patch < built.numbering().patch_count(); ++patch) {
        const auto derived =
            derived_middles(built.tables.border(patch), rows_down(built, patch), built.tables.quantum(patch));
        const auto codes = raised_middles(built.tables.border(patch), rows_down(built, patch),
                                          built.tables.between_internal(patch), built.tables.quantum(patch));
        for (size_t i = 0; i < codes.size(); ++i)
            for (size_t k = 0; k < codes[i].size(); ++k) raised += codes[i][k] > derived[i][k];
    }
    return raised;
}

// How many segments close a chain, and how many positions end an open one.
std::pair<uint32_t, uint32_t> count_chains(const Built& built) {
    uint32_t closed = 0, open = 0;
    for (uint32_t patch = 1; patch < built.numbering().patch_count(); ++patch) {
        const StoredBorder border = built.tables.border(patch);
        for (uint32_t k = 0; k < border.size(); ++k) {
            open += border.end[k] == NONE;
            closed += border.end[k] <= k;
        }
    }
    return {closed, open};
}

}

TEST_CASE("hop: as the text has it on a closed, curved surface" * doctest::skip(SANITIZED)) {
    check_rules_applied(check_hops(on_closed()));
    CHECK(count_chains(on_closed()).first > 0);
}

TEST_CASE("hop: as the text has it on a surface with holes" * doctest::skip(SANITIZED)) {
    check_rules_applied(check_hops(with_open_chains()));
    CHECK(count_chains(with_open_chains()).second > with_open_chains().numbering().patch_count());
}

TEST_CASE("hop: as the text has it where borders branch" * doctest::skip(SANITIZED)) {
    CHECK(restore(with_bridges().built.index).segments.bridges.size() > 4);
    check_rules_applied(check_hops(with_bridges()));
}

// Heights are random, up to four edges, so that paths pass bumps on either side.
TestMesh rough(uint32_t columns, uint32_t rows) {
    TestMesh mesh = hills(columns, rows);
    std::mt19937 random(3);
    for (size_t i = 2; i < mesh.positions.size(); i += 3)
        mesh.positions[i] = static_cast<double>(random() % 1000) / 250;
    return mesh;
}

TEST_CASE("hop: as the text has it over large overlays") {
    const Built built(mesh_of_long_borders(), options_of_plane(mesh_of_long_borders(), {2, 2, 3}));
    const auto& is_large = built.overlay().is_large;
    CHECK(std::ranges::count(is_large, 1) > 1);
    check_answers(hop_up(built));
}

TEST_CASE("hop: as the text has it where middles are raised" * doctest::skip(SANITIZED)) {
    const Built built(rough(24, 22), options_of(GEOIDX_METRIC_EXACT, {3, 3}));
    CHECK(count_raised(built) > 20);
    check_hops(built);
}

TEST_CASE("hop: as the text has it where leaves are too large for that" * doctest::skip(SANITIZED)) {
    const Built built(rough(40, 30), options_of(GEOIDX_METRIC_EXACT, {2}));
    CHECK(built.numbering().internal_size(built.numbering().first_leaf()) > 256);
    check_answers(hop_down(built));
    check_answers(hop_down_at_once(built));
}

TEST_CASE("hop: as the text has it where the surface is in parts" * doctest::skip(SANITIZED)) {
    const Tallies tallies = check_hops(in_parts());
    check_rules_applied(tallies);
    CHECK(tallies.at_once.unreached > 1000); // some of the sources are in other parts
}

TEST_CASE("hop: as the text has it along edges, where there are no segments") {
    const Tallies tallies = check_hops(along_edges());
    CHECK(count_chains(along_edges()).first == 0);
    for (const Tally* tally : tallies.all()) CHECK(tally->far == tally->hops);
}

TEST_CASE("hop: as the text has it where tables lack paths") {
    const Built built = with_few_paths(along_edges(), options_of(GEOIDX_METRIC_EDGES, {3, 3}));
    const Tallies tallies = check_hops(built);
    for (const Tally* tally : tallies.all()) {
        CHECK(tally->without_sum > 10);
        CHECK(tally->unreached > 10);
    }
}

// A file may state any length. Squares of these are no floats, so that no way is straightened.
TEST_CASE("hop: over segments of any length, every distance is written") {
    const Built whole(with_holes(hills(26, 24)), options_of(GEOIDX_METRIC_EXACT, {3, 3}));
    for (const float length : {1e-30f, 2e37f, 5e37f, 3e38f}) {
        CAPTURE(length);
        StoredIndex stored =
            restore(with_few_paths(whole, options_of(GEOIDX_METRIC_EXACT, {3, 3})).built.index);
        std::ranges::fill(stored.segments.length, length);
        const Built built(whole.mesh, options_of(GEOIDX_METRIC_EXACT, {3, 3}), stored);
        InnerSweep one(built.overlay(), 1, std::pmr::get_default_resource()),
            several(built.overlay(), FIELDS_AT_ONCE, std::pmr::get_default_resource());
        std::vector<float> side_by_side;
        for (uint32_t v = 0; v < built.numbering().vertex_count(); ++v)
            for (size_t i = 0; i < FIELDS_AT_ONCE; ++i)
                side_by_side.push_back(i % 3 == 0 ? INFINITE : built.fields[i].distance[v]);
        uint64_t wrong = 0, unreached = 0;
        const auto check = [&](InnerSweep& sweep, size_t sources, uint32_t patch, const float* distances) {
            std::vector<float> inside(sources * built.numbering().inner_size(patch), NAN);
            if (!sweep.begin(patch, distances)) return;
            sweep.cross_to(inside.data());
            for (const float d : inside) {
                wrong += !(d >= 0);
                unreached += d == INFINITE;
            }
        };
        for (uint32_t patch = 1; patch < built.numbering().patch_count(); ++patch) {
            for (const Field& field : built.fields) check(one, 1, patch, field.distance.data());
            check(several, FIELDS_AT_ONCE, patch, side_by_side.data());
        }
        CHECK(wrong == 0);
        CHECK(unreached > 100);
    }
}

// Here a vertex may have a path to one end of a segment and none to the other, which are joined by an edge,
// so that no mesh has that, but a file of another writer may.
TEST_CASE("hop: as the text has it where tables lack paths to an end of a segment") {
    const Built built = with_few_paths(with_open_chains(), options_of(GEOIDX_METRIC_EXACT, {4, 4}));
    const Tallies tallies = check_hops(built);
    for (const Tally* tally : tallies.all()) {
        CHECK(tally->near > 50);
        CHECK(tally->without_sum > 10);
    }
}
