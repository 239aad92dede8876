#pragma once

#include <cstdint>
#include <memory_resource>

#include "src/overlay/ssad.h"
#include "src/overlay/tables.h"

namespace geodesic {

// A source with its distances to all borders, so that a distance to any vertex is one minimum over the border
// around that vertex. Vertices are given by their numbers. An object is the scratch of one thread.
class PreparedSource {
public:
    PreparedSource(const OverlayIndex& index, std::pmr::memory_resource* memory)
        : index_(index), known_(memory), from_(memory), to_(memory) {}

    void prepare(const Sources& source, OverlaySsad& field);

    // prepare() comes before.
    float distance(uint32_t target);

private:
    const OverlayIndex& index_;
    // By number: to all border vertices, and to the inner vertices of the patches that contain the source.
    Array<float> known_;
    Array<float> from_, to_; // scratch: from both ends to the places of a ring
};

}
