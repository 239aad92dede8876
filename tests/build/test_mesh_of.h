#pragma once

#include "tests/capi/calls.h"
#include "tests/support/meshes.h"

namespace geodesic::test {

// The same mesh in the form that the C API takes.
inline TestMesh test_mesh_of(const Soup& soup) {
    TestMesh mesh;
    for (const auto& p : soup.positions) mesh.add_vertex(p.x(), p.y(), p.z());
    for (const auto& [a, b, c] : soup.triangles) mesh.add_triangle(a, b, c);
    return mesh;
}

}
