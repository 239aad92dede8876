// Questions to an index, by scratch of its own or by the handle of a query.
#include <algorithm>

#include "format/error.h"
#include "geoidx.h"
#include "src/base/numbers.h"
#include "src/capi/handles.h"
#include "src/capi/points.h"
#include "src/capi/status.h"
#include "src/path/next_step.h"
#include "src/path/path.h"
#include "src/path/point_distance.h"
#include "src/points/point_queries.h"

using namespace geodesic;

namespace {

// Borrows scratch of the index for one call.
class BorrowedQuery {
public:
    explicit BorrowedQuery(const geoidx& index) : pool_(index.queries), query_(pool_.take()) {}
    ~BorrowedQuery() { pool_.give_back(query_); }
    BorrowedQuery(const BorrowedQuery&) = delete;
    BorrowedQuery& operator=(const BorrowedQuery&) = delete;

    Query* operator->() const { return query_; }
    Query& operator*() const { return *query_; }

private:
    QueryPool& pool_;
    Query* query_;
};

// An empty list passes: where there must be a source, Query::take_sources() says that there is none.
void check_sources(std::span<const uint32_t> sources) {
    require(sources.empty() || sources.data(), "sources is NULL");
}

void check_msad(std::span<const uint32_t> sources, const float* distances) {
    check_sources(sources);
    require(distances, "distances is NULL");
}

void fill_fields(Query& query, std::span<const uint32_t> sources, std::span<float> distances) {
    check_sources(sources);
    require(distances.empty() || distances.data(), "distances is NULL");
    query.ssad_each(sources, distances);
}

void fill_matrix(Query& query, std::span<const uint32_t> sources, std::span<const uint32_t> targets,
                 std::span<float> distances) {
    check_sources(sources);
    require(targets.empty() || targets.data(), "targets is NULL");
    require(distances.empty() || distances.data(), "distances is NULL");
    query.matrix(sources, targets, distances);
}

// Sources with the offsets that they begin with, which may be NULL.
std::vector<SurfacePoint>
checked_sources(const Surface& surface, std::span<const geoidx_surface_point> sources, const float* offsets) {
    require(!sources.empty(), "there is no source");
    require(sources.data(), "sources is NULL");
    for (size_t i = 0; offsets && i < sources.size(); ++i)
        require(offsets[i] >= 0 && offsets[i] < INFINITE, "an offset is negative, infinite or NaN");
    return checked_points(surface, sources, "source");
}

// Writes as many of what was found as there is room for. `distances` may be NULL.
void write_found(std::span<const Query::Found> found, uint32_t* which, float* distances, uint32_t capacity) {
    for (size_t i = 0; i < std::min<size_t>(found.size(), capacity); ++i) {
        which[i] = found[i].which;
        if (distances) distances[i] = found[i].distance;
    }
}

}

geoidx_status geoidx_sssd(const geoidx* index, uint32_t source, uint32_t target, float* distance) {
    return guarded([&] {
        require(index, "index is NULL");
        require(distance, "distance is NULL");
        *distance = BorrowedQuery(*index)->sssd(source, target);
    });
}

geoidx_status geoidx_sssd_batch(const geoidx* index, const uint32_t* source_target_pairs, uint64_t pair_count,
                                float* distances) {
    return guarded([&] {
        require(index, "index is NULL");
        require(pair_count == 0 || source_target_pairs, "source_target_pairs is NULL");
        require(pair_count == 0 || distances, "distances is NULL");
        BorrowedQuery(*index)->sssd_each({source_target_pairs, 2 * pair_count}, {distances, pair_count});
    });
}

geoidx_status geoidx_msad(const geoidx* index, const uint32_t* sources, uint32_t source_count,
                          float* distances, uint32_t distance_count) {
    return guarded([&] {
        require(index, "index is NULL");
        check_msad({sources, source_count}, distances);
        BorrowedQuery(*index)->msad({sources, source_count}, INFINITE, {distances, distance_count});
    });
}

geoidx_status geoidx_ssad_batch(const geoidx* index, const uint32_t* sources, uint32_t source_count,
                                float* distances, uint64_t distance_count) {
    return guarded([&] {
        require(index, "index is NULL");
        fill_fields(*BorrowedQuery(*index), {sources, source_count}, {distances, distance_count});
    });
}

