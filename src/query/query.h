#pragma once

#include <array>
#include <span>
#include <variant>

#include "src/graph/query.h"
#include "src/overlay/query.h"
#include "src/query/index.h"

namespace geodesic {

// One thread's scratch for queries on one index, by the engine that the index was built for; the index must
// outlive it. Ids are checked: Error INVALID_ARGUMENT names one that is out of range.
class Query {
public:
    Query(const Index& index, std::pmr::memory_resource* memory);

    // Single source, single destination: symmetric bit for bit.
    float sssd(uint32_t source_id, uint32_t target_id);

    // Fills the distances of pairs of vertices: ids[2 i] and ids[2 i + 1] are one.
    void sssd_each(std::span<const uint32_t> ids, std::span<float> distances);

    // From then on prepared_sssd() is from this source, until the next call.
    void prepare(uint32_t source_id);
    float prepared_sssd(uint32_t target_id);

    // Multiple sources, all destinations: distances[id] to the nearest source, infinite beyond the radius.
    void msad(std::span<const uint32_t> source_ids, float radius, std::span<float> distances);

    // Fills points[i] with the vertex that is farthest from all sources and from the points before it, and
    // distances[i] with how far it is, unless `distances` is empty. Returns how many points there are.
    uint32_t farthest_points(std::span<const uint32_t> source_ids, std::span<uint32_t> points,
                             std::span<float> distances);

    // Of two points of faces: symmetric bit for bit.
    float point_sssd(const FacePoint& source, const FacePoint& target);

    // Multiple points, all destinations: the least of offsets[i] + the distance from points[i]. Without
    // offsets all are 0. `known` are ways, by number, that the distances are not to be longer than.
    struct KnownWay {
        uint32_t number;
        float length;
    };
    void point_msad(std::span<const FacePoint> points, std::span<const float> offsets,
                    std::span<const KnownWay> known, std::span<float> distances);

    // Prepares one of the two ends of a path, 0 or 1: end_distance() then answers distances from it to
    // vertices by their numbers.
    void prepare_end(size_t end, const FacePoint& point);
    float end_distance(size_t end, uint32_t number);

    // Threads of msad(), 0: one per processor; the graph engine uses one.
    void set_threads(uint32_t count);

    // Fills the distances from each source by itself: distances[i * id_count + id].
    void ssad_each(std::span<const uint32_t> source_ids, std::span<float> distances);

private:
    uint32_t number_of(uint32_t id) const;
    void check_count(std::span<const float> distances, uint64_t fields) const;
    void take_sources(std::span<const uint32_t> source_ids);
    std::span<const float> field_within(float radius);
    bool takes(const FacePoint& point) const;
    float vertex_to_point(uint32_t vertex, const FacePoint& point);
    void add_point_field(const FacePoint& point, float offset);
    void ssad_at_once(OverlayQuery& engine, std::span<const uint32_t> source_ids, std::span<float> distances);
    void write_by_id(std::span<float> field) const;
    using SideBySide = std::array<float*, OverlayQuery::FIELDS_AT_ONCE>;
    void write_by_id(const SideBySide& fields) const;

    const Index& index_;
    std::variant<GraphQuery, OverlayQuery> engine_;
    uint32_t prepared_id_ = NONE, prepared_ = NONE;
    Array<std::pair<uint64_t, uint32_t>> order_; // the vertex numbers of a pair, and its position
    Array<uint32_t> sources_;                    // of MSAD, by number
    Array<float> distance_;                      // by number; of ssad_at_once() side by side
    // Of points where the engine takes none: by number from each corner, from all points, and from the ends
    // of a path.
    std::array<Array<float>, 3> corner_fields_;
    Array<float> point_field_;
    std::array<Array<float>, 2> end_fields_;
};

}
