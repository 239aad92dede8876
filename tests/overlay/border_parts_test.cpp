// The parts of borders that a pair of vertices looks at.
#include "src/overlay/sssd/border_parts.h"

#include <algorithm>
#include <cmath>
#include <random>
#include <set>

#include "src/overlay/kernels/near.h"
#include "src/overlay/sssd/measured_path.h"
#include "src/overlay/sssd/sssd.h"
#include "tests/overlay/long_borders.h"
#include "tests/support/sanitized.h"

using namespace geodesic;
using namespace geodesic::test;

namespace {

// The vertices of the places of a part.
std::set<uint32_t> vertices_of(const OverlayIndex& overlay, const BorderPart& part) {
    std::set<uint32_t> vertices;
    part.for_each_place([&](uint32_t place) { vertices.insert(overlay.rings.vertex[place]); });
    return vertices;
}

// The vertices of a chain from `steps` before one of them to `steps` behind it: around a closed chain, or as
// far as an open one goes.
std::set<uint32_t> along_chain(const Rings& rings, const Rings::Chain& chain, uint32_t place, int steps) {
    std::set<uint32_t> vertices;
    const auto count = static_cast<int64_t>(chain.last - chain.first + 1);
    for (int step = -steps; step <= steps; ++step) {
        int64_t at = int64_t{place} - chain.first + step;
        if (chain.is_closed) at = (at % count + count) % count;
        if (at >= 0 && at < count) vertices.insert(rings.vertex[chain.first + static_cast<size_t>(at)]);
    }
    return vertices;
}

// Whether a place of a chain is a sample within a limit, or comes between such a sample and the next one, or
// the end of an open chain, on either side.
bool is_beside_one_within(const Rings::Chain& chain, std::span<const uint16_t> places, uint32_t ring,
                          std::span<const float> values, float limit, uint32_t place) {
    const uint32_t count = chain.last - chain.first + 1;
    const auto sample_at = [&](uint32_t k) {
        return static_cast<size_t>(std::ranges::find(places, k - ring) - places.begin());
    };
    for (const uint32_t step : {1u, count - 1}) // on, and back
        for (uint32_t walked = 0, at = place - chain.first; walked < count; ++walked) {
            if (const size_t sample = sample_at(chain.first + at); sample < places.size()) {
                if (values[sample] <= limit) return true;
                if (walked > 0) break;
            }
            at = (at + step) % count;
            const bool is_past_an_end = step == 1 ? at == 0 : at == count - 1;
            if (is_past_an_end && !chain.is_closed) break;
        }
    return false;
}

// Of the places of a part that have none of these vertices, the most that follow each other.
uint32_t longest_run_beside(const Rings& rings, const BorderPart& part, const std::set<uint32_t>& vertices) {
    uint32_t longest = 0, run = 0;
    part.for_each_place([&](uint32_t place) {
        run = vertices.contains(rings.vertex[place]) ? 0 : run + 1;
        longest = std::max(longest, run);
    });
    return longest;
}

}

TEST_CASE("border parts: ranges are joined if few places lie between, or if there are too many") {
    BorderPart part({10, 14});
    part.add({19, 21}); // what kernels read of both touches
    CHECK(part.ranges().size() == 1);
    CHECK(part.size() == 12);
    part.add({27, 30});
    part.add({40, 40});
    part.add({50, 39 + 10}); // empty
    REQUIRE(part.ranges().size() == 3);
    CHECK(part.size() == 17);
    for (uint32_t i = 0; i < part.size(); ++i) CHECK(part.index(part.place(i)) == i);
    CHECK(part.place(12) == 27);
    CHECK(part.index(26) == NONE);
    CHECK(part.covers(BorderPart({12, 20})));
    CHECK(!part.covers(BorderPart({20, 30})));
    part.add({60, 61});
    part.add({70, 71});
    CHECK(part.ranges().size() == BorderPart::MOST_RANGES);
    CHECK(part.size() == 17 + 12);
    CHECK(part.index(65) == 17 + 5);
}

