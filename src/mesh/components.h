#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "src/mesh/mesh.h"

namespace geodesic {

// A component of a mesh is what its edges join.
struct Component {
    double diagonal = 0; // of its bounding box
    double average_edge = 0;

    // Its diagonal in edges, as a face sees it: in average ones of the component or, if that is more, in
    // thirds of the face's longest edge.
    double edges_across(double longest_edge) const {
        constexpr double SHARE = 1.0 / 3;
        return diagonal / std::max(average_edge, SHARE * longest_edge);
    }
};

struct Components {
    std::vector<Component> all;
    std::vector<uint32_t> of_vertex; // a place in `all`

    const Component& of(uint32_t vertex) const { return all[of_vertex[vertex]]; }
};

Components components_of(const Mesh& mesh);

// Whether the edges around a face whose component is so many across are long for what the surface does.
inline bool are_long_edges(double edges_across) { return edges_across < 48; }

}
