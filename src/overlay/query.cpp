#include "src/overlay/query.h"

#include <algorithm>

namespace geodesic {

// A source alone may be given several times.
void OverlayQuery::msad(const Sources& sources, float radius, const OverlayMsad::Field& field) {
    const auto is_first = [&](uint32_t key) { return key == sources.keys.front(); };
    if (!sources.keys.empty() && std::ranges::all_of(sources.keys, is_first))
        msad_from_one(sources, radius, field);
    else
        msad_from_several(sources, radius, field);
}

// Lowering goes on from what is known. What is known of a point also counts last, since lowering may lead
// below a bound of it.
void OverlayQuery::msad_from_one(const Sources& sources, float radius, const OverlayMsad::Field& field) {
    const uint32_t source = sources.keys.front(), vertices = index_.numbering.vertex_count();
    const Sources only{sources.keys.first(1), sources.points};
    const auto correct = [&] {
        only.for_each_known(index_, source, 0, vertices, [&](const KnownWay& way) {
            field.distance[way.number] = way.corrected(field.distance[way.number]);
        });
    };
    field_.sweep(only, radius, field.distance);
    correct();
    lowering_.lower(field.distance);
    if (only.vertex(index_.numbering, source) == NONE) correct();
    for (size_t v = 0; v < field.source.size(); ++v)
        field.source[v] = field.distance[v] < INFINITE ? source : NONE;
}

// A bound from one of several sources is none for all, so that it counts within the sweep alone.
void OverlayQuery::msad_from_several(const Sources& sources, float radius, const OverlayMsad::Field& field) {
    nearest_.sweep(sources, radius, field);
    lowering_.lower(field.distance, field.source);
}

PathEnd OverlayQuery::end_of(const FacePoint& point, PointRow& row) {
    if (point.vertex != NONE) return {point.vertex};
    fill_row(index_, point.leaf, in_leaf_.to_border(point), row);
    return {NONE, point.leaf, row.codes.data(), row.quantum};
}

float OverlayQuery::point_sssd(const FacePoint& first, const FacePoint& second) {
    if (in_leaf_.has_both(first, second)) return in_leaf_.to_point(first, second);
    OverlaySssd& pair = pairs();
    const PathEnd from = end_of(first, rows_[0]), to = end_of(second, rows_[1]);
    return pair.distance_of_points(from, to);
}

// A point at a vertex is that vertex, unless it begins later.
void OverlayQuery::add_point(const FacePoint& point, float offset, std::span<const KnownWay> known) {
    if (point.vertex != NONE && offset == 0) {
        keys_.push_back(point.vertex);
        return;
    }
    keys_.push_back(index_.numbering.vertex_count() + static_cast<uint32_t>(points_.size()));
    PointWays& ways = points_.emplace_back(points_.get_allocator().resource());
    ways.offset = offset;
    ways.vertex = point.vertex;
    if (point.vertex != NONE) return;
    ways.leaf = point.leaf;
    ways.known = known;
    const auto to_all = in_leaf_.to_all(point);
    ways.distance.assign(to_all.begin(), to_all.end());
    for (const auto& [number, straight] : std::span(point.beyond).first(point.beyond_count))
        ways.beyond.push_back({number, static_cast<float>(straight)});
}

void OverlayQuery::take_points(const PointSources& sources) {
    points_.clear();
    keys_.clear();
    for (size_t i = 0; i < sources.points.size(); ++i)
        add_point(sources.points[i], sources.offset(i), sources.known_from(i));
}

void OverlayQuery::point_msad(const PointSources& sources, std::span<float> distance) {
    take_points(sources);
    msad({keys_, points_}, INFINITE, {distance});
}

// Of points at one vertex the first is written last, and stays.
void OverlayQuery::point_nearest_sources(const PointSources& sources, std::span<float> distance,
                                         std::span<uint32_t> position) {
    take_points(sources);
    msad({keys_, points_}, INFINITE, {distance, position});
    position_of_key_.resize(index_.numbering.vertex_count() + points_.size());
    for (size_t i = keys_.size(); i-- > 0;) position_of_key_[keys_[i]] = static_cast<uint32_t>(i);
    for (uint32_t& source : position)
        if (source != NONE) source = position_of_key_[source];
}

std::span<const WithinSweep::Found> OverlayQuery::point_within(const PointSources& only, float radius) {
    take_points(only);
    return within_sweep().sweep({keys_, points_}, radius);
}

void OverlayQuery::prepare_end(size_t end, const FacePoint& point) {
    if (point.vertex != NONE)
        ends_[end].prepare(point.vertex);
    else
        ends_[end].prepare(point);
}

}