TEST_CASE("border parts: kernels read the segments of a ring, with gaps between ranges") {
    const OverlayOf& of = built().front();
    const Rings& rings = of.overlay().rings;
    const uint32_t first = rings.begin[1];
    REQUIRE(rings.size(1) > 60);
    BorderPart part({first + 3, first + 9});
    PartOfRing of_ring(rings, std::pmr::get_default_resource());
    of_ring.take(part);
    CHECK(of_ring.segments().length == rings.segment_length.data() + first + 3);
    part.add({first + 30, first + 41});
    of_ring.take(part);
    for (uint32_t i = 0; i < part.size(); ++i) {
        const uint32_t place = part.place(i);
        CHECK(of_ring.is_own()[i] == rings.is_own[place]);
        if (place == first + 9 || place == first + 41) {
            CHECK(std::isnan(of_ring.segments().length[i]));
            CHECK(std::isnan(of_ring.segments().half_inverse[i]));
        } else {
            CHECK(of_ring.segments().length[i] == rings.segment_length[place]);
            CHECK(of_ring.segments().half_inverse[i] == rings.half_inverse[place]);
        }
    }
}

TEST_CASE("border parts: each place lies well inside of the part beside it, or the border ends there") {
    uint32_t moved = 0, repeated = 0, in_two = 0;
    for (const OverlayOf& of : built()) {
        const OverlayIndex& overlay = of.overlay();
        const Rings& rings = overlay.rings;
        for (uint32_t p = 1; p < overlay.numbering.patch_count(); ++p) {
            const BorderRange whole = whole_border(rings, p);
            for (uint32_t first = whole.first; first <= whole.last; first += 3) {
                const BorderPart part({first, std::min(first + 10, whole.last)});
                part.for_each_place([&](uint32_t place) {
                    const BorderPart beside = part_beside(overlay, p, part, place);
                    REQUIRE(BorderPart(whole).covers(beside));
                    const uint32_t own = own_place(rings, overlay.numbering, p, rings.position[place]);
                    const auto chain = *std::ranges::find_if(rings.chains_of(p), [&](const Rings::Chain& c) {
                        return own >= c.first && own <= c.last;
                    });
                    const auto needed = along_chain(rings, chain, own, Rings::REACH);
                    CHECK(std::ranges::includes(vertices_of(overlay, beside), needed));
                    moved += !part.covers(beside);
                    repeated += rings.is_own[place] == 0;
                    in_two += beside.ranges().size() == 2;
                });
            }
        }
    }
    CHECK(moved > 100);
    CHECK(repeated > 100);
    CHECK(in_two > 100);
}

TEST_CASE("border parts: along each chain, from the sample before those within a limit to the one behind") {
    uint64_t smaller = 0, in_more = 0;
    std::mt19937 random(5);
    for (const OverlayOf& of : built()) {
        const OverlayIndex& overlay = of.overlay();
        const Rings& rings = overlay.rings;
        for (uint32_t p = 1; p < overlay.numbering.patch_count(); ++p) {
            const auto places = overlay.pairs.samples.of(p);
            if (places.empty()) continue;
            const BorderPart whole(whole_border(rings, p));
            std::vector<float> values(places.size());
            // So far apart that no way between two samples beyond a limit may be within it.
            for (float& value : values) value = 1e6f * static_cast<float>(random() % 100);
            for (const float limit : {-1e6f, 1e6f, 2e6f, 30e6f, 99e6f}) {
                const BorderPart part = part_within(overlay, p, values, limit);
                REQUIRE(whole.covers(part));
                std::set<uint32_t> needed;
                for (const auto& chain : rings.chains_of(p))
                    for (uint32_t k = chain.first; k <= chain.last; ++k)
                        if (is_beside_one_within(chain, places, rings.begin[p], values, limit, k))
                            needed.insert(rings.vertex[k]);
                const auto vertices = vertices_of(overlay, part);
                CHECK(std::ranges::includes(vertices, needed));
                if (needed.empty()) CHECK(part.covers(whole));
                smaller += vertices.size() < overlay.numbering.border_size(p);
                in_more += part.ranges().size() > 1;
                // Few places lie between ranges that are joined, unless there are too many ranges.
                if (!needed.empty() && part.ranges().size() < BorderPart::MOST_RANGES)
                    CHECK(longest_run_beside(rings, part, needed) <= 2 * Rings::REACH + 1);
            }
        }
    }
    CHECK(smaller > 20);
    CHECK(in_more > 20);
}

