#pragma once

#include <span>
#include <string>
#include <unordered_map>

#include "geoidx.h"
#include "src/metric/metric.h"
#include "src/surface/surface.h"

namespace geodesic {

// The caller's triangles as faces; both fields are those of Intake.
struct TriangleFaces {
    std::span<const uint32_t> face_of_triangle;
    const std::unordered_map<uint32_t, std::array<uint32_t, 3>>& corners_of_duplicate;
};

// The caller's point as a point of a face. Throws Error INVALID_ARGUMENT, with the point's name, where it is
// none.
SurfacePoint checked_point(const TriangleFaces& faces, const geoidx_surface_point& point,
                           const std::string& name);

inline SurfacePoint checked_point(const Surface& surface, const geoidx_surface_point& point,
                                  const std::string& name) {
    return checked_point(TriangleFaces{surface.face_of_triangle, surface.corners_of_duplicate}, point, name);
}

// Several; the name of each is followed by its position.
std::vector<SurfacePoint> checked_points(const Surface& surface, std::span<const geoidx_surface_point> points,
                                         const std::string& name);

// The opposite: a point of a face as the caller's.
geoidx_surface_point callers_point(const Surface& surface, const SurfacePoint& point);
std::vector<geoidx_path_point> callers_path(const Surface& surface, std::span<const SurfacePoint> points);

}
