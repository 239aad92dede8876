#include "tests/support/meshes.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <numeric>

#include <Eigen/Geometry>

namespace geodesic::test {

namespace {

using Eigen::Vector3d;

// Gives each point of a lattice one vertex.
class LatticeBuilder {
public:
    Soup soup;

    template <class Place>
    uint32_t vertex(std::array<int, 3> key, Place&& place) {
        const auto [entry, added] = ids_.try_emplace(key, soup.vertex_count());
        if (added) soup.positions.push_back(place(key));
        return entry->second;
    }

private:
    std::map<std::array<int, 3>, uint32_t> ids_;
};

void add_quad(Soup& soup, uint32_t a, uint32_t b, uint32_t c, uint32_t d) {
    soup.triangles.push_back({a, b, c});
    soup.triangles.push_back({a, c, d});
}

template <class T>
void shuffle(std::vector<T>& items, std::mt19937_64& random) {
    for (size_t i = items.size(); i > 1; --i) std::swap(items[i - 1], items[random() % i]);
}

double cross(const Vector3d& a, const Vector3d& b, const Vector3d& c) {
    return (b.x() - a.x()) * (c.y() - a.y()) - (b.y() - a.y()) * (c.x() - a.x());
}

bool in_circumcircle(const Vector3d& a, const Vector3d& b, const Vector3d& c, const Vector3d& p) {
    Eigen::Matrix3d rows;
    for (int i = 0; i < 3; ++i) {
        const Vector3d d = (i == 0 ? a : i == 1 ? b : c) - p;
        rows.row(i) << d.x(), d.y(), d.x() * d.x() + d.y() * d.y();
    }
    return rows.determinant() > 0;
}

// Bowyer and Watson: the triangles whose circumcircle contains the point give way to a fan around it.
void insert_point(Soup& soup, const Vector3d& p) {
    const uint32_t added = soup.vertex_count();
    std::map<std::array<uint32_t, 2>, bool> rim;
    std::vector<std::array<uint32_t, 3>> kept;
    for (const auto& t : soup.triangles) {
        const auto& x = soup.positions;
        if (!in_circumcircle(x[t[0]], x[t[1]], x[t[2]], p)) {
            kept.push_back(t);
            continue;
        }
        for (size_t k = 0; k < 3; ++k) {
            const uint32_t a = t[k], b = t[(k + 1) % 3];
            if (rim.erase({b, a}) == 0) rim[{a, b}] = true;
        }
    }
    soup.positions.push_back(p);
    for (const auto& [edge, unused] : rim) kept.push_back({edge[0], edge[1], added});
    soup.triangles = std::move(kept);
}

Soup subdivided_on_sphere(const Soup& coarse) {
    Soup fine;
    fine.positions = coarse.positions;
    std::map<std::array<uint32_t, 2>, uint32_t> middles;
    const auto middle = [&](uint32_t a, uint32_t b) {
        const auto [entry, added] =
            middles.try_emplace({std::min(a, b), std::max(a, b)}, fine.vertex_count());
        if (added) fine.positions.push_back((fine.positions[a] + fine.positions[b]).normalized());
        return entry->second;
    };
    for (const auto& [a, b, c] : coarse.triangles) {
        const uint32_t ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
        for (const std::array<uint32_t, 3>& t :
             {std::array{a, ab, ca}, std::array{b, bc, ab}, std::array{c, ca, bc}, std::array{ab, bc, ca}})
            fine.triangles.push_back(t);
    }
    return fine;
}

void split_face(Soup& soup, size_t face, double u, double v) {
    const auto [a, b, c] = soup.triangles[face];
    const uint32_t added = soup.vertex_count();
    soup.positions.push_back(u * soup.positions[a] + v * soup.positions[b] + (1 - u - v) * soup.positions[c]);
    soup.triangles[face] = {a, b, added};
    soup.triangles.push_back({b, c, added});
    soup.triangles.push_back({c, a, added});
}

}

double uniform(std::mt19937_64& random, double low, double high) {
    return low + (high - low) * (static_cast<double>(random() >> 11) * 0x1p-53);
}

geoidx_mesh view_of(const Soup& soup) {
    geoidx_mesh mesh{};
    mesh.struct_size = sizeof mesh;
    mesh.position_type = GEOIDX_POSITION_DOUBLE;
    mesh.positions = soup.positions.data();
    mesh.vertex_count = soup.positions.size();
    mesh.triangles = soup.triangles.data()->data();
    mesh.triangle_count = soup.triangles.size();
    return mesh;
}

Mesh mesh_of(const Soup& soup) {
    Mesh mesh;
    mesh.positions = soup.positions;
    mesh.faces = soup.triangles;
    connect(mesh);
    return mesh;
}

Soup grid(uint32_t columns, uint32_t rows, double width, double height) {
    Soup soup;
    for (uint32_t y = 0; y <= rows; ++y)
        for (uint32_t x = 0; x <= columns; ++x)
            soup.positions.push_back({width * x / columns, height * y / rows, 0});
    for (uint32_t y = 0; y < rows; ++y)
        for (uint32_t x = 0; x < columns; ++x) {
            const uint32_t a = x + y * (columns + 1), b = a + columns + 1;
            add_quad(soup, a, a + 1, b + 1, b);
        }
    return soup;
}

Soup jittered_grid(uint32_t cells, uint64_t seed) {
    std::mt19937_64 random(seed);
    Soup soup = grid(cells, cells, 1, 1);
    // Too little to turn a triangle over, whichever way its three corners move.
    const double step = 0.2 / cells;
    for (auto& p : soup.positions)
        if (p.x() > 0 && p.x() < 1 && p.y() > 0 && p.y() < 1)
            p += Vector3d{uniform(random, -step, step), uniform(random, -step, step), 0};
    for (size_t f = 0; f < soup.triangles.size(); f += 2) {
        if (random() & 1) continue;
        const auto [a, b, c] = soup.triangles[f];
        const uint32_t d = soup.triangles[f + 1][2];
        // The other diagonal, where the quad is convex enough for it.
        const auto& x = soup.positions;
        if (cross(x[a], x[b], x[d]) <= 1e-6 || cross(x[b], x[c], x[d]) <= 1e-6) continue;
        soup.triangles[f] = {a, b, d};
        soup.triangles[f + 1] = {b, c, d};
    }
    return soup;
}

Soup delaunay_square(uint32_t inner_points, uint64_t seed) {
    std::mt19937_64 random(seed);
    Soup soup = grid(1, 1, 1, 1);
    for (uint32_t i = 0; i < inner_points; ++i)
        insert_point(soup, {uniform(random, 0.01, 0.99), uniform(random, 0.01, 0.99), 0});
    return soup;
}

Soup l_shape(uint32_t cells_per_unit) {
    LatticeBuilder builder;
    const int n = static_cast<int>(cells_per_unit);
    const auto at = [&](int x, int y) {
        return builder.vertex({x, y, 0}, [&](const std::array<int, 3>& key) {
            return Vector3d(static_cast<double>(key[0]) / n, static_cast<double>(key[1]) / n, 0);
        });
    };
    for (int y = 0; y < 2 * n; ++y)
        for (int x = 0; x < 2 * n; ++x)
            if (x < n || y < n)
                add_quad(builder.soup, at(x, y), at(x + 1, y), at(x + 1, y + 1), at(x, y + 1));
    return builder.soup;
}

Soup annulus(uint32_t sectors, uint32_t rings) {
    Soup soup;
    for (uint32_t r = 0; r <= rings; ++r)
        for (uint32_t s = 0; s < sectors; ++s) {
            const double angle = 2 * std::numbers::pi * s / sectors,
                         radius = 1 + static_cast<double>(r) / rings;
            soup.positions.push_back({radius * std::cos(angle), radius * std::sin(angle), 0});
        }
    for (uint32_t r = 0; r < rings; ++r)
        for (uint32_t s = 0; s < sectors; ++s) {
            const uint32_t next = (s + 1) % sectors, low = r * sectors, high = low + sectors;
            add_quad(soup, low + s, high + s, high + next, low + next);
        }
    return soup;
}

Soup pinched_sheets(uint32_t half_cells) {
    LatticeBuilder builder;
    const int n = static_cast<int>(half_cells);
    const auto place = [&](const std::array<int, 3>& key) {
        return Vector3d(static_cast<double>(key[0]) / n, static_cast<double>(key[1]) / n,
                        static_cast<double>(key[2]) / n);
    };
    builder.vertex({0, 0, 0}, place);
    for (int sheet = 0; sheet < 2; ++sheet) {
        // The second sheet stands on its corner, so that the two meet in the origin only.
        const auto at = [&](int x, int y) {
            return builder.vertex(sheet == 0 ? std::array{x, y, 0} : std::array{0, x - y, x + y}, place);
        };
        const int low = sheet == 0 ? -n : 0;
        for (int y = low; y < n; ++y)
            for (int x = low; x < n; ++x)
                add_quad(builder.soup, at(x, y), at(x + 1, y), at(x + 1, y + 1), at(x, y + 1));
    }
    return builder.soup;
}

Soup comb(uint32_t cells) {
    LatticeBuilder builder;
    const int n = static_cast<int>(cells);
    const auto at = [&](int x, int y, int z) {
        return builder.vertex({x, y, z}, [&](const std::array<int, 3>& key) -> Vector3d {
            return Vector3d(key[0], key[1], key[2]) / (6.0 * n);
        });
    };
    for (int y = 0; y < 6 * n; ++y) {
        for (int x = 0; x < 6 * n; ++x)
            add_quad(builder.soup, at(x, y, 0), at(x + 1, y, 0), at(x + 1, y + 1, 0), at(x, y + 1, 0));
        for (int x : {2 * n, 4 * n})
            for (int z = 0; z < 3 * n; ++z)
                add_quad(builder.soup, at(x, y, z), at(x, y + 1, z), at(x, y + 1, z + 1), at(x, y, z + 1));
    }
    return builder.soup;
}

Soup cube(uint32_t cells) {
    LatticeBuilder builder;
    const int n = static_cast<int>(cells);
    for (size_t axis = 0; axis < 3; ++axis)
        for (int level : {0, n}) {
            const auto at = [&](int u, int v) {
                std::array<int, 3> key{};
                key[axis] = level;
                key[(axis + 1) % 3] = u;
                key[(axis + 2) % 3] = v;
                return builder.vertex(key, [&](const std::array<int, 3>& k) {
                    return Vector3d(static_cast<double>(k[0]) / n, static_cast<double>(k[1]) / n,
                                    static_cast<double>(k[2]) / n);
                });
            };
            for (int v = 0; v < n; ++v)
                for (int u = 0; u < n; ++u)
                    if (level == 0)
                        add_quad(builder.soup, at(u, v), at(u, v + 1), at(u + 1, v + 1), at(u + 1, v));
                    else
                        add_quad(builder.soup, at(u, v), at(u + 1, v), at(u + 1, v + 1), at(u, v + 1));
        }
    return builder.soup;
}

Soup cone(std::span<const Vector3d> rays, uint32_t rings) {
    Soup soup;
    const auto count = static_cast<uint32_t>(rays.size());
    soup.positions.push_back({0, 0, 0});
    for (uint32_t ring = 1; ring <= rings; ++ring)
        for (const auto& ray : rays) soup.positions.push_back(ray * (static_cast<double>(ring) / rings));
    for (uint32_t i = 0; i < count; ++i) {
        const uint32_t next = (i + 1) % count;
        soup.triangles.push_back({0, 1 + i, 1 + next});
        for (uint32_t ring = 1; ring < rings; ++ring) {
            const uint32_t low = 1 + count * (ring - 1), high = low + count;
            add_quad(soup, low + i, high + i, high + next, low + next);
        }
    }
    return soup;
}

std::vector<Vector3d> cone_rays(uint32_t count, double slope) {
    std::vector<Vector3d> rays;
    for (uint32_t i = 0; i < count; ++i) {
        const double angle = 2 * std::numbers::pi * i / count;
        rays.push_back(
            {std::cos(slope) * std::cos(angle), std::cos(slope) * std::sin(angle), std::sin(slope)});
    }
    return rays;
}

std::vector<Vector3d> saddle_rays(uint32_t count, double slope) {
    auto rays = cone_rays(count, slope);
    for (size_t i = 1; i < rays.size(); i += 2) rays[i].z() = -rays[i].z();
    return rays;
}

Soup flat_fan(uint32_t turns) {
    constexpr uint32_t SECTORS_OF_TURN = 10, RINGS = 3;
    const uint32_t sectors = turns * SECTORS_OF_TURN;
    Soup soup;
    soup.positions.emplace_back(0, 0, 0);
    for (uint32_t ring = 1; ring <= RINGS; ++ring)
        for (uint32_t s = 0; s < sectors; ++s) {
            const double angle = 2 * std::numbers::pi * s / SECTORS_OF_TURN;
            soup.positions.emplace_back(ring * std::cos(angle), ring * std::sin(angle), 0);
        }
    const auto at = [&](uint32_t ring, uint32_t s) { return 1 + (ring - 1) * sectors + s % sectors; };
    for (uint32_t s = 0; s < sectors; ++s) {
        soup.triangles.push_back({0, at(1, s), at(1, s + 1)});
        for (uint32_t ring = 1; ring < RINGS; ++ring) {
            soup.triangles.push_back({at(ring, s), at(ring + 1, s), at(ring + 1, s + 1)});
            soup.triangles.push_back({at(ring, s), at(ring + 1, s + 1), at(ring, s + 1)});
        }
    }
    return soup;
}

Soup flat_spiral(uint32_t turns) {
    constexpr uint32_t STEPS_OF_TURN = 12, ACROSS = 3;
    const uint32_t steps = turns * STEPS_OF_TURN;
    Soup soup = grid(steps, ACROSS, 2 * std::numbers::pi * turns, 1);
    for (Vector3d& at : soup.positions) {
        // A little farther out with each turn, so that no two vertices are one.
        const double angle = at.x(), radius = 1 + at.y() + 0.01 * angle;
        at = {radius * std::cos(angle), radius * std::sin(angle), 0};
    }
    return soup;
}

Soup closed_cylinder(uint32_t sides, double height) {
    Soup soup;
    for (const double z : {0.0, height})
        for (uint32_t i = 0; i < sides; ++i) {
            const double turned = 2 * std::numbers::pi * i / sides;
            soup.positions.push_back({std::cos(turned), std::sin(turned), z});
        }
    for (uint32_t i = 0; i < sides; ++i) {
        const uint32_t next = (i + 1) % sides;
        soup.triangles.push_back({i, next, next + sides});
        soup.triangles.push_back({i, next + sides, i + sides});
        if (i < 1 || i + 1 == sides) continue;
        soup.triangles.push_back({0, next, i});
        soup.triangles.push_back({sides, i + sides, next + sides});
    }
    return soup;
}

Soup prism(uint32_t sides, uint32_t levels, double height) {
    Soup soup;
    const double radius = 0.5 / std::sin(std::numbers::pi / sides);
    for (uint32_t level = 0; level <= levels; ++level)
        for (uint32_t side = 0; side < sides; ++side) {
            const double angle = 2 * std::numbers::pi * side / sides;
            soup.positions.push_back(
                {radius * std::cos(angle), radius * std::sin(angle), height * level / levels});
        }
    for (uint32_t level = 0; level < levels; ++level)
        for (uint32_t side = 0; side < sides; ++side) {
            const uint32_t next = (side + 1) % sides, low = level * sides, high = low + sides;
            add_quad(soup, low + side, low + next, high + next, high + side);
        }
    return soup;
}

Soup torus(uint32_t around, uint32_t across, double radius, double thickness) {
    Soup soup;
    for (uint32_t u = 0; u < around; ++u)
        for (uint32_t v = 0; v < across; ++v) {
            const double a = 2 * std::numbers::pi * u / around, b = 2 * std::numbers::pi * v / across;
            const double r = radius + thickness * std::cos(b);
            soup.positions.push_back({r * std::cos(a), r * std::sin(a), thickness * std::sin(b)});
        }
    for (uint32_t u = 0; u < around; ++u)
        for (uint32_t v = 0; v < across; ++v) {
            const uint32_t u1 = (u + 1) % around * across, v1 = (v + 1) % across, u0 = u * across;
            add_quad(soup, u0 + v, u1 + v, u1 + v1, u0 + v1);
        }
    return soup;
}

Soup sphere(uint32_t subdivisions) {
    Soup soup;
    soup.positions = {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};
    soup.triangles = {{0, 2, 4}, {2, 1, 4}, {1, 3, 4}, {3, 0, 4}, {2, 0, 5}, {1, 2, 5}, {3, 1, 5}, {0, 3, 5}};
    for (uint32_t i = 0; i < subdivisions; ++i) soup = subdivided_on_sphere(soup);
    return soup;
}

Soup bumpy_sphere(uint32_t subdivisions, uint64_t seed) {
    std::mt19937_64 random(seed);
    Soup soup = sphere(subdivisions);
    for (auto& p : soup.positions) p *= uniform(random, 0.8, 1.2);
    const size_t faces = soup.triangles.size();
    for (size_t f = 0; f < faces; f += 7) {
        split_face(soup, f, 0.5, 0.4999);                     // a cap: nearly on an edge
        if (f % 2 == 0) split_face(soup, f + 3, 0.999, 5e-4); // needles: nearly at a corner
    }
    return soup;
}

Soup moebius(uint32_t around, uint32_t across) {
    Soup soup;
    for (uint32_t u = 0; u < around; ++u)
        for (uint32_t v = 0; v <= across; ++v) {
            const double a = 2 * std::numbers::pi * u / around, w = static_cast<double>(v) / across - 0.5;
            const double r = 1.5 + w * std::cos(a / 2);
            soup.positions.push_back({r * std::cos(a), r * std::sin(a), w * std::sin(a / 2)});
        }
    const auto at = [&](uint32_t u, uint32_t v) { return u == around ? across - v : u * (across + 1) + v; };
    for (uint32_t u = 0; u < around; ++u)
        for (uint32_t v = 0; v < across; ++v)
            add_quad(soup, at(u, v), at(u + 1, v), at(u + 1, v + 1), at(u, v + 1));
    return soup;
}

Soup joined(const Soup& a, const Soup& b) {
    Soup both = a;
    both.positions.insert(both.positions.end(), b.positions.begin(), b.positions.end());
    for (auto triangle : b.triangles) {
        for (uint32_t& id : triangle) id += a.vertex_count();
        both.triangles.push_back(triangle);
    }
    return both;
}

Soup shuffled(const Soup& soup, uint64_t seed, std::vector<uint32_t>& new_id) {
    std::mt19937_64 random(seed);
    new_id.resize(soup.positions.size());
    std::iota(new_id.begin(), new_id.end(), 0u);
    shuffle(new_id, random);
    Soup result = soup;
    for (size_t i = 0; i < new_id.size(); ++i) result.positions[new_id[i]] = soup.positions[i];
    for (auto& triangle : result.triangles) {
        for (uint32_t& id : triangle) id = new_id[id];
        std::rotate(triangle.begin(), triangle.begin() + static_cast<int>(random() % 3), triangle.end());
    }
    shuffle(result.triangles, random);
    return result;
}

Soup with_mixed_winding(const Soup& soup, uint64_t seed) {
    std::mt19937_64 random(seed);
    Soup result = soup;
    for (auto& triangle : result.triangles)
        if (random() & 1) std::swap(triangle[1], triangle[2]);
    return result;
}

Soup with_flipped_winding(const Soup& soup) {
    Soup result = soup;
    for (auto& triangle : result.triangles) std::swap(triangle[1], triangle[2]);
    return result;
}

namespace {

// Whether two faces a, b, c and b, a, d are one plane's, and convex together.
bool is_flat_and_convex(const Vector3d& a, const Vector3d& b, const Vector3d& c, const Vector3d& d) {
    const Vector3d normal = (b - a).cross(c - a).normalized();
    const auto turns_left = [&](const Vector3d& from, const Vector3d& over, const Vector3d& to) {
        return (over - from).cross(to - over).dot(normal) > 1e-9;
    };
    return std::abs(normal.dot(d - a)) < 1e-9 && turns_left(c, a, d) && turns_left(a, d, b) &&
           turns_left(d, b, c) && turns_left(b, c, a);
}

void flip_some_edges(Soup& soup, std::mt19937_64& random) {
    const Mesh mesh = mesh_of(soup);
    std::vector<bool> is_new(mesh.face_count(), false);
    for (uint32_t e = 0; e < mesh.edge_count(); ++e) {
        const auto beside = mesh.edge_faces[e];
        if ((random() & 1) != 0 || beside.size() != 2 || is_new[beside[0]] || is_new[beside[1]]) continue;
        const auto corner = [&](uint32_t face) {
            return static_cast<size_t>(std::ranges::find(mesh.face_edges[face], e) -
                                       mesh.face_edges[face].begin());
        };
        const size_t k = corner(beside[0]);
        const auto& face = mesh.faces[beside[0]];
        const uint32_t a = face[(k + 1) % 3], b = face[(k + 2) % 3], c = face[k];
        const uint32_t d = mesh.faces[beside[1]][corner(beside[1])];
        const auto& at = mesh.positions;
        if (find_edge(mesh, c, d) != NONE || !is_flat_and_convex(at[a], at[b], at[c], at[d])) continue;
        soup.triangles[beside[0]] = {c, a, d};
        soup.triangles[beside[1]] = {c, d, b};
        is_new[beside[0]] = is_new[beside[1]] = true;
    }
}

}

Soup with_random_diagonals(const Soup& soup, uint32_t rounds, uint64_t seed) {
    std::mt19937_64 random(seed);
    Soup result = soup;
    for (uint32_t i = 0; i < rounds; ++i) flip_some_edges(result, random);
    return result;
}

}
