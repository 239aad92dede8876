// What the overlay engine derives from a file, foreseen from its counts.
#include "src/overlay/proportion.h"

#include <doctest/doctest.h>

#include "src/build/build.h"
#include "tests/capi/calls.h"

using namespace geodesic;
using namespace geodesic::test;

namespace {

OverlayIndex build_overlay(const TestMesh& mesh, geoidx_build_options options) {
    options.engine = GEOIDX_ENGINE_OVERLAY;
    Index index(std::pmr::get_default_resource());
    build_index(mesh.view(), options, index);
    return std::get<OverlayIndex>(std::move(index.engine));
}

// As it was made, without padding.
uint64_t codes_made(const OverlayIndex& index) {
    return index.hops.outer.size() + index.hops.inner.size() + index.hops.inner_middles.size() +
           index.samples.tables.size() + index.labels.codes.size() - 4 * TableCode::PADDING;
}

}

TEST_CASE("proportion: as many codes are derived as are foreseen, and they are few") {
    for (uint32_t metric : {GEOIDX_METRIC_EXACT, GEOIDX_METRIC_EDGES})
        for (uint32_t levels : {1u, 2u, 3u}) {
            CAPTURE(metric);
            CAPTURE(levels);
            auto options = build_options(metric, levels);
            options.patches[0] = 2; // a border that is sampled
            const OverlayIndex index = build_overlay(grid(4, 220), options);
            CHECK(derived_codes(index) == codes_made(index));
            CHECK(derived_codes(index) < 40 * stored_numbers(index));
        }
}

TEST_CASE("proportion: coarse tables and labels to samples are foreseen") {
    auto options = build_options(GEOIDX_METRIC_EDGES, 2);
    options.patches[0] = options.patches[1] = 3;
    options.exact_vertices = 1;
    const OverlayIndex index = build_overlay(grid(300, 6), options);
    CHECK(derived_codes(index) == codes_made(index));
}
