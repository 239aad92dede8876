#include "src/build/steep_search.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <limits>
#include <tuple>
#include <utility>

#include "src/base/array.h"
#include "src/base/rounded.h"
#include "src/build/number_of_vertex.h"
#include "src/overlay/query.h"

namespace geodesic {

namespace {

constexpr uint64_t MOST_DISTANCES = uint64_t{1} << 32;                 // in all fields that are looked at
constexpr size_t FEWEST_BATCHES_OF_TASK = 4, MOST_TASKS_OF_LOOK = 256; // batches of a task share a query

// All edges of the mesh by the numbers of their ends, in ascending order, each with its limit. Those of no
// length, or too short for a float, have none and are left out.
std::vector<VertexPair> edges_by_number(const Intake& intake, const Index& index) {
    constexpr double MOST = std::numeric_limits<float>::max() / 2;
    std::vector<VertexPair> edges;
    for (const auto& [a, b] : intake.mesh.edges) {
        const double length = (intake.mesh.positions[a] - intake.mesh.positions[b]).norm();
        const auto [first, second] =
            std::minmax({number_of_vertex(index, intake, a), number_of_vertex(index, intake, b)});
        if (const float limit = rounded(static_cast<float>(std::min(STEEPEST * length, MOST)));
            first != second && limit > 0)
            edges.push_back({first, second, limit});
    }
    std::ranges::sort(edges, {}, [](const VertexPair& edge) { return std::tuple(edge.first, edge.second); });
    return edges;
}

class SteepSearch {
public:
    SteepSearch(const Intake& intake, Workers& workers, double end_fraction, OverlayIndex& index,
                std::vector<VertexPair> edges)
        : intake_(intake), workers_(workers), end_fraction_(end_fraction), index_(index),
          edges_(std::move(edges)), is_found_(edges_.size()) {}

    void run(const Index& index) {
        const std::vector<uint32_t> sources = look_from(choose_sources(index));
        while (hold_found()) look_from(sources);
    }

private:
    // Evenly spread by the numbers of the mesh, which are in a spatial order.
    std::vector<uint32_t> choose_sources(const Index& index) const {
        const uint64_t vertices = intake_.mesh.vertex_count(),
                       count = std::min(vertices, MOST_DISTANCES / vertices);
        std::vector<uint32_t> sources;
        for (uint64_t i = 0; i < count; ++i)
            sources.push_back(number_of_vertex(index, intake_, static_cast<uint32_t>(i * vertices / count)));
        return sources;
    }

    // Notes the edges along which fields from these sources are steep. Returns the sources that have any.
    std::vector<uint32_t> look_from(const std::vector<uint32_t>& sources) {
        const size_t batches = (sources.size() + FIELDS_AT_ONCE - 1) / FIELDS_AT_ONCE,
                     of_task = std::max(FEWEST_BATCHES_OF_TASK, batches / MOST_TASKS_OF_LOOK + 1);
        std::vector<uint8_t> has_steep_edges(batches * FIELDS_AT_ONCE, 0);
        workers_.begin_half_of_stage("accuracy", end_fraction_);
        workers_.run((batches + of_task - 1) / of_task, [&](FieldSolver&, size_t task) {
            OverlayQuery query(index_, global_heap());
            std::vector<float> fields(FIELDS_AT_ONCE * index_.numbering.vertex_count());
            for (size_t b = task * of_task; b < std::min((task + 1) * of_task, batches); ++b) {
                workers_.check_cancelled();
                std::array<uint32_t, FIELDS_AT_ONCE> batch; // the last source is repeated
                for (size_t i = 0; i < FIELDS_AT_ONCE; ++i)
                    batch[i] = sources[std::min(b * FIELDS_AT_ONCE + i, sources.size() - 1)];
                query.ssad_each(batch, fields);
                note_steep_edges(fields, has_steep_edges.data() + b * FIELDS_AT_ONCE);
            }
        });
        std::vector<uint32_t> with_steep_edges;
        for (size_t i = 0; i < sources.size(); ++i)
            if (has_steep_edges[i]) with_steep_edges.push_back(sources[i]);
        return with_steep_edges;
    }

    void note_steep_edges(const std::vector<float>& fields, uint8_t* has_steep_edges) {
        for (size_t e = 0; e < edges_.size(); ++e) {
            const auto& [first, second, limit] = edges_[e];
            const float *a = fields.data() + first * FIELDS_AT_ONCE,
                        *b = fields.data() + second * FIELDS_AT_ONCE;
            if (!FieldLowering::is_steep(a, b, limit)) continue;
            is_found_[e].store(true, std::memory_order_relaxed);
            for (size_t i = 0; i < FIELDS_AT_ONCE; ++i)
                if (a[i] + limit < b[i] || b[i] + limit < a[i]) has_steep_edges[i] = 1;
        }
    }

    // Returns whether any edge is new.
    bool hold_found() {
        std::vector<VertexPair> found;
        for (size_t e = 0; e < edges_.size(); ++e)
            if (is_found_[e]) found.push_back(edges_[e]);
        if (found.size() == index_.steep.edges.size()) return false;
        take_steep_edges(found, index_.numbering.vertex_count(), index_.steep);
        return true;
    }

    const Intake& intake_;
    Workers& workers_;
    const double end_fraction_;
    OverlayIndex& index_;
    const std::vector<VertexPair> edges_;
    std::vector<std::atomic<bool>> is_found_; // per edge
};

}

void hold_steep_edges(const Intake& intake, Workers& workers, Index& index, double end_fraction) {
    SteepSearch(intake, workers, end_fraction, std::get<OverlayIndex>(index.engine),
                edges_by_number(intake, index))
        .run(index);
}

}
