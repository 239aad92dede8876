#include "src/path/weighted_path.h"

#include <algorithm>
#include <optional>

#include "src/path/detours.h"
#include "src/path/slide.h"
#include "src/path/weighted_search.h"
#include "src/points/face_points.h"
#include "src/surface/costs.h"
#include "src/surface/nearby.h"

namespace geodesic {

namespace {

class WeightedPathFinder {
public:
    WeightedPathFinder(const Index& index, Query& query, const Surface& surface, const SurfacePoint& source,
                       const SurfacePoint& target)
        : index_(index), query_(query), surface_(surface), source_(source), target_(target) {}

    SurfacePath find(PathQuality quality);

private:
    double cost(uint32_t face) const { return surface_.costs.of_face[face]; }
    double distance(size_t end, uint32_t vertex) {
        return end_distance(index_, query_, surface_, end, vertex);
    }
    FacePoint end_at(const SurfacePoint& point) const;
    std::optional<StripWay> led_by(size_t end);
    void take_if_shorter(std::optional<StripWay>&& other);
    double slack() const;
    double limit() const;
    SurfacePath path() const;
    SurfacePoint in_cheapest_face(const SurfacePoint& from, const SurfacePoint& to) const;

    const Index& index_;
    Query& query_;
    const Surface& surface_;
    const SurfacePoint source_, target_;
    StripWay best_;
};

// The point in the cheapest face that it lies in: from there a way leads over a corner.
FacePoint WeightedPathFinder::end_at(const SurfacePoint& point) const {
    SurfacePoint cheapest = point;
    for_each_alias(surface_, point, [&](const SurfacePoint& alias) {
        if (cost(alias.face) < cost(cheapest.face)) cheapest = alias;
    });
    return face_point_on(index_, surface_, cheapest, false, cost(cheapest.face));
}

// Led by the distances from one end, from the other one on.
std::optional<StripWay> WeightedPathFinder::led_by(size_t end) {
    constexpr uint32_t POINTS = 3; // of an edge: enough to find the faces of the way
    const auto rest = [this, end](uint32_t vertex) { return distance(end, vertex); };
    auto way =
        search_weighted(surface_, end == 1 ? WeightedSearchRequest{source_, target_, rest, POINTS, slack()}
                                           : WeightedSearchRequest{target_, source_, rest, POINTS, slack()});
    if (!way || end == 1) return way;
    turn_back(way->strip);
    std::ranges::reverse(way->path.shares);
    return way;
}

void WeightedPathFinder::take_if_shorter(std::optional<StripWay>&& other) {
    if (!other || is_same_strip(other->strip, best_.strip)) return;
    slide(surface_, other->strip, other->path);
    try_detours(surface_, *other);
    if (best_.strip.faces.empty() || other->path.length < best_.path.length) best_ = std::move(*other);
}

// How much too long distances from a point inside of a face may be, since they lead over a corner: what the
// longest edge at either end costs.
double WeightedPathFinder::slack() const {
    double dearest = 0;
    for (const uint32_t face : {source_.face, target_.face})
        for (size_t k = 0; k < 3; ++k) {
            const uint32_t a = surface_.faces[face][k], b = surface_.faces[face][(k + 1) % 3];
            dearest = std::max(dearest, cost(face) * (surface_.positions[a] - surface_.positions[b]).norm());
        }
    return dearest;
}

// The search adds distances of the index to what it has gone. These may be too long by the errors that were
// measured of the index, so that a way that seems longer than the best one by so much may be shorter.
double WeightedPathFinder::limit() const {
    constexpr double LEAST_ERROR = 1e-3;
    return (1 + std::max(LEAST_ERROR, index_.description.error.p999)) * best_.path.length;
}

SurfacePath WeightedPathFinder::find(PathQuality quality) {
    if (is_same_point(surface_, source_, target_)) return path_within_point(source_, target_);
    query_.prepare_end(1, end_at(target_));
    query_.prepare_end(0, end_at(source_));
    auto way = led_by(1);
    if (!way) no_path();
    take_if_shorter(std::move(way));
    take_if_shorter(led_by(0));
    if (quality == PathQuality::EXACT) {
        const auto rest = [this](uint32_t vertex) { return distance(1, vertex); };
        take_if_shorter(search_weighted(
            surface_, {source_, target_, rest, surface_.costs.points_per_edge, slack(), limit()}));
    }
    return path();
}

// Where a piece leads along an edge, a point in the face there that costs least.
SurfacePoint WeightedPathFinder::in_cheapest_face(const SurfacePoint& from, const SurfacePoint& to) const {
    for (size_t k = 0; k < 3; ++k) {
        if (from.weights[k] != 0 || to.weights[k] != 0) continue;
        const auto& corners = surface_.faces[from.face];
        const uint32_t a = corners[(k + 1) % 3], b = corners[(k + 2) % 3];
        return point_in_face(surface_, from, cheapest_face_at(surface_, from.face, a, b)).value();
    }
    return from;
}

SurfacePath WeightedPathFinder::path() const {
    const Strip& strip = best_.strip;
    const std::vector<double>& shares = best_.path.shares;
    std::vector<SurfacePoint> points;
    SurfacePoint from = strip.source;
    for (size_t i = 0; i < strip.faces.size(); ++i) {
        const bool is_last = i == strip.portals.size();
        const SurfacePoint to =
            is_last ? strip.target : passed_point(surface_, strip.faces[i], strip.portals[i], shares[i]);
        add_point(surface_, in_cheapest_face(from, to), points);
        if (!is_last) from = passed_point(surface_, strip.faces[i + 1], strip.portals[i], shares[i]);
    }
    add_point(surface_, strip.target, points);
    return path_of_points(std::move(points), strip.target, [&](const auto& all, size_t i) {
        return cost(all[i].face) * distance_to_next(surface_, all, i);
    });
}

}

SurfacePath find_weighted_path(const Index& index, Query& query, const Surface& surface,
                               const SurfacePoint& source, const SurfacePoint& target, PathQuality quality) {
    return WeightedPathFinder(index, query, surface, source, target).find(quality);
}

}
