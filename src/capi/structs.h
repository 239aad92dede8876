#pragma once

#include <algorithm>
#include <cstring>
#include <span>
#include <string>

#include "format/error.h"
#include "src/capi/status.h"

namespace geodesic {

// As much of a struct as its caller knows of.
template <class Struct>
void init_sized(Struct* out, uint32_t struct_size, Struct defaults) {
    if (!out || struct_size < sizeof(uint32_t)) return;
    defaults.struct_size = std::min<uint32_t>(struct_size, sizeof(Struct));
    std::memcpy(out, &defaults, defaults.struct_size);
}

// A whole struct from one that an older caller may have made shorter: what it lacks keeps its default.
template <class Struct>
Struct whole(const Struct& given, void (*init)(Struct*)) {
    Struct result;
    init(&result);
    if (given.struct_size < sizeof(uint32_t))
        refuse_argument("struct_size is " + std::to_string(given.struct_size) +
                        ": the struct was not initialized");
    const auto size = std::min<size_t>(given.struct_size, sizeof(Struct));
    std::memcpy(&result, &given, size);
    result.struct_size = sizeof(Struct);
    return result;
}

template <class Struct>
Struct whole_or_default(const Struct* given, void (*init)(Struct*)) {
    if (given) return whole(*given, init);
    Struct result;
    init(&result);
    return result;
}

// The caller's bytes.
inline std::span<const std::byte> bytes_at(const void* data, uint64_t size) {
    require(data || size == 0, "data is NULL");
    return {static_cast<const std::byte*>(data), static_cast<size_t>(size)};
}

}
