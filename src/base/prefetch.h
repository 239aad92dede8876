#pragma once

#include <cstddef>
#include <cstdint>

namespace geodesic {

// Asks the processor to load memory that is going to be read soon: each line that holds any of it.
template <class T>
void prefetch(const T* first, size_t count) {
    constexpr uintptr_t LINE = 64;
    const auto begin = reinterpret_cast<uintptr_t>(first), end = begin + count * sizeof(T);
    for (uintptr_t at = begin / LINE * LINE; at < end; at += LINE)
        __builtin_prefetch(reinterpret_cast<const void*>(at));
}

}
