#include "src/build/wrong_pairs.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <tuple>
#include <utility>

#include "src/build/errors_by_distance.h"
#include "src/build/near_comparison.h"
#include "src/build/number_of_vertex.h"

namespace geodesic {

namespace {

// Pairs with no larger error than this are not held. If more than so many for each vertex, on average, have a
// larger one, and they are not few in all, what is let pass is raised by this factor.
constexpr double LARGEST_ERROR = 0.01;
constexpr size_t MOST_PAIRS = 4, FEW_IN_ALL = 32768;
constexpr double RAISE = 1.5;
// Wrong pairs are seldom alone. So what is known around their ends, and around the neighbours of these, must
// reach so many times as far as they are long. Looking farther may find at most so many times the vertices of
// the first look.
constexpr double REACH = 1.06;
constexpr uint64_t WORK = 2;
constexpr double FIRST_LOOK_END = 0.2; // the share of the progress; looking farther is the rest
constexpr uint32_t MOST_PASSES = 4;
constexpr size_t FEWEST_AT_ONCE = 64, MOST_TASKS = 256; // sources of a task share a query

// Keeps each pair once, with the larger error of its two directions.
void keep_different(std::vector<WrongPair>& wrong) {
    std::ranges::sort(wrong, {}, [](const WrongPair& w) {
        return std::tuple(w.pair.first, w.pair.second, -w.error, w.pair.distance);
    });
    const auto is_same = [](const WrongPair& a, const WrongPair& b) {
        return a.pair.first == b.pair.first && a.pair.second == b.pair.second;
    };
    wrong.erase(std::unique(wrong.begin(), wrong.end(), is_same), wrong.end());
}

class Search {
public:
    Search(const Intake& intake, const DistanceScale& scale, NearDistances& near, Workers& workers,
           Index& index, double end_fraction)
        : intake_(intake), scale_(scale), near_(near), workers_(workers), end_fraction_(end_fraction),
          index_(index), edge_ends_(edge_ends_at_vertices(intake.mesh)),
          vertex_of_number_(index.numbering().vertex_count(), NONE), let_pass_(scale.average_edge) {
        for (uint32_t v = 0; v < near.vertex_count(); ++v) {
            vertex_of_number_[number_of(v)] = v;
            most_work_ += WORK * near.of(v).size();
        }
        work_left_ = most_work_;
    }

    void run() {
        workers_.begin_stage("accuracy", FIRST_LOOK_END * end_fraction_);
        while (!hold_all() && limit_ < 1 && certainly_held() <= most()) limit_ *= RAISE;
        if (held_.size() > most()) {
            for (const WrongPair& left_out : keep_worst(most())) note_let_pass(left_out);
            hold();
        } else if (follows_positions(index_.description)) {
            hold_steep();
        }
    }

    // The largest errors of pairs that were compared and are not held. From some vertices none were compared
    // where there are more wrong pairs than may be held.
    const ErrorsByDistance& let_pass() const { return let_pass_; }

private:
    // Pairs that are off by their whole length or more, most of them infinitely: raising the limit to about 1
    // does not make these fewer.
    size_t certainly_held() const {
        return static_cast<size_t>(
            std::ranges::count_if(held_, [](const WrongPair& wrong) { return wrong.error >= 1; }));
    }
    void note_let_pass(const WrongPair& wrong) {
        const double at_least = std::isinf(wrong.error) ? double{LOOKED_AT} - 1 : wrong.error;
        let_pass_.add_to_max_of_fields(wrong.pair.distance, at_least);
    }
    size_t few_for_each() const { return MOST_PAIRS * near_.vertex_count(); }
    size_t most() const { return std::max(few_for_each(), FEW_IN_ALL); }

