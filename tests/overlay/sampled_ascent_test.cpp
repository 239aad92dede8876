// Ways over samples, by which SSSD finds what a path may cross.
#include "src/overlay/sssd/sampled_ascent.h"

#include <algorithm>
#include <random>

#include "src/overlay/sssd/pair_tables.h"
#include "tests/overlay/long_borders.h"
#include "tests/support/sanitized.h"

using namespace geodesic;
using namespace geodesic::test;

namespace {

// The ways over each sample of a border, back from those over the samples of the next one: its own distance,
// and the least step to a sample of the next border and the rest from there. A step is what way_over() adds.
std::vector<float> rests_before(const SampledAscent& sampled, size_t border,
                                const std::vector<float>& rests) {
    const auto before = sampled.distances(border - 1);
    std::vector<float> found(before.size(), INFINITE);
    for (uint32_t i = 0; i < before.size(); ++i)
        for (uint32_t j = 0; j < rests.size(); ++j)
            found[i] = std::min(found[i], sampled.way_over(border, i, j) - before[i] + rests[j]);
    return found;
}

}

TEST_CASE("sampled ascent: the ways back are the least ones over all samples" * doctest::skip(SANITIZED)) {
    std::mt19937 random(3);
    uint64_t compared = 0;
    const TestMesh mesh = pressed(grid(150, 100), 0.2);
    const OverlayOf of(mesh, options_of_plane(mesh, {4, 5, 4}));
    const OverlayIndex& overlay = of.overlay();
    const Numbering& numbering = overlay.numbering;
    SampledAscent sampled(overlay, std::pmr::get_default_resource());
    Ascent ascent(overlay, std::pmr::get_default_resource());
    for (uint32_t leaf = numbering.first_leaf(); leaf < numbering.patch_count(); leaf += 3) {
        ascent.patches.clear();
        for (uint32_t p = leaf; p != 0; p = numbering.parent[p]) ascent.patches.push_back(p);
        ascent.first_row = inner_row_of(overlay, numbering.first_inner(leaf));
        sampled.climb(ascent);
        const uint32_t top = ascent.last_patch(), siblings = numbering.child_begin[0];
        sampled.hop_across(ascent, top == siblings ? siblings + 1 : siblings);
        const size_t borders = ascent.patches.size() + 1;
        std::vector<float> rests(sampled.last_distances().size());
        for (float& rest : rests) rest = random() % 10 == 0 ? INFINITE : static_cast<float>(random() % 40);
        rests.front() = 7;
        sampled.go_back(rests);
        for (size_t b = borders; b-- > 0;) {
            const auto ways = sampled.ways_over(b);
            REQUIRE(ways.size() == rests.size());
            for (size_t i = 0; i < ways.size(); ++i) {
                const float way = sampled.distances(b)[i] + rests[i];
                if (way < INFINITE)
                    CHECK(double{ways[i]} == doctest::Approx(double{way}).epsilon(1e-3));
                else
                    CHECK(ways[i] == INFINITE);
                ++compared;
            }
            if (b > 0) rests = rests_before(sampled, b, rests);
        }
    }
    CHECK(compared > 1000);
}
