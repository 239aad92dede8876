#include "src/tables/overlay_fill.h"

#include <algorithm>

#include "src/base/array.h"
#include "src/tables/closure.h"
#include "src/tables/distance_tables.h"
#include "src/tables/measuring.h"
#include "src/tables/rounding.h"
#include "src/tables/segments.h"

namespace geodesic {

namespace {

// The number of vertices that lie inside of each patch and not on its border.
std::vector<uint64_t> inner_vertices(const Numbering& numbering) {
    std::vector<uint64_t> count(numbering.patch_count(), 0);
    for (uint32_t p = numbering.patch_count(); p-- > 0;) {
        count[p] += numbering.inner_size(p);
        if (p > 0) count[numbering.parent[p]] += count[p];
    }
    return count;
}

// Tells which overlay tables hold the metric's own distances. Those of the parents of leaves always do.
std::vector<uint8_t> exact_patches(const Numbering& numbering, uint32_t exact_vertices) {
    const auto count = inner_vertices(numbering);
    std::vector<uint8_t> exact(numbering.first_leaf());
    for (uint32_t p = 0; p < numbering.first_leaf(); ++p)
        exact[p] = count[p] <= exact_vertices || numbering.child_begin[p] >= numbering.first_leaf();
    return exact;
}

// The number of table rows that are put together from children and then lowered by parents.
size_t closure_rows(const Numbering& numbering, const std::vector<uint8_t>& exact) {
    size_t rows = 0;
    for (uint32_t p = 0; p < numbering.first_leaf(); ++p)
        if (!exact[p]) rows += (p > 0 ? 2 : 1) * size_t{numbering.overlay_size(p)};
    return rows;
}

// Measures each pair of vertices once and writes the distance to every table that has both. The first
// vertices of the mesh may be known, and pairs of these must be in the tables. Of a known vertex and another
// one, the other one measures; of two others, the one with the smaller number.
class ExactTables {
public:
    ExactTables(const Numbering& numbering, std::span<const uint32_t> vertex_of_number,
                const std::vector<uint8_t>& exact, uint32_t known, DistanceTables& tables,
                NearDistances* near)
        : numbering_(numbering), vertex_of_number_(vertex_of_number), exact_(exact), known_(known),
          tables_(tables), near_(near) {}

    // What is near a vertex is taken when its distances are measured first; added vertices take nothing.
    void fill(FieldSolver& solver, uint32_t number) {
        if (is_known(number)) return;
        const uint32_t& vertex = vertex_of_number_[number];
        NearDistances* const near = near_ && vertex < near_->vertex_count() ? near_ : nullptr;
        const bool is_solved = numbering_.is_border(number)
                                   ? fill_border(solver, number, near)
                                   : measure_internal(numbering_, vertex_of_number_, number, near, solver,
                                                      tables_.border_internal, tables_.internal);
        if (!near) return;
        if (!is_solved) solve_for_tables(vertex, {&vertex, 1}, near, solver);
        near->take(vertex, solver);
    }

private:
    bool is_known(uint32_t number) const { return vertex_of_number_[number] < known_; }
    // Whether a vertex that is not known measures the distance of another one.
    bool is_measured_to(uint32_t number, uint32_t other) const { return other > number || is_known(other); }

    // The measured overlays that have a border vertex, with its position in each.
    std::vector<PatchPosition> overlays_of(uint32_t number) const {
        std::vector<PatchPosition> positions;
        const uint32_t owner = numbering_.owner[number];
        if (exact_[owner]) positions.push_back({owner, numbering_.position_at_owner(number)});
        for (const PatchPosition& at : numbering_.borders_of(number))
            if (at.patch < numbering_.first_leaf() && exact_[at.patch]) positions.push_back(at);
        return positions;
    }

    // As measure_internal() does it.
    bool fill_border(FieldSolver& solver, uint32_t number, const NearDistances* near) {
        const auto overlays = overlays_of(number);
        const auto leaves = known_ > 0 ? leaves_of(number) : std::vector<PatchPosition>();
        std::vector<uint32_t> targets;
        for (const auto& [patch, own] : overlays)
            for (uint32_t i = 0; i < numbering_.overlay_size(patch); ++i)
                if (const uint32_t other = numbering_.overlay_number(patch, i); is_measured_to(number, other))
                    targets.push_back(vertex_of_number_[other]);
        for (const auto& [leaf, own] : leaves)
            for (uint32_t i = 0; i < numbering_.internal_size(leaf); ++i)
                targets.push_back(vertex_of_number_[numbering_.first_internal(leaf) + i]);
        if (!targets.empty()) solve_for_tables(vertex_of_number_[number], targets, near, solver);
        for (const PatchPosition& at : overlays) fill_overlay_row(solver, number, at);
        for (const PatchPosition& at : leaves) fill_leaf_row(solver, at);
        return !targets.empty();
    }

    // The leaves on whose border an added vertex is: their internal vertices are known and measure nothing.
    std::vector<PatchPosition> leaves_of(uint32_t number) const {
        std::vector<PatchPosition> leaves;
        for (const PatchPosition& at : numbering_.borders_of(number))
            if (at.patch >= numbering_.first_leaf()) leaves.push_back(at);
        return leaves;
    }

