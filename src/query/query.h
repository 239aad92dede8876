#pragma once

#include <array>
#include <compare>
#include <optional>
#include <span>
#include <variant>

#include "src/graph/query.h"
#include "src/index/point_sources.h"
#include "src/overlay/query.h"
#include "src/query/ids_of_numbers.h"
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
    void require_prepared() const;
    float prepared_sssd(uint32_t target_id);

    // Multiple sources, all destinations: distances[id] to the nearest source, infinite beyond the radius.
    void msad(std::span<const uint32_t> source_ids, float radius, std::span<float> distances);

    // Fills distances[i * target_ids.size() + j] with the distance from source i to target j.
    void matrix(std::span<const uint32_t> source_ids, std::span<const uint32_t> target_ids,
                std::span<float> distances);

    // Fills nearest[id] with the position of the source that is nearest, NONE where none is reached, and the
    // distances, unless they are empty, as msad() does.
    void nearest_sources(std::span<const uint32_t> source_ids, std::span<uint32_t> nearest,
                         std::span<float> distances);

    // A vertex or a target that was found, by its id or by its position among the targets.
    struct Found {
        float distance;
        uint32_t which;
        auto operator<=>(const Found&) const = default;
    };

    // The vertices that are no farther than the radius from the nearest source, in ascending order. They stay
    // valid until the next call.
    std::span<const Found> within(std::span<const uint32_t> source_ids, float radius);

    // The nearest `count` targets or, if fewer can be reached, all of these, in ascending order. They stay
    // valid until the next call.
    std::span<const Found> nearest_targets(uint32_t source_id, std::span<const uint32_t> target_ids,
                                           size_t count);

    // Fills points[i] with the vertex that is farthest from all sources and from the points before it, and
    // distances[i] with how far it is, unless `distances` is empty. Returns how many points there are.
    uint32_t farthest_points(std::span<const uint32_t> source_ids, std::span<uint32_t> points,
                             std::span<float> distances);

    // Of two points of faces: symmetric bit for bit.
    float point_sssd(const FacePoint& source, const FacePoint& target);

    // Multiple points, all destinations.
    void point_msad(const PointSources& sources, std::span<float> distances);

    // The same questions as of vertices. A distance counts with the offset of its source.
    void point_nearest_sources(const PointSources& sources, std::span<uint32_t> nearest,
                               std::span<float> distances);
    std::span<const Found> point_within(const PointSources& sources, float radius);

    // Sweeps from the only one of the sources, at least to all vertices within the radius.
    // distance_within() then answers distances, infinite for vertices that have not been found, and
    // nearest_beyond() the least one that was left out, infinite if no other vertex can be reached.
    void sweep_within(const PointSources& source, float radius);
    float distance_within(uint32_t number) const;
    float nearest_beyond() const;

    // Whether `count` of these targets are found faster by a pair for each of them than by sweeps. A pair
    // takes as long as `pairs` pairs of vertices.
    bool targets_are_few(uint64_t targets, uint64_t count, uint64_t pairs) const;

    // Prepares one of the two ends of a path, 0 or 1: end_distance() then answers distances from it to
    // vertices by their numbers.
    void prepare_end(size_t end, const FacePoint& point);
    float end_distance(size_t end, uint32_t number);

    // How many threads a field from one or several sources uses from now on, of vertices or points, those of
    // nearest_sources() and farthest_points() among them. 0: one per processor. The graph engine uses one.
    void set_threads(uint32_t count);

    // Fills the distances from each source by itself: distances[i * id_count + id].
    void ssad_each(std::span<const uint32_t> source_ids, std::span<float> distances);

