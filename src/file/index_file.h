#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "format/container.h"
#include "src/index/stored.h"

namespace geodesic {

// The bytes of an index as format/SPEC.md describes them.
std::vector<std::byte> write_index(const StoredIndex& stored);

// Throws Error if the sections are not those of an index, INDEX_TAGS. prepare() checks what can be checked
// only with the numbering at hand. Tables are decoded on up to so many threads.
StoredIndex read_index(const format::Container& container, uint32_t threads);

}
