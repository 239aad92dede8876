#include "tests/campaign/file_memory.h"

#include <malloc.h>

#include <algorithm>
#include <atomic>
#include <cstdlib>
#include <new>

namespace geodesic::file_campaign {

namespace {

std::atomic<uint64_t> at_hand{0}, peak{0};

void* count(void* memory) {
    if (!memory) throw std::bad_alloc();
    const uint64_t now = at_hand += malloc_usable_size(memory);
    uint64_t before = peak;
    while (before < now && !peak.compare_exchange_weak(before, now)) {
    }
    return memory;
}

void release(void* memory) noexcept {
    if (memory) at_hand -= malloc_usable_size(memory);
    std::free(memory);
}

void* aligned(size_t size, std::align_val_t alignment) {
    const auto to = std::max(static_cast<size_t>(alignment), sizeof(void*));
    return count(std::aligned_alloc(to, (size + to - 1) / to * to));
}

}

uint64_t peak_memory() { return peak; }
void start_peak() { peak = at_hand.load(); }

}

// The other forms call these.
void* operator new(size_t size) {
    return geodesic::file_campaign::count(std::malloc(std::max<size_t>(size, 1)));
}
void* operator new(size_t size, std::align_val_t alignment) {
    return geodesic::file_campaign::aligned(std::max<size_t>(size, 1), alignment);
}
void operator delete(void* memory) noexcept { geodesic::file_campaign::release(memory); }
void operator delete(void* memory, size_t) noexcept { geodesic::file_campaign::release(memory); }
void operator delete(void* memory, std::align_val_t) noexcept { geodesic::file_campaign::release(memory); }
void operator delete(void* memory, size_t, std::align_val_t) noexcept {
    geodesic::file_campaign::release(memory);
}
