// Fields from points on pages that meet in a spine: patches meet at its edges, which many triangles share.
#include <numbers>

#include "tests/path/path_cases.h"
#include "tests/points/point_cases.h"
#include "tests/support/sanitized.h"

using namespace geodesic;
using namespace geodesic::test;

namespace {

// Half planes around the z axis, of 1 by 2, whose vertices there are the same ones.
Soup pages(uint32_t count, uint32_t wide, uint32_t high) {
    Soup soup;
    for (uint32_t page = 0; page < count; ++page) {
        const double angle = std::numbers::pi * page / count;
        const Soup flat = grid(wide, high, 1, 2);
        std::vector<uint32_t> of_flat; // per vertex of the page, its number
        for (uint32_t v = 0; v < flat.vertex_count(); ++v) {
            const Eigen::Vector3d& at = flat.positions[v];
            const bool is_known = at.x() == 0 && page > 0;
            of_flat.push_back(is_known ? v : soup.vertex_count());
            if (!is_known)
                soup.positions.push_back({at.x() * std::cos(angle), at.x() * std::sin(angle), at.y()});
        }
        for (const auto& [a, b, c] : flat.triangles)
            soup.triangles.push_back({of_flat[a], of_flat[b], of_flat[c]});
    }
    return soup;
}

}

// A way from one page to another crosses the spine between two vertices, neither of which it passes. The
// borders of patches branch there.
TEST_CASE("points: fields of pages lead over each edge of the spine") {
    for (const uint32_t count : {6u, 10u}) {
        CAPTURE(count);
        const PathCase on(pages(count, 5, 8));
        std::mt19937_64 random(count);
        for (size_t i = 0; i < smaller(80, 8); ++i) {
            const geoidx_surface_point source = random_point(on.soup, random, i % 2 == 0 ? 0 : 3);
            const auto exact = on.exact_field(source);
            const auto answers = field(on, {&source, 1});
            for (uint32_t v = 0; v < on.soup.vertex_count(); ++v)
                CHECK(double{answers[v]} == doctest::Approx(exact[v]).epsilon(0.01));
        }
    }
}
