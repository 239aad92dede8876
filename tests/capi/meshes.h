#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <random>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "geoidx.h"

namespace geodesic::test {

struct TestMesh {
    std::vector<double> positions; // x, y, z of each vertex
    std::vector<uint32_t> triangles;

    uint32_t vertex_count() const { return static_cast<uint32_t>(positions.size() / 3); }
    uint32_t triangle_count() const { return static_cast<uint32_t>(triangles.size() / 3); }

    uint32_t add_vertex(double x, double y, double z) {
        positions.insert(positions.end(), {x, y, z});
        return vertex_count() - 1;
    }
    void add_triangle(uint32_t a, uint32_t b, uint32_t c) { triangles.insert(triangles.end(), {a, b, c}); }

    // As the library takes it; valid as long as this mesh is not changed.
    geoidx_mesh view() const {
        geoidx_mesh mesh;
        geoidx_mesh_init(&mesh);
        mesh.position_type = GEOIDX_POSITION_DOUBLE;
        mesh.positions = positions.data();
        mesh.vertex_count = vertex_count();
        mesh.triangles = triangles.data();
        mesh.triangle_count = triangle_count();
        return mesh;
    }

    double straight(uint32_t a, uint32_t b) const {
        return std::hypot(positions[3 * a] - positions[3 * b], positions[3 * a + 1] - positions[3 * b + 1],
                          positions[3 * a + 2] - positions[3 * b + 2]);
    }
};

// Each edge once, the smaller id first.
inline std::set<std::pair<uint32_t, uint32_t>> edges_of(const TestMesh& mesh) {
    std::set<std::pair<uint32_t, uint32_t>> edges;
    for (size_t t = 0; t < mesh.triangles.size(); t += 3)
        for (size_t k = 0; k < 3; ++k)
            edges.insert(std::minmax(mesh.triangles[t + k], mesh.triangles[t + (k + 1) % 3]));
    return edges;
}

inline double average_edge(const TestMesh& mesh) {
    const auto edges = edges_of(mesh);
    double sum = 0;
    for (const auto& [a, b] : edges) sum += mesh.straight(a, b);
    return sum / static_cast<double>(edges.size());
}

// The same mesh in single precision.
struct FloatMesh {
    std::vector<float> positions;
    const std::vector<uint32_t>& triangles;

    explicit FloatMesh(const TestMesh& mesh) : triangles(mesh.triangles) {
        for (const double coordinate : mesh.positions) positions.push_back(static_cast<float>(coordinate));
    }

