#include "src/tables/fill.h"

#include <algorithm>

#include "src/tables/measuring.h"

namespace geodesic {

namespace {

// Each pair of vertices is measured once, from the smaller number, and written to both of its places.
class RowFiller {
public:
    RowFiller(Index& index, std::span<const uint32_t> vertex_of_number)
        : index_(index), vertex_of_number_(vertex_of_number) {}

    void fill(FieldSolver& solver, uint32_t number) {
        if (index_.is_border(number)) return fill_border(solver, number);
        measure_internal(index_, vertex_of_number_, number, solver, index_.crossing_tables,
                         index_.internal_tables);
    }

private:
    std::vector<uint32_t> vertices_of(std::span<const uint32_t> numbers) const {
        std::vector<uint32_t> vertices;
        for (uint32_t n : numbers) vertices.push_back(vertex_of_number_[n]);
        return vertices;
    }

    void fill_border(FieldSolver& solver, uint32_t number) {
        std::vector<uint32_t> targets;
        for (const BorderPlace& place : index_.places_of(number))
            for (uint32_t other : index_.border_of(place.patch))
                if (other > number) targets.push_back(other);
        if (targets.empty()) return;
        solver.solve({&vertex_of_number_[number], 1}, vertices_of(targets));
        for (const BorderPlace& place : index_.places_of(number)) {
            const auto border = index_.border_of(place.patch);
            float* table = index_.border_tables.data() + index_.border_table_begin[place.patch];
            for (size_t i = 0; i < border.size(); ++i) {
                if (border[i] <= number) continue;
                const float d = measured_distance(solver, vertex_of_number_[border[i]]);
                table[place.position * border.size() + i] = d;
                table[i * border.size() + place.position] = d;
            }
        }
    }

    Index& index_;
    std::span<const uint32_t> vertex_of_number_;
};

double smallest_ratio_of_patch(const Index& index, uint32_t patch) {
    double smallest = 1;
    const auto border = index.border_of(patch);
    const auto compare = [&](float distance, uint32_t a, uint32_t b) {
        const double line = straight_distance(index, a, b);
        if (line > 0 && double{distance} < smallest * line) smallest = double{distance} / line;
    };
    for (uint32_t i = 0; i < border.size(); ++i) {
        const float* row = index.border_row(patch, i);
        for (uint32_t j = 0; j < i; ++j) compare(row[j], border[i], border[j]);
        if (patch < index.first_leaf()) continue;
        const float* crossing = index.crossing_row(patch, i);
        const uint32_t first = index.first_internal(patch);
        for (uint32_t j = 0; j < index.internal_size(patch); ++j) compare(crossing[j], border[i], first + j);
    }
    return smallest;
}

// The largest scale that keeps every table entry above its straight line, less float rounding.
void set_bound_scale(Index& index, Workers& workers) {
    std::vector<double> smallest(index.patch_count());
    workers.run(index.patch_count(), [&](FieldSolver&, size_t p) {
        smallest[p] = smallest_ratio_of_patch(index, static_cast<uint32_t>(p));
    });
    constexpr double FLOAT_ROUNDING = 1e-6;
    index.bound_scale =
        static_cast<float>(*std::min_element(smallest.begin(), smallest.end()) * (1 - FLOAT_ROUNDING));
}

}

void fill_graph_tables(Index& index, std::span<const uint32_t> vertex_of_number, Workers& workers) {
    RowFiller filler(index, vertex_of_number);
    workers.run(index.vertex_count(), [&](FieldSolver& solver, size_t number) {
        filler.fill(solver, static_cast<uint32_t>(number));
    });
    set_bound_scale(index, workers);
}

}
