#include "src/overlay/labels.h"

#include <algorithm>
#include <bit>
#include <limits>
#include <numeric>
#include <span>

#include "src/overlay/codes.h"
#include "src/overlay/inner_sweep.h"

namespace geodesic {

namespace {

constexpr size_t SOURCES = InnerSweep::MOST_SOURCES;

void lay_out_labels(OverlayIndex& index) {
    index.labels.offset.assign(index.numbering.patch_count(), 0);
    index.labels.begin.assign(index.numbering.patch_count(), 0);
    uint64_t size = 0;
    for (uint32_t p = 1; p < index.numbering.patch_count(); ++p) {
        const uint32_t parent = index.numbering.parent[p];
        if (parent != 0)
            index.labels.offset[p] = index.labels.offset[parent] + Labels::HEAD + index.label_size(parent);
        index.labels.begin[p] = size;
        size += uint64_t{index.numbering.inner_size(p)} * index.labels.offset[p];
    }
    index.labels.codes.assign(size, SourceCode::UNREACHED);
}

// Sweeps from the labelled vertices of a patch's border down to the inner vertices of all its descendants,
// with SOURCES border vertices as sources at a time, and writes the distances into the labels of those inner
// vertices.
class LabelSweep {
public:
    explicit LabelSweep(OverlayIndex& index)
        : index_(index), numbering_(index.numbering),
          sweep_(index, SOURCES, std::pmr::get_default_resource()),
          distances_(SOURCES * index.numbering.vertex_count()) {}

    void label(uint32_t patch) {
        descendants_.clear();
        add_descendants(patch);
        positions_.resize(index_.label_size(patch));
        if (index_.is_labelled_whole(patch))
            std::iota(positions_.begin(), positions_.end(), 0u);
        else
            std::ranges::copy(index_.samples.of(patch), positions_.begin());
        lay_out_distances();
        for (size_t first = 0; first < positions_.size(); first += SOURCES) {
            start(patch, std::span(positions_).subspan(first, std::min(SOURCES, positions_.size() - first)));
            for (uint32_t p : descendants_) descend(p, first);
        }
        for (uint32_t p : descendants_) encode(p, patch);
    }

private:
    void add_descendants(uint32_t patch) {
        if (patch >= numbering_.first_leaf()) return;
        for (uint32_t child = numbering_.child_begin[patch]; child < numbering_.child_begin[patch + 1];
             ++child) {
            descendants_.push_back(child);
            add_descendants(child);
        }
    }

    void lay_out_distances() {
        size_t inside = 0;
        begin_.resize(numbering_.patch_count());
        for (uint32_t p : descendants_) {
            begin_[p] = inside * positions_.size();
            inside += numbering_.inner_size(p);
        }
        of_border_.resize(inside * positions_.size());
    }

    // Fills the distances in the patch's overlay, with the border vertices at these positions as sources. If
    // there are fewer than SOURCES, the last one is repeated.
    void start(uint32_t patch, std::span<const uint32_t> positions) {
        count_ = positions.size();
        for (uint32_t i = 0; i < numbering_.overlay_size(patch); ++i) {
            float* distance = distances_.data() + size_t{numbering_.overlay_number(patch, i)} * SOURCES;
            for (size_t s = 0; s < SOURCES; ++s) {
                const uint32_t position = positions[std::min(s, count_ - 1)];
                distance[s] =
                    i == position ? 0 : index_.distance(index_.overlay_code(patch, i, position), patch);
            }
        }
    }

    void descend(uint32_t patch, size_t first) {
        const uint32_t count = numbering_.inner_size(patch);
        if (count == 0) return;
        float* const inside = distances_.data() + size_t{numbering_.first_inner(patch)} * SOURCES;
        if (sweep_.begin(patch, distances_.data()) < INFINITE)
            sweep_.cross(inside);
        else
            std::fill_n(inside, count * SOURCES, INFINITE);
        float* to_border = of_border_.data() + begin_[patch] + first;
        for (uint32_t i = 0; i < count; ++i, to_border += positions_.size())
            std::copy_n(inside + i * SOURCES, count_, to_border);
    }

    void encode(uint32_t patch, uint32_t labelled) {
        const uint32_t count = numbering_.inner_size(patch);
        if (count == 0) return;
        const float quantum = index_.quantum[numbering_.parent[labelled]];
        const float* distance = of_border_.data() + begin_[patch];
        int16_t* label =
            index_.labels.codes.data() + index_.labels.begin[patch] + index_.labels.offset[labelled];
        for (uint32_t i = 0; i < count; ++i) {
            write_label({distance, positions_.size()}, quantum, label);
            distance += positions_.size();
            label += index_.labels.offset[patch];
        }
    }

    static void write_label(std::span<const float> distances, float quantum, int16_t* label) {
        const StepsOf steps(distances, quantum);
        const auto nearest = std::bit_cast<uint32_t>(steps.nearest());
        *label++ = static_cast<int16_t>(nearest & 0xffff);
        *label++ = static_cast<int16_t>(nearest >> 16);
        // Only a distance of 0 is 0 steps, so that different vertices stay apart.
        const bool is_apart = steps.nearest() > 0;
        for (const float distance : distances)
            *label++ =
                std::max(steps.code(distance),
                         static_cast<int16_t>(SourceCode::NEAREST + (is_apart || distance == 0 ? 0 : 1)));
    }

    OverlayIndex& index_;
    const Numbering& numbering_;
    InnerSweep sweep_;
    size_t count_ = 0;
    std::vector<float> distances_; // [number * SOURCES + source], from the current sources
    // From all labelled vertices: a row for each inner vertex of each descendant.
    std::vector<float> of_border_;
    std::vector<size_t> begin_; // per patch: where its rows begin in of_border_
    std::vector<uint32_t> descendants_;
    std::vector<uint32_t> positions_; // positions of the labelled vertices in the border
};

}

void make_labels(OverlayIndex& index, const std::function<void()>& look_up) {
    lay_out_labels(index);
    LabelSweep sweep(index);
    for (uint32_t p = 1; p < index.numbering.first_leaf(); ++p) {
        sweep.label(p);
        look_up();
    }
}

}
