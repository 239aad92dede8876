// The C API of geoidx.h for C++20: owning, move-only handles, spans, and exceptions. What functions mean,
// units, and thread rules are stated in geoidx.h.
#ifndef GEOIDX_HPP
#define GEOIDX_HPP

// Compilers that know only parts of C++20 yet have a number between those of C++17 and C++20.
#if __cplusplus <= 201703L && (!defined(_MSVC_LANG) || _MSVC_LANG <= 201703L)
#error "geoidx.hpp needs C++20: compile with -std=c++20 (MSVC: /std:c++20), or include geoidx.h"
#endif

#include <array>
#include <cstddef>
#include <cstdint>
#include <exception>
#include <functional>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include <geoidx.h>

// `geoidx` itself is the handle of the C API.
namespace gdx {

// A failure, with its status and the library's detail.
class error : public std::runtime_error {
public:
    error(geoidx_status status, const std::string& detail)
        : std::runtime_error(detail.empty() ? geoidx_status_string(status) : detail), status_(status) {}
    geoidx_status status() const noexcept { return status_; }

private:
    geoidx_status status_;
};

inline void check(geoidx_status status) {
    if (status != GEOIDX_OK) throw error(status, geoidx_last_error());
}

namespace detail {

template <class T>
std::uint32_t count_of(std::span<T> values) {
    if (values.size() > std::numeric_limits<std::uint32_t>::max())
        throw std::length_error("more than 2^32 - 1 values");
    return static_cast<std::uint32_t>(values.size());
}

// Of distances that may be left out.
inline void require_equal_or_none(std::size_t distances, std::size_t others) {
    if (distances != 0 && distances != others)
        throw std::invalid_argument("distances must be as many as what they belong to, or none");
}

// Of sources with offsets, or without any.
inline const float* offsets_of(std::span<const geoidx_surface_point> sources,
                               std::span<const float> offsets) {
    if (offsets.empty()) return nullptr;
    if (offsets.size() != sources.size())
        throw std::invalid_argument("there must be an offset for each source");
    return offsets.data();
}

inline const char* path_of(const std::string& utf8_path) {
    if (utf8_path.find('\0') != std::string::npos) throw std::invalid_argument("the path holds a NUL");
    return utf8_path.c_str();
}

}

// A mesh of the caller's arrays, which must outlive it: x, y, z of each vertex, three ids a triangle.
template <class Real>
geoidx_mesh mesh_of(std::span<const Real> positions, std::span<const std::uint32_t> triangles) {
    static_assert(std::is_same_v<Real, float> || std::is_same_v<Real, double>);
    if (positions.size() % 3 != 0 || triangles.size() % 3 != 0)
        throw std::invalid_argument("positions and triangles come in threes");
    geoidx_mesh mesh;
    geoidx_mesh_init(&mesh);
    mesh.position_type = std::is_same_v<Real, float> ? GEOIDX_POSITION_FLOAT : GEOIDX_POSITION_DOUBLE;
    mesh.positions = positions.data();
    mesh.vertex_count = positions.size() / 3;
    mesh.triangles = triangles.data();
    mesh.triangle_count = triangles.size() / 3;
    return mesh;
}

inline geoidx_build_options build_options() {
    geoidx_build_options options;
    geoidx_build_options_init(&options);
    return options;
}

inline geoidx_save_options save_options() {
    geoidx_save_options options;
    geoidx_save_options_init(&options);
    return options;
}

// Expects a mesh, which must outlive the options, or any.
inline geoidx_open_options open_options(const geoidx_mesh* expected_mesh = nullptr) {
    geoidx_open_options options;
    geoidx_open_options_init(&options);
    options.expected_mesh = expected_mesh;
    return options;
}

// Told a fraction 0 .. 1 and the name of a stage; returns false to cancel. What it throws leaves build().
using progress_function = std::function<bool(float fraction, const char* stage)>;

class query;

// An index. Any number of threads may query one at once.
class index {
public:
    static index build(const geoidx_mesh& mesh, geoidx_build_options options = build_options(),
                       const progress_function& progress = {}) {
        watched_progress watched{progress, nullptr};
        if (progress) {
            options.progress = watched_progress::call;
            options.progress_user = &watched;
        }
        geoidx* built = nullptr;
        const geoidx_status status = geoidx_build(&mesh, &options, &built);
        if (watched.thrown) std::rethrow_exception(watched.thrown);
        check(status);
        return index(built);
    }

