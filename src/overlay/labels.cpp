#include "src/overlay/labels.h"

#include <algorithm>
#include <bit>
#include <memory_resource>
#include <span>
#include <vector>

#include "src/overlay/ascend.h"
#include "src/overlay/codes.h"
#include "src/overlay/descend.h"
#include "src/overlay/inner_sweep.h"

namespace geodesic {

namespace {

constexpr size_t SOURCES = InnerSweep::MOST_SOURCES;

// A labelled border has at most so many places.
constexpr uint32_t MOST_PLACES = 200;

// Calls use(patch) for each patch to be labelled.
template <class Use>
void for_each_labelled(const OverlayIndex& index, const Use& use) {
    const Numbering& numbering = index.numbering;
    std::vector<uint8_t> is_inside(numbering.patch_count(), 0); // of a labelled patch
    for (uint32_t p = 1; p < numbering.first_leaf(); ++p) {
        const uint32_t places = index.rings.size(p);
        is_inside[p] = is_inside[numbering.parent[p]];
        if (is_inside[p] || places == 0 || places > MOST_PLACES) continue;
        is_inside[p] = 1;
        use(p);
    }
}

// Calls use(patch, inside, begin) for each patch to be labelled and each patch inside of it, where the labels
// of that patch's inner vertices begin. Returns where the last ones end.
template <class Use>
uint64_t lay_out_labels(const OverlayIndex& index, const Use& use) {
    uint64_t codes = 0;
    for_each_labelled(index, [&](uint32_t patch) {
        descend_into(index.numbering, patch, [&](uint32_t inside) {
            use(patch, inside, codes);
            codes += uint64_t{index.numbering.inner_size(inside)} * index.rings.size(patch);
        });
    });
    return codes;
}

// Sweeps from the border of a patch down to the inner vertices of all its descendants, with SOURCES border
// vertices as sources at a time, and writes the distances into the labels of those inner vertices.
class LabelSweep {
public:
    LabelSweep(const OverlayIndex& index, Labels& labels, std::pmr::memory_resource* memory)
        : index_(index), labels_(labels), numbering_(index.numbering), sweep_(index, SOURCES, memory),
          distances_(SOURCES * index.numbering.vertex_count(), memory), of_border_(memory),
          begin_(index.numbering.patch_count(), memory), codes_(memory) {}

    void label(uint32_t patch) {
        lay_out_distances(patch);
        if (of_border_.empty()) return; // No vertex lies deeper.
        for (size_t first = 0; first < border_size_; first += SOURCES) {
            start(patch, first);
            descend_into(numbering_, patch, [&](uint32_t p) { hop_down(p, first); });
        }
        const float quantum = quantum_of_distances();
        labels_.quantum[patch] = quantum;
        descend_into(numbering_, patch, [&](uint32_t p) { encode(p, patch, quantum); });
    }

private:
    void lay_out_distances(uint32_t patch) {
        border_size_ = numbering_.border_size(patch);
        size_t inside = 0;
        descend_into(numbering_, patch, [&](uint32_t p) {
            begin_[p] = inside * border_size_;
            inside += numbering_.inner_size(p);
        });
        of_border_.resize(inside * border_size_);
    }

    // Fills the distances in the patch's overlay from SOURCES border vertices, the `first` one and those
    // after it. Behind the last one, it is repeated.
    void start(uint32_t patch, size_t first) {
        for (size_t s = 0; s < SOURCES; ++s)
            for_each_in_overlay(index_, patch, static_cast<uint32_t>(std::min(first + s, border_size_ - 1)),
                                [&](uint32_t number, float distance) {
                                    distances_[size_t{number} * SOURCES + s] = distance;
                                });
    }

    void hop_down(uint32_t patch, size_t first) {
        const uint32_t count = numbering_.inner_size(patch);
        float* const inside = distances_.data() + size_t{numbering_.first_inner(patch)} * SOURCES;
        if (sweep_.begin(patch, distances_.data()))
            sweep_.cross_to(inside);
        else
            std::fill_n(inside, count * SOURCES, INFINITE);
        float* to_border = of_border_.data() + begin_[patch] + first;
        for (uint32_t i = 0; i < count; ++i, to_border += border_size_)
            std::copy_n(inside + i * SOURCES, std::min(SOURCES, border_size_ - first), to_border);
    }

    // So that the longest one has the largest code. (Distances compare as their bits do, which is quicker.)
    float quantum_of_distances() const {
        constexpr auto NONE_LONGER = std::bit_cast<int32_t>(INFINITE);
        int32_t longest = 0;
        for (const float distance : of_border_) {
            const auto bits = std::bit_cast<int32_t>(distance);
            longest = std::max(longest, bits < NONE_LONGER ? bits : 0);
        }
        return std::bit_cast<float>(longest) / TableCode::LARGEST;
    }

    void encode(uint32_t patch, uint32_t labelled, float quantum) {
        const size_t count = numbering_.inner_size(patch);
        codes_.resize(count * border_size_);
        TableCode::round_all({of_border_.data() + begin_[patch], codes_.size()}, steps_per_distance(quantum),
                             codes_.data());
        const uint32_t* position = index_.rings.position.data() + index_.rings.begin[labelled];
        const uint32_t places = index_.rings.size(labelled);
        uint16_t* code = labels_.codes.data() + labels_.begin[patch];
        for (size_t row = 0; row < codes_.size(); row += border_size_)
            for (uint32_t k = 0; k < places; ++k) *code++ = codes_[row + position[k]];
    }

    const OverlayIndex& index_;
    Labels& labels_;
    const Numbering& numbering_;
    InnerSweep sweep_;
    Array<float> distances_; // [number * SOURCES + source], from the current sources
    // From the whole border: a row for each inner vertex of each descendant.
    Array<float> of_border_;
    Array<size_t> begin_; // per patch: where its rows begin in of_border_
    size_t border_size_ = 0;
    Array<uint16_t> codes_; // of the rows of one patch, by border vertices
};

}

uint64_t count_label_codes(const OverlayIndex& index) {
    return lay_out_labels(index, [](uint32_t, uint32_t, uint64_t) {});
}

void make_labels(const OverlayIndex& index, bool with_labels, Labels& labels) {
    const Numbering& numbering = index.numbering;
    labels.is_labelled.assign(numbering.patch_count(), 0);
    if (!with_labels) return;
    labels.quantum.assign(numbering.patch_count(), 0.f);
    labels.begin.assign(numbering.patch_count(), 0);
    const uint64_t codes = lay_out_labels(index, [&](uint32_t patch, uint32_t inside, uint64_t begin) {
        labels.is_labelled[patch] = 1;
        labels.begin[inside] = begin;
    });
    if (codes == 0) return;
    labels.codes.resize(codes + TableCode::PADDING);
    LabelSweep sweep(index, labels, labels.codes.get_allocator().resource());
    for_each_labelled(index, [&](uint32_t patch) { sweep.label(patch); });
}

}
