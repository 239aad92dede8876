#pragma once

#include <memory_resource>
#include <vector>

namespace geodesic {

// What an index and its queries hold: memory comes from the caller's allocator.
template <class T>
using Array = std::pmr::vector<T>;

// The memory of what building, opening and verifying need for a while: the global heap, whatever resource the
// program has made its default.
inline std::pmr::memory_resource* global_heap() { return std::pmr::new_delete_resource(); }

}
