#pragma once

#include <algorithm>
#include <cmath>
#include <random>
#include <span>
#include <vector>

#include "tests/capi/calls.h"
#include "tests/path/path_cases.h"

// Points of a surface, and fields from them.
namespace geodesic::test {

struct MeanError {
    double sum = 0;
    size_t count = 0;

    void add(double distance, double exact) {
        if (exact == 0) return;
        sum += std::abs(distance / exact - 1);
        ++count;
    }
    double mean() const { return sum / static_cast<double>(count); }
};

inline std::vector<std::vector<uint32_t>> triangles_around_vertices(const Soup& soup) {
    std::vector<std::vector<uint32_t>> around(soup.vertex_count());
    for (uint32_t t = 0; t < soup.triangles.size(); ++t)
        for (const uint32_t corner : soup.triangles[t]) around[corner].push_back(t);
    return around;
}

inline geoidx_surface_point random_edge_point(std::mt19937_64& random, uint32_t triangle) {
    geoidx_surface_point point{triangle, 0, {}};
    const size_t first = random() % 3;
    point.weights[first] = uniform(random, 0, 1);
    point.weights[(first + 1) % 3] = 1 - point.weights[first];
    return point;
}

// A point of a triangle, away from a vertex of it by that share of the way to the opposite edge.
inline geoidx_surface_point point_near(const Soup& soup, std::mt19937_64& random, uint32_t vertex,
                                       uint32_t triangle, double share) {
    geoidx_surface_point point{triangle, 0, {}};
    const auto& corners = soup.triangles[triangle];
    const auto k = static_cast<size_t>(std::ranges::find(corners, vertex) - corners.begin());
    const double turned = uniform(random, 0, 1);
    point.weights[k] = 1 - share;
    point.weights[(k + 1) % 3] = share * turned;
    point.weights[(k + 2) % 3] = share * (1 - turned);
    return point;
}

inline double longest_edge(const PathCase& on, const geoidx_surface_point& point) {
    const auto& t = on.soup.triangles[point.triangle];
    double longest = 0;
    for (size_t k = 0; k < 3; ++k)
        longest = std::max(longest, (on.soup.positions[t[k]] - on.soup.positions[t[(k + 1) % 3]]).norm());
    return longest;
}

inline std::vector<float> field(const PathCase& on, std::span<const geoidx_surface_point> sources,
                                const float* offsets = nullptr) {
    std::vector<float> distances(on.soup.vertex_count());
    require_success(geoidx_query_point_msad(on.query.get(), on.surface.get(), sources.data(),
                                            static_cast<uint32_t>(sources.size()), offsets, distances.data(),
                                            on.soup.vertex_count()));
    return distances;
}

}