    static index open(const std::string& utf8_path, const geoidx_open_options* options = nullptr) {
        geoidx* opened = nullptr;
        check(geoidx_open(detail::path_of(utf8_path), options, &opened));
        return index(opened);
    }

    static index open(std::span<const std::byte> file, const geoidx_open_options* options = nullptr) {
        geoidx* opened = nullptr;
        check(geoidx_open_memory(file.data(), file.size(), options, &opened));
        return index(opened);
    }

    void save(const std::string& utf8_path, const geoidx_save_options* options = nullptr) const {
        check(geoidx_save(get(), detail::path_of(utf8_path), options));
    }

    std::vector<std::byte> bytes(const geoidx_save_options* options = nullptr) const {
        std::uint64_t size = 0;
        check(geoidx_save_memory(get(), options, nullptr, 0, &size));
        std::vector<std::byte> file(size);
        check(geoidx_save_memory(get(), options, file.data(), file.size(), &size));
        return file;
    }

    // Of the file that the index was opened from.
    std::vector<geoidx_section> sections() const {
        std::uint32_t count = 0;
        check(geoidx_get_sections(get(), nullptr, 0, &count));
        std::vector<geoidx_section> sections(count);
        check(geoidx_get_sections(get(), sections.data(), count, &count));
        return sections;
    }

    geoidx_info info() const {
        geoidx_info info{};
        info.struct_size = sizeof info;
        check(geoidx_get_info(get(), &info));
        return info;
    }

    float sssd(std::uint32_t source, std::uint32_t target) const {
        float distance = 0;
        check(geoidx_sssd(get(), source, target, &distance));
        return distance;
    }

    // Of source-target pairs, one after the other.
    void sssd(std::span<const std::uint32_t> pairs, std::span<float> distances) const {
        if (pairs.size() != 2 * distances.size())
            throw std::invalid_argument("two vertices are needed for each distance");
        check(geoidx_sssd_batch(get(), pairs.data(), distances.size(), distances.data()));
    }

    // To every vertex from the nearest source.
    void msad(std::span<const std::uint32_t> sources, std::span<float> distances) const {
        check(geoidx_msad(get(), sources.data(), detail::count_of(sources), distances.data(),
                          detail::count_of(distances)));
    }
    std::vector<float> msad(std::span<const std::uint32_t> sources) const {
        std::vector<float> distances(info().vertex_count);
        msad(sources, distances);
        return distances;
    }

    // To every vertex from each source: one source's distances after the other's.
    void ssad(std::span<const std::uint32_t> sources, std::span<float> distances) const {
        check(geoidx_ssad_batch(get(), sources.data(), detail::count_of(sources), distances.data(),
                                distances.size()));
    }

    // distances[i * targets.size() + j] is that from sources[i] to targets[j].
    void matrix(std::span<const std::uint32_t> sources, std::span<const std::uint32_t> targets,
                std::span<float> distances) const {
        check(geoidx_matrix(get(), sources.data(), detail::count_of(sources), targets.data(),
                            detail::count_of(targets), distances.data(), distances.size()));
    }

    query make_query() const;

    const geoidx* get() const noexcept { return handle_.get(); }

private:
    struct watched_progress {
        const progress_function& progress;
        std::exception_ptr thrown;

        static std::int32_t call(void* user, float fraction, const char* stage) noexcept {
            auto& watched = *static_cast<watched_progress*>(user);
            try {
                return watched.progress(fraction, stage) ? 1 : 0;
            } catch (...) {
                watched.thrown = std::current_exception();
                return 0;
            }
        }
    };
    struct close {
        void operator()(geoidx* handle) const noexcept { geoidx_close(handle); }
    };
    explicit index(geoidx* handle) : handle_(handle) {}

