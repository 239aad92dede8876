// What is known of a pair of points beside its tables, and what that makes of their answer.
#include <doctest/doctest.h>

#include "src/points/point_queries.h"

using namespace geodesic;

TEST_CASE("known ways: bounds hold, and straight lines count unless tables know much shorter ways") {
    KnownWays known;
    CHECK(known.corrected(5) == 5);
    CHECK(known.corrected(INFINITE) == INFINITE);
    known.line = 4;
    CHECK(known.corrected(3) == 4);
    CHECK(known.corrected(5) == 5);
    known.other = 6;
    CHECK(known.corrected(7) == 6);
    CHECK(known.corrected(5) == 5);
    CHECK(known.corrected(INFINITE) == 6);
    known.seen = 5.5f;
    CHECK(known.corrected(5.49f) == 5.5f);
    CHECK(known.corrected(5) == 5);
    CHECK(known.corrected(INFINITE) == 5.5f);
    known.straight = 5.2f;
    CHECK(known.corrected(5.1f) == 5.2f);
    CHECK(known.corrected(4.5f) == 4.5f);
    CHECK(known.corrected(INFINITE) == 5.2f);
    known.is_shortest = true;
    CHECK(known.corrected(4.5f) == 5.2f);
}
