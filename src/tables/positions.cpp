#include "src/tables/positions.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "src/base/quantiles.h"
#include "src/index/positions.h"

namespace geodesic {

namespace {

// A length that three quarters of all edges have at least, edges without length left out; 0 without any.
double short_edge(const Mesh& mesh) {
    std::vector<double> lengths;
    for (const auto& face : mesh.faces)
        for (size_t i = 0; i < 3; ++i) {
            const double length = (mesh.positions[face[i]] - mesh.positions[face[(i + 1) % 3]]).norm();
            if (length > 0) lengths.push_back(length);
        }
    return lower_quartile(std::move(lengths));
}

}

void round_positions(const Mesh& mesh, std::span<const uint32_t> vertex_of_number, StoredIndex& stored) {
    if (vertex_of_number.empty()) return;
    Eigen::Vector3d least = mesh.positions[vertex_of_number[0]], most = least;
    for (const uint32_t v : vertex_of_number) {
        least = least.cwiseMin(mesh.positions[v]);
        most = most.cwiseMax(mesh.positions[v]);
    }
    constexpr double STEPS_PER_EDGE = 128;
    const double finest = (most - least).maxCoeff() / (MOST_STEPS - 1);
    const double step = std::clamp(short_edge(mesh) / STEPS_PER_EDGE,
                                   std::max(finest, double{std::numeric_limits<float>::min()}),
                                   double{std::numeric_limits<float>::max()});
    stored.position_step = static_cast<float>(step);
    stored.position_origin = {least[0], least[1], least[2]};
    for (const uint32_t v : vertex_of_number) stored.positions.push_back(in_steps(mesh.positions[v], stored));
}

}
