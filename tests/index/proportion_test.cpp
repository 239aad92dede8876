// What the overlay engine derives from a file, foreseen from its counts.
#include "src/index/proportion.h"

#include <doctest/doctest.h>

#include "src/build/build.h"
#include "tests/capi/calls.h"

using namespace geodesic;
using namespace geodesic::test;

namespace {

void build_overlay(const TestMesh& mesh, geoidx_build_options options, Index& index) {
    options.engine = GEOIDX_ENGINE_OVERLAY;
    build_index(mesh.view(), options, index);
}

// As it was made, without padding.
uint64_t codes_made(const OverlayTables& tables) {
    return tables.outer_tables.size() + tables.inner_tables.size() + tables.inner_middles.size() +
           tables.coarse_tables.size() + tables.labels.size() - 4 * OverlayTables::PADDING;
}

}

TEST_CASE("proportion: as many codes are derived as are foreseen, and they are few") {
    for (uint32_t metric : {GEOIDX_METRIC_EXACT, GEOIDX_METRIC_EDGES})
        for (uint32_t levels : {1u, 2u, 3u}) {
            CAPTURE(metric);
            CAPTURE(levels);
            auto options = build_options(metric, levels);
            options.patches[0] = 2; // a border that is sampled
            Index index(std::pmr::get_default_resource());
            build_overlay(grid(4, 220), options, index);
            CHECK(derived_codes(index) == codes_made(index.overlay_tables));
            CHECK(derived_codes(index) < 40 * stored_numbers(index));
        }
}

TEST_CASE("proportion: coarse tables and labels to samples are foreseen") {
    auto options = build_options(GEOIDX_METRIC_EDGES, 2);
    options.patches[0] = options.patches[1] = 3;
    options.exact_vertices = 1;
    Index index(std::pmr::get_default_resource());
    build_overlay(grid(300, 6), options, index);
    CHECK(derived_codes(index) == codes_made(index.overlay_tables));
}
