#pragma once

namespace geodesic {

// Up to this distance from a border, ways are straightened over every segment of its near part, and not only
// over those next to the vertex with the least sum: where a border is jagged, the straight way does not
// always pass beside that vertex. longest_segment is the length of the longest segment of the border.
inline float near_radius(float longest_segment) { return 5 * longest_segment; }

}
