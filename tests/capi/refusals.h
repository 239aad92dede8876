#pragma once

#include <cstring>
#include <limits>
#include <string>

#include "src/base/numbers.h"
#include "tests/capi/calls.h"

namespace geodesic::test {

using geodesic::INFINITE;
inline constexpr float NOT_A_NUMBER = std::numeric_limits<float>::quiet_NaN();

inline bool last_error_contains(const char* text) {
    return std::strstr(geoidx_last_error(), text) != nullptr;
}

// A status with a detail that names what is wrong.
inline void check_refused(geoidx_status actual, geoidx_status expected, const char* detail) {
    INFO("wanted in the detail: ", std::string(detail), ", found: ", std::string(geoidx_last_error()));
    CHECK(actual == expected);
    CHECK(last_error_contains(detail));
}

// A pointer that no handle is at, so that a call that leaves it alone is seen.
inline geoidx* not_null() {
    static int somewhere;
    return reinterpret_cast<geoidx*>(&somewhere);
}

inline void check_build_refused(const TestMesh& mesh, const geoidx_build_options& options,
                                geoidx_status expected, const char* detail) {
    const geoidx_mesh view = mesh.view();
    geoidx* index = not_null();
    check_refused(geoidx_build(&view, &options, &index), expected, detail);
    CHECK(index == nullptr);
}

}
