// What is known of a pair of points beside its tables, and what that makes of their answer.
#include <doctest/doctest.h>

#include "src/points/point_queries.h"

using namespace geodesic;

TEST_CASE("ways between: bounds hold, and straight lines count unless tables know much shorter ways") {
    WaysBetween ways;
    CHECK(ways.corrected(5) == 5);
    CHECK(ways.corrected(INFINITE) == INFINITE);
    ways.line = 4;
    CHECK(ways.corrected(3) == 4);
    CHECK(ways.corrected(5) == 5);
    ways.other = 6;
    CHECK(ways.corrected(7) == 6);
    CHECK(ways.corrected(5) == 5);
    CHECK(ways.corrected(INFINITE) == 6);
    ways.seen = 5.5f;
    CHECK(ways.corrected(5.49f) == 5.5f);
    CHECK(ways.corrected(5) == 5);
    CHECK(ways.corrected(INFINITE) == 5.5f);
    ways.straight = 5.2f;
    CHECK(ways.corrected(5.1f) == 5.2f);
    CHECK(ways.corrected(4.5f) == 4.5f);
    CHECK(ways.corrected(INFINITE) == 5.2f);
    ways.other = 5;
    CHECK(ways.corrected(5.1f) == 5);
    CHECK(ways.corrected(4.9f) == 4.9f);
    CHECK(ways.corrected(INFINITE) == 5);
    ways.other = 3;
    CHECK(ways.corrected(INFINITE) == 4);
    ways.is_shortest = true;
    CHECK(ways.corrected(4.5f) == 5.2f);
}
