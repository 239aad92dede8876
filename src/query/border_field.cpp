#include "src/query/border_field.h"

#include <algorithm>
#include <limits>

namespace geodesic {

namespace {

constexpr float INFINITE = std::numeric_limits<float>::infinity();
constexpr size_t BLOCK = SeenCodes::BLOCK;

}

BorderField::BorderField(const Index& index, std::pmr::memory_resource* memory)
    : kernel_(crossing_kernels().back()),
      distance_(SeenCodes::whole_blocks(index.overlay_tables.rings.largest_size()) + BLOCK, memory),
      code_(distance_.size(), memory), foot_(distance_.size(), memory), height_(distance_.size(), memory) {}

bool BorderField::finish() {
    std::fill_n(distance_.data() + border_.places, BLOCK, INFINITE);
    sight_ = kernel_.see(border_, is_own_, code_.data(), foot_.data(), height_.data());
    return sight_.nearest < INFINITE;
}

}
