#include "src/points/leaf_of_face.h"

#include "src/capi/handles.h"
#include "src/overlay/fields/point_ways.h"
#include "src/points/face_points.h"
#include "src/surface/indexed_faces.h"
#include "tests/path/path_cases.h"
#include "tests/support/sanitized.h"

using namespace geodesic;
using namespace geodesic::test;

// Of faces that lie in the leaves they are said to lie in, two are in one leaf unless the edge between them
// is on the borders of both. Faces with a corner inside of a leaf lie in that one.
TEST_CASE("leaf of face: faces of two leaves meet at the borders of both, and nowhere else" *
          doctest::skip(SANITIZED)) {
    size_t ambiguous = 0, at_borders = 0;
    for (const Soup& soup : {closed_cylinder(128, 5), closed_cylinder(250, 0.02), bumpy_sphere(3, 3),
                             cube(10), joined(torus(24, 12, 1, 0.4), moebius(40, 3))}) {
        const PathCase on(soup);
        CAPTURE(soup.vertex_count());
        const Index& index = on.index->index;
        const auto& overlay = std::get<OverlayIndex>(index.engine);
        const Surface& surface = on.surface->surface;
        std::vector<uint32_t> leaf_of;
        for (uint32_t f = 0; f < surface.face_count(); ++f)
            leaf_of.push_back(leaf_of_face(index, surface, {true, f}));
        for (uint32_t f = 0; f < surface.face_count(); ++f) {
            const auto& corners = indexed_corners(surface, f);
            const auto lengths = edge_lengths(surface, corners);
            std::array<uint32_t, 3> numbers;
            for (size_t k = 0; k < 3; ++k) numbers[k] = number_of(index, surface, corners[k]);
            REQUIRE(are_in_leaf(overlay.numbering, leaf_of[f], numbers));
            for (uint32_t leaf = overlay.numbering.first_leaf(); leaf < leaf_of[f]; ++leaf)
                ambiguous += are_in_leaf(overlay.numbering, leaf, numbers);
            for (size_t k = 0; k < 3; ++k) {
                const size_t a = (k + 1) % 3, b = (k + 2) % 3;
                for_each_indexed_face_beyond(surface, f, corners[a], corners[b], [&](uint32_t other) {
                    if (leaf_of[other] == leaf_of[f]) return;
                    for (const uint32_t face : {f, other})
                        CHECK(is_on_border(overlay, leaf_of[face], numbers[a], numbers[b], lengths[k]));
                    ++at_borders;
                });
            }
        }
    }
    CHECK(ambiguous > 20);
    CHECK(at_borders > 500);
}
