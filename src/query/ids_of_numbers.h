#pragma once

#include <cstdint>
#include <memory_resource>

#include "src/query/index.h"

namespace geodesic {

// The caller's ids by the numbers of vertices: the inverse of Index::number_of_id. Several ids have one
// number where vertices were welded, and added vertices have none.
class IdsOfNumbers {
public:
    IdsOfNumbers(const Index& index, std::pmr::memory_resource* memory);

    // The least id of a number, NONE if it has none, and the next larger one that has the same number,
    // NONE at the end.
    uint32_t first(uint32_t number) const { return first_[number]; }
    uint32_t next(uint32_t id) const { return next_.empty() ? NONE : next_[id]; }

private:
    Array<uint32_t> first_; // per number
    Array<uint32_t> next_;  // per id; empty where no ids have one number
};

}
