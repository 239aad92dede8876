// Blocks of the global heap, small ones and those that ask for huge pages.
#include <doctest/doctest.h>

#include <cstdint>
#include <cstring>
#include <initializer_list>
#include <limits>
#include <new>

#include "src/base/heap.h"
#include "tests/support/sanitized.h"

using namespace geodesic;
using namespace geodesic::test;

TEST_CASE("heap: every byte of a block can be written, and it is aligned as asked") {
    constexpr size_t MEGABYTE = size_t{1} << 20;
    for (const size_t size : {size_t{1}, size_t{4096}, MEGABYTE - 1, MEGABYTE, MEGABYTE + 1, 2 * MEGABYTE,
                              2 * MEGABYTE + 1, 7 * MEGABYTE + 123})
        for (const size_t alignment : {size_t{4}, size_t{64}, size_t{4096}, 4 * MEGABYTE}) {
            CAPTURE(size);
            CAPTURE(alignment);
            auto* const block = static_cast<unsigned char*>(allocate_on_heap(size, alignment));
            CHECK(reinterpret_cast<uintptr_t>(block) % alignment == 0);
            std::memset(block, 0x5a, size);
            CHECK(block[0] == 0x5a);
            CHECK(block[size - 1] == 0x5a);
            release_on_heap(block, size, alignment);
        }
}

// A sanitizer ends the process instead.
TEST_CASE("heap: more than there is is refused" * doctest::skip(SANITIZED)) {
    CHECK_THROWS_AS(allocate_on_heap(std::numeric_limits<size_t>::max() / 2, 8), std::bad_alloc);
}
