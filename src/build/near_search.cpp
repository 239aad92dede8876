#include "src/build/near_search.h"

#include <algorithm>
#include <limits>
#include <numeric>

#include "src/base/array.h"
#include "src/build/border_vertices.h"
#include "src/query/query.h"

namespace geodesic {

namespace {

// How far from each source, in average edges, but not much farther than so many of its nearest vertices:
// where triangles are long and narrow, far more lie within a few average edges.
constexpr double SEARCHED_EDGES = 11;
constexpr size_t MOST_SEARCHED = 1024; // vertices
constexpr size_t SOURCES_OF_TASK = 16; // which share a query

}

// One thread's answers from one source at a time.
class NearSearch::Answers {
public:
    explicit Answers(const NearSearch& search)
        : index_(search.index_), intake_(search.intake_),
          largest_radius_(SEARCHED_EDGES * search.average_edge_), too_short_(search.too_short_),
          query_(index_, global_heap()), field_(index_.description.id_count) {}

    // Answers MSAD, which may leave out what is farther than twice the largest radius.
    void set_source(uint32_t vertex) {
        source_ = vertex;
        const double reach = std::min(2 * largest_radius_, double{std::numeric_limits<float>::max()});
        fill_field(static_cast<float>(reach));
        radius_ = radius_of_field();
    }
    // Answers MSAD of that source without leaving out anything.
    void complete() { fill_field(INFINITE); }

    // How far from the source answers are compared.
    double radius() const { return radius_; }
    float msad(uint32_t vertex) const { return field_[id_of(vertex)]; }
    float sssd(uint32_t vertex) { return query_.sssd(id_of(source_), id_of(vertex)); }

    // Whether SSSD may be worse than MSAD. Of two internal vertices of one leaf, tables hold the distance
    // itself, and with the graph engine it is not worse anywhere.
    bool may_be_worse(uint32_t vertex) const {
        return index_.description.engine == GEOIDX_ENGINE_OVERLAY && is_across(vertex);
    }

    // By how much SSSD and MSAD differ at most, relative to MSAD.
    double disagreement() {
        double most = 0;
        for (uint32_t v = 0; v < intake_.mesh.vertex_count(); ++v)
            if (const double d = msad(v); d > too_short_.up_to(v) && d <= radius_ && may_be_worse(v))
                most = std::max(most, relative_error(d, sssd(v)));
        return most;
    }

private:
    void fill_field(float reach) {
        const uint32_t id = id_of(source_);
        query_.msad({&id, 1}, reach, field_);
    }
    double radius_of_field() {
        nearest_.clear();
        for (uint32_t v = 0; v < intake_.mesh.vertex_count(); ++v)
            if (const float d = msad(v); d > too_short_.up_to(v) && d <= largest_radius_)
                nearest_.push_back(d);
        if (nearest_.size() <= MOST_SEARCHED) return largest_radius_;
        const auto last = nearest_.begin() + MOST_SEARCHED - 1;
        std::ranges::nth_element(nearest_, last);
        return double{*last};
    }
    bool is_across(uint32_t vertex) const {
        const Numbering& numbering = index_.numbering();
        const uint32_t first = index_.number_of_id[id_of(source_)],
                       second = index_.number_of_id[id_of(vertex)];
        return numbering.is_border(first) || numbering.is_border(second) ||
               numbering.leaf_of(first) != numbering.leaf_of(second);
    }
    uint32_t id_of(uint32_t vertex) const { return intake_.id_of_vertex[vertex]; }

    const Index& index_;
    const Intake& intake_;
    const double largest_radius_;
    const ShortDistances& too_short_;
    Query query_;
    uint32_t source_ = NONE;
    double radius_ = 0;
    std::vector<float> field_;   // by id
    std::vector<float> nearest_; // scratch: those within the largest radius
};

// One thread's comparison of answers with the metric.
class NearSearch::Comparison {
public:
    Comparison(const NearSearch& search, FieldSolver& solver)
        : vertex_count_(search.intake_.mesh.vertex_count()), too_short_(search.too_short_), solver_(solver),
          answers_(search), errors_(search.average_edge_) {}

    void compare(Source& source) {
        answers_.set_source(source.vertex);
        find_near(source.vertex);
        // Some answer may be so wrong that it is beyond the reach.
        if (std::ranges::any_of(near_, [&](uint32_t v) { return answers_.msad(v) == INFINITE; }))
            answers_.complete();
        for (const uint32_t vertex : near_) {
            note(source, vertex, answers_.msad(vertex), true);
            if (answers_.may_be_worse(vertex)) note(source, vertex, answers_.sssd(vertex), false);
        }
    }

    const ErrorsByDistance& errors() const { return errors_; }

private:
    void find_near(uint32_t source) {
        near_.clear();
        solver_.solve({&source, 1}, {}, answers_.radius());
        for (uint32_t v = 0; v < vertex_count_; ++v)
            if (const double d = solver_.distance(v);
                d <= answers_.radius() && has_relative_error(d, too_short_.up_to(v)))
                near_.push_back(v);
    }

    void note(Source& source, uint32_t vertex, float answer, bool is_of_field) {
        const double exact = solver_.distance(vertex), error = relative_error(exact, answer);
        is_of_field ? errors_.add_to_max_of_fields(exact, error) : errors_.of(exact).add_to_max(error);
        if (error <= source.largest) return;
        source.largest = error;
        source.worst = vertex;
    }

