#pragma once

#include <cstddef>

namespace geodesic {

// Asks the processor to load memory that is going to be read soon.
template <class T>
void prefetch(const T* first, size_t count) {
    constexpr size_t LINE = 64;
    const char* end = reinterpret_cast<const char*>(first + count);
    for (const char* at = reinterpret_cast<const char*>(first); at < end; at += LINE) __builtin_prefetch(at);
}

}
