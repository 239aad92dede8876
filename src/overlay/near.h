#pragma once

namespace geodesic {

// What is near: up to this distance from a border whose longest segment is that long, ways are straightened
// over every segment there, and not only over those next to the vertex with the least sum. Where a border is
// jagged, the straight way does not always pass near that vertex.
inline float near_radius(float longest_segment) { return 5 * longest_segment; }

}
