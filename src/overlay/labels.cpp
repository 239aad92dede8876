#include "src/overlay/labels.h"

#include <algorithm>
#include <bit>
#include <numeric>
#include <span>

#include "src/overlay/ascend.h"
#include "src/overlay/codes.h"
#include "src/overlay/descend.h"
#include "src/overlay/inner_sweep.h"

namespace geodesic {

namespace {

constexpr size_t SOURCES = InnerSweep::MOST_SOURCES;

void lay_out_labels(const OverlayIndex& index, Labels& labels) {
    labels.offset.assign(index.numbering.patch_count(), 0);
    labels.begin.assign(index.numbering.patch_count(), 0);
    uint64_t size = 0;
    for (uint32_t p = 1; p < index.numbering.patch_count(); ++p) {
        const uint32_t parent = index.numbering.parent[p];
        labels.offset[p] = labels.offset[parent];
        if (index.is_labelled(parent)) labels.offset[p] += Labels::HEAD + index.label_size(parent);
        labels.begin[p] = size;
        size += uint64_t{index.numbering.inner_size(p)} * labels.offset[p];
    }
    labels.codes.assign(size, SourceCode::UNREACHED);
}

// Sweeps from the labelled vertices of a patch's border down to the inner vertices of all its descendants,
// with SOURCES border vertices as sources at a time, and writes the distances into the labels of those inner
// vertices.
class LabelSweep {
public:
    LabelSweep(const OverlayIndex& index, Labels& labels)
        : index_(index), labels_(labels), numbering_(index.numbering),
          sweep_(index, SOURCES, std::pmr::get_default_resource()),
          distances_(SOURCES * index.numbering.vertex_count()), begin_(index.numbering.patch_count()) {}

    void label(uint32_t patch) {
        positions_.resize(index_.label_size(patch));
        if (index_.is_labelled_whole(patch))
            std::iota(positions_.begin(), positions_.end(), 0u);
        else
            std::ranges::copy(index_.pairs.samples.of(patch), positions_.begin());
        lay_out_distances(patch);
        for (size_t first = 0; first < positions_.size(); first += SOURCES) {
            start(patch, first);
            descend_into(numbering_, patch, [&](uint32_t p) { hop_down(p, first); });
        }
        descend_into(numbering_, patch, [&](uint32_t p) { encode(p, patch); });
    }

private:
    void lay_out_distances(uint32_t patch) {
        size_t inside = 0;
        descend_into(numbering_, patch, [&](uint32_t p) {
            begin_[p] = inside * positions_.size();
            inside += numbering_.inner_size(p);
        });
        of_border_.resize(inside * positions_.size());
    }

    // Fills the distances in the patch's overlay from SOURCES labelled vertices, the `first` one and those
    // after it. Behind the last one, it is repeated.
    void start(uint32_t patch, size_t first) {
        for (size_t s = 0; s < SOURCES; ++s)
            for_each_in_overlay(index_, patch, positions_[std::min(first + s, positions_.size() - 1)],
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
        for (uint32_t i = 0; i < count; ++i, to_border += positions_.size())
            std::copy_n(inside + i * SOURCES, std::min(SOURCES, positions_.size() - first), to_border);
    }

    void encode(uint32_t patch, uint32_t labelled) {
        const float quantum = index_.quantum[numbering_.parent[labelled]];
        const size_t size = positions_.size(), step = labels_.offset[patch];
        const float* distance = of_border_.data() + begin_[patch];
        const uint64_t first = labels_.begin[patch] + labels_.offset[labelled];
        for (size_t i = 0; i < numbering_.inner_size(patch); ++i)
            write_label({distance + i * size, size}, quantum, &labels_.codes[first + i * step]);
    }

    static void write_label(std::span<const float> distances, float quantum, int16_t* label) {
        const StepsOf steps(distances, quantum);
        const auto nearest = std::bit_cast<uint32_t>(steps.nearest());
        *label++ = static_cast<int16_t>(nearest & 0xffff);
        *label++ = static_cast<int16_t>(nearest >> 16);
        for (const float distance : distances) *label++ = steps.code_apart(distance);
    }

    const OverlayIndex& index_;
    Labels& labels_;
    const Numbering& numbering_;
    InnerSweep sweep_;
    std::vector<float> distances_; // [number * SOURCES + source], from the current sources
    // From all labelled vertices: a row for each inner vertex of each descendant.
    std::vector<float> of_border_;
    std::vector<size_t> begin_;       // per patch: where its rows begin in of_border_
    std::vector<uint32_t> positions_; // positions of the labelled vertices in the border
};

}

void make_labels(const OverlayIndex& index, Labels& labels) {
    lay_out_labels(index, labels);
    LabelSweep sweep(index, labels);
    for (uint32_t p = 1; index.is_labelled(p); ++p) sweep.label(p);
}

}
