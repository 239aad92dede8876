#include "src/tables/rounding.h"

#include <algorithm>
#include <cmath>

#include "src/base/quantiles.h"
#include "src/overlay/tables/codes.h"

namespace geodesic {

namespace {

// Looks at the tables of one patch after the other, those of outer patches first.
class PatchScales {
public:
    PatchScales(const Numbering& numbering, const DistanceTables& tables)
        : numbering_(numbering), tables_(tables), farthest_of_(numbering.vertex_count(), 0.f) {}

    // Looks at the next patch.
    void look_at(uint32_t patch) {
        const bool is_leaf = patch >= numbering_.first_leaf();
        const uint32_t count = is_leaf ? numbering_.internal_size(patch) : numbering_.overlay_size(patch);
        nearest_.assign(count, INFINITE);
        farthest_.assign(count, 0);
        if (is_leaf)
            look_at_leaf(patch, count);
        else
            look_at_overlay(patch, count);
        for (uint32_t i = 0; i < count; ++i) {
            const uint32_t number =
                is_leaf ? numbering_.first_internal(patch) + i : numbering_.overlay_number(patch, i);
            farthest_of_[number] = std::max(farthest_of_[number], farthest_[i]);
        }
    }

    // The distance of neighbours in the tables of the patch that was looked at last.
    float spacing() const {
        std::vector<float> nearest(nearest_);
        std::erase(nearest, INFINITE);
        return lower_quartile(std::move(nearest));
    }

    // How long ways from its vertices are, those that lead out of the patch included.
    float reach() const {
        std::vector<float> farthest(farthest_);
        std::erase(farthest, 0.f);
        return lower_quartile(std::move(farthest));
    }

private:
    // From vertex i of the patch to another one, from which it is not farther to anywhere than `beyond`.
    void look_at(uint32_t i, float distance, float beyond) {
        if (distance == INFINITE) return;
        if (distance > 0) nearest_[i] = std::min(nearest_[i], distance);
        farthest_[i] = std::max({farthest_[i], distance, beyond});
    }

    void look_at_overlay(uint32_t patch, uint32_t count) {
        const float* entry = tables_.overlay[patch].data();
        for (uint32_t i = 0; i < count; ++i)
            for (uint32_t j = 0; j < count; ++j)
                look_at(i, *entry++, farthest_of_[numbering_.overlay_number(patch, j)]);
    }

    void look_at_leaf(uint32_t leaf, uint32_t count) {
        if (count == 0) return;
        const float* to_border =
            tables_.border_internal.data() + numbering_.border_internal_entry(leaf, 0, 0);
        for (const uint32_t b : numbering_.border_of(leaf))
            for (uint32_t i = 0; i < count; ++i) look_at(i, *to_border++, farthest_of_[b]);
        for (uint32_t i = 0; i < count; ++i)
            for (uint32_t j = 0; j < i; ++j) {
                const float distance = tables_.internal[numbering_.internal_entry(leaf, i, j)];
                look_at(i, distance, 0);
                look_at(j, distance, 0);
            }
    }

    const Numbering& numbering_;
    const DistanceTables& tables_;
    std::vector<float> farthest_of_;        // per number
    std::vector<float> nearest_, farthest_; // of the patch: per overlay position or internal vertex
};

}

std::vector<float> rounding_of_patches(const Numbering& numbering, const DistanceTables& tables,
                                       double rounding) {
    std::vector<float> wanted(numbering.patch_count(), 0);
    constexpr uint64_t FEW_ENTRIES = 1 << 16;
    constexpr double STEPS_OF_LONGEST = 8192;
    if (rounding == 0 || numbering.overlay_engine_entries() < FEW_ENTRIES) return wanted;
    PatchScales scales(numbering, tables);
    for (uint32_t p = 0; p < numbering.patch_count(); ++p) {
        scales.look_at(p);
        wanted[p] = static_cast<float>(
            std::min(rounding * double{scales.spacing()}, double{scales.reach()} / STEPS_OF_LONGEST));
    }
    return wanted;
}

Steps choose_steps(float longest, float wanted) {
    const double smallest = double{longest} / TableCode::LARGEST;
    if (!(double{wanted} > smallest)) return {static_cast<float>(smallest), 0};
    // Of the longest distance, as it will be rounded: this times 2^shift must be a code.
    const double steps = std::round(double{longest} / double{wanted});
    uint8_t shift = 0;
    while (shift < TableCode::MOST_SHIFT && steps <= TableCode::LARGEST >> (shift + 1)) ++shift;
    return {static_cast<float>(std::ldexp(double{wanted}, -shift)), shift};
}

}
