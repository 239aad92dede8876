#include "tests/support/drilled_plate.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace geodesic::test {

namespace {

using Eigen::Vector3d;
using Loop = std::vector<uint32_t>; // vertices in a row, the last one beside the first one

double cross(const Vector3d& a, const Vector3d& b, const Vector3d& c) {
    return (b.x() - a.x()) * (c.y() - a.y()) - (b.y() - a.y()) * (c.x() - a.x());
}

// A polygon with holes, cut open to one loop that has some vertices twice, and then into triangles.
class Cutter {
public:
    Cutter(const std::vector<Vector3d>& at, Loop outline) : at_(at), loop_(std::move(outline)) {}

    // Joins the hole to the nearest vertex of the loop, over which no part of the plate lies that is missing.
    void add_hole(const Loop& hole) {
        size_t from = 0, to = 0;
        double shortest = INFINITY;
        for (size_t i = 0; i < loop_.size(); ++i)
            for (size_t j = 0; j < hole.size(); ++j) {
                const double length = (at_[loop_[i]] - at_[hole[j]]).norm();
                if (length >= shortest || !sees(i, hole[j])) continue;
                from = i, to = j, shortest = length;
            }
        Loop way(hole.begin() + static_cast<ptrdiff_t>(to), hole.end());
        way.insert(way.end(), hole.begin(), hole.begin() + static_cast<ptrdiff_t>(to) + 1);
        way.push_back(loop_[from]);
        loop_.insert(loop_.begin() + static_cast<ptrdiff_t>(from) + 1, way.begin(), way.end());
    }

    // The first ear from the beginning on is cut off each time, however narrow it is.
    std::vector<std::array<uint32_t, 3>> triangles() {
        std::vector<std::array<uint32_t, 3>> made;
        while (loop_.size() > 3) {
            size_t i = 0;
            while (!is_ear(i)) ++i;
            made.push_back(corner(i));
            loop_.erase(loop_.begin() + static_cast<ptrdiff_t>((i + 1) % loop_.size()));
        }
        made.push_back({loop_[0], loop_[1], loop_[2]});
        return made;
    }

private:
    std::array<uint32_t, 3> corner(size_t i) const {
        const size_t n = loop_.size();
        return {loop_[i], loop_[(i + 1) % n], loop_[(i + 2) % n]};
    }

    bool is_ear(size_t i) const {
        const auto [a, b, c] = corner(i);
        if (cross(at_[a], at_[b], at_[c]) <= 1e-12) return false;
        return std::ranges::none_of(loop_, [&, a = a, b = b, c = c](uint32_t v) {
            return v != a && v != b && v != c && cross(at_[a], at_[b], at_[v]) >= 0 &&
                   cross(at_[b], at_[c], at_[v]) >= 0 && cross(at_[c], at_[a], at_[v]) >= 0;
        });
    }

    // Whether the way leaves the loop's vertex to the inside, and meets no edge.
    bool sees(size_t i, uint32_t v) const {
        const size_t n = loop_.size();
        const uint32_t u = loop_[i], before = loop_[(i + n - 1) % n], after = loop_[(i + 1) % n];
        const bool left_of_both =
            cross(at_[before], at_[u], at_[v]) > 0 && cross(at_[u], at_[after], at_[v]) > 0;
        const bool left_of_one =
            cross(at_[before], at_[u], at_[v]) > 0 || cross(at_[u], at_[after], at_[v]) > 0;
        if (!(cross(at_[before], at_[u], at_[after]) > 0 ? left_of_both : left_of_one)) return false;
        for (size_t k = 0; k < n; ++k) {
            const uint32_t a = loop_[k], b = loop_[(k + 1) % n];
            if (a == u || b == u) continue;
            if (cross(at_[u], at_[v], at_[a]) * cross(at_[u], at_[v], at_[b]) <= 0 &&
                cross(at_[a], at_[b], at_[u]) * cross(at_[a], at_[b], at_[v]) <= 0)
                return false;
        }
        return true;
    }

    const std::vector<Vector3d>& at_;
    Loop loop_;
};

}

Soup drilled_plate(uint32_t holes_in_a_row, uint32_t corners_of_a_hole, double thickness) {
    Soup soup;
    soup.positions = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
    std::vector<Loop> loops{{0, 1, 2, 3}};
    const double step = 1.0 / holes_in_a_row;
    for (uint32_t i = 0; i < holes_in_a_row * holes_in_a_row; ++i) {
        const Vector3d middle((i / holes_in_a_row + 0.5) * step, (i % holes_in_a_row + 0.5) * step, 0);
        Loop& hole = loops.emplace_back();
        for (uint32_t k = 0; k < corners_of_a_hole; ++k) { // clockwise
            const double angle = -2 * std::numbers::pi * (k + 0.3) / corners_of_a_hole;
            hole.push_back(soup.vertex_count());
            soup.positions.push_back(middle + 0.3 * step * Vector3d(std::cos(angle), std::sin(angle), 0));
        }
    }
    Cutter cutter(soup.positions, loops[0]);
    for (size_t i = 1; i < loops.size(); ++i) cutter.add_hole(loops[i]);
    soup.triangles = cutter.triangles();
    const uint32_t below = soup.vertex_count();
    for (uint32_t v = 0; v < below; ++v)
        soup.positions.push_back(soup.positions[v] - Vector3d(0, 0, thickness));
    for (size_t t = 0, top = soup.triangles.size(); t < top; ++t) {
        const auto [a, b, c] = soup.triangles[t];
        soup.triangles.push_back({a + below, c + below, b + below});
    }
    for (const Loop& loop : loops)
        for (size_t k = 0; k < loop.size(); ++k) {
            const uint32_t a = loop[k], b = loop[(k + 1) % loop.size()];
            soup.triangles.push_back({b, a, a + below});
            soup.triangles.push_back({b, a + below, b + below});
        }
    return soup;
}

}
