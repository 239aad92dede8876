#pragma once

#include <algorithm>
#include <bit>
#include <cstdint>
#include <cstring>
#include <string>
#include <vector>

#include "tools/mesh_io/mesh_io.h"

// What the tests of the mesh readers share.
namespace geodesic::tools::test {

using Ids = std::vector<uint32_t>;
using Numbers = std::vector<double>;

template <class Reader>
std::string error_of(Reader reader, const std::string& text) {
    try {
        reader(text);
    } catch (const MeshFileError& error) {
        return error.what();
    }
    return "";
}

inline bool contains(const std::string& text, const std::string& part) {
    return text.find(part) != std::string::npos;
}

template <class Number>
void append(std::string& bytes, Number number, bool big_endian = false) {
    char raw[sizeof number];
    std::memcpy(raw, &number, sizeof number);
    if (big_endian != (std::endian::native == std::endian::big)) std::reverse(raw, raw + sizeof number);
    bytes.append(raw, sizeof number);
}

}
