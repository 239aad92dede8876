#include "src/capi/points.h"

#include <array>
#include <cmath>

#include "format/error.h"
#include "src/base/number_text.h"
#include "src/base/numbers.h"

namespace geodesic {

namespace {

void check_weights(const geoidx_surface_point& point, double sum, const std::string& name) {
    for (double weight : point.weights)
        if (!(weight >= 0)) refuse_argument(name + " has the weight " + number_text(weight));
    if (!(std::abs(sum - 1) <= 1e-6))
        refuse_argument(name + " has weights of " + number_text(sum) + " in sum");
}

}

SurfacePoint checked_point(const TriangleFaces& faces, const geoidx_surface_point& point,
                           const std::string& name) {
    const size_t triangle_count = faces.face_of_triangle.size();
    const std::string on = name + " is on triangle " + std::to_string(point.triangle);
    if (point.triangle >= triangle_count)
        refuse_argument(on + ", but the mesh has " + std::to_string(triangle_count));
    const uint32_t face = faces.face_of_triangle[point.triangle];
    if (face == NONE) refuse_argument(on + ", which is degenerate");
    check_weights(point, point.weights[0] + point.weights[1] + point.weights[2], name);
    std::array<uint32_t, 3> corners{0, 1, 2};
    if (const auto found = faces.corners_of_duplicate.find(point.triangle);
        found != faces.corners_of_duplicate.end())
        corners = found->second;
    const auto weights = without_negligible(std::to_array(point.weights));
    SurfacePoint result{face, {}};
    for (size_t k = 0; k < 3; ++k) result.weights[corners[k]] = weights[k];
    return result;
}

std::vector<SurfacePoint> checked_points(const Surface& surface, std::span<const geoidx_surface_point> points,
                                         const std::string& name) {
    std::vector<SurfacePoint> checked;
    for (const geoidx_surface_point& point : points)
        checked.push_back(checked_point(surface, point, name + " " + std::to_string(checked.size())));
    return checked;
}

geoidx_surface_point callers_point(const Surface& surface, const SurfacePoint& point) {
    geoidx_surface_point result{};
    result.triangle = surface.triangle_of_face[point.face];
    for (size_t k = 0; k < 3; ++k) result.weights[k] = point.weights[k];
    return result;
}

std::vector<geoidx_path_point> callers_path(const Surface& surface, std::span<const SurfacePoint> points) {
    std::vector<geoidx_path_point> result;
    for (const SurfacePoint& point : points) {
        const Eigen::Vector3d at = position_of(surface, point);
        result.push_back({callers_point(surface, point), {at.x(), at.y(), at.z()}});
    }
    return result;
}

}
