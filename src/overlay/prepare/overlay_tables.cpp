#include "src/overlay/prepare/overlay_tables.h"

#include <algorithm>

namespace geodesic {

namespace {

// Writes the tables of one inner patch.
class OverlayTableWriter {
public:
    OverlayTableWriter(const OverlayIndex& index, uint32_t patch, const OverlayTables& tables)
        : index_(index), patch_(patch), places_(index.rings.size(patch)),
          border_(index.numbering.border_size(patch)), owned_(index.numbering.inner_size(patch)),
          parent_(border_ > 0 ? index.numbering.parent[patch] : patch),
          parent_quantum_(index.quantum[parent_]), quantum_(index.quantum[patch]),
          position_in_parent_(index.numbering.positions_in_parent(patch)),
          place_(index.rings.place_of_slot.data() + index.numbering.border_begin[patch]),
          place_position_(index.rings.position.data() + index.rings.begin[patch]), tables_(tables) {}

    void write(const uint16_t* stored) const {
        const uint16_t* const among_owned = write_inner(stored);
        write_border();
        if (index_.is_large[patch_])
            write_half_owned(among_owned);
        else
            write_owned(among_owned);
    }

private:
    // Returns the stored distances behind those that it writes.
    const uint16_t* write_inner(const uint16_t* stored) const {
        for (size_t i = 0; i < owned_; ++i, stored += border_)
            for (size_t k = 0; k < places_; ++k) tables_.inner[i * places_ + k] = stored[place_position_[k]];
        return stored;
    }

    // The code of two vertices on the patch's border, which is stored in the table of its parent only.
    uint16_t code_on_border(uint32_t i, uint32_t j) const {
        return TableCode::converted(
            index_.overlay_code(parent_, position_in_parent_[i], position_in_parent_[j]), parent_quantum_,
            quantum_);
    }

    void write_border() const {
        for (uint32_t i = 0; i < border_; ++i)
            for (uint32_t j = 0; j <= i; ++j)
                tables_.border[i * places_ + place_[j]] = tables_.border[j * places_ + place_[i]] =
                    code_on_border(i, j);
        for (size_t i = 0; i < border_; ++i) repeat_places(tables_.border + i * places_);
    }
    // Places that repeat a vertex have its codes.
    void repeat_places(uint16_t* row) const {
        for (size_t k = 0; k < places_; ++k) row[k] = row[place_[place_position_[k]]];
    }

    void write_owned(const uint16_t* among_owned) const {
        uint16_t* row = tables_.owned;
        for (size_t j = 0; j < border_; ++j)
            for (size_t i = 0; i < owned_; ++i) *row++ = tables_.inner[i * places_ + place_[j]];
        for (size_t i = 0; i < owned_; ++i) {
            row[i * owned_ + i] = 0;
            for (size_t j = 0; j < i; ++j) row[i * owned_ + j] = row[j * owned_ + i] = *among_owned++;
        }
    }

    void write_half_owned(const uint16_t* among_owned) const {
        const auto code = [&](uint32_t i, uint32_t j) {
            return i == j ? uint16_t{0} : among_owned[triangle_size(std::max(i, j)) + std::min(i, j)];
        };
        uint16_t* entry = tables_.owned;
        for (uint32_t i = 0; i < owned_; ++i)
            for (uint32_t j = 0; j < HalfTable::columns(i); ++j)
                *entry++ = j < owned_ ? code(i, j) : TableCode::UNREACHED;
    }

    const OverlayIndex& index_;
    uint32_t patch_, places_, border_, owned_, parent_;
    float parent_quantum_, quantum_;
    std::span<const uint32_t> position_in_parent_; // per position of the border
    const uint16_t* place_;                        // per position of the border: its own place
    const uint16_t* place_position_;               // per place
    OverlayTables tables_;
};

}

void write_overlay_table(const OverlayIndex& index, uint32_t patch, const uint16_t* stored,
                         const OverlayTables& tables) {
    OverlayTableWriter(index, patch, tables).write(stored);
}

}
