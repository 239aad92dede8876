#include "tools/mesh_io/polygons.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace geodesic::tools {

namespace {

struct Corner {
    double x, y; // in the plane of the polygon, which turns left there
    uint32_t vertex;
};

using Vector = std::array<double, 3>;

Vector cross(const Vector& a, const Vector& b) {
    return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

double dot(const Vector& a, const Vector& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

// Twice the area of a, b, c; positive where they turn left.
double turn(const Corner& a, const Corner& b, const Corner& c) {
    return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

// Corners relative to the first one, in two axes across the mean normal (Newell's).
std::vector<Corner> flattened(std::span<const uint32_t> polygon, std::span<const double> positions) {
    const auto point = [&](size_t i) {
        Vector p;
        for (size_t k = 0; k < 3; ++k)
            p[k] = positions[3 * size_t{polygon[i]} + k] - positions[3 * size_t{polygon[0]} + k];
        return p;
    };
    Vector normal{};
    for (size_t i = 0; i < polygon.size(); ++i) {
        const Vector n = cross(point(i), point((i + 1) % polygon.size()));
        for (size_t k = 0; k < 3; ++k) normal[k] += n[k];
    }
    const auto magnitude = [&](size_t k) { return std::abs(normal[k]); };
    const size_t smallest = magnitude(0) < magnitude(1) ? (magnitude(0) < magnitude(2) ? 0 : 2)
                                                        : (magnitude(1) < magnitude(2) ? 1 : 2);
    Vector axis{};
    axis[smallest] = 1;
    const Vector u = cross(axis, normal), v = cross(normal, u);
    const double u_length = std::sqrt(dot(u, u)), v_length = std::sqrt(dot(v, v));
    std::vector<Corner> corners;
    for (size_t i = 0; i < polygon.size(); ++i)
        corners.push_back({dot(point(i), u) / u_length, dot(point(i), v) / v_length, polygon[i]});
    return corners;
}

bool is_convex(std::span<const Corner> corners) {
    const size_t n = corners.size();
    for (size_t i = 0; i < n; ++i)
        if (turn(corners[i], corners[(i + 1) % n], corners[(i + 2) % n]) < 0) return false;
    return true;
}

// Whether the triangle at corner i lies inside: it turns left and holds no other corner.
bool is_ear(std::span<const Corner> corners, size_t i) {
    const size_t n = corners.size();
    const Corner &a = corners[(i + n - 1) % n], &b = corners[i], &c = corners[(i + 1) % n];
    if (!(turn(a, b, c) > 0)) return false;
    return std::ranges::none_of(corners, [&](const Corner& p) {
        if (p.vertex == a.vertex || p.vertex == b.vertex || p.vertex == c.vertex) return false;
        return turn(a, b, p) >= 0 && turn(b, c, p) >= 0 && turn(c, a, p) >= 0;
    });
}

void append_fan(std::span<const Corner> corners, std::vector<uint32_t>& triangles) {
    for (size_t i = 2; i < corners.size(); ++i)
        triangles.insert(triangles.end(), {corners[0].vertex, corners[i - 1].vertex, corners[i].vertex});
}

// Cuts off ears while there are any; what crosses itself ends as a fan.
void append_ears(std::vector<Corner> corners, std::vector<uint32_t>& triangles) {
    while (corners.size() > 3) {
        size_t ear = 0;
        while (ear < corners.size() && !is_ear(corners, ear)) ++ear;
        if (ear == corners.size()) break;
        const size_t n = corners.size();
        triangles.insert(triangles.end(), {corners[(ear + n - 1) % n].vertex, corners[ear].vertex,
                                           corners[(ear + 1) % n].vertex});
        corners.erase(corners.begin() + static_cast<std::ptrdiff_t>(ear));
    }
    append_fan(corners, triangles);
}

}

void Polygons::add(std::span<const uint32_t> polygon) {
    if (polygon.size() < 3) return;
    corners.insert(corners.end(), polygon.begin(), polygon.end());
    ends.push_back(corners.size());
}

std::vector<uint32_t> triangulate(const Polygons& polygons, std::span<const double> positions) {
    std::vector<uint32_t> triangles;
    size_t begin = 0;
    for (const size_t end : polygons.ends) {
        const auto polygon = std::span(polygons.corners).subspan(begin, end - begin);
        begin = end;
        if (polygon.size() == 3) {
            triangles.insert(triangles.end(), polygon.begin(), polygon.end());
            continue;
        }
        auto corners = flattened(polygon, positions);
        if (is_convex(corners))
            append_fan(corners, triangles);
        else
            append_ears(std::move(corners), triangles);
    }
    return triangles;
}

std::string out_of_range(const std::string& index, uint64_t vertex_count) {
    return "vertex index " + index + " is out of range, the mesh has " + std::to_string(vertex_count) +
           " vertices";
}

}
