#pragma once

#include <cstdint>
#include <memory_resource>

#include "src/overlay/tables.h"

namespace geodesic {

// The number of codes in the tables of all samples. Needs the rings of the index.
uint64_t count_sample_codes(const OverlayIndex& index);

// Borders that have no more pairs of places than this are crossed as a whole: that takes less time than
// finding the part of them that a path may cross.
constexpr size_t FEW_PAIRS = size_t{1} << 13;

// The rows of a table across, which lead to all samples of one patch.
class RowsAcross {
public:
    explicit RowsAcross(std::pmr::memory_resource* memory) : targets_(memory) {}

    // Chooses the patch. What is given must stay valid until the last row is filled.
    void begin(const OverlayIndex& index, const Samples& samples, uint32_t patch);
    // Fills the row of a sample of a sibling, given by its place.
    void fill(uint32_t sibling, uint16_t from, uint16_t* row) const;

private:
    struct Target {
        uint32_t vertex;
        OverlayColumn column; // of the parent's overlay
    };
    const OverlayIndex* index_ = nullptr;
    uint32_t patch_ = 0;
    Array<Target> targets_;
};

// Fills empty `samples` of an index that has its rings and overlay tables.
void make_samples(const OverlayIndex& index, Samples& samples);

}
