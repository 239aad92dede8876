#pragma once

#include <cstddef>

namespace geodesic {

// Memory of the global heap for the arrays of an index. Queries read rows that lie far apart, and with pages
// of 4 KB the processor has to look up the page of nearly every row, too. So large arrays begin at a multiple
// of a huge page, and Linux is asked to use such pages for them. It may refuse, which costs time only.

// Throws std::bad_alloc.
void* allocate_on_heap(size_t size, size_t alignment);

// `size` and `alignment` are those that the memory was allocated with.
void release_on_heap(void* memory, size_t size, size_t alignment) noexcept;

}
