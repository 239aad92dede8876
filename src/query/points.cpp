// Points of faces, as the ends of pairs, as sources and as the ends of paths.
#include <algorithm>
#include <tuple>

#include "src/query/query.h"

namespace geodesic {

namespace {

void add_to_each(std::span<float> distances, float least) {
    if (least == 0) return;
    for (float& distance : distances) distance += least;
}

}

// Whether the engine answers from points itself. If not, distances from the corners of their faces do.
bool Query::takes(const FacePoint& point) const {
    return point.has_tables() && std::holds_alternative<OverlayQuery>(engine_);
}

float Query::vertex_to_point(uint32_t vertex, const FacePoint& point) {
    std::array<double, FacePoint::MOST_VERTICES> from_vertices;
    for (size_t k = 0; k < point.vertex_count; ++k) {
        const uint32_t a = std::min(vertex, point.numbers[k]), b = std::max(vertex, point.numbers[k]);
        from_vertices[k] = a == b ? 0 : double{std::visit([&](auto& e) { return e.sssd(a, b); }, engine_)};
    }
    return static_cast<float>(distance_over(point, from_vertices));
}

float Query::point_sssd(const FacePoint& source, const FacePoint& target) {
    const auto key = [](const FacePoint& point) {
        return std::tuple(point.corners(), point.straight[0], point.straight[1], point.straight[2]);
    };
    const bool swapped = key(target) < key(source);
    const FacePoint& first = swapped ? target : source;
    const FacePoint& second = swapped ? source : target;
    if (first.vertex != NONE && second.vertex != NONE) {
        const uint32_t low = std::min(first.vertex, second.vertex),
                       high = std::max(first.vertex, second.vertex);
        return low == high ? 0 : std::visit([&](auto& e) { return e.sssd(low, high); }, engine_);
    }
    if (takes(first) && takes(second)) return std::get<OverlayQuery>(engine_).point_sssd(first, second);
    std::array<double, FacePoint::MOST_VERTICES> from_vertices;
    for (size_t k = 0; k < second.vertex_count; ++k)
        from_vertices[k] = double{vertex_to_point(second.numbers[k], first)};
    return static_cast<float>(distance_over(second, from_vertices));
}

// Fills point_field_ with the distances from the only one of the points, all that is known of it counted. A
// vertex needs no distances within its faces, which metrics of edges do not know.
void Query::fill_point_field(const PointSources& only) {
    const FacePoint& point = only.points.front();
    point_field_.resize(index_.numbering().vertex_count());
    if (takes(point)) return std::get<OverlayQuery>(engine_).point_msad(only, point_field_);
    if (point.vertex != NONE)
        std::get<GraphQuery>(engine_).msad({&point.vertex, 1}, INFINITE, point_field_);
    else
        fill_from_corners(point);
    for (const KnownWay& way : only.known_from(0))
        point_field_[way.number] = way.corrected(point_field_[way.number]);
}

// Where the engine does not answer from the point, distances from the corners of its face do.
void Query::fill_from_corners(const FacePoint& point) {
    for (size_t k = 0; k < 3; ++k) {
        corner_fields_[k].resize(point_field_.size());
        const uint32_t corner = point.numbers[k];
        std::visit([&](auto& engine) { engine.msad({&corner, 1}, INFINITE, corner_fields_[k]); }, engine_);
    }
    for (size_t v = 0; v < point_field_.size(); ++v) {
        const std::array from_corners{double{corner_fields_[0][v]}, double{corner_fields_[1][v]},
                                      double{corner_fields_[2][v]}};
        point_field_[v] = static_cast<float>(distance_over(point, from_corners));
    }
}

// Whether all sources go into one sweep.
bool Query::sweep_together(const PointSources& sources) const {
    return std::ranges::all_of(sources.points, [&](const FacePoint& point) { return takes(point); });
}

// Fills offsets_ with the offsets without the least one, which is returned. Only by what they differ in do
// offsets decide which source is nearest, so that large ones that are nearly equal do not round it away, and
// a source alone, or several with equal ones, need none.
float Query::take_offsets(const PointSources& sources) {
    offsets_.assign(sources.offsets.begin(), sources.offsets.end());
    if (offsets_.empty()) return 0;
    const float least = std::ranges::min(offsets_);
    for (float& offset : offsets_) offset -= least;
    return least;
}

void Query::point_msad(const PointSources& sources, std::span<float> distances) {
    check_count("distance_count", distances.size(), 1);
    fill_from_points(sources, false);
    write_by_id(distances);
}

void Query::point_nearest_sources(const PointSources& sources, std::span<uint32_t> nearest,
                                  std::span<float> distances) {
    check_count("vertex_count", nearest.size(), 1);
    fill_from_points(sources, true);
    for (size_t id = 0; id < nearest.size(); ++id) {
        const uint32_t number = index_.number_of_id[id];
        nearest[id] = number == NONE ? NONE : nearest_[number];
    }
    if (!distances.empty()) write_by_id(distances);
}

// Fills distance_ and, if asked for, nearest_, by numbers.
void Query::fill_from_points(const PointSources& sources, bool with_nearest) {
    if (with_nearest) nearest_.resize(index_.numbering().vertex_count());
    const float least = take_offsets(sources);
    const PointSources without_least{sources.points, offsets_, sources.known};
    const auto by_number = std::span(distance_).first(index_.numbering().vertex_count());
    if (!sweep_together(sources))
        fill_by_fields(without_least, with_nearest);
    else if (with_nearest)
        std::get<OverlayQuery>(engine_).point_nearest_sources(without_least, by_number, nearest_);
    else
        std::get<OverlayQuery>(engine_).point_msad(without_least, by_number);
    add_to_each(by_number, least);
}

// Source by source, each with all that is known from it.
void Query::fill_by_fields(const PointSources& sources, bool with_nearest) {
    const uint32_t count = index_.numbering().vertex_count();
    std::fill_n(distance_.begin(), count, INFINITE);
    if (with_nearest) std::ranges::fill(nearest_, NONE);
    for (uint32_t i = 0; i < sources.points.size(); ++i) {
        fill_point_field(sources.only(i));
        for (uint32_t v = 0; v < count; ++v)
            if (const float whole = sources.offset(i) + point_field_[v]; whole < distance_[v]) {
                distance_[v] = whole;
                if (with_nearest) nearest_[v] = i;
            }
    }
}

void Query::prepare_end(size_t end, const FacePoint& point) {
    end_fields_[end].clear();
    if (takes(point)) return std::get<OverlayQuery>(engine_).prepare_end(end, point);
    fill_point_field({{&point, 1}});
    end_fields_[end].assign(point_field_.begin(), point_field_.end());
}

float Query::end_distance(size_t end, uint32_t number) {
    if (!end_fields_[end].empty()) return end_fields_[end][number];
    return std::get<OverlayQuery>(engine_).end_distance(end, number);
}

}