    // What is held changes the fields of both vertices of a pair, so that those are looked at again. Returns
    // whether there are not too many pairs.
    bool hold_all() {
        held_.clear();
        hold();
        for (uint32_t pass = 0; pass < MOST_PASSES; ++pass) {
            if (!find(pass == 0 ? all_vertices() : vertices_with_pairs())) return true;
            if (pass == 0 && follows_positions(index_.description)) look_farther();
            if (held_.size() > most()) return false;
            hold();
        }
        return true;
    }

    // Fields are lowered along steep edges in any case (hold_steep_edges). Where there is room, pairs are
    // held besides that make edges less steep, since they are more exact than lowered ones. They have smaller
    // errors than the others and take the place of none.
    void hold_steep() {
        const size_t room = std::max(few_for_each(), held_.size());
        for (uint32_t pass = 0; pass < MOST_PASSES && held_.size() < room; ++pass) {
            if (!find_steep(pass == 0 ? all_vertices() : vertices_with_pairs(), room)) return;
            hold();
        }
    }

    std::vector<uint32_t> all_vertices() const {
        std::vector<uint32_t> all(near_.vertex_count());
        std::iota(all.begin(), all.end(), 0u);
        return all;
    }
    std::vector<uint32_t> vertices_with_pairs() const {
        std::vector<uint32_t> vertices;
        for (uint32_t v = 0; v < near_.vertex_count(); ++v)
            if (!measured().of(number_of(v)).empty()) vertices.push_back(v);
        return vertices;
    }

    // Looks from these vertices, until there are too many pairs in all. Returns whether any pair is new.
    bool find(std::vector<uint32_t> sources) {
        const size_t before = held_.size();
        while (!sources.empty() && held_.size() <= most()) sources = find_from(sources, false);
        return held_.size() > before;
    }
    // Looks for pairs at steep edges besides, and keeps so many of all pairs, the worst ones. Returns whether
    // there are more than before.
    bool find_steep(std::vector<uint32_t> sources, size_t room) {
        const size_t before = held_.size();
        while (!sources.empty()) {
            sources = find_from(sources, true);
            keep_worst(room);
        }
        return held_.size() > before;
    }

    // Returns the sources that are left, since others beside them had very many wrong pairs.
    std::vector<uint32_t> find_from(std::span<const uint32_t> sources, bool finds_steep) {
        const size_t at_once = std::max<size_t>(FEWEST_AT_ONCE, sources.size() / MOST_TASKS);
        std::vector<std::vector<WrongPair>> of_task((sources.size() + at_once - 1) / at_once);
        std::vector<ErrorsByDistance> let_pass(of_task.size(), ErrorsByDistance(scale_.average_edge));
        std::vector<size_t> done(of_task.size()); // where a task ended
        workers_.run(of_task.size(), [&](FieldSolver&, size_t task) {
            NearComparison comparison(index_, intake_, near_, edge_ends_, scale_, limit_, finds_steep);
            const size_t begin = task * at_once, end = std::min(begin + at_once, sources.size());
            const size_t very_many = most() > FEW_IN_ALL ? 16 * MOST_PAIRS * (end - begin) : FEW_IN_ALL;
            size_t i = begin;
            for (; i < end && of_task[task].size() < very_many; ++i) {
                workers_.check_cancelled();
                comparison.compare(sources[i], of_task[task]);
            }
            done[task] = i;
            let_pass[task] = comparison.let_pass();
        });
        for (const ErrorsByDistance& errors : let_pass) let_pass_.add(errors);
        std::vector<uint32_t> left;
        for (size_t task = 0; task < of_task.size(); ++task) {
            held_.insert(held_.end(), of_task[task].begin(), of_task[task].end());
            of_task[task] = {};
            const size_t end = std::min((task + 1) * at_once, sources.size());
            left.insert(left.end(), sources.begin() + static_cast<ptrdiff_t>(done[task]),
                        sources.begin() + static_cast<ptrdiff_t>(end));
        }
        keep_different(held_);
        return left;
    }

