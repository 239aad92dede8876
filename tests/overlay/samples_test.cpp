// The samples of borders, over which SSSD looks for ways first.
#include "src/overlay/sssd/samples.h"

#include <algorithm>
#include <cmath>
#include <random>

#include "tests/overlay/long_borders.h"
#include "tests/support/sanitized.h"

using namespace geodesic;
using namespace geodesic::test;

namespace {

std::vector<uint32_t> vertices_of_samples(const OverlayIndex& overlay, uint32_t patch) {
    std::vector<uint32_t> vertices;
    for (const uint16_t place : overlay.pairs.samples.of(patch))
        vertices.push_back(overlay.rings.vertex[overlay.rings.begin[patch] + place]);
    return vertices;
}

}

TEST_CASE("samples: own places of the ring, in its order") {
    for (const OverlayOf& of : built()) {
        const OverlayIndex& overlay = of.overlay();
        for (uint32_t p = 1; p < overlay.numbering.patch_count(); ++p) {
            const auto samples = overlay.pairs.samples.of(p);
            CHECK(std::ranges::is_sorted(samples, std::less_equal<>()));
            for (const uint16_t place : samples) {
                REQUIRE(place < overlay.rings.size(p));
                CHECK(overlay.rings.is_own[overlay.rings.begin[p] + place] == -1);
            }
        }
    }
}

TEST_CASE("samples: a vertex that is one of a border is one of all borders beside it and inside") {
    uint64_t common = 0;
    for (const OverlayOf& of : built()) {
        const OverlayIndex& overlay = of.overlay();
        const Numbering& numbering = overlay.numbering;
        std::vector<uint8_t> is_sample(numbering.border_vertex_count(), 0);
        for (uint32_t level = 1; level <= numbering.level_count(); ++level) {
            const uint32_t first = numbering.level_begin[level], end = numbering.level_begin[level + 1];
            for (uint32_t p = first; p < end; ++p)
                for (const uint32_t vertex : vertices_of_samples(overlay, p)) is_sample[vertex] = 1;
            for (uint32_t p = first; p < end; ++p) {
                const auto samples = vertices_of_samples(overlay, p);
                for (const uint32_t vertex : numbering.border_of(p)) {
                    if (!is_sample[vertex]) continue;
                    ++common;
                    CHECK(std::ranges::find(samples, vertex) != samples.end());
                }
            }
        }
    }
    CHECK(common > 100);
}

// The samples of a chain by their places over all rings; behind the last one of a closed chain follows the
// first one again, as if the chain went on.
std::vector<uint32_t> places_along(const Rings::Chain& chain, std::span<const uint16_t> samples,
                                   uint32_t first_place) {
    std::vector<uint32_t> places;
    for (const uint16_t place : samples)
        if (first_place + place >= chain.first && first_place + place <= chain.last)
            places.push_back(first_place + place);
    REQUIRE(!places.empty());
    if (chain.is_closed) {
        places.push_back(places.front() + chain.last - chain.first + 1);
    } else {
        CHECK(places.front() == chain.first);
        CHECK(places.back() == chain.last);
    }
    return places;
}

// The longest way along a chain from a sample to the next one, in vertices.
uint32_t longest_gap(const Rings::Chain& chain, std::span<const uint16_t> samples, uint32_t first_place) {
    const auto places = places_along(chain, samples, first_place);
    uint32_t longest = 0;
    for (size_t i = 0; i + 1 < places.size(); ++i) longest = std::max(longest, places[i + 1] - places[i]);
    return longest;
}

// The most that there are if every second vertex is a sample, and both ends of each open chain.
size_t every_second(const OverlayIndex& overlay, uint32_t patch) {
    size_t most = 0;
    for (const auto& chain : overlay.rings.chains_of(patch)) {
        const size_t size = chain.last - chain.first + 1;
        most += chain.is_closed ? (size + 1) / 2 : size / 2 + 1;
    }
    return most;
}

