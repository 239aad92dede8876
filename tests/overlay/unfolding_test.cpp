// Points placed beside a segment by their distances from its ends.
#include "src/overlay/kernels/unfolding.h"

#include <cmath>

#include <doctest/doctest.h>

using namespace geodesic;

namespace {

constexpr float LENGTH = 5;

BesideFloats all(float value) { return BesideFloats{} + value; }

struct Point {
    float x, y;
    float from_first() const { return std::hypot(x, y); }
    float from_second() const { return std::hypot(LENGTH - x, y); }
};

// The square of the way between two points, whose distances from both ends are lessened by `error`.
float square_across(const Point& source, const Point& target, float error) {
    SegmentsFromSource<BesideFloats> from_source{{all(LENGTH), all(0.5f / LENGTH)}, {}, {}};
    from_source.segments.place_point(all(source.from_first() - error), all(source.from_second() - error),
                                     from_source.foot, from_source.height);
    BesideFloats square;
    from_source.square_across(all(target.from_first() - error), all(target.from_second() - error), square);
    return square[0];
}

}

TEST_CASE("unfolding: the way over a segment is the straight line, if that crosses the segment") {
    const Point source{1, 2};
    for (const Point target : {Point{3, 1}, Point{4, 3}, Point{0.5f, 0.25f}, Point{2, 0.001f}})
        CHECK(std::sqrt(square_across(source, target, 0)) ==
              doctest::Approx(std::hypot(source.x - target.x, source.y + target.y)).epsilon(1e-4));
    CHECK(square_across(source, {12, 1}, 0) == INFINITE);
}

// Without this, paths from such a point crossed the segment at its ends only.
TEST_CASE("unfolding: a point that is nearly on a segment stays there when distances are rounded") {
    const Point target{2, 2};
    for (const float x : {0.5f, 1.25f, 2.5f, 4.f})
        for (const float height : {0.f, 0.01f, 0.1f})
            for (const float error : {LENGTH / 1000, LENGTH / 128, LENGTH / 64}) {
                CAPTURE(x);
                CAPTURE(height);
                CAPTURE(error);
                const double way = std::sqrt(square_across({x, height}, target, error));
                CHECK(std::abs(way - std::hypot(double{x - target.x}, double{height + target.y})) <
                      0.05 * LENGTH);
            }
}

TEST_CASE("unfolding: no point is much nearer to both ends of a segment than its length") {
    const float half_a_length = LENGTH / 4;
    SegmentsFromSource<BesideFloats> from_source{{all(LENGTH), all(0.5f / LENGTH)}, {}, {}};
    from_source.segments.place_point(all(half_a_length), all(half_a_length), from_source.foot,
                                     from_source.height);
    CHECK(std::isnan(from_source.height[0]));
    BesideFloats square;
    from_source.square_across(all(4), all(4), square);
    CHECK(float{square[0]} == INFINITE);
    middle_square(all(half_a_length), all(half_a_length), all(LENGTH), square);
    CHECK(std::isnan(square[0]));
}

TEST_CASE("unfolding: the middle of a segment") {
    const float apart = 3;
    BesideFloats square;
    const Point point{1, apart};
    middle_square(all(point.from_first()), all(point.from_second()), all(LENGTH), square);
    CHECK(std::sqrt(square[0]) == doctest::Approx(std::hypot(LENGTH / 2 - 1, apart)));
    middle_square(all(LENGTH / 2 - 0.01f), all(LENGTH / 2 - 0.01f), all(LENGTH), square);
    CHECK(float{square[0]} == 0);
}
