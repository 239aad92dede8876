#include "src/build/two_way_search.h"

#include <algorithm>
#include <numeric>
#include <tuple>

#include "src/base/array.h"
#include "src/build/nearest_by_edges.h"
#include "src/build/number_of_vertex.h"

namespace geodesic {

namespace {

constexpr size_t FIELDS_OF_TASK = 8 * FIELDS_AT_ONCE, PAIRS_OF_TASK = 4096; // which share a query
constexpr double LOOKED_BEYOND = 1.05; // how far a source looks beyond the pair that it was chosen for
constexpr size_t WORST = 16;           // pairs around which the search goes on
constexpr size_t FAR = DISTANCE_CLASSES - 1;
constexpr uint32_t FEWER_FAR = 4; // times, since the metric takes longest and errors are smallest
constexpr uint32_t CLIMBS = 10,
                   PAIRS_AROUND = 4; // of SSSD: how often it goes on, with how many pairs of each

size_t task_count(size_t count, size_t of_task) { return (count + of_task - 1) / of_task; }

}

TwoWaySearch::TwoWaySearch(const Compared& compared)
    : index_(compared.index), intake_(compared.intake), average_edge_(compared.scale.average_edge),
      too_short_(compared.scale.too_short), errors_(average_edge_) {}

void TwoWaySearch::run(const TwoWayEffort& effort, uint64_t seed, Workers& workers) {
    Random random(seed);
    look_between(random_vertices(effort.vertices, random), effort.sources, effort.pairs, random, workers);
    if (effort.vertices < intake_.mesh.vertex_count())
        look_between(vertices_around_worst(effort.around_worst), effort.sources, effort.pairs / 4, random,
                     workers);
}

// Returns `count` different vertices, or all of them.
std::vector<uint32_t> TwoWaySearch::random_vertices(uint32_t count, Random& random) const {
    std::vector<uint32_t> vertices(intake_.mesh.vertex_count());
    std::iota(vertices.begin(), vertices.end(), 0u);
    if (count >= vertices.size()) return vertices;
    random.shuffle(std::span(vertices));
    vertices.resize(count);
    return vertices;
}

// Those that are the fewest edges away from both ends of the worst pairs.
std::vector<uint32_t> TwoWaySearch::vertices_around_worst(uint32_t count) const {
    auto worst = worst_;
    std::ranges::stable_sort(worst, std::ranges::greater{}, &WorstPair::error);
    worst.resize(std::min(worst.size(), WORST));
    std::vector<uint32_t> ends;
    for (const WorstPair& pair : worst) ends.insert(ends.end(), {pair.source, pair.target});
    return nearest_by_edges(intake_.mesh, ends, count);
}

void TwoWaySearch::look_between(std::vector<uint32_t> vertices, uint32_t sources_of_class, uint32_t pairs,
                                Random& random, Workers& workers) {
    if (vertices.empty()) return;
    vertices_ = std::move(vertices);
    fill_answers(workers);
    std::vector<Source> sources(vertices_.size());
    for (uint32_t place = 0; place < sources.size(); ++place) sources[place].place = place;
    choose_sources(differences_of_directions(workers), sources_of_class, sources);
    choose_sources(differences_of_pairs(pairs, random, workers), sources_of_class, sources);
    std::erase_if(sources, [](const Source& source) { return source.radius == 0; });
    compare(std::move(sources), workers);
}

void TwoWaySearch::fill_answers(Workers& workers) {
    const size_t count = vertices_.size();
    answers_.resize(count * count);
    std::vector<uint32_t> numbers;
    for (const uint32_t vertex : vertices_) numbers.push_back(number_of_vertex(index_, intake_, vertex));
    const auto& overlay = std::get<OverlayIndex>(index_.engine);
    workers.run(task_count(count, FIELDS_OF_TASK), [&](FieldSolver&, size_t task) {
        OverlayQuery query(overlay, global_heap());
        std::vector<float> fields(FIELDS_AT_ONCE * overlay.numbering.vertex_count());
        const size_t end = std::min((task + 1) * FIELDS_OF_TASK, count);
        for (size_t first = task * FIELDS_OF_TASK; first < end; first += FIELDS_AT_ONCE) {
            workers.check_cancelled();
            std::array<uint32_t, FIELDS_AT_ONCE> batch; // the last one is repeated
            for (size_t i = 0; i < FIELDS_AT_ONCE; ++i) batch[i] = numbers[std::min(first + i, end - 1)];
            query.ssad_each(batch, fields);
            const size_t fields_end = std::min(first + FIELDS_AT_ONCE, end);
            for (size_t to = 0; to < count; ++to)
                for (size_t from = first; from < fields_end; ++from)
                    answers_[from * count + to] = fields[numbers[to] * FIELDS_AT_ONCE + from - first];
        }
    });
}

std::vector<TwoWaySearch::Differences> TwoWaySearch::differences_of_directions(Workers& workers) const {
    std::vector<Differences> largest(vertices_.size());
    workers.run(task_count(largest.size(), FIELDS_AT_ONCE), [&](FieldSolver&, size_t task) {
        find_largest(task * FIELDS_AT_ONCE, std::min((task + 1) * FIELDS_AT_ONCE, largest.size()), largest);
    });
    return largest;
}

// Those of several vertices together, since their answers lie side by side.
void TwoWaySearch::find_largest(size_t first, size_t end, std::span<Differences> largest) const {
    for (uint32_t other = 0; other < vertices_.size(); ++other) {
        const auto too_short = static_cast<float>(too_short_.up_to(vertices_[other]));
        for (size_t place = first; place < end; ++place) {
            const auto [less, more] = std::minmax({answer(place, other), answer(other, place)});
            Difference& found = largest[place][class_of(less)];
            if (!(more > less * (1 + found.share)) || less <= too_short || more == INFINITE) continue;
            found = {more / less - 1, less, other};
        }
    }
}

// Of random pairs and of those that they lead to: where SSSD loses a way, it often does so around both ends,
// too.
std::vector<TwoWaySearch::Differences> TwoWaySearch::differences_of_pairs(uint32_t count, Random& random,
                                                                          Workers& workers) const {
    std::vector<Pair> pairs(count);
    const auto end = static_cast<uint32_t>(vertices_.size());
    for (Pair& pair : pairs) {
        pair.place = random.below(end);
        pair.difference.other = random.below(end);
    }
    measure(pairs, workers);
    const size_t kept = std::clamp<size_t>(count / 512, 8, 64);
    keep_worst(pairs, kept);
    const std::vector<uint32_t> places = places_of_vertices();
    for (uint32_t i = 0; i < CLIMBS && !pairs.empty(); ++i) {
        std::vector<Pair> fresh = pairs_around(pairs, places, random);
        measure(fresh, workers);
        pairs.insert(pairs.end(), fresh.begin(), fresh.end());
        keep_worst(pairs, kept);
    }
    std::vector<Differences> largest(vertices_.size());
    for (const auto& [place, difference] : pairs)
        if (Difference& found = largest[place][class_of(difference.distance)]; difference.share > found.share)
            found = difference;
    return largest;
}

void TwoWaySearch::measure(std::span<Pair> pairs, Workers& workers) const {
    workers.run(task_count(pairs.size(), PAIRS_OF_TASK), [&](FieldSolver&, size_t task) {
        Query query(index_, global_heap());
        const size_t first = task * PAIRS_OF_TASK;
        for (Pair& pair : pairs.subspan(first, std::min(PAIRS_OF_TASK, pairs.size() - first)))
            measure(query, pair);
    });
}

// Compares SSSD with both directions of MSAD, and notes by how much it lies outside of these.
void TwoWaySearch::measure(Query& query, Pair& pair) const {
    Difference& difference = pair.difference;
    const auto [less, more] =
        std::minmax({answer(pair.place, difference.other), answer(difference.other, pair.place)});
    if (!has_relative_error(less, too_short_.up_to(vertices_[pair.place])) || more == INFINITE) return;
    const float answered = query.sssd(id_of(pair.place), id_of(difference.other));
    difference.distance = less;
    difference.share = std::max(answered / more, less / answered) - 1;
}

// Keeps the `of_class` worst pairs of each class of distances, each once.
void TwoWaySearch::keep_worst(std::vector<Pair>& pairs, size_t of_class) const {
    std::ranges::sort(pairs, [](const Pair& a, const Pair& b) {
        return std::tuple(-a.difference.share, a.place, a.difference.other) <
               std::tuple(-b.difference.share, b.place, b.difference.other);
    });
    const auto is_same = [](const Pair& a, const Pair& b) {
        return a.place == b.place && a.difference.other == b.difference.other;
    };
    pairs.erase(std::unique(pairs.begin(), pairs.end(), is_same), pairs.end());
    std::array<size_t, DISTANCE_CLASSES> left;
    left.fill(of_class);
    std::erase_if(pairs, [&](const Pair& pair) {
        size_t& of_this = left[class_of(pair.difference.distance)];
        if (!(pair.difference.share > 0) || of_this == 0) return true;
        --of_this;
        return false;
    });
}

// Of each pair, some whose ends are its own or their neighbours.
std::vector<TwoWaySearch::Pair> TwoWaySearch::pairs_around(std::span<const Pair> pairs,
                                                           std::span<const uint32_t> places,
                                                           Random& random) const {
    const auto neighbour = [&](uint32_t place) {
        const auto around = neighbours(intake_.mesh, vertices_[place]);
        const uint32_t i = random.below(static_cast<uint32_t>(around.size()) + 1);
        return i < around.size() ? places[around[i]] : place;
    };
    std::vector<Pair> found;
    for (const Pair& pair : pairs)
        for (uint32_t i = 0; i < PAIRS_AROUND; ++i) {
            const uint32_t place = neighbour(pair.place), other = neighbour(pair.difference.other);
            if (place != NONE && other != NONE) found.push_back({place, {0, 0, other}});
        }
    return found;
}

// NONE of those that are not among the vertices.
std::vector<uint32_t> TwoWaySearch::places_of_vertices() const {
    std::vector<uint32_t> places(intake_.mesh.vertex_count(), NONE);
    for (uint32_t place = 0; place < vertices_.size(); ++place) places[vertices_[place]] = place;
    return places;
}

// Of each class, those with the largest differences, but only one of the two vertices between which it is.
void TwoWaySearch::choose_sources(std::span<const Differences> largest, uint32_t of_class,
                                  std::vector<Source>& sources) const {
    std::vector<uint32_t> order(sources.size());
    for (size_t c = 0; c < DISTANCE_CLASSES; ++c) {
        std::iota(order.begin(), order.end(), 0u);
        std::ranges::stable_sort(order, std::ranges::greater{},
                                 [&](uint32_t place) { return largest[place][c].share; });
        uint32_t left = c == FAR ? of_class / FEWER_FAR : of_class;
        for (const uint32_t place : order) {
            const Difference& difference = largest[place][c];
            if (left == 0 || !(difference.share > 0)) break;
            const double wanted = LOOKED_BEYOND * double{difference.distance};
            if (sources[place].radius < wanted && sources[difference.other].radius < wanted) {
                sources[place].radius = wanted;
                --left;
            }
            const bool is_here = sources[place].radius >= wanted;
            sources[is_here ? place : difference.other].of_pairs.push_back(is_here ? difference.other
                                                                                   : place);
        }
    }
}

void TwoWaySearch::compare(std::vector<Source> sources, Workers& workers) {
    std::vector<ErrorsByDistance> errors(sources.size(), ErrorsByDistance(average_edge_));
    std::vector<WorstPair> worst(sources.size());
    workers.run(sources.size(), [&](FieldSolver& solver, size_t i) {
        solver.solve({&vertices_[sources[i].place], 1}, {}, sources[i].radius);
        worst[i] = compare_fields(sources[i], solver, errors[i]);
        compare_pairs(sources[i], solver, errors[i], worst[i]);
    });
    for (const ErrorsByDistance& of_source : errors) errors_.add(of_source);
    worst_.insert(worst_.end(), worst.begin(), worst.end());
}

// Both directions.
TwoWaySearch::WorstPair TwoWaySearch::compare_fields(const Source& source, const FieldSolver& exact,
                                                     ErrorsByDistance& errors) const {
    WorstPair worst{0, vertices_[source.place], vertices_[source.place]};
    for (uint32_t other = 0; other < vertices_.size(); ++other) {
        const double distance = exact.distance(vertices_[other]);
        if (distance > source.radius || !has_relative_error(distance, too_short_.up_to(vertices_[other])))
            continue;
        for (const float answered : {answer(source.place, other), answer(other, source.place)}) {
            const double error = relative_error(distance, answered);
            errors.add_to_max_of_fields(distance, error);
            if (error > worst.error) worst = {error, worst.source, vertices_[other]};
        }
    }
    return worst;
}

void TwoWaySearch::compare_pairs(const Source& source, const FieldSolver& exact, ErrorsByDistance& errors,
                                 WorstPair& worst) const {
    Query query(index_, global_heap());
    for (const uint32_t other : source.of_pairs) {
        const double distance = exact.distance(vertices_[other]);
        if (distance > source.radius || !has_relative_error(distance, too_short_.up_to(vertices_[other])))
            continue;
        const float answered = query.sssd(id_of(source.place), id_of(other));
        const double error = relative_error(distance, answered);
        errors.of(distance).add_to_max(error);
        if (error > worst.error) worst = {error, worst.source, vertices_[other]};
    }
}

}