geoidx_status geoidx_matrix(const geoidx* index, const uint32_t* sources, uint32_t source_count,
                            const uint32_t* targets, uint32_t target_count, float* distances,
                            uint64_t distance_count) {
    return guarded([&] {
        require(index, "index is NULL");
        fill_matrix(*BorrowedQuery(*index), {sources, source_count}, {targets, target_count},
                    {distances, distance_count});
    });
}

geoidx_status geoidx_query_create(const geoidx* index, geoidx_query** out) {
    if (out) *out = nullptr;
    return guarded([&] {
        require(out, "out is NULL");
        require(index, "index is NULL");
        auto& memory =
            const_cast<geoidx*>(index)->memory; // a memory resource is not part of the index's value
        *out = std::pmr::polymorphic_allocator<>(&memory).new_object<geoidx_query>(*index, memory);
    });
}

void geoidx_query_close(geoidx_query* query) {
    if (query) std::pmr::polymorphic_allocator<>(&query->memory).delete_object(query);
}

geoidx_status geoidx_query_sssd(geoidx_query* query, uint32_t source, uint32_t target, float* distance) {
    return guarded([&] {
        require(query, "query is NULL");
        require(distance, "distance is NULL");
        *distance = query->query.sssd(source, target);
    });
}

geoidx_status geoidx_query_msad(geoidx_query* query, const uint32_t* sources, uint32_t source_count,
                                float* distances, uint32_t distance_count) {
    return guarded([&] {
        require(query, "query is NULL");
        check_msad({sources, source_count}, distances);
        query->query.msad({sources, source_count}, INFINITE, {distances, distance_count});
    });
}

geoidx_status geoidx_query_msad_within(geoidx_query* query, const uint32_t* sources, uint32_t source_count,
                                       float radius, float* distances, uint32_t distance_count) {
    return guarded([&] {
        require(query, "query is NULL");
        check_msad({sources, source_count}, distances);
        query->query.msad({sources, source_count}, radius, {distances, distance_count});
    });
}

geoidx_status geoidx_query_matrix(geoidx_query* query, const uint32_t* sources, uint32_t source_count,
                                  const uint32_t* targets, uint32_t target_count, float* distances,
                                  uint64_t distance_count) {
    return guarded([&] {
        require(query, "query is NULL");
        fill_matrix(query->query, {sources, source_count}, {targets, target_count},
                    {distances, distance_count});
    });
}

geoidx_status geoidx_query_nearest_sources(geoidx_query* query, const uint32_t* sources,
                                           uint32_t source_count, uint32_t* nearest, float* distances,
                                           uint32_t vertex_count) {
    return guarded([&] {
        require(query, "query is NULL");
        check_sources({sources, source_count});
        require(nearest, "nearest is NULL");
        query->query.nearest_sources({sources, source_count}, {nearest, vertex_count},
                                     {distances, distances ? vertex_count : 0});
    });
}

geoidx_status geoidx_query_within(geoidx_query* query, const uint32_t* sources, uint32_t source_count,
                                  float radius, uint32_t* vertices, float* distances, uint32_t capacity,
                                  uint32_t* count) {
    if (count) *count = 0;
    return guarded([&] {
        require(query, "query is NULL");
        check_sources({sources, source_count});
        require(capacity == 0 || vertices, "vertices is NULL");
        require(count, "count is NULL");
        const auto found = query->query.within({sources, source_count}, radius);
        write_found(found, vertices, distances, capacity);
        *count = static_cast<uint32_t>(found.size());
    });
}

geoidx_status geoidx_query_nearest_targets(geoidx_query* query, uint32_t source, const uint32_t* targets,
                                           uint32_t target_count, uint32_t* positions, float* distances,
                                           uint32_t capacity, uint32_t* count) {
    if (count) *count = 0;
    return guarded([&] {
        require(query, "query is NULL");
        require(target_count == 0 || targets, "targets is NULL");
        require(capacity == 0 || positions, "positions is NULL");
        require(count, "count is NULL");
        const auto found = query->query.nearest_targets(source, {targets, target_count}, capacity);
        write_found(found, positions, distances, capacity);
        *count = static_cast<uint32_t>(found.size());
    });
}

