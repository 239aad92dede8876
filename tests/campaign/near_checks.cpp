#include "tests/campaign/near_checks.h"

#include <algorithm>
#include <utility>

namespace geodesic::campaign {

namespace {

using Ranked = std::vector<std::pair<float, uint32_t>>; // in ascending order

Ranked ranked(const Floats& distances, float radius) {
    Ranked ranked;
    for (uint32_t i = 0; i < distances.size(); ++i)
        if (distances[i] <= radius && distances[i] < FAR) ranked.push_back({distances[i], i});
    std::ranges::sort(ranked);
    return ranked;
}

Ranked ranked(const std::vector<uint32_t>& which, const Floats& distances, uint32_t count) {
    Ranked ranked;
    for (uint32_t i = 0; i < count; ++i) ranked.push_back({distances[i], which[i]});
    return ranked;
}

void check_nearest_sources(const Subject& subject, std::span<const uint32_t> sources, const Floats& field,
                           Dice& dice) {
    const uint32_t count = subject.vertex_count();
    std::vector<uint32_t> nearest(count, 7);
    Floats distances(count, -1);
    succeed(geoidx_query_nearest_sources(subject.query(), sources.data(),
                                         static_cast<uint32_t>(sources.size()), nearest.data(),
                                         distances.data(), count),
            "geoidx_query_nearest_sources");
    expect_same("nearest_sources is msad", distances, field);
    for (uint32_t id = 0; id < count; ++id)
        expect(nearest[id] < sources.size() || (nearest[id] == GEOIDX_NO_SOURCE && !(field[id] < FAR)),
               "nearest_sources names a source where there is one", "%u: %u", id, nearest[id]);
    const auto id = static_cast<uint32_t>(dice.below(count));
    if (nearest[id] == GEOIDX_NO_SOURCE) return;
    const Floats own = subject.msad(sources[nearest[id]]);
    expect(own[id] <= subject.bounds().most_over(field[id]), "nearest_sources names the nearest source",
           "%u: %u, %.9g for %.9g", id, nearest[id], double{own[id]}, double{field[id]});
    expect(std::ranges::find(sources.first(nearest[id]), sources[nearest[id]]) ==
               sources.first(nearest[id]).end(),
           "nearest_sources names the first of repeated sources", "%u: %u", id, nearest[id]);
}

void check_within(const Subject& subject, uint32_t source, const Floats& field, float radius) {
    std::vector<uint32_t> vertices(field.size(), 7);
    Floats distances(field.size(), -1);
    uint32_t count = 0;
    succeed(geoidx_query_within(subject.query(), &source, 1, radius, vertices.data(), distances.data(),
                                static_cast<uint32_t>(field.size()), &count),
            "geoidx_query_within");
    expect(count <= field.size() && ranked(vertices, distances, count) == ranked(field, radius),
           "within is msad within", "%u, radius %.9g: %u vertices", source, double{radius}, count);
}

// By a field or by pairs.
void check_nearest_targets(const Subject& subject, uint32_t source, const Floats& field, Dice& dice) {
    std::vector<uint32_t> targets(dice.pick({1u, 4u, 50u, subject.vertex_count()}));
    Floats of_field, of_pairs;
    for (uint32_t& target : targets) {
        target = dice.below(subject.vertex_count());
        of_field.push_back(field[target]);
        of_pairs.push_back(subject.sssd(source, target));
    }
    const uint32_t wanted = dice.pick({1u, 3u, static_cast<uint32_t>(targets.size())});
    std::vector<uint32_t> positions(wanted, 7);
    Floats distances(wanted, -1);
    uint32_t count = 0;
    succeed(geoidx_query_nearest_targets(subject.query(), source, targets.data(),
                                         static_cast<uint32_t>(targets.size()), positions.data(),
                                         distances.data(), wanted, &count),
            "geoidx_query_nearest_targets");
    const auto is_first_of = [&](Ranked all) {
        all.resize(std::min<size_t>(all.size(), wanted));
        return count <= wanted && ranked(positions, distances, count) == all;
    };
    expect(is_first_of(ranked(of_field, static_cast<float>(FAR))) ||
               is_first_of(ranked(of_pairs, static_cast<float>(FAR))),
           "nearest_targets is msad or sssd", "%u, %zu targets, %u of %u", source, targets.size(), count,
           wanted);
}

void check_matrix(const Subject& subject, std::span<const uint32_t> sources, Dice& dice) {
    const auto rows = sources.first(std::min<size_t>(sources.size(), 12));
    std::vector<uint32_t> targets(dice.pick({1u, 5u, 30u}));
    std::vector<Floats> from, to;
    for (uint32_t& target : targets) {
        target = dice.below(subject.vertex_count());
        to.push_back(subject.msad(target));
    }
    for (const uint32_t source : rows) from.push_back(subject.msad(source));
    Floats entries(rows.size() * targets.size(), -1);
    succeed(geoidx_query_matrix(subject.query(), rows.data(), static_cast<uint32_t>(rows.size()),
                                targets.data(), static_cast<uint32_t>(targets.size()), entries.data(),
                                entries.size()),
            "geoidx_query_matrix");
    for (size_t i = 0; i < rows.size(); ++i)
        for (size_t j = 0; j < targets.size(); ++j) {
            const float entry = entries[i * targets.size() + j];
            expect(same_bits(entry, from[i][targets[j]]) || same_bits(entry, to[j][rows[i]]) ||
                       same_bits(entry, subject.sssd(rows[i], targets[j])),
                   "matrix is msad or sssd", "%u to %u: %.9g", rows[i], targets[j], double{entry});
        }
}

// Each point is as far as the farthest vertex, from the sources and the points before it, but for what fields
// may be off; those that cannot be reached come first.
void check_farthest(const Subject& subject, std::span<const uint32_t> sources, Dice& dice) {
    const uint32_t wanted = dice.pick({1u, 3u, 12u});
    std::vector<uint32_t> points(wanted, 7);
    Floats distances(wanted, -1);
    uint32_t count = 0;
    succeed(geoidx_query_farthest_points(subject.query(), sources.data(),
                                         static_cast<uint32_t>(sources.size()), wanted, points.data(),
                                         distances.data(), &count),
            "geoidx_query_farthest_points");
    const Surface& surface = subject.input().surface();
    const Bounds& bounds = subject.bounds();
    std::vector<uint32_t> so_far(sources.begin(), sources.end());
    const auto farthest = [&](const Floats& field) {
        float most = 0;
        for (uint32_t id = 0; id < field.size(); ++id)
            if (surface.is_used(id)) most = std::max(most, field[id]);
        return most;
    };
    expect(count <= wanted, "farthest points", "%u of %u", count, wanted);
    double before = FAR;
    for (uint32_t i = 0; i < count; ++i) {
        const Floats field = subject.msad(so_far);
        expect(points[i] < field.size() && surface.is_used(points[i]), "farthest point is of a triangle",
               "%u", points[i]);
        const double told{distances[i]}, own{field[points[i]]};
        expect(told > 0 && (told < FAR) == (own < FAR) &&
                   (own == FAR || (told <= bounds.most_over(own) && own <= bounds.most_over(told))),
               "farthest point is as far as msad says", "%u: %.9g, %.9g", points[i], told, own);
        expect(double{farthest(field)} <= bounds.most_over(told), "farthest point is the farthest",
               "%u: %.9g, %.9g", points[i], told, double{farthest(field)});
        expect(told <= bounds.most_over(before), "farthest points come nearer", "%u: %.9g, %.9g", points[i],
               told, before);
        before = told;
        so_far.push_back(points[i]);
    }
    if (count < wanted)
        expect(double{farthest(subject.msad(so_far))} <= bounds.most_over(0), "all farthest points are found",
               "%u of %u, %.9g left", count, wanted, double{farthest(subject.msad(so_far))});
}

}

void check_near(const Subject& subject, std::span<const uint32_t> sources, const Floats& field, Dice& dice) {
    check_nearest_sources(subject, sources, field, dice);
    const uint32_t source = sources[dice.below(sources.size())];
    const Floats own = subject.msad(source);
    for (const float radius : {own[dice.below(own.size())], 0.0f, own[dice.below(own.size())]})
        check_within(subject, source, own, radius);
    check_nearest_targets(subject, source, own, dice);
    check_matrix(subject, sources, dice);
    check_farthest(subject, sources, dice);
}

}
