#include "src/query/border_fields.h"

#include <algorithm>
#include <cstring>
#include <limits>

#include "src/query/four_at_a_time.h"
#include "src/query/lanes.h"

namespace geodesic {

namespace {

constexpr float INFINITE = std::numeric_limits<float>::infinity();
constexpr size_t BLOCK = SeenBorder::BLOCK;

// From one source's places to the next one's.
constexpr size_t stride_of(size_t places) { return SeenBorder::whole_blocks(places) + BLOCK; }

}

BorderFields::BorderFields(const Index& index, std::pmr::memory_resource* memory)
    : index_(index), rings_(index.overlay_tables.rings), kernel_(crossing_kernels().back()),
      distance_(memory), foot_(memory), height_(memory), code_(memory), code_of_one_(memory), of_one_(memory),
      rows_(memory) {
    const size_t most = stride_of(rings_.largest_size());
    for (Array<float>* of_each : {&distance_, &foot_, &height_}) of_each->resize(SOURCES * most);
    code_.resize(SOURCES * most);
    code_of_one_.resize(most);
    for (uint32_t p = 0; p < index.patch_count(); ++p)
        rows_.resize(std::max<size_t>(rows_.size(), index.inner_size(p)));
    of_one_.resize(rows_.size());
}

bool BorderFields::see(uint32_t patch, const float* distances) {
    patch_ = patch;
    const uint32_t first = rings_.begin[patch], places = rings_.size(patch);
    const SeenBorder border{places,
                            code_of_one_.data(),
                            distance_.data(),
                            rings_.segment_length.data() + first,
                            rings_.half_inverse.data() + first,
                            foot_.data(),
                            height_.data(),
                            index_.overlay_tables.quantum[patch]};
    borders_ = {border, stride_of(places), code_.data()};
    gather(rings_.vertex.data() + first, distances);
    size_t reached = SOURCES; // a source that is
    for (size_t i = 0; i < SOURCES; ++i) {
        const size_t begin = i * borders_.stride;
        SeenBorder of_source = border;
        of_source.distance += begin;
        sights_[i] = kernel_.see(of_source, rings_.is_own.data() + first, code_of_one_.data(),
                                 foot_.data() + begin, height_.data() + begin);
        is_reached_[i] = sights_[i].nearest < INFINITE;
        if (!is_reached_[i]) continue;
        reached = i;
        for (size_t k = 0; k < places; ++k) code_[k * SOURCES + i] = code_of_one_[k];
    }
    if (reached == SOURCES) return false;
    all_reached_ = std::ranges::find(is_reached_, false) == is_reached_.end();
    for (size_t i = 0; i < SOURCES && !all_reached_; ++i)
        if (!is_reached_[i]) copy_source(reached, i);
    return true;
}

void BorderFields::gather(const uint32_t* vertices, const float* distances) {
    const size_t places = borders_.first.places, stride = borders_.stride;
    for (size_t k = 0; k < places; k += 4)
        for (size_t i = 0; i < SOURCES; i += 4) {
            NearFloats four[4];
            for (size_t j = 0; j < 4; ++j)
                four[j] = near_floats(distances + size_t{vertices[k + j]} * SOURCES + i);
            transpose(four);
            for (size_t j = 0; j < 4; ++j)
                std::memcpy(distance_.data() + (i + j) * stride + k, &four[j], sizeof four[j]);
        }
    for (size_t i = 0; i < SOURCES; ++i) std::fill_n(distance_.data() + i * stride + places, BLOCK, INFINITE);
}

// So that no source is without a way, which takes long.
void BorderFields::copy_source(size_t from, size_t to) {
    const size_t places = borders_.first.places, stride = borders_.stride;
    for (Array<float>* of_each : {&distance_, &foot_, &height_})
        std::copy_n(of_each->data() + from * stride, stride, of_each->data() + to * stride);
    for (size_t k = 0; k < places; ++k) code_[k * SOURCES + to] = code_[k * SOURCES + from];
}

// As it is done for one source alone.
void BorderFields::lower_near(size_t source, Rows rows, float* inside) {
    SeenBorder border = borders_.first;
    for (const float** of_source : {&border.distance, &border.foot, &border.height})
        *of_source += source * borders_.stride;
    for (size_t r = 0; r < rows.size(); ++r) of_one_[r] = inside[r * SOURCES];
    kernel_.lower_near(border, sights_[source], rows, of_one_.data());
    for (size_t r = 0; r < rows.size(); ++r) inside[r * SOURCES] = of_one_[r];
}

void BorderFields::cross(float* inside) {
    const uint32_t count = index_.inner_size(patch_), places = rings_.size(patch_);
    const uint16_t* row = index_.overlay_tables.inner_tables.data() + index_.inner_row(patch_, 0);
    four_at_a_time(count, [&](size_t i) { rows_[i] = row + i * places; });
    kernel_.cross_each(borders_, {rows_.data(), count}, inside);
    for (size_t i = 0; i < SOURCES; ++i)
        if (is_reached_[i] && sights_[i].is_near()) lower_near(i, {rows_.data(), count}, inside + i);
    if (all_reached_) return;
    for (size_t r = 0; r < count; ++r)
        for (size_t i = 0; i < SOURCES; ++i)
            if (!is_reached_[i]) inside[r * SOURCES + i] = INFINITE;
}

}
