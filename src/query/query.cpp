#include "src/query/query.h"

#include <algorithm>

namespace geodesic {

Query::Query(const Index& index, std::pmr::memory_resource* memory)
    : index_(index), queue_(memory), distance_(index.vertex_count(), memory),
      has_sources_(index.patch_count(), uint8_t{0}, memory), overlay_(memory),
      slot_distance_(index.border.size(), memory), buckets_(memory),
      search_distance_(index.border_vertex_count(), memory),
      search_epoch_(index.border_vertex_count(), 0u, memory),
      allowed_epoch_(index.patch_count(), 0u, memory) {
    uint32_t largest = 0;
    for (uint32_t p = 0; p < index.first_leaf(); ++p) largest = std::max(largest, index.overlay_size(p));
    overlay_.resize(largest);
}

}
