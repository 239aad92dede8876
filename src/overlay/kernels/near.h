#pragma once

#include <algorithm>
#include <cstdint>

namespace geodesic {

// A distance is near if it is at most so many times as long as the border's longest segment. Then ways are
// straightened over every segment of the border that is as near, and not only over those next to the vertex
// with the least sum: where a border is jagged, the straight way does not always pass beside that vertex.
inline constexpr float NEAR_SEGMENTS = 5;

// The same on a mesh of so many vertices, added ones among them. On a small mesh no distance is so long that
// errors of ways over middles would not show, and it takes few microseconds to straighten all.
inline float near_segments(uint32_t vertex_count) {
    constexpr float SMALL = 2000, MOST = 20;
    return std::clamp(NEAR_SEGMENTS * SMALL / static_cast<float>(vertex_count), NEAR_SEGMENTS, MOST);
}

// If a way that crosses a border is no longer than `radius`, some vertex of the border is no farther from the
// source than this: the way crosses a segment at most half its length from one end. The other half is room
// for rounding.
inline float farthest_on_border(float radius, float longest_segment) { return radius + longest_segment; }

}
