#pragma once

#include <functional>
#include <span>
#include <vector>

#include "src/index/point_sources.h"
#include "src/points/face_points.h"
#include "src/query/query.h"
#include "src/surface/surface.h"

namespace geodesic {

// Lengths of ways between two points, infinite where none is known.
struct WaysBetween {
    float straight = INFINITE; // over faces that are known to lie between
    float seen = INFINITE;     // straight over the polygons of the points
    float other = INFINITE;    // of any kind
    float line = 0;            // in space: no way is shorter
    bool is_shortest = false;  // the straight one, whatever tables say

    // The distance of which tables say this, or infinity if they say nothing.
    float corrected(float distance) const;
};

// Distances of points of a surface by an index of its mesh.
class PointQueries {
public:
    // Throws Error MESH_MISMATCH where the index is of another mesh, and INVALID_ARGUMENT where its metric
    // does not tell what a way within a face costs.
    PointQueries(const Index& index, Query& query, const Surface& surface);

    // Of two points. Where the edges around a point are long for how far the other one is away, a way that
    // crosses them may come from another side than tables tell of: a path between the points tells more.
    // needs_path is false where no path can be looked for, as with the graph engine, even if the distance may
    // be far off.
    struct Pair {
        float distance;
        bool needs_path = false;
        float known_way = INFINITE; // the length of some way, where a path is needed
    };
    Pair pair(const SurfacePoint& source, const SurfacePoint& target);
    float sssd(const SurfacePoint& source, const SurfacePoint& target) {
        return pair(source, target).distance;
    }
    // Of several sources; `offsets` are as many, or none. Arrays of answers have an item for each id of the
    // index. In the mesh's unit; infinity where no source reaches.
    void msad(std::span<const SurfacePoint> sources, std::span<const float> offsets,
              std::span<float> distances);
    // The position of the nearest source, or NONE. `distances` may be empty.
    void nearest_sources(std::span<const SurfacePoint> sources, std::span<const float> offsets,
                         std::span<uint32_t> nearest, std::span<float> distances);
    // Ids in ascending order of their distances, valid until the query is asked again.
    std::span<const Query::Found> within(std::span<const SurfacePoint> sources,
                                         std::span<const float> offsets, float radius);

    // The nearest `count` targets or, if fewer can be reached, all of these, in ascending order. Few targets
    // are asked for one by one, and so is each of many that needs a path (see Pair): of_pair(i) is
    // to return that of targets[i], along a path if need be, which this folder does not know. It may use the
    // query, but neither within() nor sweeps.
    std::vector<Query::Found> nearest_targets(const SurfacePoint& source,
                                              std::span<const SurfacePoint> targets, size_t count,
                                              const std::function<float(size_t)>& of_pair);

    // The point as the query takes it, with what it sees where the metric unfolds.
    PointView view_of(const SurfacePoint& point) const;
    PointView view_of(const SurfacePoint& at, const FacePoint& point) const;
    uint32_t number_of(uint32_t vertex) const { return geodesic::number_of(index_, surface_, vertex); }
    bool unfolds() const;

private:
    struct Sources {
        std::vector<FacePoint> points;
        std::span<const float> offsets;
        std::vector<std::vector<KnownWay>> known;

        operator PointSources() const { return {points, offsets, known}; }
    };
    Sources sources_of(std::span<const SurfacePoint> points, std::span<const float> offsets) const;
    void add_beyond(const SurfacePoint& source, const SeenAround& around, FacePoint& point) const;
    void add_known_ways(const SurfacePoint& source, const SeenAround& around,
                        std::vector<KnownWay>& known) const;
    void add_measured_ways(const FacePoint& point, std::vector<KnownWay>& known) const;
    bool needs_path(const FacePoint& source, const FacePoint& target, const WaysBetween& ways,
                    float distance) const;
    WaysBetween ways_between(const SurfacePoint& source, const PointView& from, const SurfacePoint& target,
                             const PointView& to, float distance) const;
    double way_around_corner(const SurfacePoint& source, const SurfacePoint& target) const;
    double straight_way_of_near(const SurfacePoint& source, const SurfacePoint& target, float distance) const;

    const Index& index_;
    Query& query_;
    const Surface& surface_;
};

}
