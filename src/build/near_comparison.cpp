#include "src/build/near_comparison.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "src/base/array.h"
#include "src/base/rounded.h"
#include "src/build/number_of_vertex.h"
#include "src/build/steep_search.h"

namespace geodesic {

namespace {

// The largest one of all tables. An answer is the sum of two codes or more, each rounded by half a step.
double largest_step(const Index& index) {
    const auto& overlay = std::get<OverlayIndex>(index.engine);
    double largest = 0;
    for (size_t p = 0; p < overlay.quantum.size(); ++p)
        largest = std::max(largest, std::ldexp(double{overlay.quantum[p]}, overlay.shift[p]));
    return largest;
}

}

NearComparison::NearComparison(const Index& index, const Intake& intake, const NearDistances& near,
                               const ListOfLists<uint32_t>& edge_ends, const DistanceScale& scale,
                               double limit, bool finds_steep)
    : index_(index), intake_(intake), near_(near), edge_ends_(edge_ends), limit_(limit),
      finds_steep_(finds_steep), too_short_(scale.too_short), rounded_by_limit_(largest_step(index) / limit),
      query_(index, global_heap()), answer_(index.description.id_count, INFINITE),
      field_(near.vertex_count(), {0, 0}), let_pass_(scale.average_edge) {}

void NearComparison::compare(uint32_t source, std::vector<WrongPair>& wrong) {
    source_ = source;
    wrong_ = &wrong;
    fill_field();
    correct_wrong();
    if (finds_steep_) correct_steep();
    for (const auto& near : near_.of(source)) field_[near.vertex] = {0, 0};
}

void NearComparison::correct_wrong() {
    for (const auto& near : near_.of(source_)) {
        if (!has_relative_error(near.distance, too_short_.up_to(source_))) continue;
        if (const double error = largest_error(near.vertex); error > limit_)
            correct(near.vertex, error);
        else
            note_let_pass(near.vertex, error);
    }
}

void NearComparison::note_let_pass(uint32_t vertex, double error) {
    const Distances& distances = field_[vertex];
    let_pass_.add_to_max_of_fields(distances.exact, distances.error());
    let_pass_.of(distances.exact).add_to_max(error);
}

void NearComparison::correct_steep() {
    open_.clear();
    for (const auto& near : near_.of(source_)) open_.push_back(near.vertex);
    while (!open_.empty()) {
        const uint32_t vertex = open_.back();
        open_.pop_back();
        make_less_steep(vertex);
    }
}

// Fills the field with the metric's distances and with those of MSAD, which count as infinite where they are
// longer than it looks.
void NearComparison::fill_field() {
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

double NearComparison::largest_error(uint32_t vertex) {
    const Distances& distances = field_[vertex];
    const double of_field = distances.error();
    const bool is_suspicious = // what makes one of MSAD and SSSD wrong makes both, but for rounding
        of_field > limit_ / 2 || distances.exact < rounded_by_limit_;
    if (!is_suspicious || of_field > limit_) return of_field;
    return std::max(of_field, relative_error(distances.exact, query_.sssd(id_of(source_), id_of(vertex))));
}

void NearComparison::correct(uint32_t vertex, double error) {
    Distances& distances = field_[vertex];
    const auto [first, second] =
        std::minmax({number_of_vertex(index_, intake_, source_), number_of_vertex(index_, intake_, vertex)});
    distances.answer = distances.exact;
    const float distance = rounded(distances.exact);
    if (distance > 0 && distance < INFINITE) wrong_->push_back({{first, second, distance}, error});
}

// Where an edge of a near vertex leads to another one and is too steep, the worse end is corrected.
void NearComparison::make_less_steep(uint32_t vertex) {
    const auto is_near = [&](uint32_t v) { return field_[v].exact > 0 || v == source_; };
    for (const uint32_t end : edge_ends_[vertex]) {
        const uint32_t other = intake_.mesh.edges[end / 2][1 - end % 2];
        if (!is_near(other) || !is_too_steep(vertex, other)) continue;
        const uint32_t worse = field_[vertex].deviation() < field_[other].deviation() ? other : vertex;
        const Distances& distances = field_[worse];
        if (!has_relative_error(distances.exact, too_short_.up_to(source_))) continue;
        if (!(distances.deviation() > LARGEST_ROUNDING * distances.exact)) continue;
        correct(worse, distances.error());
        open_.push_back(worse);
    }
}

// An edge that is shorter than the rounding of a measured distance is made less steep by none.
bool NearComparison::is_too_steep(uint32_t a, uint32_t b) const {
    const double most = STEEPEST * (intake_.mesh.positions[a] - intake_.mesh.positions[b]).norm();
    return most > LARGEST_ROUNDING * std::max(field_[a].exact, field_[b].exact) &&
           std::abs(field_[a].answer - field_[b].answer) > most;
}

}
