// How planes are cut into triangles changes no distance, so that it must not change how exact answers are.
#include "tests/build/errors.h"
#include "tests/build/test_mesh_of.h"
#include "tests/support/drilled_plate.h"
#include "tests/support/sanitized.h"

using namespace geodesic::test;

TEST_CASE("flat faces: a plate that is cut into slivers is answered nearly as exactly as any" *
          doctest::skip(SANITIZED)) {
    const TestMesh plate = test_mesh_of(drilled_plate(4, 20, 0.02));
    const auto index = shared_index(plate, default_options());
    const Errors errors = errors_of(index.get(), plate, default_options(), {.first_source = 1, .step = 37});
    INFO("mean ", errors.mean, ", max ", errors.max, ", of pairs ", errors.pair_max);
    CHECK(errors.mean < 0.001);
    CHECK(errors.max < 0.03);
    CHECK(errors.pair_max < 0.03);
}
