#include "src/build/wrong_pairs.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <tuple>
#include <utility>

#include "src/build/errors_by_distance.h"
#include "src/query/query.h"

namespace geodesic {

namespace {

constexpr double LARGEST_ERROR = 0.01; // that is let pass, unless too many pairs are off by more
constexpr size_t MOST_PAIRS = 4;       // for each vertex, on average
constexpr double RAISE = 1.5;          // by which a larger error is let pass then
// Along an edge, distances change by no more than its length. Answers may by this much more.
constexpr double STEEPEST = 1.05;
constexpr uint32_t MOST_PASSES = 4;
constexpr float LOOKED_AT = 1.1f; // times as far as near vertices: what is beyond is off by more than that
constexpr size_t FEWEST_AT_ONCE = 64, MOST_TASKS = 256; // sources of a task share a query

struct WrongPair {
    MeasuredPair pair;
    double error;
};

// Rounded to 13 bits, which changes it far less than what is let pass, so that files have fewer of them.
constexpr float ROUNDING = 1.f / (1 << 13);
float rounded(float distance) {
    constexpr uint32_t DROPPED = (1 << 11) - 1;
    const auto bits = std::bit_cast<uint32_t>(distance);
    return std::bit_cast<float>((bits + DROPPED / 2 + 1) & ~DROPPED);
}

// One thread's answers compared with the metric, from one source at a time.
class Comparison {
public:
    // An error up to `limit` is let pass.
    Comparison(const Index& index, const Intake& intake, const NearDistances& near,
               const ListOfLists<uint32_t>& edge_ends, double limit)
        : index_(index), intake_(intake), near_(near), edge_ends_(edge_ends), limit_(limit),
          query_(index, std::pmr::get_default_resource()), answer_(index.description.id_count, INFINITE),
          field_(near.vertex_count(), {0, 0}) {}

    // Adds the wrong pairs of this source.
    void compare(uint32_t source, std::vector<WrongPair>& wrong) {
        source_ = source;
        wrong_ = &wrong;
        fill_field();
        for (const auto& near : near_.of(source))
            if (const double error = largest_error(near.vertex); error > limit_) correct(near.vertex, error);
        open_.clear();
        for (const auto& near : near_.of(source)) open_.push_back(near.vertex);
        while (!open_.empty()) {
            const uint32_t vertex = open_.back();
            open_.pop_back();
            make_less_steep(vertex);
        }
        for (const auto& near : near_.of(source)) field_[near.vertex] = {0, 0};
    }

private:
    // Of a near vertex; others, and the source, have 0 for both.
    struct Distances {
        float exact, answer;
        double error() const { return relative_error(exact, answer); }
    };

    uint32_t id_of(uint32_t vertex) const { return intake_.id_of_vertex[vertex]; }

    // With the answers of MSAD.
    void fill_field() {
        const uint32_t id = id_of(source_);
        float farthest = 0;
        for (const auto& near : near_.of(source_)) farthest = std::max(farthest, near.distance);
        const float radius = std::min(LOOKED_AT * farthest, std::numeric_limits<float>::max());
        const auto found = query_.within({&id, 1}, radius);
        for (const auto& [distance, other] : found) answer_[other] = distance;
        for (const auto& [vertex, distance] : near_.of(source_))
            field_[vertex] = {distance, answer_[id_of(vertex)]};
        for (const auto& [distance, other] : found) answer_[other] = INFINITE;
    }

    double largest_error(uint32_t vertex) {
        const Distances& distances = field_[vertex];
        const double of_field = distances.error();
        const double suspicious = limit_ / 2; // what makes one of MSAD and SSSD wrong makes both
        if (of_field <= suspicious || of_field > limit_) return of_field;
        return std::max(of_field,
                        relative_error(distances.exact, query_.sssd(id_of(source_), id_of(vertex))));
    }

    void correct(uint32_t vertex, double error) {
        Distances& distances = field_[vertex];
        const auto number = [&](uint32_t v) { return index_.number_of_id[id_of(v)]; };
        const auto [first, second] = std::minmax({number(source_), number(vertex)});
        distances.answer = distances.exact;
        const float distance = rounded(distances.exact);
        if (distance > 0 && distance < INFINITE) wrong_->push_back({{first, second, distance}, error});
    }