TEST_CASE("border parts: each has all bridges of its border" * doctest::skip(SANITIZED)) {
    static const TestMesh mesh = pages(4, 30, 40);
    const OverlayOf of(mesh, options_of_plane(mesh, {4, 3}));
    const OverlayIndex& overlay = of.overlay();
    uint32_t parts = 0;
    for (uint32_t p = 1; p < overlay.numbering.patch_count(); ++p) {
        const auto places = overlay.pairs.samples.of(p);
        if (places.size() < 3 || overlay.rings.bridge_places(p) == 0) continue;
        const auto check = [&](const BorderPart& part) {
            for_each_bridge(overlay.rings, p, [&](uint32_t place, float) {
                REQUIRE(part.index(place) != NONE);
                CHECK(part.index(place + 1) == part.index(place) + 1);
            });
            parts += part.size() < overlay.rings.size(p);
        };
        std::vector<float> lengths(places.size(), 1e9f);
        lengths[places.size() / 2] = 1;
        check(part_within(overlay, p, lengths, 2));
        for (uint32_t sample = 0; sample < places.size(); ++sample) {
            const BorderPart part =
                part_near(overlay, p, ways_near(overlay, p, sample, [&](uint32_t i) { return lengths[i]; }));
            check(part);
            const BorderPart beside = part_beside(overlay, p, part, part.place(0));
            check(beside);
            // It grows by what lies beside the place alone, however many bridges there are.
            CHECK(beside.size() <= 3 * part.size() + overlay.rings.bridge_places(p));
        }
    }
    CHECK(parts > 20);
}

// The ways that get longer on both sides of one place as fast as they can, which is twice the way along the
// border: the samples beside the place may be far from it.
TEST_CASE("border parts: no place is left out that a way within the limit may cross") {
    constexpr float SHORTEST = 10, FAR = 1e9f;
    TestMesh stretched = grid(100, 20);
    for (size_t i = 0; i < stretched.positions.size(); i += 3) stretched.positions[i] *= 40;
    const OverlayOf of_stretched(stretched, options_of_plane(stretched, {3, 12}));
    uint32_t far_from_samples = 0;
    const auto check = [&](const OverlayIndex& overlay, uint32_t p, const Rings::Chain& chain,
                           uint32_t valley) {
        const Rings& rings = overlay.rings;
        const auto along = [&](uint32_t from, uint32_t to) {
            float length = 0;
            for (uint32_t k = from; k < to; ++k) length += rings.segment_length[k];
            return length;
        };
        const float around = along(chain.first, chain.last + chain.is_closed);
        const float spacing = overlay.pairs.samples.spacing[p];
        float nearest_sample = FAR;
        std::vector<float> lengths;
        for (const uint16_t place : overlay.pairs.samples.of(p)) {
            const uint32_t at = rings.begin[p] + place;
            lengths.push_back(FAR);
            if (at < chain.first || at > chain.last) continue;
            float off = along(std::min(at, valley), std::max(at, valley));
            if (chain.is_closed) off = std::min(off, around - off);
            lengths.back() = SHORTEST + 2 * off;
            nearest_sample = std::min(nearest_sample, off);
        }
        far_from_samples += 2 * nearest_sample > MOST_LONGER * spacing;
        *std::ranges::max_element(lengths) = SHORTEST; // so that some sample is within the limit in any case
        const float limit = SHORTEST + MOST_LONGER * spacing;
        const BorderPart part = part_within(overlay, p, lengths, 1.0001f * limit);
        CHECK(vertices_of(overlay, part).contains(rings.vertex[valley]));
    };
    const auto check_all = [&](const OverlayIndex& overlay) {
        for (uint32_t p = 1; p < overlay.numbering.patch_count(); ++p)
            for (const auto& chain : overlay.rings.chains_of(p))
                for (uint32_t k = chain.first; k <= chain.last; ++k) check(overlay, p, chain, k);
    };
    for (const OverlayOf& of : built()) check_all(of.overlay());
    check_all(of_stretched.overlay());
    CHECK(far_from_samples > 0);
}

