// What the overlay engine derives from a file, foreseen from its counts.
#include "src/overlay/proportion.h"

#include <doctest/doctest.h>

#include "tests/overlay/overlay_of.h"

using namespace geodesic;
using namespace geodesic::test;

namespace {

// As it was made, without padding.
uint64_t codes_made(const OverlayIndex& index) {
    return index.hops.outer_begin.back() + 2 * index.hops.inner_begin.back() +
           index.pairs.samples.tables.size() + index.pairs.labels.codes.size() - TableCode::PADDING;
}

uint64_t coarse_codes(const OverlayIndex& index) {
    return index.pairs.samples.tables.size() - TableCode::PADDING;
}

// The number of patches whose inner vertices have labels to the samples of a border, and not to all of it.
uint32_t labels_to_samples(const OverlayIndex& index) {
    const Numbering& numbering = index.numbering;
    uint32_t patches = 0;
    for (uint32_t p = 1; p < numbering.patch_count(); ++p) {
        const uint32_t parent = numbering.parent[p], size = numbering.border_size(parent);
        patches += parent != 0 && size > Labels::WHOLE && index.pairs.samples.of(parent).size() < size;
    }
    return patches;
}

}

TEST_CASE("proportion: as many codes are derived as are foreseen, and they are few") {
    for (uint32_t metric : {GEOIDX_METRIC_EXACT, GEOIDX_METRIC_EDGES})
        for (uint32_t levels : {1u, 2u, 3u}) {
            CAPTURE(metric);
            CAPTURE(levels);
            const OverlayOf built(grid(4, 220), build_options(metric, levels));
            const OverlayIndex& index = built.overlay();
            CHECK(derived_codes(index) == codes_made(index));
            CHECK(derived_codes(index) < 40 * stored_numbers(index));
        }
}

// What has coarse tables has chains of segments, which no metric along edges has.
TEST_CASE("proportion: coarse tables and labels to samples are foreseen") {
    const TestMesh mesh = pressed(grid(420, 7), 0.01);
    for (const auto patches : {std::initializer_list<uint32_t>{2}, {2, 3}}) {
        CAPTURE(patches.size());
        const OverlayOf built(mesh, options_of_plane(mesh, patches));
        const OverlayIndex& index = built.overlay();
        CHECK(coarse_codes(index) > 10000);
        CHECK((labels_to_samples(index) > 0) == (patches.size() > 1));
        CHECK(derived_codes(index) == codes_made(index));
    }
}