    const uint32_t vertex_count_;
    const ShortDistances& too_short_;
    FieldSolver& solver_;
    Answers answers_;
    std::vector<uint32_t> near_; // vertices
    ErrorsByDistance errors_;
};

NearSearch::NearSearch(const Compared& compared)
    : index_(compared.index), intake_(compared.intake), average_edge_(compared.scale.average_edge),
      too_short_(compared.scale.too_short), is_source_(intake_.mesh.vertex_count(), false),
      errors_(average_edge_) {}

void NearSearch::run(const NearEffort& effort, uint64_t seed, Workers& workers) {
    Random random(seed);
    add_first_sources(effort, random, workers);
    compare_new_sources(workers);
    for (uint32_t i = 0; i < effort.climbs && climb(effort.sources_per_climb); ++i)
        compare_new_sources(workers);
}

// Different vertices, a quarter of them anywhere.
std::vector<uint32_t> NearSearch::choose_candidates(uint32_t count, Random& random) const {
    const uint32_t vertex_count = intake_.mesh.vertex_count();
    const BorderVertices borders(index_, intake_);
    std::vector<uint32_t> candidates;
    std::vector<bool> is_chosen(vertex_count, false);
    for (uint32_t i = 0; i < count; ++i) {
        const bool anywhere = i % 4 == 0 || !borders.are_there();
        const uint32_t v = anywhere ? random.below(vertex_count) : borders.on_or_next_to(random);
        if (!is_chosen[v]) candidates.push_back(v);
        is_chosen[v] = true;
    }
    return candidates;
}

// On a mesh that is not much larger, all vertices are sources. Otherwise these are a third as they come, and
// those where answers disagree most.
void NearSearch::add_first_sources(const NearEffort& effort, Random& random, Workers& workers) {
    const uint32_t vertex_count = intake_.mesh.vertex_count(), count = effort.first_sources;
    if (vertex_count <= count + effort.climbs * effort.sources_per_climb) {
        for (uint32_t v = 0; v < vertex_count; ++v) add_source(v);
        return;
    }
    const auto candidates = choose_candidates(std::max(effort.candidates, count), random);
    std::vector<size_t> order(candidates.size());
    std::iota(order.begin(), order.end(), size_t{0});
    if (effort.candidates > count) {
        const auto score = disagreements(candidates, workers);
        std::stable_sort(order.begin() + static_cast<ptrdiff_t>(std::min<size_t>(count / 3, order.size())),
                         order.end(), [&](size_t a, size_t b) { return score[a] > score[b]; });
    }
    for (const size_t i : std::span(order).first(std::min<size_t>(count, order.size())))
        add_source(candidates[i]);
}

std::vector<double> NearSearch::disagreements(std::span<const uint32_t> sources, Workers& workers) const {
    std::vector<double> result(sources.size());
    workers.run((sources.size() + SOURCES_OF_TASK - 1) / SOURCES_OF_TASK, [&](FieldSolver&, size_t task) {
        Answers answers(*this);
        const size_t begin = task * SOURCES_OF_TASK, end = std::min(begin + SOURCES_OF_TASK, sources.size());
        for (size_t i = begin; i < end; ++i) {
            answers.set_source(sources[i]);
            result[i] = answers.disagreement();
        }
    });
    return result;
}

// Errors of neighbours resemble each other, so the worst pair of all lies near bad ones. Makes new sources of
// the vertices around the worst pairs, those of the worst ones first. Returns whether there are any.
bool NearSearch::climb(uint32_t most_sources) {
    std::vector<size_t> order;
    for (size_t i = 0; i < compared_; ++i)
        if (!sources_[i].is_climbed && sources_[i].worst != NONE) order.push_back(i);
    std::ranges::sort(order, [&](size_t a, size_t b) {
        return sources_[a].largest != sources_[b].largest ? sources_[a].largest > sources_[b].largest : a < b;
    });
    const size_t most = compared_ + most_sources;
    const auto add = [&](uint32_t vertex) {
        if (sources_.size() < most) add_source(vertex);
    };
    for (const size_t i : order) {
        if (sources_.size() >= most) break;
        const uint32_t ends[] = {sources_[i].vertex, sources_[i].worst};
        sources_[i].is_climbed = true;
        add(ends[1]);
        for (const uint32_t end : ends)
            for (const uint32_t v : neighbours(intake_.mesh, end)) add(v);
    }
    return sources_.size() > compared_;
}

void NearSearch::add_source(uint32_t vertex) {
    if (is_source_[vertex]) return;
    is_source_[vertex] = true;
    sources_.push_back({vertex});
}

void NearSearch::compare_new_sources(Workers& workers) {
    const auto fresh = std::span(sources_).subspan(compared_);
    const size_t tasks = (fresh.size() + SOURCES_OF_TASK - 1) / SOURCES_OF_TASK;
    std::vector<ErrorsByDistance> errors(tasks, ErrorsByDistance(average_edge_));
    workers.run(tasks, [&](FieldSolver& solver, size_t task) {
        Comparison comparison(*this, solver);
        const size_t begin = task * SOURCES_OF_TASK;
        for (Source& source : fresh.subspan(begin, std::min(SOURCES_OF_TASK, fresh.size() - begin)))
            comparison.compare(source);
        errors[task] = comparison.errors();
    });
    for (const ErrorsByDistance& of_task : errors) errors_.add(of_task);
    compared_ = sources_.size();
}

}