    // Where an edge of a near vertex leads to another one and is too steep, the worse end is corrected.
    void make_less_steep(uint32_t vertex) {
        const auto is_near = [&](uint32_t v) { return field_[v].exact > 0 || v == source_; };
        for (const uint32_t end : edge_ends_[vertex]) {
            const uint32_t other = intake_.mesh.edges[end / 2][1 - end % 2];
            if (!is_near(other) || !is_too_steep(vertex, other)) continue;
            const uint32_t worse = deviation(vertex) < deviation(other) ? other : vertex;
            if (!(deviation(worse) > ROUNDING * field_[worse].exact)) continue;
            correct(worse, field_[worse].error());
            open_.push_back(worse);
        }
    }
    bool is_too_steep(uint32_t a, uint32_t b) const {
        const double length = (intake_.mesh.positions[a] - intake_.mesh.positions[b]).norm();
        return std::abs(field_[a].answer - field_[b].answer) > STEEPEST * length;
    }
    float deviation(uint32_t vertex) const { return std::abs(field_[vertex].answer - field_[vertex].exact); }

    const Index& index_;
    const Intake& intake_;
    const NearDistances& near_;
    const ListOfLists<uint32_t>& edge_ends_;
    const double limit_;
    Query query_;
    uint32_t source_ = NONE;
    std::vector<WrongPair>* wrong_ = nullptr;
    std::vector<float> answer_;    // by id; infinite but while a field is filled
    std::vector<Distances> field_; // by vertex
    std::vector<uint32_t> open_;   // vertices whose edges are to be looked at
};

// Keeps each pair once. Errors and distances of both directions may differ.
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
    Search(const Intake& intake, const NearDistances& near, Workers& workers, Index& index)
        : intake_(intake), near_(near), workers_(workers), index_(index),
          edge_ends_(edge_ends_at_vertices(intake.mesh)), average_edge_(mean_edge(intake.mesh)) {}

    void run() {
        for (double limit = LARGEST_ERROR; !hold_all(limit) && limit < 1;) limit *= RAISE;
        if (held_.size() > most()) keep_worst();
    }

private:
    size_t most() const { return MOST_PAIRS * near_.vertex_count(); }

    // What is held changes the fields of both vertices of a pair, so that those are looked at again. Returns
    // whether there are not too many pairs.
    bool hold_all(double limit) {
        held_.clear();
        hold();
        for (uint32_t pass = 0; pass < MOST_PASSES; ++pass) {
            if (!find(limit, pass == 0)) return true;
            if (held_.size() > most()) return false;
            hold();
        }
        return true;
    }

    // Looks from all vertices, or from those that have pairs. Returns whether any pair is new.
    bool find(double limit, bool everywhere) {
        const uint32_t vertices = near_.vertex_count();
        const size_t at_once = std::max<size_t>(FEWEST_AT_ONCE, vertices / MOST_TASKS);
        std::vector<std::vector<WrongPair>> of_task((vertices + at_once - 1) / at_once);
        workers_.run(of_task.size(), [&](FieldSolver&, size_t task) {
            Comparison comparison(index_, intake_, near_, edge_ends_, limit);
            const size_t begin = task * at_once, end = std::min<size_t>(begin + at_once, vertices);
            const size_t far_too_many = 16 * MOST_PAIRS * (end - begin);
            for (size_t v = begin; v < end && of_task[task].size() < far_too_many; ++v) {
                workers_.check_cancelled();
                const auto vertex = static_cast<uint32_t>(v);
                if (everywhere || has_pairs(vertex)) comparison.compare(vertex, of_task[task]);
            }
        });
        const size_t before = held_.size();
        for (auto& found : of_task) {
            held_.insert(held_.end(), found.begin(), found.end());
            found = {};
        }
        keep_different(held_);
        return held_.size() > before;
    }

    bool has_pairs(uint32_t vertex) const {
        return !measured().of(index_.number_of_id[intake_.id_of_vertex[vertex]]).empty();
    }

    void hold() {
        std::vector<MeasuredPair> pairs;
        measured().largest_errors.fill(0);
        for (const WrongPair& wrong : held_) {
            pairs.push_back(wrong.pair);
            float& largest = measured().largest_errors[distance_class(wrong.pair.distance / average_edge_)];
            largest = std::max(largest, static_cast<float>(std::min(wrong.error, 1.0)));
        }
        take_measured_pairs(pairs, index_.numbering().vertex_count(), measured());
    }

    void keep_worst() {
        std::ranges::stable_sort(held_, std::ranges::greater{}, &WrongPair::error);
        held_.resize(most());
        keep_different(held_); // in the order of pairs again
        hold();
    }

    MeasuredPairs& measured() const { return std::get<OverlayIndex>(index_.engine).measured; }

    const Intake& intake_;
    const NearDistances& near_;
    Workers& workers_;
    Index& index_;
    const ListOfLists<uint32_t> edge_ends_;
    const double average_edge_;
    std::vector<WrongPair> held_; // in ascending order, each once
};

}

void hold_wrong_pairs(const Intake& intake, const NearDistances& near, Workers& workers, Index& index) {
    Search(intake, near, workers, index).run();
}

}
