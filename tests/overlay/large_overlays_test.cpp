// Overlays that have each distance once.
#include "src/overlay/prepare/large_overlays.h"

#include <doctest/doctest.h>

#include "tests/overlay/overlay_of.h"
#include "tests/support/sanitized.h"

using namespace geodesic;
using namespace geodesic::test;

namespace {

const OverlayOf& with_large_overlays() {
    static const OverlayOf built(mesh_of_long_borders(), options_of_plane(mesh_of_long_borders(), {2, 2, 3}));
    return built;
}

uint64_t bytes_of_hops(const OverlayIndex& index) {
    return 2 * (index.hops.border_begin.back() + index.hops.owned_begin.back() +
                index.numbering.internal_table_begin.back()) +
           3 * index.hops.inner_begin.back();
}

uint32_t overlay_size(const OverlayIndex& index, uint32_t patch) {
    return index.rings.size(patch) + index.numbering.inner_size(patch);
}

// The codes of an owned table from all vertices of the overlay.
uint64_t whole_owned_table(const OverlayIndex& index, uint32_t patch) {
    const uint64_t border = index.numbering.border_size(patch), owned = index.numbering.inner_size(patch);
    return (border + owned) * owned;
}

}

TEST_CASE("large overlays: none where tables are small" * doctest::skip(SANITIZED)) {
    const OverlayOf built(hills(40, 30), build_options(GEOIDX_METRIC_EXACT, 2));
    CHECK(std::ranges::count(built.overlay().is_large, 0) == built.overlay().numbering.first_leaf());
}

TEST_CASE("large overlays: the largest ones, as few as are needed" * doctest::skip(SANITIZED)) {
    const OverlayIndex& index = with_large_overlays().overlay();
    const uint64_t most = MOST_HOP_BYTES_EACH * index.numbering.vertex_count();
    uint32_t smallest = NONE;
    for (uint32_t p = 0; p < index.numbering.first_leaf(); ++p)
        if (index.is_large[p]) smallest = std::min(smallest, overlay_size(index, p));
    REQUIRE(smallest != NONE);
    uint64_t without_smallest = bytes_of_hops(index);
    uint32_t others_as_large = 0, others_that_would_shrink = 0;
    for (uint32_t p = 0; p < index.numbering.first_leaf(); ++p) {
        if (!index.is_large[p]) {
            others_as_large += overlay_size(index, p) >= smallest;
            others_that_would_shrink +=
                HalfTable::size(index.numbering.inner_size(p)) < index.owned_table_size(p);
        }
        if (index.is_large[p] && overlay_size(index, p) == smallest)
            without_smallest += 2 * (whole_owned_table(index, p) - index.owned_table_size(p));
    }
    CHECK((bytes_of_hops(index) <= most || others_that_would_shrink == 0));
    CHECK(others_as_large == 0);
    CHECK(without_smallest > most);
}

TEST_CASE("large overlays: each distance is where it is looked for") {
    StoredIndex stored = restore(with_large_overlays().index);
    for (size_t i = 0; i < stored.overlay_codes.size(); ++i)
        stored.overlay_codes[i] = static_cast<uint16_t>(1 + i * 31 % 32000);
    Index index(std::pmr::get_default_resource());
    prepare(stored, index);
    CHECK(std::get<OverlayIndex>(index.engine).is_large == with_large_overlays().overlay().is_large);
    CHECK(restore(index).overlay_codes == stored.overlay_codes);
}
