#pragma once

#include <array>
#include <memory_resource>
#include <optional>
#include <span>
#include <utility>

#include "src/index/point_sources.h"
#include "src/overlay/fields/field_lowering.h"
#include "src/overlay/fields/msad.h"
#include "src/overlay/fields/point_ways.h"
#include "src/overlay/fields/ssad.h"
#include "src/overlay/fields/within_sweep.h"
#include "src/overlay/sssd/pair_tables.h"
#include "src/overlay/sssd/prepared_source.h"
#include "src/overlay/sssd/sssd.h"

namespace geodesic {

// Queries over overlay tables, which are fixed sequences of min-plus products. Where the metric unfolds, a
// path may cross a border between two vertices.
class OverlayQuery {
public:
    OverlayQuery(const OverlayIndex& index, std::pmr::memory_resource* memory)
        : index_(index), memory_(memory), field_(index, memory), nearest_(index, memory),
          batch_(index, memory, FIELDS_AT_ONCE), lowering_(index.steep, memory), prepared_(index, memory),
          in_leaf_(index, memory), rows_{PointRow(memory), PointRow(memory)}, points_(memory), keys_(memory),
          position_of_key_(memory), ends_{PreparedSource(index, memory), PreparedSource(index, memory)} {}

    // Requires low < high; callers pass both orders of a pair this way, so that both get the same bits.
    float sssd(uint32_t low, uint32_t high) {
        const float* const measured = index_.measured.distance(low, high);
        if (measured) return *measured;
        const float distance = pairs().distance(low, high);
        return pairs_->may_misplace_ends(low, high, distance)
                   ? std::min(distance, distance_in_field(low, high))
                   : distance;
    }

    // Prepares a source: prepared_sssd() then answers distances from it.
    void prepare(uint32_t source) {
        prepared_.prepare(source);
        prepared_source_ = source;
    }
    float prepared_sssd(uint32_t target) {
        const float* const measured = index_.measured.distance(prepared_source_, target);
        return measured ? *measured : prepared_.distance(target, field_);
    }

    // Sets how many threads msad() uses.
    void set_threads(uint32_t count) {
        field_.set_threads(count);
        nearest_.set_threads(count);
    }

    // Fills distance[number] of every vertex. Vertices of patches beyond the radius may be infinite.
    void msad(std::span<const uint32_t> sources, float radius, std::span<float> distance) {
        msad(Sources{sources}, radius, {distance});
    }

    // The same, without a radius, and fills source[number] with the source that is nearest, NONE for none.
    void nearest_sources(std::span<const uint32_t> sources, std::span<float> distance,
                         std::span<uint32_t> source) {
        msad(Sources{sources}, INFINITE, {distance, source});
    }

    // The vertices that are no farther than `radius` from a source.
    std::span<const WithinSweep::Found> within(uint32_t source, float radius) {
        return within_sweep().sweep({{&source, 1}}, radius);
    }
    // The distance of one of the vertices that the latest call of within() or point_within() has found;
    // infinite for other vertices.
    float distance_within(uint32_t number) const { return within_->distance(number); }
    // The least distance of those that this call has seen and left out, infinite if there are none: then all
    // vertices that can be reached are within the radius.
    float nearest_beyond() const { return within_->nearest_beyond(); }

    // ---- Points of faces, each of which has tables (see FacePoint)

    // Of two points that are not both vertices; callers pass both orders of a pair the same way.
    float point_sssd(const FacePoint& first, const FacePoint& second);

    // Fills distance[number] of every vertex. The least offset must be 0.
    void point_msad(const PointSources& sources, std::span<float> distance);

    // The same, and fills position[number] with that of the nearest one of the points, NONE for none.
    void point_nearest_sources(const PointSources& sources, std::span<float> distance,
                               std::span<uint32_t> position);

    // The vertices that are no farther than `radius` from the only one of the points, whose offset is 0.
    std::span<const WithinSweep::Found> point_within(const PointSources& only, float radius);

    // Prepares one of the two ends of a path, 0 or 1: end_distance() then answers distances from it.
    void prepare_end(size_t end, const FacePoint& point);
    float end_distance(size_t end, uint32_t number) { return ends_[end].distance(number, field_); }

    // Fills distances[number * FIELDS_AT_ONCE + i] with the distance from the i-th of FIELDS_AT_ONCE sources.
    // For fewer than FEWEST_AT_ONCE different ones it is faster to call msad() for each.
    static constexpr size_t FEWEST_AT_ONCE = 8;
    void ssad_each(std::span<const uint32_t> sources, std::span<float> distances) {
        batch_.sweep(sources, INFINITE, distances);
        for (size_t i = 0; i < sources.size(); ++i)
            for (const auto& [number, measured] : index_.measured.of(sources[i]))
                distances[number * FIELDS_AT_ONCE + i] = measured;
        lowering_.lower_each(distances);
    }

private:
    void msad(const Sources& sources, float radius, const OverlayMsad::Field& field);
    void msad_from_one(const Sources& sources, float radius, const OverlayMsad::Field& field);
    void msad_from_several(const Sources& sources, float radius, const OverlayMsad::Field& field);
    PathEnd end_of(const FacePoint& point, PointRow& row);
    void take_points(const PointSources& sources);
    void add_point(const FacePoint& point, float offset, std::span<const KnownWay> known);

    // The first pair of all makes the tables that all pairs need, and the first one of this object its
    // scratch.
    OverlaySssd& pairs() {
        if (pairs_) return *pairs_;
        require_pair_tables(index_);
        return pairs_.emplace(index_, memory_);
    }

    // The distance of a pair in a field from its first vertex, over the borders between the two alone. Pairs
    // are often asked for source by source.
    float distance_in_field(uint32_t source, uint32_t target) {
        if (!in_field_) in_field_.emplace(index_, memory_);
        if (std::exchange(source_in_field_, NONE) != source) in_field_->prepare(source);
        const float distance = in_field_->distance(target, field_);
        source_in_field_ = source;
        return distance;
    }

    WithinSweep& within_sweep() { return within_ ? *within_ : within_.emplace(index_, memory_); }

    const OverlayIndex& index_;
    std::pmr::memory_resource* const memory_;
    std::optional<OverlaySssd> pairs_;
    std::optional<PreparedSource> in_field_;
    uint32_t source_in_field_ = NONE;
    std::optional<WithinSweep> within_;
    OverlaySsad field_;
    OverlayMsad nearest_;
    OverlaySsad batch_;
    FieldLowering lowering_; // of all three kinds of fields
    PreparedSource prepared_;
    uint32_t prepared_source_ = NONE;
    PointsInLeaf in_leaf_;
    std::array<PointRow, 2> rows_; // of the points of a pair
    Array<PointWays> points_;      // of a sweep
    Array<uint32_t> keys_;
    Array<uint32_t> position_of_key_; // among the points; of keys of the sweep only
    std::array<PreparedSource, 2> ends_;
};

}
