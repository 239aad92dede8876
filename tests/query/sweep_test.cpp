// The innermost loop of MSAD: by every instruction set that this processor has.
#include "src/overlay/kernels/dispatch.h"

#include <array>
#include <cstring>

#include <doctest/doctest.h>

#include "tests/query/flat_border.h"

using namespace geodesic;
using namespace geodesic::test;

namespace {

// A border in the plane, with a gap here and there, sources below it and targets above.
struct Plane {
    Plane(std::vector<Point> line, std::vector<Point> above)
        : border(std::move(line)), targets(std::move(above)) {
        const size_t places = border.size();
        double longest = 0;
        for (const Point& target : targets)
            for (const Point& at : border) longest = std::max(longest, distance(target, at));
        quantum = static_cast<float>(longest / TableCode::LARGEST);
        length.assign(places + SourceCode::BLOCK, 1);
        for (size_t k = 0; k + 1 < places; ++k)
            length[k] = static_cast<float>(distance(border[k], border[k + 1]));
        length[places - 1] = NAN;
        codes.assign(targets.size() * places + TableCode::PADDING, 0);
        middles.assign(targets.size() * places + MiddleOffset::PADDING, 0);
        for (size_t r = 0; r < targets.size(); ++r) {
            for (size_t k = 0; k < places; ++k)
                codes[r * places + k] = code_of(distance(targets[r], border[k]));
            for (size_t k = 0; k + 1 < places; ++k) {
                const int mean = MiddleOffset::mean(codes[r * places + k], codes[r * places + k + 1]);
                const double beyond = mean - code_of(distance(targets[r], middle(k)));
                middles[r * places + k] =
                    static_cast<uint8_t>(std::lround(std::max(beyond, 0.0) / stride(k)));
            }
        }
    }

    int16_t stride(size_t k) const { return MiddleOffset::stride(length[k], quantum); }
    // How far the middle of a segment is, by the table.
    double from_middle(size_t k, size_t target) const {
        const size_t entry = target * border.size() + k;
        return double{quantum} *
               MiddleOffset::code(codes[entry], codes[entry + 1], middles[entry], stride(k));
    }

    Point middle(size_t k) const {
        return {(border[k].x + border[k + 1].x) / 2, (border[k].y + border[k + 1].y) / 2};
    }
    uint16_t code_of(double d) const { return static_cast<uint16_t>(std::lround(d / double{quantum})); }

    // Whatever the offsets of middles are there.
    void add_gap(size_t k) { length[k] = NAN; }
    void add_source(Point source) {
        std::vector<float> distances(border.size());
        for (size_t k = 0; k < border.size(); ++k)
            distances[k] = static_cast<float>(distance(source, border[k]));
        from.push_back(distances);
        sources.push_back(source);
    }

    // By definition.
    double least_way(size_t source, size_t target) const {
        double least = std::numeric_limits<double>::infinity();
        for (size_t k = 0; k < border.size(); ++k) {
            if (from[source][k] == INFINITE) continue;
            least = std::min(least, double{from[source][k]} + distance(border[k], targets[target]));
            if (k + 1 == border.size() || std::isnan(length[k]) || from[source][k + 1] == INFINITE) continue;
            least = std::min(least, distance(sources[source], middle(k)) + from_middle(k, target));
        }
        return least;
    }

