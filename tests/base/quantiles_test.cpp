#include "src/base/quantiles.h"

#include <doctest/doctest.h>

using namespace geodesic;

TEST_CASE("quantiles: half and three quarters of the numbers are not below") {
    CHECK(median(std::vector<double>{}) == 0);
    CHECK(lower_quartile(std::vector<float>{}) == 0);
    CHECK(median(std::vector<double>{-2}) == -2);
    CHECK(median(std::vector<double>{5, -1, 3}) == 3);
    CHECK(median(std::vector<double>{4, 1, 9, 2}) == 4);
    CHECK(median(std::vector<int>{7, 7, 1, 7}) == 7);
    CHECK(lower_quartile(std::vector<int>{8, 1, 7, 2, 6, 3, 5, 4}) == 3);
    CHECK(lower_quartile(std::vector<int>{2, 1, 3}) == 1);
}
