#include "src/overlay/proportion.h"

#include <string>
#include <vector>

#include "format/error.h"
#include "src/overlay/samples.h"

namespace geodesic {

namespace {

// Counts the codes that are derived. No sum wraps around, since a ring has fewer than 2^15 places and there
// are fewer than 2^32 vertices.
class Derived {
public:
    explicit Derived(const OverlayIndex& index)
        : index_(index), numbering_(index.numbering), label_size_(index.numbering.patch_count(), 0) {
        for (uint32_t p = 0; p < index.numbering.patch_count(); ++p)
            samples_.push_back(count_samples(index, p));
    }

    uint64_t outer_and_inner(uint32_t patch) const {
        return index_.rings.size(patch) * (uint64_t{numbering_.overlay_size(numbering_.parent[patch])} +
                                           2 * uint64_t{numbering_.inner_size(patch)});
    }

    uint64_t coarse(uint32_t parent) const { return count_coarse_codes(index_, samples_, parent); }

    // The size of the labels of a patch's inner vertices. It must be called for parents before their
    // children.
    uint64_t labels(uint32_t patch) {
        const uint32_t parent = numbering_.parent[patch];
        const uint32_t size = numbering_.border_size(parent);
        label_size_[patch] = label_size_[parent];
        if (index_.is_labelled(parent))
            label_size_[patch] += Labels::HEAD + (size <= Labels::WHOLE ? size : samples_[parent].samples);
        return uint64_t{numbering_.inner_size(patch)} * label_size_[patch];
    }

private:
    const OverlayIndex& index_;
    const Numbering& numbering_;
    std::vector<SampleCount> samples_; // both are per patch
    std::vector<uint32_t> label_size_;
};

}

uint64_t derived_codes(const OverlayIndex& index) {
    Derived derived(index);
    uint64_t codes = 0;
    for (uint32_t p = 1; p < index.numbering.patch_count(); ++p)
        codes += derived.outer_and_inner(p) + derived.labels(p);
    for (uint32_t p = 0; p < index.numbering.first_leaf(); ++p) codes += derived.coarse(p);
    return codes;
}

uint64_t stored_numbers(const OverlayIndex& index) {
    const Numbering& numbering = index.numbering;
    return numbering.border.size() + numbering.vertex_count() + numbering.overlay_engine_entries();
}

void require_proportion(const OverlayIndex& index) {
    const uint64_t derived = derived_codes(index), stored = stored_numbers(index);
    if (derived > ALWAYS_DERIVED && (derived - ALWAYS_DERIVED) / MOST_DERIVED_EACH > stored)
        throw Error(GEOIDX_ERROR_LIMIT, "the overlay engine would derive " + std::to_string(derived) +
                                            " codes from " + std::to_string(stored) +
                                            " numbers, which is out of proportion");
}

}