private:
    // Fields of some sources, side by side by number. A source that no triangle uses has no lane.
    struct FieldsByNumber {
        const float* distances;
        size_t stride;
        std::array<uint32_t, FIELDS_AT_ONCE> lane; // per source

        float at(size_t source, uint32_t number) const {
            return number == NONE || lane[source] == NONE ? INFINITE
                                                          : distances[number * stride + lane[source]];
        }
    };
    // The entries of a matrix, or of its transpose.
    struct MatrixEntries {
        float* first;
        size_t row_stride, column_stride;
        float& at(size_t row, size_t column) const {
            return first[row * row_stride + column * column_stride];
        }
    };

    uint32_t number_of(uint32_t id) const;
    void check_count(const char* name, uint64_t count, uint64_t fields) const;
    void take_sources(std::span<const uint32_t> source_ids);
    std::span<const float> field_within(float radius);
    bool takes(const FacePoint& point) const;
    bool sweep_together(const PointSources& sources) const;
    float vertex_to_point(uint32_t vertex, const FacePoint& point);
    float take_offsets(const PointSources& sources);
    void fill_point_field(const PointSources& only);
    void fill_from_corners(const FacePoint& point);
    void fill_from_points(const PointSources& sources, bool with_nearest);
    void fill_by_fields(const PointSources& sources, bool with_nearest);
    size_t fields_at_once(size_t left) const;
    FieldsByNumber fields_from(std::span<const uint32_t> source_ids);
    void ssad_at_once(std::span<const uint32_t> source_ids, std::span<float> distances);
    double pairs_worth_a_field(size_t fields) const;
    bool pairs_are_faster(size_t pairs, size_t fields) const;
    void matrix_of_pairs(std::span<const uint32_t> source_ids, std::span<const uint32_t> target_ids,
                         bool is_symmetric, float* distances);
    void matrix_of_fields(std::span<const uint32_t> source_ids, std::span<const uint32_t> target_ids,
                          const MatrixEntries& entries);
    void write_positions(std::span<const uint32_t> source_ids, std::span<uint32_t> nearest);
    const IdsOfNumbers& ids_of_numbers();
    std::span<const WithinSweep::Found> numbers_within(uint32_t source, float radius);
    std::span<const WithinSweep::Found> numbers_within(const PointSources& only, float radius);
    std::span<const WithinSweep::Found> found_in(std::span<const float> field, float radius);
    void keep_least();
    void keep_least_if_many(size_t& different);
    void replace_numbers();
    void rank_by_pairs(uint32_t source_id, std::span<const uint32_t> target_ids);
    void rank_by_sweeps(uint32_t source, std::span<const uint32_t> target_ids, size_t count);
    class TargetsAtNumbers;
    void write_by_id(std::span<float> field) const;
    using SideBySide = std::array<float*, FIELDS_AT_ONCE>;
    void write_by_id(const SideBySide& fields) const;

    const Index& index_;
    std::variant<GraphQuery, OverlayQuery> engine_;
    uint32_t prepared_id_ = NONE, prepared_ = NONE;
    Array<std::pair<uint64_t, uint32_t>> order_;            // the vertex numbers of a pair, and its position
    Array<uint32_t> sources_;                               // of MSAD, by number
    Array<uint32_t> unused_sources_;                        // by id: those that no triangle uses
    Array<uint32_t> batch_ids_;                             // of ssad_each()
    Array<std::pair<uint32_t, uint32_t>> unused_positions_; // such ids, and their positions
    Array<float> distance_;                                 // by number; of ssad_at_once() side by side
    // Of points where the engine takes none: by number from each corner, from all points, and from the ends
    // of a path.
    std::array<Array<float>, 3> corner_fields_;
    Array<float> point_field_;
    Array<float> offsets_; // of point sources, without the least one
    std::array<Array<float>, 2> end_fields_;
    Array<uint32_t> pair_ids_; // of a row of a matrix
    Array<uint32_t> nearest_;  // by number: the nearest source, by its number
    // By number: the position of the first source or target at a vertex, NONE except during a call; and per
    // target the next one at the same vertex.
    Array<uint32_t> position_at_, next_target_;
    std::optional<IdsOfNumbers> ids_of_numbers_;
    Array<WithinSweep::Found> within_; // where the engine sweeps whole fields only
    bool swept_field_ = false;         // whether sweep_within() has filled point_field_
    Array<Found> ranked_;              // what within() and nearest_targets() answer
};

}
