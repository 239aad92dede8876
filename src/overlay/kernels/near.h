#pragma once

namespace geodesic {

// Up to this distance from a border, ways are straightened over every segment of its near part, and not only
// over those next to the vertex with the least sum: where a border is jagged, the straight way does not
// always pass beside that vertex. longest_segment is the length of the longest segment of the border.
inline float near_radius(float longest_segment) { return 5 * longest_segment; }

// If a way that crosses a border is no longer than `radius`, some vertex of the border is no farther from the
// source than this: the way crosses a segment at most half its length from one end. The other half is room
// for rounding.
inline float farthest_on_border(float radius, float longest_segment) { return radius + longest_segment; }

}
