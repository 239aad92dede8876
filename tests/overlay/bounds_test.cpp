// Rows along long borders are read only where their bounds allow a short way.
#include "src/overlay/prepare/bounds.h"

#include <cstring>

#include <doctest/doctest.h>

#include "src/overlay/fields/ssad.h"
#include "tests/overlay/overlay_of.h"
#include "tests/support/sanitized.h"

using namespace geodesic;
using namespace geodesic::test;

namespace {

uint64_t wrong_bounds(const OverlayIndex& index, uint32_t patch) {
    const size_t places = index.rings.size(patch), blocks = InnerBounds::blocks(places);
    const int16_t* const strides = index.strides.of(patch);
    uint64_t wrong = 0;
    for (uint32_t i = 0; i < index.numbering.inner_size(patch); ++i) {
        std::vector<uint16_t> least(blocks, TableCode::UNREACHED);
        for (size_t k = 0; k < places; ++k) {
            const uint64_t entry = index.inner_row(patch, i) + k;
            const uint16_t code = index.hops.inner[entry], next = index.hops.inner[entry + 1];
            uint16_t& of_block = least[k / InnerBounds::PLACES];
            of_block = std::min(of_block, code);
            if (strides[k] > 0)
                of_block = std::min(
                    of_block, MiddleOffset::code(code, next, index.hops.inner_middles[entry], strides[k]));
        }
        const uint16_t* bounds = index.bounds.codes.data() + index.bounds.begin[patch] + i * blocks;
        wrong += !std::equal(least.begin(), least.end(), bounds);
    }
    return wrong;
}

}

TEST_CASE("bounds: the least code of each block, along long borders only" * doctest::skip(SANITIZED)) {
    const OverlayOf built(mesh_of_long_borders(), options_of_plane(mesh_of_long_borders(), {2, 2, 3}));
    const OverlayIndex& index = built.overlay();
    uint32_t bounded = 0, others = 0;
    for (uint32_t p = 0; p < index.numbering.patch_count(); ++p)
        if (InnerBounds::are_kept(index.rings.size(p))) {
            CHECK(wrong_bounds(index, p) == 0);
            bounded += index.numbering.inner_size(p) > 0;
        } else {
            CHECK(index.bounds.begin[p] == index.bounds.begin[p + 1]);
            others += index.numbering.inner_size(p) > 0;
        }
    CHECK(bounded > 0);
    CHECK(others > 0);
}

TEST_CASE("bounds: a source alone has the answers that it has in a batch, which reads whole rows" *
          doctest::skip(SANITIZED)) {
    const OverlayOf built(mesh_of_long_borders(), options_of_plane(mesh_of_long_borders(), {2, 2, 3}));
    const OverlayIndex& index = built.overlay();
    const auto memory = std::pmr::get_default_resource();
    const size_t count = index.numbering.vertex_count(), fields = FIELDS_AT_ONCE;
    OverlaySsad one(index, memory), batch(index, memory, fields);
    std::vector<uint32_t> sources;
    for (size_t i = 0; i < fields; ++i)
        sources.push_back(static_cast<uint32_t>(i * (count - 1) / (fields - 1)));
    std::vector<float> alone(count), together(count * fields);
    batch.sweep(sources, INFINITE, together);
    uint64_t different = 0;
    for (size_t i = 0; i < fields; ++i) {
        one.sweep({&sources[i], 1}, INFINITE, alone);
        for (size_t v = 0; v < count; ++v)
            different += std::memcmp(&alone[v], &together[v * fields + i], sizeof(float)) != 0;
    }
    CHECK(different == 0);
}
