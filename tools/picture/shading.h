#pragma once

#include <cstdint>
#include <span>

#include "tools/picture/camera.h"
#include "tools/picture/colour_map.h"
#include "tools/picture/rasterizer.h"

namespace geodesic::tools {

// Lines at k * max_distance / (count + 1), k = 1 .. count, evenly wide on the screen.
struct Isolines {
    int count = 0;
    double spacing = 1; // in the distances' unit
    double width = 1.5; // in pixels
};

// What a pixel's colour follows from. The spans are per vertex.
struct Scene {
    const DrawnSurface& surface;
    const Camera& camera;
    std::span<const ScreenPoint> points;
    std::span<const float> distances;
    std::span<const float> sky; // visibility, 0 .. 1
    double max_distance = 0;    // of the finite ones
    Isolines isolines;
};

// The largest finite distance of a vertex that a triangle uses, 0 if there is none.
double largest_distance(const DrawnSurface& surface, std::span<const float> distances);

// How much of a line covers the place with this distance, 0 .. 1; `slope` is the distance's change per pixel.
double line_coverage(const Isolines& lines, double distance, double slope);

class Shader {
public:
    explicit Shader(const Scene& scene) : scene_(scene) {}

    // Of a triangle at a place on the screen.
    Colour operator()(uint32_t triangle, double x, double y) const;

private:
    Colour surface_colour(double distance, double slope) const;
    Colour lit(Colour colour, bool reachable, Vec3 normal, double sky) const;

    const Scene& scene_;
    ColourMap colour_map_;
};

}