geoidx_status geoidx_query_farthest_points(geoidx_query* query, const uint32_t* sources,
                                           uint32_t source_count, uint32_t point_count, uint32_t* points,
                                           float* distances, uint32_t* count) {
    if (count) *count = 0;
    return guarded([&] {
        require(query, "query is NULL");
        check_sources({sources, source_count});
        require(point_count == 0 || points, "points is NULL");
        require(count, "count is NULL");
        *count = query->query.farthest_points({sources, source_count}, {points, point_count},
                                              {distances, distances ? point_count : 0});
    });
}

geoidx_status geoidx_query_set_threads(geoidx_query* query, uint32_t threads) {
    return guarded([&] {
        require(query, "query is NULL");
        query->query.set_threads(threads);
    });
}

geoidx_status geoidx_query_ssad_batch(geoidx_query* query, const uint32_t* sources, uint32_t source_count,
                                      float* distances, uint64_t distance_count) {
    return guarded([&] {
        require(query, "query is NULL");
        fill_fields(query->query, {sources, source_count}, {distances, distance_count});
    });
}

geoidx_status geoidx_query_prepare(geoidx_query* query, uint32_t source) {
    return guarded([&] {
        require(query, "query is NULL");
        query->query.prepare(source);
    });
}

geoidx_status geoidx_query_prepared(geoidx_query* query, const uint32_t* targets, uint64_t target_count,
                                    float* distances) {
    return guarded([&] {
        require(query, "query is NULL");
        require(target_count == 0 || targets, "targets is NULL");
        require(target_count == 0 || distances, "distances is NULL");
        query->query.require_prepared();
        for (uint64_t i = 0; i < target_count; ++i) distances[i] = query->query.prepared_sssd(targets[i]);
    });
}

geoidx_status geoidx_query_point_sssd(geoidx_query* query, const geoidx_surface* surface,
                                      const geoidx_surface_point* source, const geoidx_surface_point* target,
                                      float* distance) {
    return guarded([&] {
        require(query, "query is NULL");
        require(surface, "surface is NULL");
        require(source, "source is NULL");
        require(target, "target is NULL");
        require(distance, "distance is NULL");
        const SurfacePoint from = checked_point(surface->surface, *source, "source"),
                           to = checked_point(surface->surface, *target, "target");
        *distance = distance_of_points(query->index, query->query, surface->surface, from, to);
    });
}

geoidx_status geoidx_query_point_msad(geoidx_query* query, const geoidx_surface* surface,
                                      const geoidx_surface_point* sources, uint32_t source_count,
                                      const float* offsets, float* distances, uint32_t distance_count) {
    return guarded([&] {
        require(query, "query is NULL");
        require(surface, "surface is NULL");
        require(distances, "distances is NULL");
        const auto points = checked_sources(surface->surface, {sources, source_count}, offsets);
        PointQueries(query->index, query->query, surface->surface)
            .msad(points, {offsets, offsets ? source_count : 0}, {distances, distance_count});
    });
}

geoidx_status geoidx_query_point_nearest_sources(geoidx_query* query, const geoidx_surface* surface,
                                                 const geoidx_surface_point* sources, uint32_t source_count,
                                                 const float* offsets, uint32_t* nearest, float* distances,
                                                 uint32_t vertex_count) {
    return guarded([&] {
        require(query, "query is NULL");
        require(surface, "surface is NULL");
        require(nearest, "nearest is NULL");
        const auto points = checked_sources(surface->surface, {sources, source_count}, offsets);
        PointQueries(query->index, query->query, surface->surface)
            .nearest_sources(points, {offsets, offsets ? source_count : 0}, {nearest, vertex_count},
                             {distances, distances ? vertex_count : 0});
    });
}

geoidx_status geoidx_query_point_within(geoidx_query* query, const geoidx_surface* surface,
                                        const geoidx_surface_point* sources, uint32_t source_count,
                                        const float* offsets, float radius, uint32_t* vertices,
                                        float* distances, uint32_t capacity, uint32_t* count) {
    if (count) *count = 0;
    return guarded([&] {
        require(query, "query is NULL");
        require(surface, "surface is NULL");
        require(capacity == 0 || vertices, "vertices is NULL");
        require(count, "count is NULL");
        const auto points = checked_sources(surface->surface, {sources, source_count}, offsets);
        const auto found = PointQueries(query->index, query->query, surface->surface)
                               .within(points, {offsets, offsets ? source_count : 0}, radius);
        write_found(found, vertices, distances, capacity);
        *count = static_cast<uint32_t>(found.size());
    });
}

