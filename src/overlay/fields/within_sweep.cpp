#include "src/overlay/fields/within_sweep.h"

#include <algorithm>

#include "src/overlay/kernels/near.h"

namespace geodesic {

WithinSweep::WithinSweep(const OverlayIndex& index, std::pmr::memory_resource* memory)
    : index_(index), numbering_(index.numbering), up_(index, memory), down_(index, 1, memory),
      lowering_(index.steep, memory), distance_(index.numbering.vertex_count(), INFINITE, memory),
      seen_(memory), found_(memory) {}

// The overlay of a patch on the way up is known once the hop from its child has been made, so that the way
// down into its other children begins there.
std::span<const WithinSweep::Found> WithinSweep::sweep(const Sources& source, float radius) {
    forget();
    radius_ = radius;
    const uint32_t key = source.keys.front();
    source.for_each_way(index_, key, [&](uint32_t number, float way) { lower(number, way); });
    uint32_t patch = source.innermost_patch(numbering_, key);
    hop_down_to_children(patch, NONE);
    while (patch != 0 && may_cross_border(patch)) {
        hop_up(patch);
        hop_down_to_children(numbering_.parent[patch], patch);
        patch = numbering_.parent[patch];
    }
    take_known(source);
    lower_along_steep_edges();
    if (source.vertex(numbering_, key) == NONE) take_known(source);
    collect();
    return found_;
}

void WithinSweep::take_known(const Sources& source) {
    source.for_each_known(index_, source.keys.front(), 0, numbering_.vertex_count(),
                          [&](const KnownWay& way) {
                              float& distance = distance_[way.number];
                              const float corrected = way.corrected(distance);
                              if (distance == INFINITE && corrected < INFINITE) seen_.push_back(way.number);
                              distance = corrected;
                          });
}

void WithinSweep::lower_along_steep_edges() {
    nearest_beyond_ = lowering_.lower_within(
        radius_, seen_, [&](uint32_t number) { return distance_[number]; },
        [&](uint32_t to, float way, uint32_t) { lower(to, way); });
}

// Also clears what an earlier sweep left when memory ran out.
void WithinSweep::forget() {
    for (const uint32_t number : seen_) distance_[number] = INFINITE;
    seen_.clear();
}

void WithinSweep::lower(uint32_t number, float way) {
    if (!(way < distance_[number])) return;
    if (distance_[number] == INFINITE) seen_.push_back(number);
    distance_[number] = way;
}

// A path may cross the border between two vertices that are both farther than the radius, as InnerSweep has
// it.
bool WithinSweep::may_cross_border(uint32_t patch) const {
    const float farthest = farthest_on_border(radius_, index_.longest_segment[patch]);
    return std::ranges::any_of(numbering_.border_of(patch), [&](uint32_t number) {
        return distance_[number] <= farthest && distance_[number] < INFINITE;
    });
}

// Hops to the overlay of the parent.
void WithinSweep::hop_up(uint32_t child) {
    if (!up_.begin(child, {distance_.data()})) return;
    const std::span<const float> ways = up_.cross();
    const std::span<const uint32_t> targets = up_.targets();
    for (size_t r = 0; r < ways.size(); ++r) lower(targets[r], ways[r]);
}

void WithinSweep::hop_down_to_children(uint32_t patch, uint32_t left_out) {
    if (patch >= numbering_.first_leaf()) return;
    for (uint32_t child = numbering_.child_begin[patch]; child < numbering_.child_begin[patch + 1]; ++child)
        if (child != left_out) hop_down(child);
}

// Hops to the inner vertices of a patch and of the patches inside of it.
void WithinSweep::hop_down(uint32_t patch) {
    if (!may_cross_border(patch)) return;
    if (down_.begin(patch, distance_.data())) {
        const uint32_t first = numbering_.first_inner(patch);
        const std::span<const float> ways = down_.cross();
        for (uint32_t r = 0; r < ways.size(); ++r) lower(first + r, ways[r]);
    }
    hop_down_to_children(patch, NONE);
}

void WithinSweep::collect() {
    found_.clear();
    for (const uint32_t number : seen_)
        if (distance_[number] <= radius_)
            found_.push_back({number, distance_[number]});
        else
            nearest_beyond_ = std::min(nearest_beyond_, distance_[number]);
}

}
