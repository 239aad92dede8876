#include "src/overlay/hops/border_field.h"

#include <algorithm>

#include "src/overlay/kernels/near.h"

namespace geodesic {

BorderField::BorderField(const OverlayIndex& index, std::pmr::memory_resource* memory)
    : kernels_(runnable_kernels().back()), near_segments_(near_segments(index.numbering.vertex_count())),
      distance_(index.rings.room_for_places(), memory), code_(distance_.size(), memory),
      foot_(distance_.size(), memory), height_(distance_.size(), memory) {}

bool BorderField::finish() {
    std::fill_n(distance_.data() + border_.places, SourceCode::BLOCK, INFINITE);
    range_ = kernels_.prepare_crossing(border_, is_own_, code_.data(), foot_.data(), height_.data());
    return range_.nearest < INFINITE;
}

}