    std::vector<Point> border, targets, sources;
    float quantum;
    std::vector<float> length;
    std::vector<uint16_t> codes;
    std::vector<uint8_t> middles;
    std::vector<std::vector<float>> from; // per source and place
};

// The least code or middle of each block of each row.
std::vector<uint16_t> bounds_of(const Plane& plane) {
    const size_t places = plane.border.size(), blocks = InnerBounds::blocks(places);
    std::vector<uint16_t> bounds(plane.targets.size() * blocks, TableCode::UNREACHED);
    for (size_t r = 0; r < plane.targets.size(); ++r)
        for (size_t k = 0; k < places; ++k) {
            uint16_t& bound = bounds[r * blocks + k / InnerBounds::PLACES];
            const size_t entry = r * places + k;
            bound = std::min(bound, plane.codes[entry]);
            if (plane.stride(k) > 0)
                bound = std::min(bound, MiddleOffset::code(plane.codes[entry], plane.codes[entry + 1],
                                                           plane.middles[entry], plane.stride(k)));
        }
    return bounds;
}

// Distances by row, of `count` sources from `first` on, side by side; of one source, over bounds or not.
std::vector<float> sweep(const Kernels& kernels, const Plane& plane, size_t first, size_t count,
                         bool bounded = false) {
    const size_t places = plane.border.size();
    const size_t room = (SourceCode::whole_blocks(places) + SourceCode::BLOCK) * count;
    std::vector<float> from(room, INFINITE), middle_from(room, 12345);
    std::vector<int16_t> code(room, -77), middle(room, -77);
    for (size_t k = 0; k < places; ++k)
        for (size_t i = 0; i < count; ++i) from[k * count + i] = plane.from[first + i][k];
    std::vector<int16_t> strides(SourceCode::whole_blocks(places), 0);
    for (size_t k = 0; k < places; ++k) strides[k] = plane.stride(k);
    const BorderDistances border{places, from.data(), plane.length.data(), strides.data(), plane.quantum};
    std::array<float, FIELDS_AT_ONCE> nearest{};
    std::vector<int16_t> bound(InnerBounds::blocks(places), -77);
    const std::vector<uint16_t> bounds = bounds_of(plane);
    const BorderCodes codes{code.data(), middle.data(), nearest.data(), bound.data()};
    const SweepRows rows{plane.targets.size(), plane.codes.data(), plane.middles.data(), bounds.data()};
    std::vector<float> distances(rows.count * count);
    (count == 1 ? kernels.prepare_sweep : kernels.prepare_sweep_each)(border, codes, middle_from.data());
    if (count == 1 && nearest[0] == INFINITE)
        distances.assign(rows.count, INFINITE);
    else
        (bounded      ? kernels.sweep_bounded
         : count == 1 ? kernels.sweep
                      : kernels.sweep_each)(border, codes, rows, distances.data());
    return distances;
}

// Of all sources, each alone, also over bounds, and all at once, which must be the same bits, by every
// instruction set.
std::vector<float> sweep_every_way(const Plane& plane) {
    const size_t rows = plane.targets.size();
    std::vector<float> first;
    uint64_t different = 0;
    for (const Kernels& kernels : runnable_kernels()) {
        CAPTURE(kernels.name);
        const auto each = sweep(kernels, plane, 0, FIELDS_AT_ONCE);
        if (first.empty()) first = each;
        CHECK(std::memcmp(first.data(), each.data(), each.size() * sizeof(float)) == 0);
        for (size_t i = 0; i < FIELDS_AT_ONCE; ++i) {
            const auto alone = sweep(kernels, plane, i, 1), bounded = sweep(kernels, plane, i, 1, true);
            for (size_t r = 0; r < rows; ++r)
                for (const float distance : {alone[r], bounded[r]})
                    different += std::memcmp(&distance, &each[r * FIELDS_AT_ONCE + i], sizeof(float)) != 0;
        }
    }
    CHECK(different == 0);
    return first;
}

Plane random_plane(size_t places, size_t targets, std::mt19937& random) {
    std::uniform_real_distribution<double> along(-5, 60), off(0.5, 30);
    std::vector<Point> above;
    for (size_t i = 0; i < targets; ++i) above.push_back({along(random), off(random)});
    Plane plane(line_of(places, random), above);
    for (size_t i = 0; i < FIELDS_AT_ONCE; ++i) plane.add_source({along(random), -off(random)});
    return plane;
}

uint64_t count_wrong(const Plane& plane, const std::vector<float>& distances) {
    uint64_t wrong = 0;
    for (size_t r = 0; r < plane.targets.size(); ++r)
        for (size_t i = 0; i < FIELDS_AT_ONCE; ++i) {
            const double expected = plane.least_way(i, r), answer = double{distances[r * FIELDS_AT_ONCE + i]};
            const double rounding = 1.1 * double{plane.quantum} + 1e-5 * expected; // half a step at each end
            wrong += std::isfinite(expected) ? std::abs(answer - expected) > rounding : answer != expected;
        }
    return wrong;
}

}

