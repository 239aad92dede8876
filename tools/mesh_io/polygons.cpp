#include "tools/mesh_io/polygons.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

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

// The sine of a turn that counts as none: far above the rounding of coordinates, and below the turns of a
// circle of 100,000 corners.
constexpr double STRAIGHT = 1e-5;

// The turn at corner i, 0 where it counts as none.
double turn_at(std::span<const Corner> corners, size_t i) {
    const size_t n = corners.size();
    const Corner &a = corners[(i + n - 1) % n], &b = corners[i % n], &c = corners[(i + 1) % n];
    const double turned = turn(a, b, c);
    const double lengths = std::hypot(b.x - a.x, b.y - a.y) * std::hypot(c.x - b.x, c.y - b.y);
    return std::abs(turned) <= STRAIGHT * lengths ? 0 : turned;
}

bool is_straight(std::span<const Corner> corners, size_t i) { return !(turn_at(corners, i) > 0); }

bool is_convex(std::span<const Corner> corners) {
    for (size_t i = 0; i < corners.size(); ++i)
        if (turn_at(corners, i) < 0) return false;
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

// A convex polygon that is cut into halves, and each half again; its first corner is one where it turns.
// Where corners lie on a straight side, no cut leads along it, since the triangles there would have no area:
// they are joined to the side across instead.
class Halves {
public:
    explicit Halves(std::span<const Corner> corners) : corners_(corners), count_(corners.size()) {
        find_runs();
    }

    void append_to(std::vector<uint32_t>& triangles) const {
        std::vector<Part> parts = whole();
        while (!parts.empty()) {
            const auto [first, middle, last] = parts.back();
            parts.pop_back();
            if (middle != NOT_CUT) {
                append_triangle(first, middle, last, triangles);
            } else if (last - first > 1) {
                const size_t cut = middle_of(first, last);
                parts.push_back({cut, NOT_CUT, last});
                parts.push_back({first, cut, last});
                parts.push_back({first, NOT_CUT, cut});
            }
        }
    }

private:
    // The corners from `first` to `last`, still to be cut at one of them, or the triangle of these three.
    struct Part {
        size_t first, middle, last;
    };
    static constexpr size_t NOT_CUT = SIZE_MAX;

    // Position count_ is the first corner again.
    void find_runs() {
        run_end_.assign(count_ + 1, count_);
        for (size_t i = count_ - 1; i-- > 0;)
            run_end_[i] = is_straight(corners_, i + 1) ? run_end_[i + 1] : i + 1;
        run_begin_.assign(count_ + 1, 0);
        for (size_t i = 2; i <= count_; ++i)
            run_begin_[i] = is_straight(corners_, i - 1) ? run_begin_[i - 1] : i - 1;
    }

    // Where a cut from either end may lead to: to the neighbour, which is no cut, or beyond the straight
    // side.
    size_t lowest_cut(size_t first) const { return run_end_[first] + (run_end_[first] > first + 1 ? 1 : 0); }
    size_t highest_cut(size_t last) const { return run_begin_[last] - (run_begin_[last] + 1 < last ? 1 : 0); }

    bool can_be_halved(size_t first, size_t last) const {
        return run_begin_[last] > 0 && lowest_cut(first) <= highest_cut(last);
    }

    size_t half_of(size_t first, size_t last) const {
        return std::clamp((first + last + 1) / 2, lowest_cut(first), highest_cut(last));
    }

    // Between two straight sides that meet, or with one edge between them, the longer one is left first.
    size_t middle_of(size_t first, size_t last) const {
        if (can_be_halved(first, last)) return half_of(first, last);
        return run_end_[first] - first >= last - run_begin_[last] ? first + 1 : last - 1;
    }

    // In two halves or, where the sides at the first corner leave no room for a cut from it, without it.
    std::vector<Part> whole() const {
        if (!can_be_halved(0, count_)) return {{1, NOT_CUT, count_ - 1}, {0, 1, count_ - 1}};
        const size_t cut = half_of(0, count_);
        return {{cut, NOT_CUT, count_}, {0, NOT_CUT, cut}};
    }

    void append_triangle(size_t a, size_t b, size_t c, std::vector<uint32_t>& triangles) const {
        if (c == count_)
            triangles.insert(triangles.end(), {corners_[0].vertex, corners_[a].vertex, corners_[b].vertex});
        else
            triangles.insert(triangles.end(), {corners_[a].vertex, corners_[b].vertex, corners_[c].vertex});
    }

    const std::span<const Corner> corners_;
    const size_t count_;
    // Per position: the last and the first one that lie with it on a straight side, as far as this leads on
    // or back from there.
    std::vector<size_t> run_end_, run_begin_;
};

// One without area ends as a fan.
void append_halves(std::vector<Corner> corners, std::vector<uint32_t>& triangles) {
    size_t first = 0;
    while (first < corners.size() && is_straight(corners, first)) ++first;
    if (first == corners.size()) return append_fan(corners, triangles);
    std::rotate(corners.begin(), corners.begin() + static_cast<std::ptrdiff_t>(first), corners.end());
    Halves(corners).append_to(triangles);
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
            append_halves(std::move(corners), triangles);
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
