#pragma once

#include <Eigen/Geometry>

#include "src/surface/surface.h"
#include "tests/support/meshes.h"

namespace geodesic::test {

// A mesh as a surface takes it, as it lies in the soup: not in spatial order.
inline Intake intake_of(const Soup& soup) {
    Intake intake;
    intake.mesh.positions = soup.positions;
    for (const auto& [a, b, c] : soup.triangles) intake.mesh.faces.push_back({a, b, c});
    connect(intake.mesh);
    Eigen::AlignedBox3d box;
    for (const Eigen::Vector3d& position : soup.positions) box.extend(position);
    intake.bounding_box_diagonal = box.diagonal().norm();
    return intake;
}

inline Surface surface_of(const Soup& soup) { return Surface(intake_of(soup)); }

}