TEST_CASE("sweep: the least way over places and middles, by every instruction set") {
    std::mt19937 random(1);
    for (size_t places : {5u, 7u, 16u, 17u, 31u, 33u, 48u, 63u, 100u, 129u, 300u})
        for (size_t targets : {1u, 2u, 7u, 8u, 9u, 64u}) {
            CAPTURE(places);
            CAPTURE(targets);
            Plane plane = random_plane(places, targets, random);
            for (size_t k = 3; k + 1 < places; k += 7) plane.add_gap(k);
            CHECK(count_wrong(plane, sweep_every_way(plane)) == 0);
        }
}

TEST_CASE("sweep: sources that reach a part of the border, or nothing of it") {
    std::mt19937 random(2);
    for (size_t places : {6u, 33u, 70u}) {
        CAPTURE(places);
        Plane plane = random_plane(places, 11, random);
        plane.from[0].assign(places, INFINITE);
        plane.from[FIELDS_AT_ONCE - 1].assign(places, INFINITE);
        for (size_t k = 0; k < places; ++k)
            if (k % 3 != 2) plane.from[5][k] = INFINITE;
        plane.from[6].assign(places, INFINITE);
        plane.from[6][places - 1] = 5;
        CHECK(count_wrong(plane, sweep_every_way(plane)) == 0);
    }
}

TEST_CASE("sweep: the middle of a segment nearer than both of its ends") {
    Plane plane({{-30, 0}, {-10, 0}, {10, 0}, {30, 0}}, {{0, 1}, {0, 25}});
    for (size_t i = 0; i < FIELDS_AT_ONCE; ++i) plane.add_source({0, -0.5 - static_cast<double>(i)});
    const auto distances = sweep_every_way(plane);
    const double most_off = 20.0 / 500; // of a segment of length 20
    CHECK(std::abs(plane.from_middle(1, 0) - 1) < most_off);
    CHECK(std::abs(plane.from_middle(1, 1) - 25) < most_off);
    for (size_t i = 0; i < FIELDS_AT_ONCE; ++i)
        for (size_t r = 0; r < 2; ++r) {
            const double expected = 0.5 + static_cast<double>(i) + plane.from_middle(1, r);
            CHECK(double{distances[r * FIELDS_AT_ONCE + i]} == doctest::Approx(expected).epsilon(1e-3));
        }
}

TEST_CASE("sweep: targets out of reach") {
    std::mt19937 random(3);
    Plane plane = random_plane(40, 9, random);
    for (size_t k = 0; k < 40; ++k) {
        plane.codes[k] = TableCode::UNREACHED; // row 0: from everywhere
        plane.middles[k] = plane.middles[40 + k] = 0;
        if (k != 30) plane.codes[40 + k] = TableCode::UNREACHED; // row 1: but from one place, far off
    }
    plane.codes[40 + 30] = TableCode::LARGEST;
    const auto distances = sweep_every_way(plane);
    for (size_t i = 0; i < FIELDS_AT_ONCE; ++i) {
        CHECK(distances[i] == INFINITE);
        CHECK(double{distances[FIELDS_AT_ONCE + i]} ==
              doctest::Approx(double{plane.from[i][30] + TableCode::LARGEST * plane.quantum}).epsilon(1e-4));
    }
}
