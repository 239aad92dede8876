// What a sweep reads beside the tables of the file.
#include "src/overlay/prepare/middles.h"

#include <cmath>

#include <doctest/doctest.h>

#include "src/build/build.h"
#include "tests/capi/calls.h"

using namespace geodesic;
using namespace geodesic::test;

TEST_CASE("middle tables: in the plane, straight lines to the middles of segments") {
    const TestMesh mesh = grid(30, 30);
    geoidx_build_options options = build_options(GEOIDX_METRIC_EXACT, 2);
    options.engine = GEOIDX_ENGINE_OVERLAY;
    Index built(std::pmr::get_default_resource());
    build_index(mesh.view(), options, built);
    const auto& index = std::get<OverlayIndex>(built.engine);
    const Numbering& numbering = index.numbering;

    uint64_t wrong = 0, middles = 0;
    for (uint32_t p = 1; p < numbering.patch_count(); ++p) {
        const int16_t* const strides = index.strides.of(p);
        for (uint32_t i = 0; i < numbering.inner_size(p); ++i)
            for (uint32_t k = 0; k < index.rings.size(p); ++k) {
                const uint32_t place = index.rings.begin[p] + k;
                const uint64_t entry = index.inner_row(p, i) + k;
                const uint8_t offset = index.hops.inner_middles[entry];
                if (std::isnan(index.rings.segment_length[place])) {
                    wrong += strides[k] != 0 || offset != 0;
                    continue;
                }
                const uint16_t code = MiddleOffset::code(index.hops.inner[entry], index.hops.inner[entry + 1],
                                                         offset, strides[k]);
                const auto& target = numbering.positions[numbering.first_inner(p) + i];
                const auto &first = numbering.positions[index.rings.vertex[place]],
                           &second = numbering.positions[index.rings.vertex[place + 1]];
                double square = 0;
                for (size_t axis = 0; axis < 3; ++axis)
                    square += std::pow(target[axis] - 0.5 * (first[axis] + second[axis]), 2);
                const double quantum = double{index.quantum[p]},
                             distance = double{numbering.position_step} * std::sqrt(square);
                // Entries are rounded by half a step, the middle's once more; near a segment that counts
                // more. What is no leaf's is calibrated.
                const double length = double{index.rings.segment_length[place]};
                const double step = std::ldexp(quantum, index.shift[p]);
                const double rounding = step * (1 + 2 * (distance + length) / distance) +
                                        2 * double{numbering.position_step} +
                                        (p < numbering.first_leaf() ? 1e-3 * distance : 0);
                wrong += std::abs(code * quantum - distance) > rounding;
                wrong += quantum * strides[k] > length / 510 + quantum;
                ++middles;
            }
    }
    CHECK(wrong == 0);
    CHECK(middles > 5000);
}