    std::unique_ptr<geoidx, close> handle_;
};

inline geoidx_surface_options surface_options() {
    geoidx_surface_options options;
    geoidx_surface_options_init(&options);
    return options;
}

// A mesh with its adjacency, shared by threads, for points of the surface.
class surface {
public:
    explicit surface(const geoidx_mesh& mesh, double weld_tolerance = 0)
        : surface(mesh, [&] {
              geoidx_surface_options options = surface_options();
              options.weld_tolerance = weld_tolerance;
              return options;
          }()) {}

    // With the costs that an index was built with.
    surface(const geoidx_mesh& mesh, const geoidx_surface_options& options) {
        geoidx_surface* made = nullptr;
        check(geoidx_surface_create(&mesh, &options, &made));
        handle_.reset(made);
    }

    // Of the mesh that the index keeps (geoidx_build_options.store_mesh); it outlives the index.
    static surface of(const index& keeping, const geoidx_surface_options& options = surface_options()) {
        geoidx_surface* made = nullptr;
        check(geoidx_surface_of_index(keeping.get(), &options, &made));
        return surface(made);
    }

    // A corner of one of the vertex' triangles.
    geoidx_surface_point vertex_point(std::uint32_t vertex) const {
        geoidx_surface_point point{};
        check(geoidx_vertex_point(get(), vertex, &point));
        return point;
    }

    // The nearest point of the surface, and how far it is.
    std::pair<geoidx_surface_point, double> closest_point(const std::array<double, 3>& position) const {
        std::pair<geoidx_surface_point, double> closest{};
        check(geoidx_closest_point(get(), position.data(), &closest.first, &closest.second));
        return closest;
    }

    const geoidx_surface* get() const noexcept { return handle_.get(); }

private:
    struct close {
        void operator()(geoidx_surface* handle) const noexcept { geoidx_surface_close(handle); }
    };
    explicit surface(geoidx_surface* handle) : handle_(handle) {}

    std::unique_ptr<geoidx_surface, close> handle_;
};

// A path over the surface, from its first point to its last one.
struct path {
    double length = 0;
    std::vector<geoidx_path_point> points;
};

// The next piece of a way, on one triangle, and how far the target is from its first point.
struct step {
    std::array<geoidx_path_point, 2> points{};
    double distance = 0;
};

// One thread's scratch for queries on one index, which must outlive it.
class query {
public:
    float sssd(std::uint32_t source, std::uint32_t target) {
        float distance = 0;
        check(geoidx_query_sssd(get(), source, target, &distance));
        return distance;
    }
    void msad(std::span<const std::uint32_t> sources, std::span<float> distances) {
        check(geoidx_query_msad(get(), sources.data(), detail::count_of(sources), distances.data(),
                                detail::count_of(distances)));
    }
    void msad_within(std::span<const std::uint32_t> sources, float radius, std::span<float> distances) {
        check(geoidx_query_msad_within(get(), sources.data(), detail::count_of(sources), radius,
                                       distances.data(), detail::count_of(distances)));
    }
    void ssad(std::span<const std::uint32_t> sources, std::span<float> distances) {
        check(geoidx_query_ssad_batch(get(), sources.data(), detail::count_of(sources), distances.data(),
                                      distances.size()));
    }
    // distances[i * targets.size() + j] is that from sources[i] to targets[j].
    void matrix(std::span<const std::uint32_t> sources, std::span<const std::uint32_t> targets,
                std::span<float> distances) {
        check(geoidx_query_matrix(get(), sources.data(), detail::count_of(sources), targets.data(),
                                  detail::count_of(targets), distances.data(), distances.size()));
    }
    // Fills the position in `sources` of the nearest one to each vertex; `distances` are as many, or none.
    void nearest_sources(std::span<const std::uint32_t> sources, std::span<std::uint32_t> nearest,
                         std::span<float> distances = {}) {
        detail::require_equal_or_none(distances.size(), nearest.size());
        check(geoidx_query_nearest_sources(get(), sources.data(), detail::count_of(sources), nearest.data(),
                                           distances.empty() ? nullptr : distances.data(),
                                           detail::count_of(nearest)));
    }
    // Returns how many vertices are within the radius, of which the nearest are written; `distances` are as
    // many as `vertices`, or none.
    std::uint32_t within(std::span<const std::uint32_t> sources, float radius,
                         std::span<std::uint32_t> vertices, std::span<float> distances = {}) {
        detail::require_equal_or_none(distances.size(), vertices.size());
        std::uint32_t count = 0;
        check(geoidx_query_within(get(), sources.data(), detail::count_of(sources), radius, vertices.data(),
                                  distances.empty() ? nullptr : distances.data(), detail::count_of(vertices),
                                  &count));
        return count;
    }
    // Returns how many of the nearest targets were written; `distances` are as many as `positions`, or none.
    std::uint32_t nearest_targets(std::uint32_t source, std::span<const std::uint32_t> targets,
                                  std::span<std::uint32_t> positions, std::span<float> distances = {}) {
        detail::require_equal_or_none(distances.size(), positions.size());
        std::uint32_t count = 0;
        check(geoidx_query_nearest_targets(get(), source, targets.data(), detail::count_of(targets),
                                           positions.data(), distances.empty() ? nullptr : distances.data(),
                                           detail::count_of(positions), &count));
        return count;
    }
    // Returns how many of the points there are; `distances` are as many as the points, or none.
    std::uint32_t farthest_points(std::span<const std::uint32_t> sources, std::span<std::uint32_t> points,
                                  std::span<float> distances = {}) {
        detail::require_equal_or_none(distances.size(), points.size());
        std::uint32_t count = 0;
        check(geoidx_query_farthest_points(get(), sources.data(), detail::count_of(sources),
                                           detail::count_of(points), points.data(),
                                           distances.empty() ? nullptr : distances.data(), &count));
        return count;
    }
    void set_threads(std::uint32_t threads) { check(geoidx_query_set_threads(get(), threads)); }

