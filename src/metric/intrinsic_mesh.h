#pragma once

#include <cstdint>
#include <vector>

#include "src/mesh/mesh.h"

namespace geodesic {

// An edge seen from a vertex.
struct Spoke {
    double length;
    uint32_t edge;
    uint32_t other; // the vertex at its far end
};

// One face at one edge, unfolded into the plane: the edge lies on the x axis, its first vertex at 0, its
// second at `length`, and the face below it with its third vertex, the apex, at (apex_x, -apex_depth).
struct Side {
    double apex_x, apex_depth;
    double apex_back; // length - apex_x, measured from the second vertex
    uint32_t apex;
    uint32_t face;
    // The two other edges of the face: [0] from the first vertex to the apex, [1] from the second. The lowest
    // bit is set where that edge's own first vertex is the apex.
    uint32_t tagged_edge[2];
};

// How the faces around a vertex hang together.
enum class Fan : uint8_t {
    Closed,   // one cycle of faces
    Open,     // one chain of faces: the vertex is on the boundary
    Irregular // several fans meet, or rounding hides how paths go around the vertex
};

// The surface as window propagation reads it: lengths and unfolded faces.
struct IntrinsicMesh {
    // With own lengths, one per edge of the mesh, positions do not count; every face has an area then.
    explicit IntrinsicMesh(const Mesh& mesh, std::span<const double> own_lengths = {});

    // Empty where the lengths are not those of the positions: then lines in space say nothing about them.
    std::vector<Eigen::Vector3d> positions;
    std::vector<double> edge_length;
    std::vector<std::array<uint32_t, 2>> edge_vertices;
    ListOfLists<Side> sides;              // per edge
    ListOfLists<Spoke> spokes;            // per vertex
    std::vector<uint32_t> edge_of_corner; // [3 face + k]: the edge opposite to corner k of the face
    std::vector<uint32_t> side_of_corner; // [3 face + k]: the face at that edge, as an index in sides.items
    std::vector<uint32_t> corner_of_side; // its inverse: the corner of the apex
    ListOfLists<uint32_t> corners;        // per vertex: 3 face + k

    // Angles around a vertex, in radians from an arbitrary start: corner c reaches from corner_begin[c] to
    // corner_begin[c] + corner_angle[c] and begins at the edge corner_first_edge[c].
    std::vector<double> corner_begin, corner_angle;
    std::vector<uint32_t> corner_first_edge;
    std::vector<double> total_angle; // per vertex
    std::vector<Fan> fan;            // per vertex

    // Whether a shortest path can bend at a vertex: it can where there is more than a straight angle on both
    // of its sides, so at saddles, at reflex boundary vertices and where several fans meet.
    std::vector<uint8_t> can_bend;
};

// The vertex at a corner of a face.
inline uint32_t corner_vertex(const IntrinsicMesh& mesh, uint32_t corner) {
    return mesh.sides.items[mesh.side_of_corner[corner]].apex;
}

}