    void fill_overlay_row(const FieldSolver& solver, uint32_t number, const PatchPosition& at) {
        const size_t size = numbering_.overlay_size(at.patch);
        std::vector<float>& table = tables_.overlay[at.patch];
        table[at.position * size + at.position] = 0;
        for (uint32_t i = 0; i < size; ++i)
            if (const uint32_t other = numbering_.overlay_number(at.patch, i); is_measured_to(number, other))
                table[at.position * size + i] = table[i * size + at.position] =
                    measured_distance(solver, vertex_of_number_[other]);
    }

    void fill_leaf_row(const FieldSolver& solver, const PatchPosition& at) {
        for (uint32_t i = 0; i < numbering_.internal_size(at.patch); ++i)
            tables_.border_internal[numbering_.border_internal_entry(at.patch, at.position, i)] =
                measured_distance(solver, vertex_of_number_[numbering_.first_internal(at.patch) + i]);
    }

    const Numbering& numbering_;
    std::span<const uint32_t> vertex_of_number_;
    const std::vector<uint8_t>& exact_;
    const uint32_t known_; // vertices
    DistanceTables& tables_;
    NearDistances* const near_; // NULL if nobody wants them
};

// Writes what is known into the tables, frees it, and returns of how many vertices it was.
uint32_t take_known(const Numbering& numbering, std::span<const uint32_t> vertex_of_number,
                    const std::vector<uint8_t>& exact, std::optional<MeasuredTables>& known,
                    DistanceTables& tables) {
    if (!known) return 0;
    known->copy_to(numbering, vertex_of_number, exact, tables);
    const uint32_t count = known->vertex_count();
    known.reset();
    return count;
}

// Copies of the tables that hold measured distances.
DistanceTables measured_part(const std::vector<uint8_t>& exact, const DistanceTables& tables) {
    DistanceTables part;
    for (size_t p = 0; p < exact.size(); ++p)
        part.overlay.push_back(exact[p] ? tables.overlay[p] : std::vector<float>());
    part.border_internal = tables.border_internal;
    part.internal = tables.internal;
    return part;
}

std::vector<uint32_t> numbers_of_vertices(std::span<const uint32_t> vertex_of_number) {
    std::vector<uint32_t> number_of_vertex(vertex_of_number.size());
    for (uint32_t number = 0; number < vertex_of_number.size(); ++number)
        number_of_vertex[vertex_of_number[number]] = number;
    return number_of_vertex;
}

// Lowers the tables by those of their parents. The table of a patch is handed over once its children's are
// lowered; the leaves' need no closure.
void close_downwards_and_hand_over(const Numbering& numbering, const std::vector<uint8_t>& exact,
                                   const Rings& rings, std::span<const float> rounding, Workers& workers,
                                   DistanceTables& tables, StoredIndex& stored) {
    for (uint32_t p = 0; p < numbering.patch_count(); ++p) {
        if (p < numbering.first_leaf())
            for (uint32_t child = numbering.child_begin[p]; child < numbering.child_begin[p + 1]; ++child)
                if (child < numbering.first_leaf() && !exact[child])
                    close_from_above(child, numbering, rings, workers, tables);
        hand_over(p, numbering, rounding[p], tables, stored);
    }
}

// Whether floats can hold the squares of distances between the length of a segment and that of thousands of
// segments.
bool can_be_squared(const BorderSegments& segments) {
    constexpr float SHORTEST = 1e-16f, LONGEST = 1e14f;
    float longest = 0;
    for (const float length : segments.length) longest = std::max(longest, length);
    for (const Bridge& bridge : segments.bridges) longest = std::max(longest, bridge.length);
    return longest >= SHORTEST && longest <= LONGEST;
}

}

void fill_overlay_tables(const Mesh& mesh, std::span<const uint32_t> leaf_of_face,
                         std::span<const uint32_t> vertex_of_number, const OverlayOptions& options,
                         Workers& workers, StoredIndex& stored, NearDistances* near,
                         std::optional<MeasuredTables>* measured) {
    Numbering numbering(global_heap());
    number_vertices(stored, numbering);
    DistanceTables tables(numbering);
    const auto exact = exact_patches(numbering, options.exact_vertices);
    const uint32_t known = measured ? take_known(numbering, vertex_of_number, exact, *measured, tables) : 0;
    ExactTables filler(numbering, vertex_of_number, exact, known, tables, near);
    workers.run(numbering.vertex_count(), [&](FieldSolver& solver, size_t number) {
        filler.fill(solver, static_cast<uint32_t>(number));
    });
    if (measured) {
        measured->emplace();
        number_vertices(stored, (*measured)->numbering);
        (*measured)->number_of_vertex = numbers_of_vertices(vertex_of_number);
        (*measured)->tables = measured_part(exact, tables);
    }
    BorderSegments segments(numbering.border.size());
    if (options.unfold) segments = find_segments(mesh, leaf_of_face, vertex_of_number, tables, numbering);
    if (!can_be_squared(segments)) segments = BorderSegments(numbering.border.size());
    Rings rings(global_heap());
    lay_out_rings(segments, numbering, rings);
    Slots slots(global_heap());
    find_slots(numbering, slots);
    workers.begin_stage("closure", options.stage_end, closure_rows(numbering, exact));
    for (uint32_t p = numbering.first_leaf(); p-- > 0;)
        if (!exact[p]) close_from_below(p, numbering, slots, rings, workers, tables);
    const auto rounding = rounding_of_patches(numbering, tables, options.rounding);
    close_downwards_and_hand_over(numbering, exact, rings, rounding, workers, tables, stored);
    stored.segments = std::move(segments);
}

}
