#pragma once

#include <string>
#include <vector>

namespace geodesic::bench {

struct Point {
    double x;
    double y;
};

struct Series {
    std::string label;
    std::vector<Point> points; // in the order of the line through them
};

// A line chart with both axes from 0.
struct Plot {
    std::string title;
    std::string x_label;
    std::string y_label;
    std::vector<Series> series;
};

std::string to_svg(const Plot& plot);

}