TEST_CASE("samples: about 64 of a border, more of one that is long for its mesh, along every chain") {
    uint32_t open_chains = 0, closed_chains = 0, long_borders = 0;
    for (const OverlayOf& of : built()) {
        const OverlayIndex& overlay = of.overlay();
        for (uint32_t p = 1; p < overlay.numbering.patch_count(); ++p) {
            const auto samples = overlay.pairs.samples.of(p);
            const uint32_t size = overlay.numbering.border_size(p);
            const double extent = std::sqrt(static_cast<double>(overlay.numbering.vertex_count()));
            const double step = std::clamp(std::min(size / 64.0, extent / 40), 2.0, 10.0);
            if (size > 128) CHECK(samples.size() >= 56);
            if (overlay.numbering.parent[p] == 0)
                CHECK(samples.size() <= std::max(size_t{192}, every_second(overlay, p)));
            long_borders += size > 128;
            for (const auto& chain : overlay.rings.chains_of(p)) {
                CHECK(longest_gap(chain, samples, overlay.rings.begin[p]) <= 1.5 * step + 1);
                ++(chain.is_closed ? closed_chains : open_chains);
            }
        }
    }
    CHECK(open_chains > 0);
    CHECK(closed_chains > 0);
    CHECK(long_borders > 0);
}

// Between two vertices that are samples already, the number of pieces is rounded, so that one has up to one
// and a half spacings; and it ends at a vertex, up to a segment later, which is no longer than a spacing.
TEST_CASE("samples: no farther apart where edges are longer than elsewhere on a border" *
          doctest::skip(SANITIZED)) {
    TestMesh mesh = grid(400, 9);
    for (size_t i = 0; i < mesh.positions.size(); i += 3) {
        double& x = mesh.positions[i];
        x = x < 340 ? 0.002 * x : 0.002 * 340 + 0.05 * (x - 340);
    }
    const OverlayOf of(mesh, options_of_plane(mesh, {2, 3}));
    const OverlayIndex& overlay = of.overlay();
    uint32_t compared = 0;
    for (uint32_t p = 1; p < overlay.numbering.patch_count(); ++p) {
        const float spacing = overlay.pairs.samples.spacing[p];
        for (const auto& chain : overlay.rings.chains_of(p)) {
            const auto places = places_along(chain, overlay.pairs.samples.of(p), overlay.rings.begin[p]);
            for (size_t i = 0; i + 1 < places.size(); ++i) {
                if (places[i + 1] - places[i] == 1) continue; // a segment may have any length
                double length = 0;
                for (uint32_t k = places[i]; k < places[i + 1]; ++k) {
                    const uint32_t place = k <= chain.last ? k : k - (chain.last - chain.first + 1);
                    length += double{overlay.rings.segment_length[place]};
                }
                CHECK(length <= 2.5 * double{spacing});
                ++compared;
            }
        }
    }
    CHECK(compared > 100);
}

TEST_CASE("samples: both ends of each segment that is longer than samples are apart" *
          doctest::skip(SANITIZED)) {
    // Rows of short edges, joined by edges that are a hundred times as long.
    const OverlayOf of(strip(), options_of_plane(strip(), {2, 3}));
    const OverlayIndex& overlay = of.overlay();
    const Samples& samples = overlay.pairs.samples;
    uint32_t count = 0;
    for (uint32_t p = 1; p < overlay.numbering.patch_count(); ++p) {
        const uint32_t begin = overlay.rings.begin[p];
        uint32_t found = 0;
        for (uint32_t k = begin; k < overlay.rings.begin[p + 1]; ++k)
            found += overlay.rings.is_own[k] && overlay.rings.segment_length[k] > samples.spacing[p];
        REQUIRE(samples.long_segments_of(p).size() == found);
        for (const auto& [first, second, length] : samples.long_segments_of(p)) {
            REQUIRE(std::max(first, second) < samples.of(p).size());
            const uint32_t from = begin + samples.of(p)[first], to = begin + samples.of(p)[second];
            CHECK(overlay.rings.segment_length[from] == length);
            CHECK(overlay.rings.vertex[from + 1] == overlay.rings.vertex[to]);
            ++count;
        }
    }
    CHECK(count > 2);
}

TEST_CASE("samples: all vertices, where none are joined by segments" * doctest::skip(SANITIZED)) {
    const OverlayOf of(hills(60, 50), build_options(GEOIDX_METRIC_EDGES, 1));
    const OverlayIndex& overlay = of.overlay();
    for (uint32_t p = 1; p < overlay.numbering.patch_count(); ++p)
        CHECK(overlay.pairs.samples.of(p).size() == overlay.numbering.border_size(p));
}

