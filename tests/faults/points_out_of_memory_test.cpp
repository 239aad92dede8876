// Every allocation of a question about points of the surface, or about paths, that can fail fails in turn:
// the answer is the right one or GEOIDX_ERROR_OUT_OF_MEMORY, and the question can be asked again.

#include "tests/faults/faults.h"

using namespace geodesic::test;

namespace {

// Allocations of paths are many.
constexpr uint64_t STRIDE = 29;

// With room for every answer, since a question that is disturbed must not allocate by itself.
struct AboutPoints {
    geoidx_query* query;
    const geoidx_surface* surface;
    std::vector<geoidx_surface_point> points;
    std::vector<float> distances; // one for each vertex
    std::vector<uint32_t> ids;    // likewise
    std::vector<geoidx_path_point> path = std::vector<geoidx_path_point>(1000);
    std::vector<double> answer;

    AboutPoints(geoidx_query* query, const geoidx_surface* surface, uint32_t vertex_count,
                std::vector<geoidx_surface_point> points)
        : query(query), surface(surface), points(std::move(points)), distances(vertex_count),
          ids(vertex_count) {
        answer.reserve(2 * vertex_count + 3 * path.size());
    }

    uint32_t vertex_count() const { return static_cast<uint32_t>(ids.size()); }
    template <class Number>
    void add(std::span<const Number> numbers) {
        answer.insert(answer.end(), numbers.begin(), numbers.end());
    }
    void add_distances(size_t count) { add(std::span<const float>(distances).first(count)); }
    void add_ids(size_t count) { add(std::span<const uint32_t>(ids).first(count)); }
};

struct PointQuestion {
    const char* name;
    geoidx_status (*ask)(AboutPoints& about);
};

geoidx_status ask_for_path(AboutPoints& about, uint32_t quality) {
    double length = 0;
    auto status =
        geoidx_query_path(about.query, about.surface, &about.points[0], &about.points[2], quality, &length);
    if (status != GEOIDX_OK) return status;
    uint64_t count = 0;
    status = geoidx_query_path_points(about.query, about.path.data(), about.path.size(), &count);
    about.answer.push_back(length);
    for (size_t i = 0; i < count; ++i) about.add(std::span<const double>(about.path[i].position));
    return status;
}

const PointQuestion POINT_QUESTIONS[] = {
    {"pair",
     [](AboutPoints& about) {
         const auto status = geoidx_query_point_sssd(about.query, about.surface, &about.points[0],
                                                     &about.points[2], about.distances.data());
         about.add_distances(1);
         return status;
     }},
    {"near pair",
     [](AboutPoints& about) {
         const geoidx_surface_point beside{about.points[0].triangle + 3, 0, {0.4, 0.3, 0.3}};
         const auto status = geoidx_query_point_sssd(about.query, about.surface, &about.points[0], &beside,
                                                     about.distances.data());
         about.add_distances(1);
         return status;
     }},
    {"field",
     [](AboutPoints& about) {
         const auto status = geoidx_query_point_msad(about.query, about.surface, about.points.data(), 3,
                                                     nullptr, about.distances.data(), about.vertex_count());
         about.add_distances(about.vertex_count());
         return status;
     }},
    {"nearest sources",
     [](AboutPoints& about) {
         const auto status = geoidx_query_point_nearest_sources(
             about.query, about.surface, about.points.data(), 3, nullptr, about.ids.data(),
             about.distances.data(), about.vertex_count());
         about.add_distances(about.vertex_count());
         about.add_ids(about.vertex_count());
         return status;
     }},
    {"within a radius",
     [](AboutPoints& about) {
         uint32_t count = 0;
         const auto status =
             geoidx_query_point_within(about.query, about.surface, about.points.data(), 2, nullptr, 3,
                                       about.ids.data(), nullptr, about.vertex_count(), &count);
         about.add_ids(count);
         return status;
     }},
    {"nearest targets",
     [](AboutPoints& about) {
         uint32_t count = 0;
         const auto status = geoidx_query_point_nearest_targets(
             about.query, about.surface, &about.points[0], about.points.data(),
             static_cast<uint32_t>(about.points.size()), about.ids.data(), about.distances.data(), 2, &count);
         about.add_ids(count);
         about.add_distances(count);
         return status;
     }},
    {"straight path", [](AboutPoints& about) { return ask_for_path(about, GEOIDX_PATH_STRAIGHT); }},
    {"exact path", [](AboutPoints& about) { return ask_for_path(about, GEOIDX_PATH_EXACT); }},
    {"step",
     [](AboutPoints& about) {
         double distance = 0;
         auto status = geoidx_query_prepare_target(about.query, about.surface, &about.points[2]);
         if (status != GEOIDX_OK) return status;
         status = geoidx_query_next_step(about.query, about.surface, &about.points[0], about.path.data(),
                                         &distance);
         about.answer.push_back(distance);
         about.add(std::span<const double>(about.path[1].position));
         return status;
     }},
};

std::vector<double> answer_to(const PointQuestion& question, AboutPoints& about) {
    about.answer.clear();
    require_success(question.ask(about));
    return about.answer;
}

std::vector<geoidx_surface_point> some_points(const TestMesh& mesh) {
    const auto last = static_cast<uint32_t>(mesh.triangles.size() / 3 - 1);
    std::vector<geoidx_surface_point> points{
        {0, 0, {0.5, 0.3, 0.2}}, {last / 2, 0, {0, 1, 0}}, {last, 0, {0.25, 0.75, 0}}};
    for (uint32_t triangle = 1; triangle < last; triangle += 2)
        points.push_back({triangle, 0, {0.2, 0.2, 0.6}});
    return points;
}

SurfaceHandle surface_of(const TestMesh& mesh) {
    const geoidx_mesh view = mesh.view();
    geoidx_surface* surface = nullptr;
    require_success(geoidx_surface_create(&view, nullptr, &surface));
    return SurfaceHandle(surface);
}

}