// A hop from a part with several ranges leads over the same places as one from the whole border, where the
// way lies well inside of the part. Near to the border, a way may be straightened over any segment of it,
// also one beside the part, so that the leaves are wide here.
TEST_CASE("border parts: ways over several ranges are those over the whole border") {
    const TestMesh mesh = grid(120, 60);
    const OverlayOf of(mesh, options_of_plane(mesh, {3, 3}));
    const OverlayIndex& overlay = of.overlay();
    const Numbering& numbering = overlay.numbering;
    const Rings& rings = overlay.rings;
    BorderCrossing crossing(overlay, std::pmr::get_default_resource());
    MeasuredEnd by_whole(overlay, std::pmr::get_default_resource()), by_part = by_whole;
    uint32_t same = 0, longer = 0, wrong = 0;
    std::mt19937 random(11);
    const auto compare = [&](uint32_t leaf, uint32_t inner) {
        const uint32_t parent = numbering.parent[leaf];
        Ascent ascent(overlay, std::pmr::get_default_resource());
        ascent.patches = {leaf, parent};
        ascent.first_row = inner_row_of(overlay, inner);
        const BorderPart whole(whole_border(rings, leaf)), above(whole_border(rings, parent));
        float nearest = INFINITE;
        whole.for_each_place([&](uint32_t k) { nearest = std::min(nearest, ascent.first_row(k)); });
        if (nearest <= near_segments(numbering.vertex_count()) * overlay.longest_segment[leaf]) return;
        BorderPart part;
        for (uint32_t k = rings.begin[leaf]; k + 12 < rings.begin[leaf + 1];
             k += 20 + static_cast<uint32_t>(random() % 5))
            part.add({k, k + 10});
        by_whole.begin();
        by_part.begin();
        by_whole.measure(ascent, std::vector{whole, above}, crossing);
        by_part.measure(ascent, std::vector{part, above}, crossing);
        for (uint32_t i = 0; i < above.size(); ++i) {
            const uint32_t place = above.place(i);
            const float way = by_whole.last_distances()[i], over_part = by_part.last_distances()[i];
            const uint32_t winner = rings.begin[leaf] + by_whole.winner_before(1, place);
            longer += over_part > way;
            if (!part.covers(BorderPart({winner - Rings::REACH, winner + Rings::REACH}))) continue;
            // Codes of distances are rounded from the nearest place on, which may be another one.
            const auto beside = static_cast<int>(by_part.winner_before(1, place)) -
                                static_cast<int>(by_whole.winner_before(1, place));
            const bool is_same = std::abs(over_part - way) <= 1e-3f * way &&
                                 std::abs(beside) <= static_cast<int>(Rings::REACH);
            ++(is_same ? same : wrong);
        }
    };
    for (uint32_t leaf = numbering.first_leaf(); leaf < numbering.patch_count(); ++leaf)
        for (uint32_t i = 0; i < numbering.inner_size(leaf); i += 29)
            compare(leaf, numbering.first_inner(leaf) + i);
    CHECK(same > 100);
    CHECK(longer > 100);
    CHECK(wrong == 0);
}

// The ring of a border begins at some vertex of a closed chain. Ways that cross the border near this vertex
// are found as those anywhere else.
TEST_CASE("border parts: pairs find ways over the place where a ring is cut open") {
    uint32_t count = 0, over_a_hundredth = 0;
    double largest = 0;
    const OverlayOf& of = built().back();
    const TestMesh& mesh = wide();
    const OverlayIndex& overlay = of.overlay();
    OverlaySssd pairs(overlay, std::pmr::get_default_resource());
    const auto ids = ids_by_number(of.index);
    for (uint32_t p = 1; p < overlay.numbering.patch_count(); ++p)
        for (const auto& chain : overlay.rings.chains_of(p)) {
            if (!chain.is_closed) continue;
            const uint32_t id = ids[overlay.rings.vertex[chain.first]], x = id % WIDE_X, y = id / WIDE_X;
            for (uint32_t source_y = y - std::min(y, 3u); source_y <= y; ++source_y)
                for (uint32_t target_y = y; target_y <= std::min(y + 3, WIDE_Y - 1); ++target_y)
                    for (uint32_t dx = 0; dx <= 12; dx += 2) {
                        const uint32_t source = source_y * WIDE_X + x - std::min(x, dx),
                                       target = target_y * WIDE_X + std::min(x + dx, WIDE_X - 1);
                        if (source == target) continue;
                        const auto [low, high] =
                            std::minmax({of.index.number_of_id[source], of.index.number_of_id[target]});
                        const double straight = mesh.straight(source, target);
                        const double answer = double{pairs.distance(low, high)};
                        const double error = std::abs(answer - straight) / straight;
                        largest = std::max(largest, error);
                        over_a_hundredth += error > 0.01;
                        ++count;
                    }
        }
    CHECK(count > 500);
    CHECK(largest < 0.05);
    CHECK(over_a_hundredth <= count / 100);
}
