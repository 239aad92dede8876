#include <doctest/doctest.h>

// In header_test.c, compiled as C99.
extern "C" int geoidx_header_test(void);

TEST_CASE("the header works in C99: the line of header_test.c that failed, 0 if none") {
    CHECK(geoidx_header_test() == 0);
}
