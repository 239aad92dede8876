// What the overlay engine derives from a file, foreseen from its counts.
#include "src/overlay/prepare/proportion.h"

#include <random>

#include <doctest/doctest.h>

#include "src/overlay/sssd/label_rows.h"
#include "tests/overlay/overlay_of.h"
#include "tests/support/meshes.h"
#include "tests/support/sanitized.h"

using namespace geodesic;
using namespace geodesic::test;

namespace {

// As they were made, without padding.
uint64_t sample_codes(const OverlayIndex& index) {
    return index.pairs.samples.codes.size() - TableCode::PADDING;
}
uint64_t label_codes(const OverlayIndex& index) {
    const Labels& labels = *index.pairs.labels;
    uint64_t codes = 0;
    for (uint32_t p = 1; p < index.numbering.patch_count(); ++p)
        for (uint32_t q = index.numbering.parent[p]; q != NONE; q = index.numbering.parent[q])
            if (labels.is_labelled[q]) codes += uint64_t{index.numbering.inner_size(p)} * index.rings.size(q);
    const uint64_t bytes = labels.rows ? labels.rows.get_deleter().size : 0;
    CHECK(bytes <= sizeof(uint16_t) * codes + LABEL_ROW_PADDING * index.numbering.patch_count());
    return codes;
}
uint64_t codes_made(const OverlayIndex& index) {
    return index.hops.border_begin.back() + index.hops.owned_begin.back() +
           3 * index.hops.inner_begin.back() / 2 + (index.hops.on_border_begin.back() + 15) / 16 +
           index.bounds.codes.size() + sample_codes(index) + label_codes(index);
}

}

TEST_CASE("proportion: as many codes are derived as are foreseen, and they are few" *
          doctest::skip(SANITIZED)) {
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

TEST_CASE("proportion: bounds, tables of samples and labels are foreseen" * doctest::skip(SANITIZED)) {
    const TestMesh mesh = pressed(grid(300, 7), 0.01);
    for (const auto patches : {std::initializer_list<uint32_t>{2}, {2, 3, 2}}) {
        CAPTURE(patches.size());
        const OverlayOf built(mesh, options_of_plane(mesh, patches));
        const OverlayIndex& index = built.overlay();
        CHECK(index.bounds.codes.size() > 1000);
        CHECK(sample_codes(index) > 10000);
        CHECK((label_codes(index) > 0) == (patches.size() > 1));
        CHECK(derived_codes(index) == codes_made(index));
    }
}

// Most triangles have no edge in common with another one, so that each is a patch, and a few hundred vertices
// are on the borders of a thousand patches. Some hundred triangles are one patch with a long border.
TEST_CASE("proportion: many patches that share few vertices") {
    constexpr uint32_t VERTICES = 300, TRIANGLES = 6500;
    TestMesh mesh;
    std::mt19937_64 random(5);
    for (uint32_t i = 0; i < 3 * VERTICES; ++i) mesh.positions.push_back(uniform(random, 0, 1));
    for (uint32_t i = 0; i < 3 * TRIANGLES; ++i)
        mesh.triangles.push_back(static_cast<uint32_t>(random() % VERTICES));
    const OverlayOf built(mesh, build_options(GEOIDX_METRIC_EXACT, 1));
    const OverlayIndex& index = built.overlay();
    CHECK(index.numbering.patch_count() > 500);
    CHECK(index.rings.largest_size() > 400);
    CHECK(derived_codes(index) == codes_made(index));
    CHECK(derived_codes(index) < 40 * stored_numbers(index));
}
