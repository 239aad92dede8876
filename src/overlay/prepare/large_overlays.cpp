#include "src/overlay/prepare/large_overlays.h"

#include <algorithm>
#include <functional>
#include <vector>

namespace geodesic {

namespace {

struct Overlay {
    uint32_t patch;
    uint32_t size;  // places of the ring, and owned vertices
    uint64_t saved; // bytes, if it is large
};

// In all hop tables.
uint64_t hop_bytes(const OverlayIndex& index) {
    uint64_t bytes = sizeof(uint16_t) * index.numbering.internal_table_begin.back();
    for (uint32_t p = 0; p < index.numbering.patch_count(); ++p) bytes += index.hop_table_bytes(p);
    return bytes;
}

// Those whose tables are smaller if they are large: half of a table of a few vertices, filled up to whole
// squares, can be more than the whole.
std::vector<Overlay> overlays_that_shrink(const OverlayIndex& index) {
    std::vector<Overlay> overlays;
    for (uint32_t p = 0; p < index.numbering.first_leaf(); ++p) {
        const uint32_t owned = index.numbering.inner_size(p);
        const uint64_t each_twice = index.owned_table_size(p), each_once = HalfTable::size(owned);
        if (each_once < each_twice)
            overlays.push_back({p, index.rings.size(p) + owned, sizeof(uint16_t) * (each_twice - each_once)});
    }
    return overlays;
}

}

void choose_large_overlays(OverlayIndex& index) {
    const Numbering& numbering = index.numbering;
    index.is_large.assign(numbering.first_leaf(), 0);
    uint64_t bytes = hop_bytes(index);
    const uint64_t most = MOST_HOP_BYTES_EACH * numbering.vertex_count();
    auto overlays = overlays_that_shrink(index);
    std::ranges::sort(overlays, std::greater{}, &Overlay::size);
    for (size_t i = 0; i < overlays.size() && bytes > most;)
        for (const uint32_t size = overlays[i].size; i < overlays.size() && overlays[i].size == size; ++i) {
            index.is_large[overlays[i].patch] = true;
            bytes -= overlays[i].saved;
        }
}

}
