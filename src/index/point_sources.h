#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "src/index/face_point.h"

namespace geodesic {

// What is known of the distance between a source and a vertex, by its number, besides what tables say: it is
// no longer than a way, if one is known, and no shorter than the line in space or another bound.
struct KnownWay {
    uint32_t number;
    float length, least;

    float corrected(float distance) const { return std::min(std::max(distance, least), length); }
};

// Points as sources of a field. How far a vertex is, is the least of offset(i) + the distance from points[i].
struct PointSources {
    std::span<const FacePoint> points;
    std::span<const float> offsets{};               // as many, or none: then all are 0
    std::span<const std::vector<KnownWay>> known{}; // as many, or none; by their numbers, each once

    float offset(size_t i) const { return offsets.empty() ? 0 : offsets[i]; }
    // Lengths are from the point itself, without its offset.
    std::span<const KnownWay> known_from(size_t i) const {
        return known.empty() ? std::span<const KnownWay>() : known[i];
    }
    // One of them alone, without its offset.
    PointSources only(size_t i) const {
        return {points.subspan(i, 1), {}, known.empty() ? known : known.subspan(i, 1)};
    }
};

}
