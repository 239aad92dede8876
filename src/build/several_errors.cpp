#include "src/build/several_errors.h"

#include <algorithm>
#include <functional>

#include "src/base/array.h"
#include "src/build/border_vertices.h"
#include "src/build/nearest_by_edges.h"
#include "src/query/query.h"

namespace geodesic {

namespace {

constexpr uint32_t GROUP_SIZES[] = {2, 16, 64};

SourceGroup anywhere(uint32_t vertex_count, uint32_t size, Random& random) {
    SourceGroup group(size);
    for (uint32_t& source : group) source = random.below(vertex_count);
    return group;
}

// Some of the vertices that are the fewest edges away from a random one.
SourceGroup around_one(const Mesh& mesh, uint32_t size, Random& random) {
    constexpr uint32_t CHOSEN_FROM = 4; // times as many
    const uint32_t middle = random.below(mesh.vertex_count());
    SourceGroup nearest = nearest_by_edges(mesh, {&middle, 1}, size_t{CHOSEN_FROM} * size);
    random.shuffle(std::span(nearest));
    nearest.resize(std::min<size_t>(nearest.size(), size));
    return nearest;
}

// Of each group, solve(solver, i) is called first; distance(solver, i, vertex) then gives its exact
// distances.
ErrorSum compare(const Compared& compared, std::span<const SourceGroup> groups, Workers& workers,
                 const std::function<void(FieldSolver&, size_t)>& solve,
                 const std::function<double(const FieldSolver&, size_t, uint32_t)>& distance) {
    std::vector<ErrorSum> errors(groups.size());
    const auto& ids_of = compared.intake.id_of_vertex;
    workers.run(groups.size(), [&](FieldSolver& solver, size_t i) {
        solve(solver, i);
        std::vector<uint32_t> ids;
        for (const uint32_t source : groups[i]) ids.push_back(ids_of[source]);
        std::vector<float> answers(compared.index.description.id_count);
        Query(compared.index, global_heap()).msad(ids, INFINITE, answers);
        for_each_comparison(
            answers, ids_of, compared.scale.too_short, [&](uint32_t v) { return distance(solver, i, v); },
            [&](double exact, double answer) { errors[i].add(relative_error(exact, answer)); });
    });
    ErrorSum all;
    for (const ErrorSum& of_group : errors) all.add(of_group);
    return all;
}

}

std::vector<SourceGroup> source_groups(const Index& index, const Intake& intake, uint32_t rounds,
                                       uint64_t seed) {
    const BorderVertices borders(index, intake);
    const uint32_t vertex_count = intake.mesh.vertex_count();
    Random random(seed);
    std::vector<SourceGroup> groups;
    for (uint32_t i = 0; i < rounds; ++i)
        for (const uint32_t size : GROUP_SIZES) {
            if (size > 2 && size > vertex_count / 4) continue;
            groups.push_back(anywhere(vertex_count, size, random));
            groups.push_back(around_one(intake.mesh, size, random));
            if (borders.are_there()) groups.push_back(borders.in_a_row(random, size));
        }
    return groups;
}

ErrorSum errors_of_groups(const Compared& compared, std::span<const SourceGroup> groups, Workers& workers) {
    return compare(
        compared, groups, workers, [&](FieldSolver& solver, size_t i) { solver.solve(groups[i], {}); },
        [](const FieldSolver& solver, size_t, uint32_t vertex) { return solver.distance(vertex); });
}

ErrorSum errors_of_known_groups(const Compared& compared, const ExactFields& exact, Workers& workers) {
    std::vector<SourceGroup> groups;
    for (const uint32_t size : GROUP_SIZES)
        if (size <= exact.sources.size())
            groups.emplace_back(exact.sources.begin(), exact.sources.begin() + size);
    return compare(
        compared, groups, workers, [](FieldSolver&, size_t) {},
        [&](const FieldSolver&, size_t i, uint32_t vertex) {
            double least = UNREACHABLE;
            for (size_t k = 0; k < groups[i].size(); ++k) least = std::min(least, exact.distances[k][vertex]);
            return least;
        });
}

}
