#pragma once

#include <cstdint>
#include <memory_resource>

#include "src/overlay/ssad.h"
#include "src/overlay/tables.h"

namespace geodesic {

// A source with its distances to borders, so that a distance to any vertex is one minimum over the border
// around that vertex. Borders become known when a target needs them, and stay so: up from the source to the
// first patch around both, then down to the target. Vertices are given by their numbers. An object is the
// scratch of one thread.
class PreparedSource {
public:
    PreparedSource(const OverlayIndex& index, std::pmr::memory_resource* memory)
        : index_(index), known_(memory), is_known_(memory), from_(memory), to_(memory) {}

    void prepare(const Sources& source);

    // prepare() comes before. `field` is scratch.
    float distance(uint32_t target, OverlaySsad& field);

private:
    void require_inner(uint32_t patch, OverlaySsad& field);
    float distance_over_border(uint32_t target);

    const OverlayIndex& index_;
    uint32_t innermost_ = 0;  // patch around the source
    uint32_t top_ = 0;        // the outermost patch around it whose overlay is known
    Array<float> known_;      // by number: to the inner vertices of the patches where they are known
    Array<uint8_t> is_known_; // per patch: whether its inner vertices are
    Array<float> from_, to_;  // scratch: from both ends to the places of a ring
};

}
