#include "src/capi/handles.h"

#include <new>

namespace geodesic {

void* CallerMemory::do_allocate(size_t size, size_t alignment) {
    if (!allocator_.allocate) return ::operator new (size, std::align_val_t{alignment});
    void* memory = allocator_.allocate(allocator_.user, size, alignment);
    if (!memory) throw std::bad_alloc();
    return memory;
}

void CallerMemory::do_deallocate(void* memory, size_t size, size_t alignment) {
    if (allocator_.release)
        allocator_.release(allocator_.user, memory, size, alignment);
    else
        ::operator delete (memory, std::align_val_t{alignment});
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

void QueryPool::give_back(Query* query) {
    try {
        const std::lock_guard lock(mutex_);
        idle_.push_back(query);
    } catch (const std::bad_alloc&) {
        std::pmr::polymorphic_allocator<>(&memory_).delete_object(query);
    }
}

QueryPool::~QueryPool() {
    for (Query* query : idle_) std::pmr::polymorphic_allocator<>(&memory_).delete_object(query);
}

}
