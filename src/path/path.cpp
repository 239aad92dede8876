#include "src/path/path.h"

#include <string>

#include "format/error.h"
#include "geoidx.h"
#include "src/path/exact_path.h"
#include "src/path/vertex_path.h"
#include "src/path/weighted_path.h"
#include "src/points/face_points.h"

namespace geodesic {

void require_path_end(const Index& index, const Surface& surface, const SurfacePoint& point,
                      const char* name) {
    const Description& about = index.description;
    require_same_mesh(index, surface);
    if (about.metric == GEOIDX_METRIC_EXACT && about.metric_fingerprint != 0)
        refuse_argument(
            "the index was built with edge_lengths, which do not say how triangles lie: there are "
            "no paths");
    if (about.metric > GEOIDX_METRIC_WEIGHTED)
        refuse_argument("the index has metric " + std::to_string(about.metric) +
                        ", which this library does not know: there are no paths");
    if (about.metric == GEOIDX_METRIC_WEIGHTED) require_face_costs(index, surface);
    if (about.metric == GEOIDX_METRIC_EDGES || about.metric == GEOIDX_METRIC_CALLBACK)
        require_vertex_path_end(index, surface, point, name);
    face_point_on(index, surface, point, false); // throws where the index has no such point
}

SurfacePath find_path(const Index& index, Query& query, const Surface& surface, const SurfacePoint& source,
                      const SurfacePoint& target, PathQuality quality) {
    require_path_end(index, surface, source, "source");
    require_path_end(index, surface, target, "target");
    switch (index.description.metric) {
    case GEOIDX_METRIC_EXACT:
        return find_exact_path(index, query, surface, source, target, quality);
    case GEOIDX_METRIC_WEIGHTED:
        return find_weighted_path(index, query, surface, source, target, quality);
    default:
        return find_vertex_path(index, query, surface, source, target);
    }
}

}