    // From then on prepared() is from this source.
    void prepare(std::uint32_t source) { check(geoidx_query_prepare(get(), source)); }
    void prepared(std::span<const std::uint32_t> targets, std::span<float> distances) {
        if (targets.size() != distances.size())
            throw std::invalid_argument("there must be a distance for each target");
        check(geoidx_query_prepared(get(), targets.data(), targets.size(), distances.data()));
    }

    float sssd(const surface& on, const geoidx_surface_point& source, const geoidx_surface_point& target) {
        float distance = 0;
        check(geoidx_query_point_sssd(get(), on.get(), &source, &target, &distance));
        return distance;
    }
    // `offsets` are as many as the sources, or none, here and below.
    void msad(const surface& on, std::span<const geoidx_surface_point> sources, std::span<float> distances,
              std::span<const float> offsets = {}) {
        check(geoidx_query_point_msad(get(), on.get(), sources.data(), detail::count_of(sources),
                                      detail::offsets_of(sources, offsets), distances.data(),
                                      detail::count_of(distances)));
    }
    // These are as those of vertices are.
    void nearest_sources(const surface& on, std::span<const geoidx_surface_point> sources,
                         std::span<std::uint32_t> nearest, std::span<float> distances = {},
                         std::span<const float> offsets = {}) {
        detail::require_equal_or_none(distances.size(), nearest.size());
        check(geoidx_query_point_nearest_sources(
            get(), on.get(), sources.data(), detail::count_of(sources), detail::offsets_of(sources, offsets),
            nearest.data(), distances.empty() ? nullptr : distances.data(), detail::count_of(nearest)));
    }
    std::uint32_t within(const surface& on, std::span<const geoidx_surface_point> sources, float radius,
                         std::span<std::uint32_t> vertices, std::span<float> distances = {},
                         std::span<const float> offsets = {}) {
        detail::require_equal_or_none(distances.size(), vertices.size());
        std::uint32_t count = 0;
        check(geoidx_query_point_within(get(), on.get(), sources.data(), detail::count_of(sources),
                                        detail::offsets_of(sources, offsets), radius, vertices.data(),
                                        distances.empty() ? nullptr : distances.data(),
                                        detail::count_of(vertices), &count));
        return count;
    }
    std::uint32_t nearest_targets(const surface& on, const geoidx_surface_point& source,
                                  std::span<const geoidx_surface_point> targets,
                                  std::span<std::uint32_t> positions, std::span<float> distances = {}) {
        detail::require_equal_or_none(distances.size(), positions.size());
        std::uint32_t count = 0;
        check(geoidx_query_point_nearest_targets(
            get(), on.get(), &source, targets.data(), detail::count_of(targets), positions.data(),
            distances.empty() ? nullptr : distances.data(), detail::count_of(positions), &count));
        return count;
    }

