#include "tools/picture/surface.h"

#include <limits>
#include <numeric>
#include <stdexcept>
#include <string>
#include <tuple>

namespace geodesic::tools {

namespace {

std::vector<std::array<uint32_t, 3>> grouped_by_three(std::span<const uint32_t> triangles) {
    std::vector<std::array<uint32_t, 3>> groups(triangles.size() / 3);
    for (size_t t = 0; t < groups.size(); ++t)
        groups[t] = {triangles[3 * t], triangles[3 * t + 1], triangles[3 * t + 2]};
    return groups;
}

// Only vertices that a triangle uses decide where the centre is and how large the mesh.
std::vector<Vec3> in_unit_ball(const TriangleMesh& mesh) {
    std::vector<Vec3> positions(mesh.vertex_count());
    for (size_t v = 0; v < positions.size(); ++v)
        positions[v] = {mesh.positions[3 * v], mesh.positions[3 * v + 1], mesh.positions[3 * v + 2]};
    for (size_t v = 0; v < positions.size(); ++v)
        if (!std::isfinite(positions[v].x + positions[v].y + positions[v].z))
            throw std::runtime_error("vertex " + std::to_string(v) + " has no finite position");
    constexpr double HUGE_NUMBER = std::numeric_limits<double>::max();
    Vec3 low{HUGE_NUMBER, HUGE_NUMBER, HUGE_NUMBER};
    Vec3 high = -1 * low;
    for (const uint32_t v : mesh.triangles) {
        low = minimum(low, positions[v]);
        high = maximum(high, positions[v]);
    }
    const Vec3 centre = 0.5 * low + 0.5 * high;
    const double radius = length(0.5 * high - 0.5 * low);
    for (Vec3& position : positions) position = (radius > 0 ? 1 / radius : 1) * (position - centre);
    return positions;
}

// The triangles around each place, one list after the other.
struct TrianglesAround {
    std::vector<uint32_t> place_of_vertex;
    std::vector<size_t> begin;
    std::vector<uint32_t> triangles;

    std::span<const uint32_t> of(uint32_t vertex) const {
        const uint32_t place = place_of_vertex[vertex];
        return {triangles.data() + begin[place], triangles.data() + begin[place + 1]};
    }
};

TrianglesAround triangles_around(const DrawnSurface& surface) {
    TrianglesAround around{first_in_same_place(surface.positions), {}, {}};
    around.begin.assign(surface.positions.size() + 1, 0);
    for (const auto& triangle : surface.triangles)
        for (const uint32_t v : triangle) ++around.begin[around.place_of_vertex[v] + 1];
    std::partial_sum(around.begin.begin(), around.begin.end(), around.begin.begin());
    around.triangles.resize(around.begin.back());
    std::vector<size_t> next(around.begin.begin(), around.begin.end() - 1);
    for (uint32_t t = 0; t < surface.triangles.size(); ++t)
        for (const uint32_t v : surface.triangles[t]) around.triangles[next[around.place_of_vertex[v]]++] = t;
    return around;
}

// The mean over the neighbours that go on smoothly, whichever way round their corners are listed.
Vec3 corner_normal(std::span<const Vec3> area_normals, std::span<const uint32_t> neighbours,
                   uint32_t triangle) {
    constexpr double COSINE_OF_CREASE = 0.6;
    const Vec3 own = area_normals[triangle];
    Vec3 sum = own;
    for (const uint32_t t : neighbours) {
        if (t == triangle) continue;
        const double product = dot(own, area_normals[t]);
        if (std::abs(product) < COSINE_OF_CREASE * length(own) * length(area_normals[t])) continue;
        sum = sum + (product < 0 ? -1.0 : 1.0) * area_normals[t];
    }
    return normalized(sum);
}

void add_normals(DrawnSurface& surface) {
    std::vector<Vec3> area_normals;
    area_normals.reserve(surface.triangles.size());
    for (const auto& [a, b, c] : surface.triangles)
        area_normals.push_back(
            cross(surface.positions[b] - surface.positions[a], surface.positions[c] - surface.positions[a]));
    const TrianglesAround around = triangles_around(surface);
    surface.normals.resize(surface.triangles.size());
    for (uint32_t t = 0; t < surface.triangles.size(); ++t)
        for (size_t corner = 0; corner < 3; ++corner)
            surface.normals[t][corner] =
                corner_normal(area_normals, around.of(surface.triangles[t][corner]), t);
}

}

std::vector<uint32_t> first_in_same_place(std::span<const Vec3> positions) {
    std::vector<uint32_t> order(positions.size());
    std::iota(order.begin(), order.end(), 0u);
    const auto key = [&](uint32_t v) { return std::tie(positions[v].x, positions[v].y, positions[v].z); };
    std::sort(order.begin(), order.end(),
              [&](uint32_t a, uint32_t b) { return key(a) != key(b) ? key(a) < key(b) : a < b; });
    std::vector<uint32_t> first(positions.size());
    for (size_t i = 0; i < order.size(); ++i)
        first[order[i]] = i > 0 && key(order[i]) == key(order[i - 1]) ? first[order[i - 1]] : order[i];
    return first;
}

DrawnSurface drawn_surface(const TriangleMesh& mesh) {
    DrawnSurface surface;
    surface.positions = in_unit_ball(mesh);
    surface.triangles = grouped_by_three(mesh.triangles);
    add_normals(surface);
    return surface;
}

}
