#include "src/tables/measured_tables.h"

namespace geodesic {

namespace {

// Copies the tables of one patch. Vertices of the finer mesh are given by their numbers there.
class PatchCopy {
public:
    PatchCopy(const MeasuredTables& known, const Numbering& finer, std::span<const uint32_t> vertex_of_number,
              uint32_t patch, DistanceTables& to)
        : known_(known), finer_(finer), vertex_of_number_(vertex_of_number), patch_(patch), to_(to) {}

    void copy_overlay() const {
        const size_t size = finer_.overlay_size(patch_), known_size = known_.numbering.overlay_size(patch_);
        std::vector<uint32_t> positions(size);
        for (uint32_t i = 0; i < size; ++i) positions[i] = known_position(finer_.overlay_number(patch_, i));
        std::vector<float>& table = to_.overlay[patch_];
        for (size_t i = 0; i < size; ++i)
            for (size_t j = 0; j < size; ++j)
                if (positions[i] != NONE && positions[j] != NONE)
                    table[i * size + j] =
                        known_.tables.overlay[patch_][positions[i] * known_size + positions[j]];
    }

    // All internal vertices are known.
    void copy_leaf() const {
        const uint32_t size = finer_.internal_size(patch_);
        std::vector<uint32_t> internal(size);
        for (uint32_t i = 0; i < size; ++i)
            internal[i] =
                known_number(finer_.first_internal(patch_) + i) - known_.numbering.first_internal(patch_);
        const auto border = finer_.border_of(patch_);
        for (uint32_t k = 0; k < border.size(); ++k)
            if (const uint32_t at = known_position(border[k]); at != NONE)
                for (uint32_t i = 0; i < size; ++i)
                    to_.border_internal[finer_.border_internal_entry(patch_, k, i)] =
                        known_.tables
                            .border_internal[known_.numbering.border_internal_entry(patch_, at, internal[i])];
        for (uint32_t i = 0; i < size; ++i)
            for (uint32_t j = 0; j < i; ++j)
                to_.internal[finer_.internal_entry(patch_, i, j)] =
                    known_.tables.internal[known_.numbering.internal_entry(patch_, internal[i], internal[j])];
    }

private:
    // NONE if it is an added vertex.
    uint32_t known_number(uint32_t number) const {
        const uint32_t vertex = vertex_of_number_[number];
        return vertex < known_.vertex_count() ? known_.number_of_vertex[vertex] : NONE;
    }

    // In the patch's overlay, which begins with its border; NONE if it is an added vertex.
    uint32_t known_position(uint32_t border_vertex) const {
        const uint32_t number = known_number(border_vertex);
        if (number == NONE) return NONE;
        return known_.numbering.owner[number] == patch_ ? known_.numbering.position_at_owner(number)
                                                        : known_.numbering.border_position(patch_, number);
    }

    const MeasuredTables& known_;
    const Numbering& finer_;
    std::span<const uint32_t> vertex_of_number_;
    uint32_t patch_;
    DistanceTables& to_;
};

}

void MeasuredTables::copy_to(const Numbering& finer, std::span<const uint32_t> vertex_of_number,
                             std::span<const uint8_t> is_measured, DistanceTables& to) const {
    for (uint32_t p = 0; p < finer.patch_count(); ++p) {
        const PatchCopy copy(*this, finer, vertex_of_number, p, to);
        if (p >= finer.first_leaf())
            copy.copy_leaf();
        else if (is_measured[p])
            copy.copy_overlay();
    }
}

}
