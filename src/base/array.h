#pragma once

#include <memory_resource>
#include <vector>

namespace geodesic {

// What an index and its queries hold: memory comes from the caller's allocator.
template <class T>
using Array = std::pmr::vector<T>;

}
