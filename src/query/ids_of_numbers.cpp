#include "src/query/ids_of_numbers.h"

#include <cstddef>

namespace geodesic {

IdsOfNumbers::IdsOfNumbers(const Index& index, std::pmr::memory_resource* memory)
    : first_(index.numbering().vertex_count(), NONE, memory), next_(memory) {
    const auto& number_of_id = index.number_of_id;
    for (size_t id = number_of_id.size(); id-- > 0;) {
        const uint32_t number = number_of_id[id];
        if (number == NONE) continue;
        uint32_t& first = first_[number];
        if (first != NONE) {
            if (next_.empty()) next_.assign(number_of_id.size(), NONE);
            next_[id] = first;
        }
        first = static_cast<uint32_t>(id);
    }
}

}