    geoidx_mesh view() const {
        geoidx_mesh mesh;
        geoidx_mesh_init(&mesh);
        mesh.positions = positions.data();
        mesh.vertex_count = positions.size() / 3;
        mesh.triangles = triangles.data();
        mesh.triangle_count = triangles.size() / 3;
        return mesh;
    }
};

inline TestMesh one_triangle() { return {{0, 0, 0, 3, 0, 0, 0, 4, 0}, {0, 1, 2}}; }
inline TestMesh two_triangles() { return {{0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0}, {0, 1, 2, 0, 2, 3}}; }

// A flat rectangle of `columns` x `rows` vertices, one unit apart. `jitter` moves every vertex but those on
// the boundary by at most so much along x and y; below 0.3 no triangle turns over.
inline TestMesh grid(uint32_t columns, uint32_t rows, double jitter = 0) {
    std::mt19937 random(7);
    const auto moved = [&](uint32_t i, uint32_t count) {
        const double unit = static_cast<double>(random()) / 4294967296.0;
        return i + (i == 0 || i + 1 == count ? 0 : jitter * (2 * unit - 1));
    };
    TestMesh mesh;
    for (uint32_t y = 0; y < rows; ++y)
        for (uint32_t x = 0; x < columns; ++x) {
            const bool boundary = x == 0 || y == 0 || x + 1 == columns || y + 1 == rows;
            // In this order, which that of a call's arguments would leave to the compiler.
            const double at_y = boundary ? y : moved(y, rows), at_x = boundary ? x : moved(x, columns);
            mesh.add_vertex(at_x, at_y, 0);
        }
    for (uint32_t y = 0; y + 1 < rows; ++y)
        for (uint32_t x = 0; x + 1 < columns; ++x) {
            const uint32_t a = y * columns + x, b = a + 1, c = a + columns, d = c + 1;
            mesh.add_triangle(a, b, d);
            mesh.add_triangle(a, d, c);
        }
    return mesh;
}

// A grid lifted into hills: no closed form, no symmetry.
inline TestMesh hills(uint32_t columns, uint32_t rows) {
    TestMesh mesh = grid(columns, rows, 0.25);
    for (size_t i = 0; i < mesh.positions.size(); i += 3)
        mesh.positions[i + 2] = 1.5 * std::sin(mesh.positions[i] * 0.7) * std::cos(mesh.positions[i + 1]);
    return mesh;
}

// `around` x `along` vertices on a torus of the radii 3 and 1.
// Random heights: nearly no two triangles lie in a plane.
inline TestMesh rough_sheet(uint32_t side, double height) {
    TestMesh mesh = grid(side, side);
    std::mt19937 random(5);
    for (size_t i = 2; i < mesh.positions.size(); i += 3)
        mesh.positions[i] = height * static_cast<double>(random() % 1000) / 1000;
    return mesh;
}

// Half planes of columns x rows cells that begin at one line, whose vertices they share: as many triangles
// meet at each edge of it.
inline TestMesh pages(uint32_t count, uint32_t columns, uint32_t rows) {
    constexpr double TURN = 6.283185307179586;
    TestMesh mesh;
    for (uint32_t j = 0; j <= rows; ++j) mesh.add_vertex(0, 0, j);
    for (uint32_t page = 0; page < count; ++page) {
        const uint32_t first = mesh.vertex_count();
        const double x = std::cos(TURN * page / count), y = std::sin(TURN * page / count);
        for (uint32_t i = 1; i <= columns; ++i)
            for (uint32_t j = 0; j <= rows; ++j) mesh.add_vertex(i * x, i * y, j);
        const auto at = [&](uint32_t i, uint32_t j) { return i == 0 ? j : first + (i - 1) * (rows + 1) + j; };
        for (uint32_t i = 0; i < columns; ++i)
            for (uint32_t j = 0; j < rows; ++j) {
                mesh.add_triangle(at(i, j), at(i + 1, j), at(i + 1, j + 1));
                mesh.add_triangle(at(i, j), at(i + 1, j + 1), at(i, j + 1));
            }
    }
    return mesh;
}

inline TestMesh torus(uint32_t around, uint32_t along) {
    constexpr double TURN = 6.283185307179586;
    TestMesh mesh;
    for (uint32_t i = 0; i < around; ++i)
        for (uint32_t j = 0; j < along; ++j) {
            const double u = TURN * i / around, v = TURN * j / along, r = 3 + std::cos(v);
            mesh.add_vertex(r * std::cos(u), r * std::sin(u), std::sin(v));
        }
    const auto at = [&](uint32_t i, uint32_t j) { return i % around * along + j % along; };
    for (uint32_t i = 0; i < around; ++i)
        for (uint32_t j = 0; j < along; ++j) {
            mesh.add_triangle(at(i, j), at(i + 1, j), at(i + 1, j + 1));
            mesh.add_triangle(at(i, j), at(i + 1, j + 1), at(i, j + 1));
        }
    return mesh;
}

// The unit sphere as textbooks write it: `rings` + 1 rows of `around` vertices from pole to pole, stretched
// to `height`. The first row is one point; the last one is a ring with this radius, about 1.2e-16 if the
// sine of pi is asked for.
inline TestMesh textbook_sphere(uint32_t rings, uint32_t around, double height, double last_radius) {
    constexpr double TURN = 6.283185307179586;
    TestMesh mesh;
    for (uint32_t i = 0; i <= rings; ++i)
        for (uint32_t j = 0; j < around; ++j) {
            const double v = TURN / 2 * i / rings, u = TURN * j / around;
            const double radius = i == rings ? last_radius : std::sin(v);
            mesh.add_vertex(radius * std::cos(u), radius * std::sin(u), height * std::cos(v));
        }
    for (uint32_t i = 0; i < rings; ++i)
        for (uint32_t j = 0; j < around; ++j) {
            const uint32_t a = i * around + j, b = i * around + (j + 1) % around;
            mesh.add_triangle(a, b, b + around);
            mesh.add_triangle(a, b + around, a + around);
        }
    return mesh;
}

// Poles and `rings` circles of `around` vertices on the unit sphere.
inline TestMesh sphere(uint32_t rings, uint32_t around) {
    constexpr double TURN = 6.283185307179586;
    TestMesh mesh;
    for (uint32_t i = 0; i < rings; ++i)
        for (uint32_t j = 0; j < around; ++j) {
            const double v = TURN / 2 * (i + 1) / (rings + 1), u = TURN * (j + 0.5 * (i % 2)) / around;
            mesh.add_vertex(std::sin(v) * std::cos(u), std::sin(v) * std::sin(u), std::cos(v));
        }
    const uint32_t north = mesh.add_vertex(0, 0, 1), south = mesh.add_vertex(0, 0, -1);
    const auto at = [&](uint32_t i, uint32_t j) { return i * around + j % around; };
    for (uint32_t j = 0; j < around; ++j) {
        mesh.add_triangle(north, at(0, j), at(0, j + 1));
        mesh.add_triangle(south, at(rings - 1, j + 1), at(rings - 1, j));
        for (uint32_t i = 0; i + 1 < rings; ++i) {
            const uint32_t shift = i % 2; // of the next ring against this one
            mesh.add_triangle(at(i, j), at(i + 1, j + shift), at(i, j + 1));
            mesh.add_triangle(at(i, j + 1), at(i + 1, j + shift), at(i + 1, j + shift + 1));
        }
    }
    return mesh;
}

// A box with a side of 2 whose edges and corners are bevelled, by so little: each face is a grid of
// cells x cells whose outermost rows are the bevels. Each vertex is there once.
inline TestMesh bevelled_box(uint32_t cells, double bevel) {
    TestMesh mesh;
    using Place = std::array<uint32_t, 3>;
    std::map<Place, uint32_t> vertices;
    const auto line = [&](uint32_t i) {
        if (i == 1) return bevel - 1;
        if (i + 1 == cells) return 1 - bevel;
        return 2.0 * i / cells - 1;
    };
    const auto vertex = [&](const Place& place) {
        const auto [at, is_new] = vertices.try_emplace(place, mesh.vertex_count());
        if (!is_new) return at->second;
        std::array<double, 3> core, out;
        for (size_t k = 0; k < 3; ++k) {
            core[k] = std::clamp(line(place[k]), bevel - 1, 1 - bevel);
            out[k] = line(place[k]) - core[k];
        }
        const double length = std::hypot(out[0], out[1], out[2]);
        for (size_t k = 0; k < 3; ++k) core[k] += bevel * out[k] / length;
        return mesh.add_vertex(core[0], core[1], core[2]);
    };
    for (size_t axis = 0; axis < 3; ++axis)
        for (const uint32_t side : {0u, cells})
            for (uint32_t i = 0; i < cells; ++i)
                for (uint32_t j = 0; j < cells; ++j) {
                    const auto corner = [&](uint32_t x, uint32_t y) {
                        Place place;
                        place[axis] = side;
                        place[(axis + 1) % 3] = side == 0 ? y : x;
                        place[(axis + 2) % 3] = side == 0 ? x : y;
                        return vertex(place);
                    };
                    mesh.add_triangle(corner(i, j), corner(i + 1, j), corner(i + 1, j + 1));
                    mesh.add_triangle(corner(i, j), corner(i + 1, j + 1), corner(i, j + 1));
                }
    return mesh;
}

// The surface of bars one unit thick along the edges of cells x cells x cells cubes of four units each: tubes
// of four sides that meet in every corner.
inline TestMesh lattice(uint32_t cells) {
    const int side = static_cast<int>(4 * cells + 1);
    const auto is_bar = [&](const std::array<int, 3>& at) {
        int on_edge = 0;
        for (const int c : at) {
            if (c < 0 || c >= side) return false;
            on_edge += c % 4 == 0;
        }
        return on_edge >= 2;
    };
    TestMesh mesh;
    std::map<std::array<int, 3>, uint32_t> id_of;
    const auto id = [&](const std::array<int, 3>& corner) {
        const auto [at, is_new] = id_of.try_emplace(corner, mesh.vertex_count());
        if (is_new) mesh.positions.insert(mesh.positions.end(), corner.begin(), corner.end());
        return at->second;
    };
    for (int i = 0; i < side * side * side; ++i)
        for (size_t axis = 0; axis < 3; ++axis)
            for (const int step : {0, 1}) {
                std::array<int, 3> at{i % side, i / side % side, i / side / side}, beside = at;
                beside[axis] += step ? 1 : -1;
                if (!is_bar(at) || is_bar(beside)) continue;
                at[axis] += step;
                std::array<uint32_t, 4> corners;
                for (size_t k = 0; k < 4; ++k) {
                    auto corner = at;
                    corner[(axis + 1) % 3] += step ? k == 1 || k == 2 : k >= 2;
                    corner[(axis + 2) % 3] += step ? k >= 2 : k == 1 || k == 2;
                    corners[k] = id(corner);
                }
                for (const size_t k : {0u, 1u, 2u, 0u, 2u, 3u}) mesh.triangles.push_back(corners[k]);
            }
    return mesh;
}

inline void append(TestMesh& mesh, const TestMesh& other, double shift) {
    const uint32_t first = mesh.vertex_count();
    for (size_t i = 0; i < other.positions.size(); ++i)
        mesh.positions.push_back(other.positions[i] + (i % 3 == 0 ? shift : 0));
    for (uint32_t v : other.triangles) mesh.triangles.push_back(first + v);
}

// Three components and, before, between and after them, vertices that no triangle uses.
inline TestMesh components_and_unused() {
    TestMesh mesh;
    mesh.add_vertex(-50, 0, 0);
    append(mesh, hills(14, 13), 0);
    mesh.add_vertex(50, 0, 0);
    append(mesh, one_triangle(), 100);
    append(mesh, sphere(7, 12), 200);
    mesh.add_vertex(300, 0, 0);
    return mesh;
}

// A grid cut into two along its middle column, which both halves have: what exporters make of a texture seam.
inline TestMesh seam(uint32_t columns, uint32_t rows) {
    TestMesh mesh = grid(columns, rows, 0.2);
    const uint32_t middle = columns / 2, whole = mesh.vertex_count();
    for (uint32_t y = 0; y < rows; ++y) {
        const size_t i = 3 * size_t{y * columns + middle};
        mesh.add_vertex(mesh.positions[i], mesh.positions[i + 1], mesh.positions[i + 2]);
    }
    for (size_t t = 0; t < mesh.triangles.size(); t += 3) {
        uint32_t leftmost = columns;
        for (size_t k = 0; k < 3; ++k) leftmost = std::min(leftmost, mesh.triangles[t + k] % columns);
        for (size_t k = 0; k < 3; ++k)
            if (leftmost >= middle && mesh.triangles[t + k] % columns == middle)
                mesh.triangles[t + k] = whole + mesh.triangles[t + k] / columns;
    }
    return mesh;
}

struct NamedMesh {
    std::string name;
    TestMesh mesh;
};

// One of each kind, 3 to 330 vertices.
inline std::vector<NamedMesh> mesh_zoo() {
    return {{"one triangle", one_triangle()},
            {"two triangles", two_triangles()},
            {"grid", grid(15, 12)},
            {"jittered grid", grid(14, 13, 0.25)},
            {"hills", hills(18, 18)},
            {"sphere", sphere(10, 16)},
            {"torus", torus(20, 10)},
            {"components and unused vertices", components_and_unused()},
            {"seam", seam(15, 11)}};
}

}
