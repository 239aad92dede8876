// MSAD lowers many distances at once. Which source a distance came from is found afterwards: from the sum
// that has the same bits.
#include "src/graph/query.h"

namespace geodesic {

// Takes a way that needs no sum, if it is shorter than those before it.
void GraphQuery::take_way(uint32_t number, float way, uint32_t source) {
    if (!(way < distance_[number])) return;
    distance_[number] = way;
    if (!source_.empty()) source_[number] = source;
}

// Of a child whose active slots have been crossed: fills the sources of the distances that fell.
void GraphQuery::find_crossed_sources(uint32_t child) {
    const uint32_t first = numbering_.border_begin[child], size = numbering_.border_size(child);
    for (uint32_t k = 0; k < size; ++k) {
        if (!(crossed_[k] < slot_distance_[first + k])) continue;
        for (uint32_t i = 0; i < active_count_[child]; ++i) {
            const uint32_t slot = active_slots_[first + i];
            const double sum = slot_distance_[slot] + double{index_.border_row(child, slot - first)[k]};
            if (sum != crossed_[k]) continue;
            crossed_source_[k] = source_[numbering_.border[slot]];
            break;
        }
    }
}

// A vertex whose source is not replaced here was reached without a sum, or not at all.
void GraphQuery::find_sources_in_leaf(uint32_t leaf) {
    const auto border = numbering_.border_of(leaf);
    const uint32_t first = numbering_.first_internal(leaf), size = numbering_.internal_size(leaf);
    for (uint32_t b = 0; b < border.size(); ++b) {
        const float from = distance_[border[b]];
        if (!(from < INFINITE)) continue;
        const float* const row = index_.border_internal_row(leaf, b);
        for (uint32_t i = 0; i < size; ++i)
            if (from + row[i] == distance_[first + i] && distance_[first + i] < INFINITE)
                source_[first + i] = source_[border[b]];
    }
}

}
