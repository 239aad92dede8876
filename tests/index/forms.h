#pragma once

#include <array>
#include <vector>

#include <doctest/doctest.h>

#include "tests/capi/calls.h"

namespace geodesic::test {

inline constexpr std::array CODECS{uint32_t{GEOIDX_CODEC_PACKED}, uint32_t{GEOIDX_CODEC_LOSSLESS},
                                   uint32_t{GEOIDX_CODEC_MAPPED}};
inline constexpr std::array ENGINES{uint32_t{GEOIDX_ENGINE_GRAPH}, uint32_t{GEOIDX_ENGINE_OVERLAY}};

inline void check_same_answers(const geoidx* a, const geoidx* b, uint32_t count) {
    for (uint32_t source : {0u, count / 3, count - 1}) {
        CHECK(msad(a, source, count) == msad(b, source, count));
        CHECK(sssd(a, source, count / 2) == sssd(b, source, count / 2));
    }
    const std::vector<uint32_t> sources{0, count / 2, count - 1};
    CHECK(msad(a, sources, count) == msad(b, sources, count));
}

}
