#pragma once

#include <functional>
#include <optional>

#include "src/path/strip.h"

namespace geodesic {

// What a search knows of the distances to its target.
struct TargetDistances {
    std::function<double(uint32_t)> at_vertex; // infinite where unknown
    // Distances of evenly spaced points inside of an edge, from the vertex with the smaller number to the
    // other; empty where none are known.
    std::function<std::span<const double>(uint32_t, uint32_t)> inside_edge;
    // As a share, how far they may be off: ways that lead on are followed unless others seem shorter by more.
    double error = 0;
};

// A strip from one point to another: A* over faces, each entered at a point of an edge, and over vertices. A
// step crosses an edge where the way on, straight to where the distances of the edge's points place the
// target, is shortest. Every face and every vertex is left at most once, so that distances that are not quite
// right change the way but never make it endless. Nothing if there is no way.
std::optional<Strip> search_strip(const Surface& surface, const SurfacePoint& source,
                                  const SurfacePoint& target, const TargetDistances& distances);

}
