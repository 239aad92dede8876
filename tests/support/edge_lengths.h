#pragma once

#include <vector>

#include "tests/capi/meshes.h"

namespace geodesic::test {

// Three for each triangle, opposite to its corners, as geoidx_build_options takes them.
inline std::vector<double> edge_lengths_of(const TestMesh& mesh) {
    std::vector<double> lengths;
    for (size_t t = 0; t < mesh.triangles.size(); t += 3)
        for (size_t k = 0; k < 3; ++k)
            lengths.push_back(
                mesh.straight(mesh.triangles[t + (k + 1) % 3], mesh.triangles[t + (k + 2) % 3]));
    return lengths;
}

}
