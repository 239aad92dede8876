#include "src/graph/query.h"

namespace geodesic {

GraphQuery::GraphQuery(const GraphIndex& index, std::pmr::memory_resource* memory)
    : index_(index), numbering_(index.numbering), queue_(memory),
      has_sources_(index.numbering.patch_count(), uint8_t{0}, memory),
      slot_distance_(index.numbering.border.size(), memory),
      slot_is_active_(index.numbering.border.size(), uint8_t{0}, memory),
      active_slots_(index.numbering.border.size(), memory),
      active_count_(index.numbering.patch_count(), 0u, memory),
      nearest_active_(index.numbering.patch_count(), INFINITE, memory), crossed_(memory),
      crossed_source_(memory), search_distance_(index.numbering.border_vertex_count(), memory),
      search_epoch_(index.numbering.border_vertex_count(), 0u, memory),
      allowed_epoch_(index.numbering.patch_count(), 0u, memory) {
    crossed_.resize(index.numbering.largest_border_size());
    crossed_source_.resize(crossed_.size());
}

}
