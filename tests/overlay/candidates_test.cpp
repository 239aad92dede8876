// The candidates of a pair: samples of one border that the shortest path may pass near.
#include "src/overlay/sssd/candidates.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "tests/overlay/long_borders.h"

using namespace geodesic;
using namespace geodesic::test;

namespace {

// The ways between two ends on both sides of a straight border, of which the samples are a spacing apart. The
// line between the ends crosses it at `foot`, and they are so far from it, all in spacings.
struct StraightBorder {
    StraightBorder(const OverlayIndex& of_index, uint32_t of_patch, double foot, double from_height,
                   double to_height)
        : index(of_index), patch(of_patch), spacing(index.pairs.samples.spacing[patch]) {
        for (size_t i = 0; i < index.pairs.samples.of(patch).size(); ++i) {
            const double along = static_cast<double>(i) - foot;
            from.push_back(spacing * static_cast<float>(std::hypot(along, from_height)));
            to.push_back(spacing * static_cast<float>(std::hypot(along, to_height)));
        }
        take_lengths();
    }

    void take_lengths() {
        lengths.resize(from.size());
        for (size_t i = 0; i < from.size(); ++i) lengths[i] = from[i] + to[i];
    }
    Candidates find() const {
        const WaysOverSamples ways{from, to, lengths};
        return find_candidates(index, patch, ways, ways.least(), spacing);
    }

    const OverlayIndex& index;
    uint32_t patch;
    float spacing;
    std::vector<float> from, to, lengths;
};

// A patch with one open border of many samples.
uint32_t patch_of_strip(const OverlayIndex& overlay) {
    for (uint32_t p = 1; p < overlay.numbering.patch_count(); ++p) {
        const auto chains = overlay.rings.chains_of(p);
        if (chains.size() == 1 && !chains.front().is_closed && overlay.pairs.samples.of(p).size() > 20)
            return p;
    }
    FAIL("no such patch");
    return NONE;
}

const OverlayIndex& long_strip() { return built().front().overlay(); }

}

TEST_CASE("candidates: where a straight line crosses a straight border, however near the ends are") {
    const uint32_t patch = patch_of_strip(long_strip());
    for (const double foot : {7.2, 9.5, 10.0, 12.9})
        for (const double from : {0.05, 0.5, 3.0, 40.0})
            for (const double to : {0.05, 2.0, 20.0, 500.0}) {
                CAPTURE(foot);
                CAPTURE(from);
                CAPTURE(to);
                const StraightBorder border(long_strip(), patch, foot, from, to);
                const Candidates candidates = border.find();
                REQUIRE(candidates.begin() != candidates.end());
                CHECK(std::abs(*candidates.begin() - foot) <= 0.5 + 1e-3);
                CHECK(!candidates.are_unsure);
            }
}

TEST_CASE("candidates: unsure where ways go up and down among those that may be the shortest") {
    const uint32_t patch = patch_of_strip(long_strip());
    for (const double height : {4.0, 30.0}) {
        // The way over a sample becomes so many spacings shorter, and those beside it are longer on both
        // sides.
        const auto with_valley = [&](uint32_t sample, float depth) {
            StraightBorder border(long_strip(), patch, 10, height, 30);
            border.from[sample] -= depth * border.spacing;
            border.take_lengths();
            return border.find();
        };
        CHECK(!with_valley(11, 0.15f).are_unsure);
        CHECK(with_valley(11, 0.6f).are_unsure);
        CHECK(with_valley(10, 0.6f).are_unsure);
    }
    // Where the border ends, nothing tells how ways go on.
    StraightBorder at_end(long_strip(), patch, 0, 4, 30);
    at_end.from[0] -= 2 * at_end.spacing;
    at_end.take_lengths();
    CHECK(*at_end.find().begin() == 0);
    CHECK(!at_end.find().are_unsure);
    // Far from where the line crosses, ways are longer by more than they can get shorter.
    StraightBorder border(long_strip(), patch, 3, 1, 1);
    border.from[18] -= 0.6f * border.spacing;
    border.take_lengths();
    CHECK(!border.find().are_unsure);
}

TEST_CASE("candidates: none where no way leads over the border") {
    const uint32_t patch = patch_of_strip(long_strip());
    StraightBorder border(long_strip(), patch, 10, 5, 5);
    std::ranges::fill(border.from, INFINITE);
    border.take_lengths();
    const Candidates candidates = border.find();
    CHECK(candidates.begin() == candidates.end());
    CHECK(!candidates.are_unsure);
}
