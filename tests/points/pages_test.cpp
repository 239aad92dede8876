// Fields from points on pages that meet in a spine: patches meet at its edges, which many triangles share.
#include "tests/path/path_cases.h"
#include "tests/points/point_cases.h"
#include "tests/support/sanitized.h"

using namespace geodesic;
using namespace geodesic::test;

namespace {

Soup soup_of(const TestMesh& mesh) {
    Soup soup;
    for (size_t i = 0; i < mesh.positions.size(); i += 3)
        soup.positions.push_back({mesh.positions[i], mesh.positions[i + 1], mesh.positions[i + 2]});
    for (size_t i = 0; i < mesh.triangles.size(); i += 3)
        soup.triangles.push_back({mesh.triangles[i], mesh.triangles[i + 1], mesh.triangles[i + 2]});
    return soup;
}

}

// A way from one page to another crosses the spine between two vertices, neither of which it passes. The
// borders of patches branch there.
TEST_CASE("points: fields of pages lead over each edge of the spine" * doctest::skip(SANITIZED)) {
    for (const uint32_t count : {6u, 10u}) {
        CAPTURE(count);
        const PathCase on(soup_of(pages(count, 5, 8)));
        std::mt19937_64 random(count);
        for (size_t i = 0; i < 80; ++i) {
            const geoidx_surface_point source = random_point(on.soup, random, i % 2 == 0 ? 0 : 3);
            const auto exact = on.exact_field(source);
            const auto answers = field(on, {&source, 1});
            for (uint32_t v = 0; v < on.soup.vertex_count(); ++v)
                CHECK(double{answers[v]} == doctest::Approx(exact[v]).epsilon(0.01));
        }
    }
}