// A way up along the border that it begins at is longer by half of what samples are apart.
TEST_CASE("samples: their tables are entries of the overlay tables, but between vertices of one border" *
          doctest::skip(SANITIZED)) {
    uint64_t up = 0, across = 0, wrong = 0;
    for (const OverlayOf& of : built()) {
        const OverlayIndex& overlay = of.overlay();
        const Numbering& numbering = overlay.numbering;
        const Samples& samples = overlay.pairs.samples;
        const auto position = [&](uint32_t p, uint16_t place) {
            return overlay.rings.position[overlay.rings.begin[p] + place];
        };
        const auto overlay_position = [&](uint32_t p, uint16_t place) {
            return numbering.overlay_position[numbering.border_begin[p] + position(p, place)];
        };
        // The code for a sample on a border of `patch` and an overlay position of its parent; along the
        // border, where it is made longer, with what rounding may change.
        struct Expected {
            int code, rounding = 0;
        };
        const auto expected = [&](uint32_t patch, uint16_t place, uint32_t other, bool along) -> Expected {
            const uint32_t parent = numbering.parent[patch], own = overlay_position(patch, place);
            const uint16_t code = overlay.overlay_code(parent, own, other);
            if (numbering.border_position(patch, numbering.overlay_number(parent, other)) == NONE)
                return {code};
            if (other == own) return {0};
            if (!along || code == TableCode::UNREACHED) return {TableCode::UNREACHED};
            const double longer = 0.5 * double{samples.spacing[patch]} / double{overlay.quantum[parent]};
            return {std::min(code + static_cast<int>(longer), int{TableCode::LARGEST}), 1};
        };
        const auto differs = [](uint16_t code, const Expected& from) {
            return std::abs(code - from.code) > from.rounding;
        };
        for (uint32_t p = 1; p < numbering.patch_count(); ++p) {
            const uint32_t parent = numbering.parent[p];
            const auto from = samples.of(p), above = samples.of(parent);
            const uint16_t* code = samples.codes.data() + samples.up_begin[p];
            for (size_t i = 0; i < from.size(); ++i)
                for (size_t j = 0; j < above.size(); ++j, ++up)
                    wrong += differs(*code++, expected(p, from[i], position(parent, above[j]), true));
            if (!samples.has_table_across(p)) continue;
            for (uint32_t s = numbering.child_begin[parent]; s < numbering.child_begin[parent + 1]; ++s) {
                const auto beside = samples.of(s);
                const uint16_t* row = samples.rows_across(numbering, s, p);
                for (size_t i = 0; i < beside.size(); ++i)
                    for (size_t j = 0; j < from.size(); ++j, ++across)
                        wrong += differs(*row++, expected(p, from[j], overlay_position(s, beside[i]), false));
            }
        }
        CHECK(samples.codes.size() == count_sample_codes(overlay) + TableCode::PADDING);
    }
    CHECK(wrong == 0);
    CHECK(up > 1000);
    CHECK(across > 1000);
}

TEST_CASE("samples: beside each lies the next one of its chain, around a closed one") {
    uint32_t around = 0, ends = 0;
    for (const OverlayOf& of : built()) {
        const OverlayIndex& overlay = of.overlay();
        for (uint32_t p = 1; p < overlay.numbering.patch_count(); ++p) {
            const auto places = overlay.pairs.samples.of(p);
            for (const auto& chain : overlay.rings.chains_of(p)) {
                std::vector<uint32_t> in_chain;
                for (uint32_t s = 0; s < places.size(); ++s)
                    if (const uint32_t k = overlay.rings.begin[p] + places[s];
                        k >= chain.first && k <= chain.last)
                        in_chain.push_back(s);
                for (size_t i = 0; i < in_chain.size(); ++i) {
                    const bool at_begin = i == 0, at_end = i + 1 == in_chain.size();
                    const uint32_t before = at_begin ? in_chain.back() : in_chain[i - 1],
                                   behind = at_end ? in_chain.front() : in_chain[i + 1];
                    const auto beside = neighbouring_samples(overlay, p, in_chain[i]);
                    CHECK(beside.previous == (at_begin && !chain.is_closed ? NONE : before));
                    CHECK(beside.next == (at_end && !chain.is_closed ? NONE : behind));
                    (chain.is_closed ? around : ends) += at_begin || at_end;
                }
            }
        }
    }
    CHECK(around > 10);
    CHECK(ends > 0);
}
