#include "src/query/graph_query.h"

#include <algorithm>
#include <limits>

namespace geodesic {

GraphQuery::GraphQuery(const Index& index, std::pmr::memory_resource* memory)
    : index_(index), queue_(memory), has_sources_(index.patch_count(), uint8_t{0}, memory),
      slot_distance_(index.border.size(), memory), slot_is_active_(index.border.size(), uint8_t{0}, memory),
      active_slots_(index.border.size(), memory), active_count_(index.patch_count(), 0u, memory),
      nearest_active_(index.patch_count(), std::numeric_limits<float>::infinity(), memory), crossed_(memory),
      search_distance_(index.border_vertex_count(), memory),
      search_epoch_(index.border_vertex_count(), 0u, memory),
      allowed_epoch_(index.patch_count(), 0u, memory) {
    uint32_t largest = 0;
    for (uint32_t p = 0; p < index.patch_count(); ++p) largest = std::max(largest, index.border_size(p));
    crossed_.resize(largest);
}

}
