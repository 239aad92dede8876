#include "tests/campaign/random_mesh.h"

#include <algorithm>
#include <cmath>

#include "tests/campaign/random_shapes.h"

namespace geodesic::campaign {

namespace {

using Eigen::Vector3d;
using test::Soup;

uint32_t random_size(Dice& dice) {
    const double kind = dice.real(0, 1);
    if (kind < 0.6) return dice.between(4, 150);
    if (kind < 0.92) return dice.between(150, 600);
    return dice.between(600, 2000);
}

void transform(Soup& soup, double scale, const Vector3d& shift) {
    for (auto& p : soup.positions) p = p * scale + shift;
}

Soup random_parts(Dice& dice) {
    const uint32_t parts = dice.chance(0.45) ? 1 : dice.between(2, 5);
    uint32_t vertices = random_size(dice);
    const bool one_is_large = dice.chance(0.3), all_one_size = dice.chance(0.5);
    const double distance = dice.pick({0.0, 0.3, 3.0, 3.0, 100.0});
    Soup soup;
    for (uint32_t part = 0; part < parts; ++part) {
        const bool is_small = one_is_large && part > 0;
        Soup shape =
            random_shape(dice, is_small ? dice.between(4, 60) : vertices / (one_is_large ? 1 : parts));
        const double scale = all_one_size ? 1 : std::pow(10.0, dice.real(-2, 2));
        transform(shape, scale, distance * part * Vector3d(1, dice.real(-0.3, 0.3), 0));
        soup = test::joined(soup, shape);
    }
    return soup;
}

// The same triangle again, turned and flipped; triangles of two vertices, and of three on a line.
void add_bad_triangles(Dice& dice, Soup& soup) {
    for (uint32_t i = dice.between(1, 5); i > 0; --i) {
        auto [a, b, c] = soup.triangles[dice.below(soup.triangles.size())];
        if (dice.chance(0.5)) {
            soup.triangles.push_back({b, a, c});
        } else if (dice.chance(0.5)) {
            soup.triangles.push_back({a, a, b});
        } else {
            soup.positions.push_back((soup.positions[a] + soup.positions[b]) / 2);
            soup.triangles.push_back({a, soup.vertex_count() - 1, b});
        }
    }
}

// Some triangles, or all, have vertices of their own at the same positions.
void cut_seams(Dice& dice, Soup& soup) {
    const double share = dice.pick({0.05, 0.3, 1.0});
    for (auto& triangle : soup.triangles)
        for (uint32_t& id : triangle)
            if (dice.chance(share)) {
                soup.positions.push_back(Vector3d(soup.positions[id]));
                id = soup.vertex_count() - 1;
            }
}

void add_unused(Dice& dice, Soup& soup) {
    for (uint32_t i = dice.between(1, 4); i > 0; --i)
        soup.positions.push_back(dice.chance(0.5)
                                     ? Vector3d(soup.positions[dice.below(soup.positions.size())])
                                     : Vector3d(dice.real(-9, 9), 0, 0));
}

void change_unit_and_place(Dice& dice, Soup& soup) {
    if (dice.chance(0.15))
        for (auto& p : soup.positions) p.z() *= dice.pick({1e-3, 30.0});
    if (dice.chance(0.2)) {
        const double far = std::pow(10.0, dice.between(2, 6));
        transform(soup, 1, far * Vector3d(1, dice.real(-1, 1), 0.3));
    }
    if (dice.chance(0.2)) transform(soup, dice.pick({1e-3, 1e3, 1e-12, 1e12, 1e-25, 1e25}), Vector3d::Zero());
}

}

Soup random_mesh(Dice& dice) {
    Soup soup = random_parts(dice);
    if (dice.chance(0.2)) add_bad_triangles(dice, soup);
    if (dice.chance(0.15)) cut_seams(dice, soup);
    if (dice.chance(0.2)) add_unused(dice, soup);
    if (dice.chance(0.2)) soup = test::with_mixed_winding(soup, dice.bits());
    change_unit_and_place(dice, soup);
    std::vector<uint32_t> new_id;
    if (dice.chance(0.5)) soup = test::shuffled(soup, dice.bits(), new_id);
    return soup;
}

}
