#include "src/tables/fill.h"

#include <algorithm>

#include "src/base/array.h"
#include "src/index/numbering.h"
#include "src/tables/measuring.h"

namespace geodesic {

namespace {

// Measures each pair of vertices once, from the one with the smaller number, and writes the distance to every
// table that has both.
class RowFiller {
public:
    RowFiller(const Numbering& numbering, std::span<const uint32_t> vertex_of_number, StoredIndex& stored)
        : numbering_(numbering), vertex_of_number_(vertex_of_number), stored_(stored) {
        for (uint32_t p = 0; p < numbering.patch_count(); ++p) {
            border_table_begin_.push_back(border_table_begin_.back() +
                                          triangle_size(numbering.border_size(p)));
            require_room_for(border_table_begin_.back());
        }
        stored.border_tables.resize(border_table_begin_.back());
        stored.border_internal_tables.resize(numbering.border_internal_begin.back());
        stored.internal_tables.resize(numbering.internal_table_begin.back());
    }

    void fill(FieldSolver& solver, uint32_t number) {
        if (numbering_.is_border(number)) return fill_border(solver, number);
        measure_internal(numbering_, vertex_of_number_, number, nullptr, solver,
                         stored_.border_internal_tables, stored_.internal_tables);
    }

    // The least ratio of a distance in the patch's tables to the straight line between its two vertices; at
    // most 1.
    double smallest_ratio(uint32_t patch) const {
        double smallest = 1;
        const auto border = numbering_.border_of(patch);
        const auto compare = [&](float distance, uint32_t a, uint32_t b) {
            const double line = straight_distance(numbering_, a, b);
            if (line > 0 && double{distance} < smallest * line) smallest = double{distance} / line;
        };
        const float* entry = stored_.border_tables.data() + border_table_begin_[patch];
        for (uint32_t i = 0; i < border.size(); ++i)
            for (uint32_t j = 0; j < i; ++j) compare(*entry++, border[i], border[j]);
        if (patch < numbering_.first_leaf()) return smallest;
        const float* row =
            stored_.border_internal_tables.data() + numbering_.border_internal_entry(patch, 0, 0);
        for (const uint32_t v : border)
            for (uint32_t j = 0; j < numbering_.internal_size(patch); ++j)
                compare(*row++, v, numbering_.first_internal(patch) + j);
        return smallest;
    }

private:
    void fill_border(FieldSolver& solver, uint32_t number) {
        std::vector<uint32_t> targets;
        for (const PatchPosition& at : numbering_.borders_of(number))
            for (uint32_t other : numbering_.border_of(at.patch))
                if (other > number) targets.push_back(vertex_of_number_[other]);
        if (targets.empty()) return;
        solver.solve({&vertex_of_number_[number], 1}, targets);
        for (const auto& [patch, own] : numbering_.borders_of(number)) {
            const auto border = numbering_.border_of(patch);
            float* table = stored_.border_tables.data() + border_table_begin_[patch];
            for (uint32_t i = 0; i < border.size(); ++i)
                if (border[i] > number)
                    table[below_diagonal(std::max(i, own), std::min(i, own))] =
                        measured_distance(solver, vertex_of_number_[border[i]]);
        }
    }

    const Numbering& numbering_;
    std::span<const uint32_t> vertex_of_number_;
    StoredIndex& stored_;
    std::vector<uint64_t> border_table_begin_{0}; // per patch: where its border table begins
};

// The largest scale with which no table entry is shorter than its scaled straight line, made smaller by the
// rounding of floats.
float bound_scale(const RowFiller& filler, uint32_t patch_count, Workers& workers) {
    std::vector<double> smallest(patch_count);
    workers.run(patch_count, [&](FieldSolver&, size_t p) {
        smallest[p] = filler.smallest_ratio(static_cast<uint32_t>(p));
    });
    constexpr double FLOAT_ROUNDING = 1e-6;
    return static_cast<float>(*std::min_element(smallest.begin(), smallest.end()) * (1 - FLOAT_ROUNDING));
}

}

void fill_graph_tables(std::span<const uint32_t> vertex_of_number, Workers& workers, StoredIndex& stored) {
    Numbering numbering(global_heap());
    number_vertices(stored, numbering);
    RowFiller filler(numbering, vertex_of_number, stored);
    workers.run(numbering.vertex_count(), [&](FieldSolver& solver, size_t number) {
        filler.fill(solver, static_cast<uint32_t>(number));
    });
    stored.description.bound_scale = bound_scale(filler, numbering.patch_count(), workers);
}

}
