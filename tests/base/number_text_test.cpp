#include "src/base/number_text.h"

#include <limits>

#include <doctest/doctest.h>

using namespace geodesic;

TEST_CASE("number_text: at most nine digits, and one word for what is no number") {
    CHECK(number_text(0.5) == "0.5");
    CHECK(number_text(-3) == "-3");
    CHECK(number_text(1e300) == "1e+300");
    CHECK(number_text(4294967295.0) == "4.2949673e+09");
    CHECK(number_text(0.1 + 0.2) == "0.3");
    CHECK(number_text(std::numeric_limits<double>::quiet_NaN()) == "NaN");
    CHECK(number_text(-std::numeric_limits<double>::quiet_NaN()) == "NaN");
    CHECK(number_text(-std::numeric_limits<double>::infinity()) == "-inf");
}