geoidx_status geoidx_query_point_nearest_targets(geoidx_query* query, const geoidx_surface* surface,
                                                 const geoidx_surface_point* source,
                                                 const geoidx_surface_point* targets, uint32_t target_count,
                                                 uint32_t* positions, float* distances, uint32_t capacity,
                                                 uint32_t* count) {
    if (count) *count = 0;
    return guarded([&] {
        require(query, "query is NULL");
        require(surface, "surface is NULL");
        require(source, "source is NULL");
        require(target_count == 0 || targets, "targets is NULL");
        require(capacity == 0 || positions, "positions is NULL");
        require(count, "count is NULL");
        const SurfacePoint from = checked_point(surface->surface, *source, "source");
        const auto to = checked_points(surface->surface, {targets, target_count}, "target");
        const auto of_pair = [&](size_t i) {
            return distance_of_points(query->index, query->query, surface->surface, from, to[i]);
        };
        const auto found = PointQueries(query->index, query->query, surface->surface)
                               .nearest_targets(from, to, capacity, of_pair);
        write_found(found, positions, distances, capacity);
        *count = static_cast<uint32_t>(found.size());
    });
}

geoidx_status geoidx_query_path(geoidx_query* query, const geoidx_surface* surface,
                                const geoidx_surface_point* source, const geoidx_surface_point* target,
                                uint32_t quality, double* length) {
    if (query) query->path.clear();
    return guarded([&] {
        require(query, "query is NULL");
        require(surface, "surface is NULL");
        require(source, "source is NULL");
        require(target, "target is NULL");
        require(length, "length is NULL");
        require(quality <= GEOIDX_PATH_EXACT, "quality is not a GEOIDX_PATH_*");
        const SurfacePoint from = checked_point(surface->surface, *source, "source"),
                           to = checked_point(surface->surface, *target, "target");
        const SurfacePath path =
            find_path(query->index, query->query, surface->surface, from, to,
                      quality == GEOIDX_PATH_EXACT ? PathQuality::EXACT : PathQuality::STRAIGHT);
        query->path = callers_path(surface->surface, path.points);
        *length = path.length;
    });
}

geoidx_status geoidx_query_path_points(const geoidx_query* query, geoidx_path_point* points,
                                       uint64_t capacity, uint64_t* count) {
    if (count) *count = 0;
    return guarded([&] {
        require(query, "query is NULL");
        require(count, "count is NULL");
        *count = query->path.size();
        require(points || capacity == 0, "points is NULL, but capacity is not 0");
        if (!points) return;
        require(*count <= capacity, "there are more points than capacity");
        std::ranges::copy(query->path, points);
    });
}

geoidx_status geoidx_query_prepare_target(geoidx_query* query, const geoidx_surface* surface,
                                          const geoidx_surface_point* target) {
    if (query) query->walk.reset();
    return guarded([&] {
        require(query, "query is NULL");
        require(surface, "surface is NULL");
        require(target, "target is NULL");
        const Surface& on = surface->surface;
        const SurfacePoint to = checked_point(on, *target, "target");
        require_path_end(query->index, on, to, "target");
        query->walk = Walk{to};
        query->walk_vertices = on.vertex_count();
        query->walk_faces = on.face_count();
    });
}

geoidx_status geoidx_query_next_step(geoidx_query* query, const geoidx_surface* surface,
                                     const geoidx_surface_point* from, geoidx_path_point* step,
                                     double* distance) {
    return guarded([&] {
        require(query, "query is NULL");
        require(surface, "surface is NULL");
        require(from, "from is NULL");
        require(step, "step is NULL");
        require(query->walk.has_value(), "no target has been prepared");
        const Surface& on = surface->surface;
        if (on.vertex_count() != query->walk_vertices || on.face_count() != query->walk_faces)
            throw Error(GEOIDX_ERROR_MESH_MISMATCH, "the target was prepared on another surface");
        const Step next =
            next_step(query->index, query->query, on, checked_point(on, *from, "from"), *query->walk);
        const SurfacePoint ends[] = {next.from, next.to};
        std::ranges::copy(callers_path(on, ends), step);
        if (distance) *distance = next.distance;
    });
}
