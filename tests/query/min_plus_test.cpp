// The innermost loop of the overlay engine: every kernel that this processor can run.
#include "src/query/min_plus.h"

#include <random>
#include <vector>

#include <doctest/doctest.h>

using namespace geodesic;

TEST_CASE("min-plus: every kernel gives the least sum and the first row that attains it") {
    std::mt19937 random(1);
    for (const MinPlusKernel& kernel : min_plus_kernels()) {
        CAPTURE(kernel.name);
        for (size_t columns : {1u, 2u, 15u, 16u, 17u, 31u, 32u, 33u, 64u, 100u, 257u})
            for (size_t row_count : {0u, 1u, 2u, 7u, 90u}) {
                const uint32_t largest = random() % 2 ? 0x7fff : 5; // small numbers tie
                std::vector<uint16_t> entries(row_count * columns + min_plus_room(columns));
                for (uint16_t& entry : entries) entry = static_cast<uint16_t>(random() % (largest + 1));
                std::vector<MinPlusRow> rows;
                for (size_t r = 0; r < row_count; ++r)
                    rows.push_back({entries.data() + r * columns, static_cast<uint16_t>(random() % largest)});

                std::vector<uint16_t> best(min_plus_room(columns)), winner(best.size());
                min_plus(rows, columns, best.data(), winner.data(), kernel);
                for (size_t x = 0; x < columns; ++x) {
                    uint32_t least = UINT16_MAX, first = 0;
                    for (uint32_t r = 0; r < row_count; ++r)
                        if (const uint32_t sum = uint32_t{rows[r].start} + rows[r].entries[x]; sum < least) {
                            least = sum;
                            first = r;
                        }
                    CHECK(best[x] == least);
                    CHECK(winner[x] == first);
                }
            }
    }
    CHECK(min_plus_kernels().size() >= 1);
}
