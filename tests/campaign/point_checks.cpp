#include "tests/campaign/point_checks.h"

#include <algorithm>
#include <cmath>

namespace geodesic::campaign {

namespace {

constexpr size_t POINTS = 5;

class PointChecks {
public:
    PointChecks(const Subject& subject, const SurfacePoints& on, geoidx_solver* solver, Dice& dice)
        : subject_(subject), input_(subject.input()), solver_(solver), on_(on), dice_(dice) {
        for (size_t i = 0; i < POINTS; ++i) points_.push_back(on_.random_point(dice, dice.chance(0.2)));
    }

    void check() {
        for (const auto& point : points_) fields_.push_back(msad(std::span(&point, 1)));
        for (size_t i = 0; i < POINTS; ++i) {
            check_field(points_[i], fields_[i]);
            for (size_t j = 0; j <= i; ++j) check_pair(points_[i], points_[j]);
        }
        check_within();
        check_several();
        check_nearest_targets();
    }

private:
    const geoidx_surface* surface() const { return on_.surface(); }

    Floats msad(std::span<const geoidx_surface_point> sources, const float* offsets = nullptr) const {
        Floats distances(subject_.vertex_count(), -1);
        succeed(geoidx_query_point_msad(subject_.query(), surface(), sources.data(),
                                        static_cast<uint32_t>(sources.size()), offsets, distances.data(),
                                        subject_.vertex_count()),
                "geoidx_query_point_msad");
        return distances;
    }

    float sssd(const geoidx_surface_point& a, const geoidx_surface_point& b) const {
        float distance = -1;
        succeed(geoidx_query_point_sssd(subject_.query(), surface(), &a, &b, &distance),
                "geoidx_query_point_sssd");
        return distance;
    }

    // The metric between two points; by edges that is the shortest way along them.
    double metric(const geoidx_surface_point& a, const geoidx_surface_point& b) const {
        if (input_.options().metric == GEOIDX_METRIC_EDGES) return on_.along_edges(a, b);
        double distance = -1;
        succeed(geoidx_solver_point_distances(solver_, &a, 1, &b, 1, &distance),
                "geoidx_solver_point_distances");
        return distance;
    }

    void check_answer_of(const char* query, float answer, double along, const Bounds::Range& range,
                         const std::string& at) const {
        const auto require = [&](bool holds, const char* what) {
            if (!holds)
                throw Finding(std::string(query) + ' ' + what,
                              formatted("%.9g, of %.9g to %.9g ", double{answer}, range.least, range.most) +
                                  at);
        };
        require(!std::isnan(answer), "is NaN");
        require(answer >= 0, "is negative");
        require((double{answer} < FAR) == (along < FAR), along < FAR ? "does not reach" : "reaches");
        if (along == FAR) return;
        require(answer >= range.least, "is too short");
        require(answer <= range.most, "is too long");
    }

    // `range` is a function of Bounds.
    template <class RangeOf>
    void check_pair_answer(const char* query, float answer, const geoidx_surface_point& a,
                           const geoidx_surface_point& b, const RangeOf& range) const {
        const double along = on_.along_edges(a, b), exact = along < FAR ? metric(a, b) : FAR;
        check_answer_of(query, answer, along, (subject_.bounds().*range)(exact, along),
                        described(a) + " to " + described(b));
    }

    void check_pair(const geoidx_surface_point& a, const geoidx_surface_point& b) const {
        const float there = sssd(a, b), back = sssd(b, a);
        const std::string at = described(a) + " to " + described(b);
        expect(same_bits(there, back), "point_sssd is symmetric", "%.9g, %.9g %s", double{there},
               double{back}, at.c_str());
        if (&a == &b) return expect(there == 0, "point_sssd is 0", "%.9g %s", double{there}, at.c_str());
        check_pair_answer("point_sssd", there, a, b, &Bounds::of_point_pair);
        const uint32_t from = on_.vertex_of(a), to = on_.vertex_of(b);
        if (from != GEOIDX_NO_SOURCE && to != GEOIDX_NO_SOURCE)
            expect(same_bits(there, subject_.sssd(from, to)), "point_sssd of vertices is sssd", "%s",
                   at.c_str());
    }

    void check_field(const geoidx_surface_point& source, const Floats& field) const {
        const auto along = on_.along_edges(source);
        std::vector<double> exact = along;
        if (input_.options().metric == GEOIDX_METRIC_EXACT) {
            std::vector<uint32_t> used;
            std::vector<geoidx_surface_point> targets;
            for (uint32_t id = 0; id < field.size(); ++id) {
                if (!input_.surface().is_used(id)) continue;
                used.push_back(id);
                succeed(geoidx_vertex_point(surface(), id, &targets.emplace_back()), "geoidx_vertex_point");
            }
            std::vector<double> found(used.size());
            succeed(geoidx_solver_point_distances(solver_, &source, 1, targets.data(),
                                                  static_cast<uint32_t>(targets.size()), found.data()),
                    "geoidx_solver_point_distances");
            for (size_t i = 0; i < used.size(); ++i) exact[used[i]] = found[i];
        }
        for (uint32_t id = 0; id < field.size(); ++id)
            check_answer_of("point_msad", field[id], along[id],
                            subject_.bounds().of_point_field(exact[id], along[id]),
                            described(source) + formatted(" to %u", id));
        const uint32_t vertex = on_.vertex_of(source);
        if (vertex != GEOIDX_NO_SOURCE)
            expect_same("point_msad of a vertex is msad", field, subject_.msad(vertex));
    }

