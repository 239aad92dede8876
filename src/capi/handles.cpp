#include "src/capi/handles.h"

#include <new>
#include <string>

#include "format/error.h"
#include "src/base/heap.h"

namespace geodesic {

void* CallerMemory::do_allocate(size_t size, size_t alignment) {
    take_share(size);
    try {
        if (!allocator_.allocate) return allocate_on_heap(size, alignment);
        void* memory = allocator_.allocate(allocator_.user, size, alignment);
        if (!memory) throw std::bad_alloc();
        return memory;
    } catch (const std::bad_alloc&) {
        used_.fetch_sub(size, std::memory_order_relaxed);
        throw;
    }
}

void CallerMemory::take_share(uint64_t size) {
    const uint64_t before = used_.fetch_add(size, std::memory_order_relaxed);
    if (before <= limit_ && size <= limit_ - before) return;
    used_.fetch_sub(size, std::memory_order_relaxed);
    throw Error(GEOIDX_ERROR_LIMIT, "the index would take more than " + std::to_string(limit_) +
                                        " bytes, which max_memory allows");
}

void CallerMemory::do_deallocate(void* memory, size_t size, size_t alignment) {
    used_.fetch_sub(size, std::memory_order_relaxed);
    if (allocator_.release)
        allocator_.release(allocator_.user, memory, size, alignment);
    else
        release_on_heap(memory, size, alignment);
}

Query* QueryPool::take() {
    {
        const std::lock_guard lock(mutex_);
        if (!idle_.empty()) {
            Query* query = idle_.back();
            idle_.pop_back();
            return query;
        }
    }
    return std::pmr::polymorphic_allocator<>(&memory_).new_object<Query>(index_, &memory_);
}

// Where there is no memory for it, or none that max_memory allows, the next call makes scratch anew.
void QueryPool::give_back(Query* query) noexcept {
    try {
        const std::lock_guard lock(mutex_);
        idle_.push_back(query);
    } catch (...) {
        std::pmr::polymorphic_allocator<>(&memory_).delete_object(query);
    }
}

QueryPool::~QueryPool() {
    for (Query* query : idle_) std::pmr::polymorphic_allocator<>(&memory_).delete_object(query);
}

}
