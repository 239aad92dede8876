#include "src/query/border_field.h"

#include <algorithm>
#include <cstring>
#include <limits>

#include "src/index/unfolding.h"

namespace geodesic {

namespace {

constexpr float INFINITE = std::numeric_limits<float>::infinity();
constexpr size_t BLOCK = SeenBorder::BLOCK;
constexpr size_t whole_blocks(size_t places) { return (places + BLOCK - 1) / BLOCK * BLOCK; }
static_assert(OverlayTables::PADDING >= BLOCK && Rings::PADDING >= BLOCK,
              "the last row of a table is read in whole blocks");

}

BorderField::BorderField(const Index& index, std::pmr::memory_resource* memory)
    : distance_(whole_blocks(index.overlay_tables.rings.largest_size()) + 4, memory),
      code_(distance_.size(), memory), foot_(distance_.size(), memory), height_(distance_.size(), memory) {}

bool BorderField::finish() {
    std::fill_n(distance_.data() + border_.places, 4, INFINITE); // a vector may end there
    nearest_ = INFINITE;
    for (size_t k = 0; k < border_.places; ++k) nearest_ = std::min(nearest_, distance_[k]);
    if (nearest_ == INFINITE) return false;
    encode();
    unfold();
    return true;
}

void BorderField::encode() {
    using Numbers [[gnu::vector_size(sizeof(NearFloats))]] = int32_t;
    using Codes [[gnu::vector_size(sizeof(NearFloats) / 2)]] = int16_t;
    const NearFloats largest = NearFloats{} + float{OverlayTables::LARGEST};
    const float scale = border_.quantum > 0 ? 1 / border_.quantum : 0;
    const size_t places = border_.places;
    for (size_t k = 0; k < places; k += 4) {
        const NearFloats distance = near_floats(distance_.data() + k);
        const NearFloats steps = (distance - nearest_) * scale + 0.5f;
        Numbers own;
        std::memcpy(&own, is_own_ + k, sizeof own);
        const Numbers code =
            __builtin_convertvector(steps < largest ? steps : largest, Numbers) + SeenBorder::NEAREST;
        const Codes codes = __builtin_convertvector(
            distance < INFINITE ? code & own : Numbers{} + SeenBorder::NOT_SEEN, Codes);
        std::memcpy(code_.data() + k, &codes, sizeof codes);
    }
    std::fill(code_.data() + places, code_.data() + whole_blocks(places), SeenBorder::NOT_SEEN);
}

void BorderField::unfold() {
    for (size_t k = 0; k < border_.places; k += 4) {
        const Segments<NearFloats> segments{near_floats(border_.length + k),
                                            near_floats(border_.half_inverse + k)};
        NearFloats foot, height;
        segments.place_point(near_floats(distance_.data() + k), near_floats(distance_.data() + k + 1), foot,
                             height);
        std::memcpy(foot_.data() + k, &foot, sizeof foot);
        std::memcpy(height_.data() + k, &height, sizeof height);
    }
}

}
