#include "src/overlay/sssd/prepared_source.h"

#include <algorithm>

#include "src/base/four_at_a_time.h"
#include "src/overlay/tables/ring_segments.h"

namespace geodesic {

void PreparedSource::prepare(uint32_t vertex) {
    begin(index_.numbering.innermost_patch(vertex));
    point_.reset();
    for_each_way_from(index_, vertex, [&](uint32_t number, float way) { known_[number] = way; });
}

// The distances of internal vertices of the leaf follow where they are asked for.
void PreparedSource::prepare(const FacePoint& point) {
    begin(point.leaf);
    point_ = point;
    const auto border = index_.numbering.border_of(innermost_);
    const auto to_border = in_leaf_.to_border(point);
    for (size_t i = 0; i < border.size(); ++i) known_[border[i]] = to_border[i];
}

// The distances of internal vertices are read in the source's own leaf only.
void PreparedSource::begin(uint32_t innermost) {
    if (known_.empty())
        make_room();
    else
        forget();
    innermost_ = innermost;
    begin_border(innermost);
}

void PreparedSource::make_room() {
    const Numbering& numbering = index_.numbering;
    for (auto* is_known : {&is_inner_known_, &is_border_known_}) is_known->resize(numbering.patch_count());
    begun_.reserve(numbering.patch_count());
    kept_begin_.resize(numbering.patch_count(), NONE);
    code_.resize(SourceCode::whole_blocks(index_.rings.largest_size()));
    known_.resize(numbering.vertex_count(), INFINITE); // last: begin() takes it for all
}

// Only what the last source made known, since most sources ask for few patches; or else everything, where
// that is less.
void PreparedSource::forget() {
    const Numbering& numbering = index_.numbering;
    const uint32_t borders = numbering.border_vertex_count();
    uint64_t on_begun = 0;
    for (const uint32_t patch : begun_) on_begun += numbering.border_size(patch);
    if (on_begun > borders) std::fill_n(known_.begin(), borders, INFINITE);
    for (const uint32_t patch : begun_) {
        if (on_begun <= borders) forget(patch);
        is_inner_known_[patch] = is_border_known_[patch] = 0;
        kept_begin_[patch] = NONE;
    }
    begun_.clear();
    kept_.clear();
}

void PreparedSource::forget(uint32_t patch) {
    const Numbering& numbering = index_.numbering;
    for (const uint32_t vertex : numbering.border_of(patch)) known_[vertex] = INFINITE;
    if (is_inner_known_[patch] || patch == innermost_)
        std::fill_n(known_.begin() + numbering.first_inner(patch), numbering.inner_size(patch), INFINITE);
}

void PreparedSource::begin_border(uint32_t patch) {
    begun_.push_back(patch);
    is_border_known_[patch] = 1;
}

// The one that the innermost patch is, or lies in; not of the innermost patch itself.
uint32_t PreparedSource::child_around_source(uint32_t patch) const {
    uint32_t child = innermost_;
    while (index_.numbering.parent[child] != patch) child = index_.numbering.parent[child];
    return child;
}

// The overlay of the innermost patch is known. Of any other patch around the source only the borders of those
// children become known that targets need.
void PreparedSource::require(uint32_t border_vertex, OverlaySsad& field) {
    const Numbering& numbering = index_.numbering;
    const uint32_t owner = numbering.owner[border_vertex];
    if (owner == innermost_) return;
    if (!is_around_source(owner)) return require_inner(owner, field);
    const auto is_of_child = [&](const PatchPosition& at) { return numbering.parent[at.patch] == owner; };
    require_border(std::ranges::find_if(numbering.borders_of(border_vertex), is_of_child)->patch, field);
}

void PreparedSource::require_border(uint32_t patch, OverlaySsad& field) {
    if (is_border_known_[patch]) return;
    const uint32_t parent = index_.numbering.parent[patch];
    if (!is_around_source(parent)) {
        require_inner(parent, field);
    } else if (parent != innermost_) {
        const uint32_t child = child_around_source(is_around_source(patch) ? patch : parent);
        require_border(child, field);
        field.hop_to_border(child, patch, known_);
    }
    begin_border(patch);
}

// Of a patch that is not around the source: down from its border.
void PreparedSource::require_inner(uint32_t patch, OverlaySsad& field) {
    if (is_inner_known_[patch]) return;
    require_border(patch, field);
    field.hop_down(patch, known_);
    is_inner_known_[patch] = 1;
}

// A border vertex that is known has its final distance, whichever border it became known with.
float PreparedSource::distance(uint32_t target, OverlaySsad& field) {
    if (index_.numbering.is_border(target)) {
        if (!(known_[target] < INFINITE)) require(target, field);
        return known_[target];
    }
    const uint32_t leaf = index_.numbering.leaf_of(target);
    if (leaf == innermost_) return distance_in_own_leaf(target);
    if (!is_border_known_[leaf]) require_border(leaf, field);
    return distance_over_border(leaf, target);
}

float PreparedSource::distance_in_own_leaf(uint32_t target) const {
    return point_ ? in_leaf_.to_vertex(*point_, target) : known_[target];
}

// The borders of leaves are kept: a search asks for many vertices of a leaf, and comes and goes between
// leaves.
BorderFromSource PreparedSource::border_around(uint32_t leaf) {
    const Rings& rings = index_.rings;
    const uint32_t places = rings.size(leaf);
    const size_t room = NearRange::whole_parts(places), all = 3 * room + NearRange::PART;
    const bool is_new = kept_begin_[leaf] == NONE;
    if (is_new) {
        kept_.resize(kept_.size() + all, INFINITE);
        kept_begin_[leaf] = static_cast<uint32_t>(kept_.size() - all);
    }
    float *const foot = kept_.data() + kept_begin_[leaf], *const height = foot + room,
                 *const distance = height + room;
    const RingSegments segments = segments_from(rings, rings.begin[leaf]);
    const BorderFromSource border{places,          code_.data(),          distance,
                                  segments.length, segments.half_inverse, foot,
                                  height,          index_.quantum[leaf]};
    if (!is_new) return border;
    const uint32_t first = rings.begin[leaf];
    four_at_a_time(places, [&](size_t k) { distance[k] = known_[rings.vertex[first + k]]; });
    kernels_.prepare_crossing(border, rings.is_own.data() + first, code_.data(), foot, height);
    return border;
}

// Over all of the border.
float PreparedSource::distance_over_border(uint32_t leaf, uint32_t target) {
    const BorderFromSource border = border_around(leaf);
    const NearRange whole{0, INFINITE, 0, border.places};
    const uint32_t inner = target - index_.numbering.first_internal(leaf);
    const uint16_t* const row = index_.hops.inner.data() + index_.inner_row(leaf, inner);
    float distance = INFINITE;
    kernels_.cross_near(border, whole, {&row, 1}, &distance);
    return distance;
}

}
