#include "src/index/proportion.h"

#include <string>
#include <vector>

#include "format/error.h"
#include "src/index/coarse_tables.h"

namespace geodesic {

namespace {

// None of the sums wraps around: a ring has fewer than 2^15 places, and there are fewer than 2^32 vertices.
class Derived {
public:
    explicit Derived(const Index& index) : index_(index), label_size_(index.patch_count(), 0) {
        for (uint32_t p = 0; p < index.patch_count(); ++p) samples_.push_back(count_samples(index, p));
    }

    uint64_t outer_and_inner(uint32_t patch) const {
        return index_.ring_size(patch) *
               (uint64_t{index_.overlay_size(index_.parent[patch])} + 2 * uint64_t{index_.inner_size(patch)});
    }

    uint64_t coarse(uint32_t parent) const {
        uint64_t rows = samples_[parent].samples, places = 0;
        for (uint32_t child = index_.child_begin[parent]; child < index_.child_begin[parent + 1]; ++child) {
            rows += samples_[child].samples;
            if (samples_[child].places < index_.ring_size(child)) places += samples_[child].places;
        }
        return rows * places;
    }

    // Of what lies just inside of a patch; parents come first.
    uint64_t labels(uint32_t patch) {
        const uint32_t parent = index_.parent[patch];
        if (parent == 0) return 0;
        const uint32_t size = index_.border_size(parent);
        label_size_[patch] = label_size_[parent] + OverlayTables::LABEL_HEAD +
                             (size <= OverlayTables::LABELLED_WHOLE ? size : samples_[parent].samples);
        return uint64_t{index_.inner_size(patch)} * label_size_[patch];
    }

private:
    const Index& index_;
    std::vector<SampleCount> samples_; // per patch, as is this
    std::vector<uint32_t> label_size_;
};

}

uint64_t derived_codes(const Index& index) {
    Derived derived(index);
    uint64_t codes = 0;
    for (uint32_t p = 1; p < index.patch_count(); ++p)
        codes += derived.outer_and_inner(p) + derived.labels(p);
    for (uint32_t p = 0; p < index.first_leaf(); ++p) codes += derived.coarse(p);
    return codes;
}

uint64_t stored_numbers(const Index& index) {
    uint64_t numbers = index.border.size() + index.vertex_count();
    for (uint32_t p = 0; p < index.first_leaf(); ++p) numbers += index.overlay_entries(p);
    return numbers + index.crossing_table_begin.back() + index.internal_table_begin.back();
}

void require_proportion(const Index& index) {
    const uint64_t derived = derived_codes(index), stored = stored_numbers(index);
    if (derived > ALWAYS_DERIVED && (derived - ALWAYS_DERIVED) / MOST_DERIVED_EACH > stored)
        throw Error(GEOIDX_ERROR_LIMIT, "the overlay engine would derive " + std::to_string(derived) +
                                            " codes from " + std::to_string(stored) +
                                            " numbers, which is out of proportion");
}

}