    // Widens what is known around wrong pairs until no more are found at its rim, or half as many are held as
    // may be: then more would soon be too many.
    void look_farther() {
        while (held_.size() <= most() / 2) {
            auto sources = choose_to_widen();
            if (sources.empty()) return;
            begin_stage_of_widening();
            workers_.run(sources.size(),
                         [&](FieldSolver& solver, size_t i) { near_.widen(sources[i], solver); });
            find(std::move(sources));
        }
    }

    // It ends at the share of the work that was done or will be done in it.
    void begin_stage_of_widening() {
        const double share = most_work_ ? 1 - double(work_left_) / double(most_work_) : 1;
        workers_.begin_stage("accuracy", (FIRST_LOOK_END + (1 - FIRST_LOOK_END) * share) * end_fraction_);
    }

    // Chooses the vertices around which more is to be known, as many of them as there is work left for.
    std::vector<uint32_t> choose_to_widen() {
        std::vector<uint8_t> is_wanted(near_.vertex_count(), 0);
        for (const auto& [pair, error] : held_) {
            const double wanted = REACH * double{pair.distance};
            for (const uint32_t number : {pair.first, pair.second})
                for_each_around(vertex_of_number_[number], [&](uint32_t v) {
                    if (near_.reach(v) < wanted) is_wanted[v] = 1;
                });
        }
        std::vector<uint32_t> vertices;
        for (uint32_t v = 0; v < is_wanted.size(); ++v) {
            const uint32_t count = is_wanted[v] ? near_.wider_count(v) : 0;
            if (count == 0 || count > work_left_) continue;
            work_left_ -= count;
            vertices.push_back(v);
        }
        return vertices;
    }

    // Calls function(v) for a vertex and its neighbours.
    template <class Function>
    void for_each_around(uint32_t vertex, const Function& function) const {
        function(vertex);
        for (const uint32_t end : edge_ends_[vertex]) function(intake_.mesh.edges[end / 2][1 - end % 2]);
    }

    uint32_t number_of(uint32_t vertex) const { return number_of_vertex(index_, intake_, vertex); }

    void hold() {
        std::vector<VertexPair> pairs;
        measured().largest_errors.fill(0);
        for (const WrongPair& wrong : held_) {
            pairs.push_back(wrong.pair);
            float& largest =
                measured().largest_errors[distance_class(wrong.pair.distance / scale_.average_edge)];
            largest = std::max(largest, static_cast<float>(std::min(wrong.error, 1.0)));
        }
        take_pairs(pairs, index_.numbering().vertex_count(), measured());
    }

    // Keeps all if they are no more than so many. Returns those that are not kept.
    std::vector<WrongPair> keep_worst(size_t count) {
        if (held_.size() <= count) return {};
        std::ranges::stable_sort(held_, std::ranges::greater{}, &WrongPair::error);
        std::vector<WrongPair> left_out(held_.begin() + static_cast<ptrdiff_t>(count), held_.end());
        held_.resize(count);
        keep_different(held_); // in the order of pairs again
        return left_out;
    }

    MeasuredPairs& measured() const { return std::get<OverlayIndex>(index_.engine).measured; }

    const Intake& intake_;
    const DistanceScale& scale_;
    NearDistances& near_;
    Workers& workers_;
    const double end_fraction_;
    Index& index_;
    const ListOfLists<uint32_t> edge_ends_;
    double limit_ = LARGEST_ERROR;           // of errors that are let pass
    std::vector<uint32_t> vertex_of_number_; // NONE of added vertices
    uint64_t most_work_ = 0;                 // so many vertices may be found by looking farther
    uint64_t work_left_ = 0;                 // of these
    std::vector<WrongPair> held_;            // in ascending order, each once
    ErrorsByDistance let_pass_;
};

}

ErrorsByDistance hold_wrong_pairs(const Intake& intake, const DistanceScale& scale, NearDistances& near,
                                  Workers& workers, Index& index, double end_fraction) {
    Search search(intake, scale, near, workers, index, end_fraction);
    search.run();
    return search.let_pass();
}

}
