#include "src/overlay/proportion.h"

#include <string>
#include <vector>

#include "format/error.h"
#include "src/overlay/bounds.h"
#include "src/overlay/labels.h"
#include "src/overlay/samples.h"

namespace geodesic {

namespace {

// The size of the outer table of a patch, and of the inner ones.
uint64_t outer_and_inner(const OverlayIndex& index, uint32_t patch) {
    const Numbering& numbering = index.numbering;
    const uint32_t outside = numbering.overlay_size(numbering.parent[patch]) - numbering.border_size(patch);
    return index.rings.size(patch) * (uint64_t{outside} + 2 * uint64_t{numbering.inner_size(patch)});
}

// The size of all kept tables.
uint64_t kept(const Numbering& numbering) {
    std::vector<uint64_t> count(numbering.patch_count(), 0);
    for_each_kept(numbering, [&](uint32_t slot) { ++count[numbering.patch_of_slot[slot]]; });
    uint64_t codes = 0;
    for (const uint64_t vertices : count) codes += triangle_size(vertices);
    return codes;
}

}

// No sum wraps around, since a ring has fewer than 2^15 places and there are fewer than 2^32 vertices.
uint64_t derived_codes(const OverlayIndex& index) {
    uint64_t codes = kept(index.numbering) + count_bound_codes(index) + count_sample_codes(index) +
                     count_label_codes(index);
    for (uint32_t p = 1; p < index.numbering.patch_count(); ++p) codes += outer_and_inner(index, p);
    return codes;
}

uint64_t stored_numbers(const OverlayIndex& index) {
    const Numbering& numbering = index.numbering;
    return numbering.border.size() + numbering.vertex_count() + numbering.overlay_engine_entries();
}

void require_proportion(const OverlayIndex& index) {
    const uint64_t derived = derived_codes(index), stored = stored_numbers(index);
    if (derived > ALWAYS_DERIVED && (derived - ALWAYS_DERIVED) / MOST_DERIVED_EACH > stored)
        throw Error(GEOIDX_ERROR_LIMIT, "the overlay engine would derive " + std::to_string(derived) +
                                            " codes from " + std::to_string(stored) +
                                            " numbers, which is out of proportion");
}

}