TEST_CASE("out of memory while a query is asked about points and paths") {
    const TestMesh mesh = hills(9, 8);
    const SurfaceHandle surface = surface_of(mesh);
    for (const uint32_t engine : {GEOIDX_ENGINE_OVERLAY, GEOIDX_ENGINE_GRAPH}) {
        auto options = build_options(GEOIDX_METRIC_EXACT, 2);
        options.engine = engine;
        const Bytes file = save(build(mesh, options).get());
        for (const PointQuestion& question : POINT_QUESTIONS)
            for (const Source source : {Source::caller, Source::process}) {
                CAPTURE(engine);
                CAPTURE(question.name);
                std::vector<double> right;
                const uint64_t stride = source == Source::caller ? 1 : STRIDE;
                try_with_faults(source, stride, [&](Fault& fault) {
                    geoidx_open_options opening;
                    geoidx_open_options_init(&opening);
                    opening.allocator = fault.allocator();
                    geoidx* opened = nullptr;
                    require_success(geoidx_open_memory(file.data(), file.size(), &opening, &opened));
                    const IndexHandle index(opened);
                    const QueryHandle query = query_of(index.get());
                    AboutPoints about(query.get(), surface.get(), mesh.vertex_count(), some_points(mesh));
                    const geoidx_status status = fault.disturb([&] { return question.ask(about); });
                    if (status == GEOIDX_OK && right.empty()) right = about.answer;
                    const std::vector<double> disturbed = about.answer, again = answer_to(question, about);
                    if (status == GEOIDX_OK) CHECK(disturbed == again);
                    if (right.empty()) right = again;
                    CHECK(again == right);
                });
            }
    }
}

TEST_CASE("out of memory while a surface is made") {
    const TestMesh mesh = hills(9, 8);
    const geoidx_mesh view = mesh.view();
    const uint64_t failed = try_with_faults(Source::process, 3, [&](Fault& fault) {
        geoidx_surface* surface = nullptr;
        const geoidx_status status =
            fault.disturb([&] { return geoidx_surface_create(&view, nullptr, &surface); });
        CHECK((status == GEOIDX_OK) == (surface != nullptr));
        geoidx_surface_close(surface);
    });
    CHECK(failed > 20);
}