    // Nothing if the points lie in different components.
    std::optional<path> find_path(const surface& on, const geoidx_surface_point& source,
                                  const geoidx_surface_point& target,
                                  std::uint32_t quality = GEOIDX_PATH_STRAIGHT) {
        path found;
        const geoidx_status status =
            geoidx_query_path(get(), on.get(), &source, &target, quality, &found.length);
        if (status == GEOIDX_ERROR_NO_PATH) return std::nullopt;
        check(status);
        std::uint64_t count = 0;
        check(geoidx_query_path_points(get(), nullptr, 0, &count));
        found.points.resize(count);
        check(geoidx_query_path_points(get(), found.points.data(), count, &count));
        return found;
    }

    // From then on next_step() leads there.
    void prepare_target(const surface& on, const geoidx_surface_point& target) {
        check(geoidx_query_prepare_target(get(), on.get(), &target));
    }
    // Nothing if the target lies in another component.
    std::optional<step> next_step(const surface& on, const geoidx_surface_point& from) {
        step next;
        const geoidx_status status =
            geoidx_query_next_step(get(), on.get(), &from, next.points.data(), &next.distance);
        if (status == GEOIDX_ERROR_NO_PATH) return std::nullopt;
        check(status);
        return next;
    }

    geoidx_query* get() const noexcept { return handle_.get(); }

private:
    struct close {
        void operator()(geoidx_query* handle) const noexcept { geoidx_query_close(handle); }
    };
    friend class index;
    explicit query(geoidx_query* handle) : handle_(handle) {}
    std::unique_ptr<geoidx_query, close> handle_;
};

inline query index::make_query() const {
    geoidx_query* made = nullptr;
    check(geoidx_query_create(get(), &made));
    return query(made);
}

// A mesh and a metric, and one thread's scratch: distances computed from scratch.
class solver {
public:
    explicit solver(const geoidx_mesh& mesh, const geoidx_build_options* options = nullptr) {
        geoidx_solver* made = nullptr;
        check(geoidx_solver_create(&mesh, options, &made));
        handle_.reset(made);
    }

    // To each target, which the computation stops after, from the nearest source.
    void distances(std::span<const std::uint32_t> sources, std::span<const std::uint32_t> targets,
                   std::span<double> distances) {
        if (targets.size() != distances.size())
            throw std::invalid_argument("there must be a distance for each target");
        if (targets.empty()) return;
        check(geoidx_solver_distances(get(), sources.data(), detail::count_of(sources), targets.data(),
                                      detail::count_of(targets), distances.data()));
    }

    // To every vertex of the mesh.
    void distances(std::span<const std::uint32_t> sources, std::span<double> distances) {
        check(geoidx_solver_distances(get(), sources.data(), detail::count_of(sources), nullptr,
                                      detail::count_of(distances), distances.data()));
    }

    void distances(std::span<const geoidx_surface_point> sources,
                   std::span<const geoidx_surface_point> targets, std::span<double> distances) {
        if (targets.size() != distances.size())
            throw std::invalid_argument("there must be a distance for each target");
        if (targets.empty()) return;
        check(geoidx_solver_point_distances(get(), sources.data(), detail::count_of(sources), targets.data(),
                                            detail::count_of(targets), distances.data()));
    }

    geoidx_solver* get() const noexcept { return handle_.get(); }

private:
    struct close {
        void operator()(geoidx_solver* handle) const noexcept { geoidx_solver_close(handle); }
    };
    std::unique_ptr<geoidx_solver, close> handle_;
};

}

#endif