    void check_within() const {
        const size_t i = dice_.below(POINTS);
        const Floats& field = fields_[i];
        const float radius = field[dice_.below(field.size())];
        std::vector<uint32_t> vertices(field.size(), 7);
        Floats distances(field.size(), -1);
        uint32_t count = 0;
        succeed(geoidx_query_point_within(subject_.query(), surface(), &points_[i], 1, nullptr, radius,
                                          vertices.data(), distances.data(), subject_.vertex_count(), &count),
                "geoidx_query_point_within");
        const auto is_within = [&](float d) { return d <= radius && d < static_cast<float>(FAR); };
        expect(count == std::ranges::count_if(field, is_within), "point_within is point_msad",
               "%u within %.9g", count, double{radius});
        for (uint32_t k = 0; k < count; ++k) {
            expect(vertices[k] < field.size(), "point_within names vertices", "%u", vertices[k]);
            expect(same_bits(distances[k], field[vertices[k]]) &&
                       (k == 0 || distances[k - 1] <= distances[k]),
                   "point_within distances", "%u: %.9g", vertices[k], double{distances[k]});
        }
    }

    // With offsets, of which the least is 0 or not.
    void check_several() const {
        Floats offsets;
        for (size_t i = 0; i < POINTS; ++i) {
            const float d = fields_[i][dice_.below(fields_[i].size())];
            offsets.push_back(dice_.chance(0.3) || !(d < static_cast<float>(FAR)) ? 0 : 0.5f * d);
        }
        const bool has_offsets = dice_.chance(0.7);
        const Floats field = msad(points_, has_offsets ? offsets.data() : nullptr);
        std::vector<uint32_t> nearest(field.size(), 7);
        Floats distances(field.size(), -1);
        succeed(geoidx_query_point_nearest_sources(subject_.query(), surface(), points_.data(),
                                                   static_cast<uint32_t>(POINTS),
                                                   has_offsets ? offsets.data() : nullptr, nearest.data(),
                                                   distances.data(), subject_.vertex_count()),
                "geoidx_query_point_nearest_sources");
        expect_same("point_nearest_sources is point_msad", distances, field);
        for (uint32_t id = 0; id < field.size(); ++id)
            check_vertex(id, field[id], nearest[id], has_offsets, offsets);
    }

    void check_vertex(uint32_t id, float answer, uint32_t nearest, bool has_offsets,
                      const Floats& offsets) const {
        double least = FAR;
        for (size_t i = 0; i < POINTS; ++i)
            least = std::min(least, double{fields_[i][id]} + (has_offsets ? double{offsets[i]} : 0));
        expect((answer < static_cast<float>(FAR)) == (least < FAR), "point_msad of several reaches",
               "%u: %.9g, %.9g", id, double{answer}, least);
        expect((nearest < POINTS) == (least < FAR) && (nearest < POINTS || nearest == GEOIDX_NO_SOURCE),
               "point_nearest_sources names a source where there is one", "%u: %u", id, nearest);
        if (least == FAR) return;
        const Bounds& bounds = subject_.bounds();
        expect(answer <= bounds.most_over(least) && least <= bounds.most_over(double{answer}),
               "point_msad of several is the least of each", "%u: %.9g, %.9g", id, double{answer}, least);
        const double own = double{fields_[nearest][id]} + (has_offsets ? double{offsets[nearest]} : 0);
        expect(own <= bounds.most_over(double{answer}), "point_nearest_sources names the nearest",
               "%u: %.9g, %.9g", id, own, double{answer});
    }

    void check_nearest_targets() const {
        const auto& source = points_.front();
        std::vector<geoidx_surface_point> targets(dice_.pick({1u, 3u, 40u}));
        for (auto& target : targets) target = on_.random_point(dice_, dice_.chance(0.2));
        const auto count = static_cast<uint32_t>(targets.size());
        std::vector<uint32_t> positions(count, 7);
        Floats distances(count, -1);
        uint32_t found = 0;
        succeed(geoidx_query_point_nearest_targets(subject_.query(), surface(), &source, targets.data(),
                                                   count, positions.data(), distances.data(), count, &found),
                "geoidx_query_point_nearest_targets");
        const auto is_reached = [&](const auto& target) { return on_.are_joined(source, target); };
        expect(found == std::ranges::count_if(targets, is_reached), "point_nearest_targets reaches",
               "%u of %u", found, count);
        for (uint32_t k = 0; k < found; ++k) {
            expect(positions[k] < count && (k == 0 || distances[k - 1] <= distances[k]),
                   "point_nearest_targets in order", "%u: %.9g", positions[k], double{distances[k]});
            check_pair_answer("point_nearest_targets", distances[k], source, targets[positions[k]],
                              &Bounds::of_point_field);
        }
    }

    const Subject& subject_;
    const BuildInput& input_;
    geoidx_solver* solver_;
    const SurfacePoints& on_;
    Dice& dice_;
    std::vector<geoidx_surface_point> points_;
    std::vector<Floats> fields_; // of each point
};

}

void check_points(const Subject& subject, const SurfacePoints& points, geoidx_solver* solver, Dice& dice) {
    const geoidx_build_options& options = subject.input().options();
    const bool is_served = (options.metric == GEOIDX_METRIC_EXACT && !options.edge_lengths) ||
                           (options.metric == GEOIDX_METRIC_EDGES && !options.edge_costs);
    if (is_served) PointChecks(subject, points, solver, dice).check();
}

}
