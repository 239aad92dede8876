#pragma once

#include <memory_resource>
#include <span>

#include "src/overlay/sssd/ascent.h"
#include "src/overlay/sssd/samples.h"
#include "src/overlay/tables/tables.h"

namespace geodesic {

// The distances of one end from the samples of all borders of its ascent, by ways over samples only. Borders
// are counted from the innermost one, and samples from the first one of their border. Over borders without
// segments these are the distances.
class SampledAscent {
public:
    SampledAscent(const OverlayIndex& index, std::pmr::memory_resource* memory);

    // Hops from border to border. The index must have its samples.
    void climb(const Ascent& ascent);

    // Hops from the samples of the last border to those of a sibling's border, which is then the last one.
    void hop_across(const Ascent& ascent, uint32_t sibling);

    // The distances from the samples of a border, and of the last one.
    std::span<const float> distances(size_t border) const {
        return {distances_of(border), samples_of(borders_[border]).size()};
    }
    std::span<const float> last_distances() const { return distances(borders_.size() - 1); }

    // The sample, of the border before, that the way to a sample of a border comes over. There must be a way.
    uint32_t sample_before(size_t border, uint32_t sample) const {
        return winners_[border * stride_ + sample];
    }

    // How long the way to a sample of a border is over a sample of the border before.
    float way_over(size_t border, uint32_t before, uint32_t sample) const;

    // `rest` has the distances of the other end from the samples of the last border. Hops from these back to
    // all borders before, so that ways_over() has the length of the whole way between both ends over each
    // sample. Unlike those of climb(), hops back are not straightened over long segments.
    void go_back(std::span<const float> rest);
    std::span<const float> ways_over(size_t border) const {
        return {ways_.data() + border * stride_, samples_of(borders_[border]).size()};
    }

private:
    // A border, and the table that the hop to it reads, with its quantum: a row for each sample of the border
    // before, with one entry for each of its own samples.
    struct Border {
        uint32_t patch = 0;
        float quantum = 0;
        const uint16_t* table = nullptr;
    };

    std::span<const uint16_t> samples_of(const Border& border) const {
        return index_.pairs.samples.of(border.patch);
    }

    float* distances_of(size_t border) { return distances_.data() + border * stride_; }
    const float* distances_of(size_t border) const { return distances_.data() + border * stride_; }
    void hop(const Border& to);
    void hop_back(size_t border);
    const uint16_t* make_rows_across(uint32_t patch, uint32_t sibling);
    void keep_common(uint32_t before);
    void measure_over_vertices();

    const OverlayIndex& index_;
    const size_t stride_; // room for what there is of one border, in whole blocks
    Array<Border> borders_;
    Array<float> distances_;
    Array<uint16_t> winners_;
    Array<float> ways_;
    RowsAcross rows_across_; // where there is no table across:
    Array<uint16_t> across_; // the rows that are made in its place
    Array<int16_t> codes_;   // scratch of a hop
    // Of hops back, which sweep, over samples and over no middles; gaps_ and no_strides_ stay as they are:
    Array<float> gaps_, middles_;
    Array<int16_t> middle_codes_, no_strides_;
};

}
