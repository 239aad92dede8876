#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include "src/overlay/kernels/dispatch.h"
#include "src/overlay/tables/tables.h"

namespace geodesic::test {

struct Point {
    double x, y;
};

inline double distance(Point a, Point b) { return std::hypot(a.x - b.x, a.y - b.y); }

// Along a straight line.
inline std::vector<Point> line_of(size_t places, std::mt19937& random) {
    std::uniform_real_distribution<double> gap(0.3, 1.7);
    std::vector<Point> border(places);
    for (size_t k = 1; k < places; ++k) border[k].x = border[k - 1].x + gap(random);
    return border;
}

// A border in the plane, a source below it, and rows for points above.
struct FlatBorder {
    FlatBorder(size_t places, Point source, const std::vector<Point>& targets, std::mt19937& random)
        : FlatBorder(line_of(places, random), source, targets) {}

    FlatBorder(const std::vector<Point>& border, Point source, const std::vector<Point>& targets) {
        const size_t places = border.size();
        double longest = 0;
        for (const Point& target : targets)
            for (const Point& at : border) longest = std::max(longest, geodesic_distance(target, at));
        quantum = static_cast<float>(longest / TableCode::LARGEST);
        const size_t room = (places / SourceCode::BLOCK + 2) * SourceCode::BLOCK;
        code.assign(room, SourceCode::UNREACHED);
        for (auto* values : {&to_source, &length, &half_inverse, &foot, &height}) values->assign(room, 0);
        double nearest = longest;
        for (const Point& at : border) nearest = std::min(nearest, geodesic_distance(source, at));
        for (size_t k = 0; k < places; ++k) {
            to_source[k] = static_cast<float>(geodesic_distance(source, border[k]));
            code[k] = static_cast<int16_t>(
                SourceCode::NEAREST +
                std::lround(std::min((double{to_source[k]} - nearest) / double{quantum}, 32766.0)));
            const Point next = border[std::min(k + 1, places - 1)];
            const Point along{next.x - border[k].x, next.y - border[k].y};
            const Point relative{source.x - border[k].x, source.y - border[k].y};
            length[k] = k + 1 == places ? NAN : static_cast<float>(std::hypot(along.x, along.y));
            half_inverse[k] = 0.5f / length[k];
            foot[k] = static_cast<float>((relative.x * along.x + relative.y * along.y) / double{length[k]});
            height[k] =
                static_cast<float>(std::abs(relative.x * along.y - relative.y * along.x) / double{length[k]});
        }
        // The ends are there to be neighbours only.
        for (size_t k : {size_t{0}, size_t{1}, places - 2, places - 1}) code[k] = SourceCode::UNREACHED;
        codes.assign(targets.size() * places + SourceCode::BLOCK, 0);
        for (size_t r = 0; r < targets.size(); ++r)
            for (size_t k = 0; k < places; ++k)
                codes[r * places + k] = static_cast<uint16_t>(
                    std::lround(geodesic_distance(targets[r], border[k]) / double{quantum}));
        for (size_t r = 0; r < targets.size(); ++r) rows.push_back(codes.data() + r * places);
        first_x = border[2].x;
        last_x = border[places - 3].x;
    }
    static double geodesic_distance(Point a, Point b) { return test::distance(a, b); }

    BorderFromSource from_source() const {
        return {rows.size() > 1 ? static_cast<size_t>(rows[1] - rows[0]) : codes.size() - SourceCode::BLOCK,
                code.data(),
                to_source.data(),
                length.data(),
                half_inverse.data(),
                foot.data(),
                height.data(),
                quantum};
    }

    float quantum;
    std::vector<int16_t> code;
    std::vector<float> to_source, length, half_inverse, foot, height;
    std::vector<uint16_t> codes;
    std::vector<const uint16_t*> rows;
    double first_x, last_x; // of what may be crossed
};

}
