#include "src/base/heap.h"

#include <algorithm>
#include <cstdint>
#include <new>

#if defined(__linux__)
#include <sys/mman.h>
#endif

namespace geodesic {

namespace {

struct Block {
    size_t size, alignment;
};

#if defined(__linux__)

// Of x86-64, and of arm64 with pages of 4 KB.
constexpr size_t HUGE_PAGE = size_t{1} << 21;

// A large block is a number of whole huge pages. At most half of it is left unused.
Block block_for(size_t size, size_t alignment) {
    if (size < HUGE_PAGE / 2 || size > SIZE_MAX - HUGE_PAGE) return {size, alignment};
    return {(size + HUGE_PAGE - 1) / HUGE_PAGE * HUGE_PAGE, std::max(alignment, HUGE_PAGE)};
}

void ask_for_huge_pages(void* memory, const Block& block) {
    if (block.alignment >= HUGE_PAGE) madvise(memory, block.size, MADV_HUGEPAGE);
}

#else

Block block_for(size_t size, size_t alignment) { return {size, alignment}; }
void ask_for_huge_pages(void*, const Block&) {}

#endif

}

void* allocate_on_heap(size_t size, size_t alignment) {
    const Block block = block_for(size, alignment);
    void* memory = ::operator new (block.size, std::align_val_t{block.alignment});
    ask_for_huge_pages(memory, block);
    return memory;
}

void release_on_heap(void* memory, size_t size, size_t alignment) noexcept {
    ::operator delete (memory, std::align_val_t{block_for(size, alignment).alignment});
}

}
