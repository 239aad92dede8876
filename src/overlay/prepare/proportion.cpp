#include "src/overlay/prepare/proportion.h"

#include <string>

#include "format/error.h"
#include "src/overlay/prepare/bounds.h"
#include "src/overlay/sssd/labels.h"
#include "src/overlay/sssd/samples.h"

namespace geodesic {

namespace {

// Flags of the vertices in the overlay of each patch's parent, of which 16 are a code.
uint64_t count_flag_codes(const Numbering& numbering) {
    uint64_t flags = 0;
    for (uint32_t p = 1; p < numbering.patch_count(); ++p)
        flags += numbering.overlay_size(numbering.parent[p]);
    return (flags + 15) / 16;
}

}

// No sum wraps around: a ring has fewer than 2^15 places, and the vertices of overlays are numbers that the
// file holds, fewer than 2^31 in any file below 8 GB. Flags are fewer than patches times such numbers.
uint64_t derived_codes(const OverlayIndex& index) {
    uint64_t bytes = 0;
    for (uint32_t p = 0; p < index.numbering.patch_count(); ++p) bytes += index.hop_table_bytes(p);
    return bytes / sizeof(uint16_t) + count_flag_codes(index.numbering) + count_bound_codes(index) +
           count_sample_codes(index) + count_label_codes(index);
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
