#include "src/path/surface_path.h"

#include "format/error.h"
#include "geoidx.h"
#include "src/surface/nearby.h"

namespace geodesic {

void no_path() {
    throw Error(GEOIDX_ERROR_NO_PATH, "no path joins the two points, as between different components");
}

SurfacePoint passed_point(const Surface& surface, uint32_t face, const Portal& portal, double share) {
    if (share < NEGLIGIBLE_WEIGHT) return point_at(surface, face, portal, 0);
    if (1 - share < NEGLIGIBLE_WEIGHT) return point_at(surface, face, portal, 1);
    return point_at(surface, face, portal, share);
}

void add_point(const Surface& surface, const SurfacePoint& point, std::vector<SurfacePoint>& points) {
    if (!points.empty() && is_same_point(surface, points.back(), point)) points.pop_back();
    points.push_back(point);
}

SurfacePath
path_of_points(std::vector<SurfacePoint>&& points, const SurfacePoint& target,
               const std::function<double(const std::vector<SurfacePoint>&, size_t)>& length_of_piece) {
    SurfacePath path{std::move(points), {}, 0};
    if (path.points.size() < 2) path.points.push_back(target);
    path.pieces.reserve(path.points.size() - 1);
    for (size_t i = 0; i + 1 < path.points.size(); ++i) {
        path.pieces.push_back(length_of_piece(path.points, i));
        path.length += path.pieces.back();
    }
    return path;
}

SurfacePath path_within_point(const SurfacePoint& source, const SurfacePoint& target) {
    return {{source, target}, {0}, 0};
}

double distance_to_next(const Surface& surface, const std::vector<SurfacePoint>& points, size_t i) {
    return (position_of(surface, points[i + 1]) - position_of(surface, points[i])).norm();
}

}
