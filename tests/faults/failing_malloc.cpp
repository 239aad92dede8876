#include "tests/faults/failing_malloc.h"

#include <atomic>
#include <cerrno>
#include <cstddef>
#include <cstdlib>
#include <new>
#include <utility>

#include <dlfcn.h>
#include <pthread.h>

// The functions of the C library take the place of those that the executable defines here, for all shared
// libraries too. They pass on to the C library's own or, where there is one, to the sanitizer's.

extern "C" {
void* __libc_malloc(size_t size);
void* __libc_calloc(size_t count, size_t size);
void* __libc_realloc(void* memory, size_t size);
void* __libc_memalign(size_t alignment, size_t size);
[[gnu::weak]] void* __interceptor_malloc(size_t size);
[[gnu::weak]] void* __interceptor_calloc(size_t count, size_t size);
[[gnu::weak]] void* __interceptor_realloc(void* memory, size_t size);
[[gnu::weak]] void* __interceptor_memalign(size_t alignment, size_t size);
}

namespace {

std::atomic<bool> is_armed = false, all_from_there = false;
std::atomic<uint64_t> call_count = 0, failing = 0, failure_count = 0;

// What a sanitizer allocates when a thread begins and ends is its own affair.
thread_local bool is_at_work = false;

bool fails() {
    if (!is_armed || !is_at_work) return false;
    const uint64_t call = call_count++;
    if (all_from_there ? call < failing : call != failing) return false;
    ++failure_count;
    errno = ENOMEM;
    return true;
}

void* allocate_aligned(size_t alignment, size_t size) {
    if (fails()) return nullptr;
    return __interceptor_memalign ? __interceptor_memalign(alignment, size)
                                  : __libc_memalign(alignment, size);
}

struct ThreadStart {
    void* (*run)(void*);
    void* argument;
};

void* run_thread(void* given) {
    const ThreadStart start = *static_cast<ThreadStart*>(given);
    std::free(given);
    is_at_work = true;
    void* const result = start.run(start.argument);
    is_at_work = false;
    return result;
}

void* allocate_or_throw(size_t size) {
    if (void* const memory = std::malloc(size ? size : 1)) return memory;
    throw std::bad_alloc();
}

void* allocate_or_throw(size_t size, std::align_val_t alignment) {
    if (void* const memory = allocate_aligned(static_cast<size_t>(alignment), size)) return memory;
    throw std::bad_alloc();
}

}

#define REPLACES [[gnu::visibility("default")]]

extern "C" {

REPLACES void* malloc(size_t size) {
    if (fails()) return nullptr;
    return __interceptor_malloc ? __interceptor_malloc(size) : __libc_malloc(size);
}

REPLACES void* calloc(size_t count, size_t size) {
    if (fails()) return nullptr;
    return __interceptor_calloc ? __interceptor_calloc(count, size) : __libc_calloc(count, size);
}

REPLACES void* realloc(void* memory, size_t size) {
    if (fails()) return nullptr;
    return __interceptor_realloc ? __interceptor_realloc(memory, size) : __libc_realloc(memory, size);
}

REPLACES void* memalign(size_t alignment, size_t size) { return allocate_aligned(alignment, size); }
REPLACES void* aligned_alloc(size_t alignment, size_t size) { return allocate_aligned(alignment, size); }

REPLACES int posix_memalign(void** out, size_t alignment, size_t size) {
    void* const memory = allocate_aligned(alignment, size);
    if (!memory) return ENOMEM;
    *out = memory;
    return 0;
}

REPLACES int pthread_create(pthread_t* thread, const pthread_attr_t* attributes, void* (*run)(void*),
                            void* argument) {
    using Create = decltype(pthread_create);
    static auto* const create = reinterpret_cast<Create*>(dlsym(RTLD_NEXT, "pthread_create"));
    auto* const start = static_cast<ThreadStart*>(std::malloc(sizeof(ThreadStart)));
    if (!start) return EAGAIN;
    *start = {run, argument};
    const int error = create(thread, attributes, run_thread, start);
    if (error) std::free(start);
    return error;
}

// The address sanitizer asks for the bounds of the stack whenever something is thrown, and ends the process
// if it does not learn them. The C library allocates for the answer.
REPLACES int pthread_getattr_np(pthread_t thread, pthread_attr_t* attributes) {
    using GetAttributes = decltype(pthread_getattr_np);
    const bool was_at_work = std::exchange(is_at_work, false);
    static auto* const get = reinterpret_cast<GetAttributes*>(dlsym(RTLD_NEXT, "pthread_getattr_np"));
    const int error = get(thread, attributes);
    is_at_work = was_at_work;
    return error;
}

// The loader keeps the storage of threads that have ended, where the leak sanitizer does not look.
REPLACES const char* __lsan_default_suppressions() { return "leak:ld-linux"; }
}

// A sanitizer has an operator new of its own, which asks no malloc.
void* operator new(size_t size) { return allocate_or_throw(size); }
void* operator new[](size_t size) { return allocate_or_throw(size); }
void* operator new(size_t size, std::align_val_t alignment) { return allocate_or_throw(size, alignment); }
void* operator new[](size_t size, std::align_val_t alignment) { return allocate_or_throw(size, alignment); }
void* operator new(size_t size, const std::nothrow_t&) noexcept { return std::malloc(size ? size : 1); }
void* operator new[](size_t size, const std::nothrow_t&) noexcept { return std::malloc(size ? size : 1); }
void operator delete(void* memory) noexcept { std::free(memory); }
void operator delete[](void* memory) noexcept { std::free(memory); }
void operator delete(void* memory, size_t) noexcept { std::free(memory); }
void operator delete[](void* memory, size_t) noexcept { std::free(memory); }
void operator delete(void* memory, std::align_val_t) noexcept { std::free(memory); }
void operator delete[](void* memory, std::align_val_t) noexcept { std::free(memory); }
void operator delete(void* memory, size_t, std::align_val_t) noexcept { std::free(memory); }
void operator delete[](void* memory, size_t, std::align_val_t) noexcept { std::free(memory); }
void operator delete(void* memory, const std::nothrow_t&) noexcept { std::free(memory); }
void operator delete[](void* memory, const std::nothrow_t&) noexcept { std::free(memory); }

namespace geodesic::test {

FailingMalloc::FailingMalloc(uint64_t failing_call, bool recovers) {
    call_count = failure_count = 0;
    failing = failing_call;
    all_from_there = !recovers;
    is_at_work = true;
    is_armed = true;
}

FailingMalloc::~FailingMalloc() { is_armed = is_at_work = false; }

uint64_t FailingMalloc::failures() const { return failure_count; }

}
