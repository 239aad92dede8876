#pragma once

#include <cstddef>
#include <memory>
#include <memory_resource>
#include <type_traits>

namespace geodesic {

template <class T>
struct ReleaseRoom {
    std::pmr::memory_resource* memory = nullptr;
    size_t size = 0;

    void operator()(T* first) const { memory->deallocate(first, size * sizeof(T), alignof(T)); }
};

// Memory of the caller's allocator for elements that have no value before one is written. Where an Array
// would write zeros, no page of it is touched.
template <class T>
using Room = std::unique_ptr<T[], ReleaseRoom<T>>;

template <class T>
Room<T> make_room(size_t size, std::pmr::memory_resource* memory) {
    static_assert(std::is_trivial_v<T>);
    return {static_cast<T*>(memory->allocate(size * sizeof(T), alignof(T))), {memory, size}};
}

}
