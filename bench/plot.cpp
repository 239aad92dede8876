#include "bench/plot.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

namespace geodesic::bench {

namespace {

constexpr double WIDTH = 720, HEIGHT = 440, LEFT = 70, RIGHT = 130, TOP = 50, BOTTOM = 60;
constexpr int TICKS = 5;
constexpr std::array COLOURS{"#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#56b4e9"};

std::string number(double value) {
    char text[40];
    std::snprintf(text, sizeof text, "%.6g", value);
    return text;
}

std::string escaped(const std::string& text) {
    std::string result;
    for (const char c : text) result += c == '<' ? "&lt;" : c == '&' ? "&amp;" : std::string(1, c);
    return result;
}

std::string text_at(Point at, const std::string& text, const char* anchor) {
    return "<text x=\"" + number(at.x) + "\" y=\"" + number(at.y) + "\" text-anchor=\"" + anchor + "\">" +
           escaped(text) + "</text>\n";
}

std::string line(Point from, Point to, const char* colour) {
    return "<line x1=\"" + number(from.x) + "\" y1=\"" + number(from.y) + "\" x2=\"" + number(to.x) +
           "\" y2=\"" + number(to.y) + "\" stroke=\"" + colour + "\"/>\n";
}

// 1, 2 or 5 times a power of ten, so that TICKS steps or fewer reach `largest`.
double round_step(double largest) {
    if (!(largest > 0)) return 1;
    const double power = std::pow(10, std::floor(std::log10(largest / TICKS)));
    for (const double factor : {1.0, 2.0, 5.0})
        if (power * factor * TICKS >= largest) return power * factor;
    return power * 10;
}

struct Axes {
    double x_step;
    double y_step;

    Point place(Point p) const {
        return {LEFT + p.x / (x_step * TICKS) * (WIDTH - LEFT - RIGHT),
                HEIGHT - BOTTOM - p.y / (y_step * TICKS) * (HEIGHT - TOP - BOTTOM)};
    }
};

Axes axes_of(const Plot& plot) {
    Point largest{0, 0};
    for (const Series& series : plot.series)
        for (const Point& point : series.points)
            largest = {std::max(largest.x, point.x), std::max(largest.y, point.y)};
    return {round_step(largest.x), round_step(largest.y)};
}

std::string drawn(const Axes& axes) {
    std::string svg;
    for (int i = 0; i <= TICKS; ++i) {
        const Point x = axes.place({i * axes.x_step, 0});
        const Point y = axes.place({0, i * axes.y_step});
        svg += line(y, {WIDTH - RIGHT, y.y}, i ? "#ddd" : "#000");
        svg += text_at({x.x, x.y + 20}, number(i * axes.x_step), "middle");
        svg += text_at({y.x - 8, y.y + 4}, number(i * axes.y_step), "end");
    }
    return svg;
}

std::string drawn(const Series& series, size_t position, const Axes& axes) {
    const std::string colour = COLOURS[position % COLOURS.size()];
    std::string corners, dots;
    for (const Point& point : series.points) {
        const Point at = axes.place(point);
        corners += number(at.x) + ',' + number(at.y) + ' ';
        dots += "<circle cx=\"" + number(at.x) + "\" cy=\"" + number(at.y) + "\" r=\"4\" fill=\"" + colour +
                "\"/>\n";
    }
    const Point legend{WIDTH - RIGHT + 15, TOP + 20 * static_cast<double>(position)};
    return "<polyline points=\"" + corners + "\" fill=\"none\" stroke-width=\"2\" stroke=\"" + colour +
           "\"/>\n" + dots + line(legend, {legend.x + 20, legend.y}, colour.c_str()) +
           text_at({legend.x + 26, legend.y + 4}, series.label, "start");
}

std::string labels(const Plot& plot) {
    const Point y_label{20, (TOP + HEIGHT - BOTTOM) / 2};
    return text_at({LEFT, TOP - 20}, plot.title, "start") +
           text_at({(LEFT + WIDTH - RIGHT) / 2, HEIGHT - 15}, plot.x_label, "middle") +
           "<g transform=\"rotate(-90 " + number(y_label.x) + ' ' + number(y_label.y) + ")\">" +
           text_at(y_label, plot.y_label, "middle") + "</g>\n";
}

}

std::string to_svg(const Plot& plot) {
    const Axes axes = axes_of(plot);
    std::string svg = "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 " + number(WIDTH) + ' ' +
                      number(HEIGHT) + "\" font-family=\"sans-serif\" font-size=\"13\">\n" +
                      "<rect width=\"100%\" height=\"100%\" fill=\"#fff\"/>\n" + drawn(axes) + labels(plot);
    for (size_t i = 0; i < plot.series.size(); ++i) svg += drawn(plot.series[i], i, axes);
    return svg + "</svg>\n";
}

}
