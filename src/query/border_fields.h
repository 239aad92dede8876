#pragma once

#include <array>
#include <memory_resource>
#include <span>

#include "src/index/index.h"
#include "src/query/crossing.h"

namespace geodesic {

// The distances of several sources from the border of one patch after the other, and across it to what lies
// inside.
class BorderFields {
public:
    static constexpr size_t SOURCES = SeenBorders::SOURCES;

    BorderFields(const Index& index, std::pmr::memory_resource* memory);

    // From the border of a patch, with distances[number * SOURCES + i] from the i-th source. Returns whether
    // any source reaches any vertex of it.
    bool see(uint32_t patch, const float* distances);

    // To what lies one hop inside of that patch, if see() returned true: inside[i * SOURCES + source].
    void cross(float* inside);

private:
    void gather(const uint32_t* vertices, const float* distances);
    void lower_near(size_t source, Rows rows, float* inside);
    void copy_source(size_t from, size_t to);

    const Index& index_;
    const Rings& rings_;
    const CrossingKernel& kernel_;
    uint32_t patch_ = 0;
    SeenBorders borders_{};
    std::array<Sight, SOURCES> sights_{};
    std::array<bool, SOURCES> is_reached_{};
    bool all_reached_ = false;
    Array<float> distance_, foot_, height_; // of one source after the other
    Array<int16_t> code_;                   // of all sources, by place
    Array<int16_t> code_of_one_;
    Array<float> of_one_; // per row
    Array<const uint16_t*> rows_;
};

}
