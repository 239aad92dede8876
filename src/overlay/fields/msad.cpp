#include "src/overlay/fields/msad.h"

#include <algorithm>

#include "src/overlay/fields/descend.h"

namespace geodesic {

namespace {

// Lowers the distances of vertices, which begin at `first`, to those from one source.
void lower(const OverlayMsad::Field& field, uint32_t first, std::span<const float> found, uint32_t source) {
    float* const known = field.distance.data() + first;
    if (field.source.empty()) {
        for (size_t i = 0; i < found.size(); ++i) known[i] = std::min(known[i], found[i]);
        return;
    }
    uint32_t* const nearest = field.source.data() + first;
    for (size_t i = 0; i < found.size(); ++i) {
        nearest[i] = found[i] < known[i] ? source : nearest[i];
        known[i] = std::min(known[i], found[i]);
    }
}

}

OverlayMsad::Scratch::Scratch(const OverlayIndex& index, std::pmr::memory_resource* memory)
    : sweep(index, 1, memory), own(index, memory), with_offset(memory) {}

OverlayMsad::OverlayMsad(const OverlayIndex& index, std::pmr::memory_resource* memory)
    : index_(index), numbering_(index.numbering), up_(index, memory), top_(index, memory), of_thread_(memory),
      sources_inside_(memory), nearest_(index, memory), corrected_(memory) {
    set_threads(1);
}

// The distances with the offset added, valid until the next call; `found` itself if the offset is 0.
std::span<const float> OverlayMsad::Scratch::add_offset(std::span<const float> found, float offset) {
    if (offset == 0) return found;
    with_offset.assign(found.begin(), found.end());
    for (float& distance : with_offset) distance += offset;
    return with_offset;
}

void OverlayMsad::set_threads(uint32_t count) {
    while (of_thread_.size() > count) of_thread_.pop_back();
    while (of_thread_.size() < count) of_thread_.emplace_back(index_, of_thread_.get_allocator().resource());
}

void OverlayMsad::sweep(const Sources& sources, float radius, const Field& field) {
    sources_ = sources;
    const uint32_t keys = numbering_.vertex_count() + static_cast<uint32_t>(sources.points.size());
    top_.own.set_keys(keys);
    for (Scratch& scratch : of_thread_) scratch.own.set_keys(keys);
    begin(field);
    count_sources(numbering_, sources, sources_inside_);
    ascend(numbering_, sources_inside_, [&](uint32_t child) { hop_up(child, field.distance); });
    descend_everywhere(numbering_, top_, std::span(of_thread_),
                       [&](uint32_t patch, Scratch& scratch) { hop_down(patch, radius, field, scratch); });
    if (!field.source.empty())
        for (uint32_t v = 0; v < numbering_.border_vertex_count(); ++v) field.source[v] = nearest_.nearest(v);
    take_known(field);
}

// Takes the ways that need no hop. Those to border vertices are kept source by source. A way that is no
// shorter than the distance found so far is passed over: to correct it could only lengthen it to a bound, or
// shorten it to a known way, which take_known() takes in any case.
void OverlayMsad::begin(const Field& field) {
    nearest_.clear();
    std::ranges::fill(field.distance, INFINITE);
    std::ranges::fill(field.source, NONE);
    for (const uint32_t source : sources_.keys)
        sources_.for_each_way(index_, source, [&](uint32_t number, float way) {
            const float whole = way + offset(source);
            if (whole < field.distance[number]) lower_corrected(field, number, {&whole, 1}, source);
            if (numbering_.is_border(number)) add_way(number, whole, source);
        });
}

// Lowers the distances of inner vertices of a patch, which begin at `first`, to those from one source: those
// found, corrected by what is known besides. Border vertices are corrected in the end, since hops read their
// distances and go on with what tables say.
void OverlayMsad::lower_corrected(const Field& field, uint32_t first, std::span<const float> found,
                                  uint32_t source) const {
    if (numbering_.is_border(first)) return lower(field, first, found, source);
    uint32_t next = first;
    const uint32_t end = first + static_cast<uint32_t>(found.size());
    for_each_known(source, first, end, [&](const KnownWay& way) {
        lower(field, next, found.subspan(next - first, way.number - next), source);
        const float corrected = way.corrected(found[way.number - first]);
        lower(field, way.number, {&corrected, 1}, source);
        next = way.number + 1;
    });
    lower(field, next, found.subspan(next - first), source);
}

// Corrects border vertices, when no hop reads their distances any more. Then ways that are known lower all
// others, too, since hops may not have led to them from the same source.
void OverlayMsad::take_known(const Field& field) {
    const uint32_t vertices = numbering_.vertex_count();
    corrected_.clear();
    for (const uint32_t source : sources_.keys)
        for_each_known(source, 0, numbering_.border_vertex_count(),
                       [&](const KnownWay& way) { corrected_.push_back(way.number); });
    std::ranges::sort(corrected_);
    corrected_.erase(std::unique(corrected_.begin(), corrected_.end()), corrected_.end());
    for (const uint32_t border_vertex : corrected_) correct_border_vertex(field, border_vertex);
    for (const uint32_t source : sources_.keys)
        for_each_known(source, 0, vertices, [&](const KnownWay& way) {
            lower(field, way.number, {&way.length, 1}, source);
        });
}

void OverlayMsad::correct_border_vertex(const Field& field, uint32_t border_vertex) const {
    field.distance[border_vertex] = INFINITE;
    nearest_.for_each_way(border_vertex, [&](const NearestSources::Way& found) {
        float distance = found.distance;
        for_each_known(found.source, border_vertex, border_vertex + 1,
                       [&](const KnownWay& way) { distance = way.corrected(distance); });
        lower(field, border_vertex, {&distance, 1}, found.source);
    });
}

bool OverlayMsad::is_within(uint32_t source, uint32_t patch) const {
    return numbering_.is_within(sources_.innermost_patch(numbering_, source), patch);
}

// Hops from the sources inside of a child to the overlay of its parent. The child's border keeps the
// distances it has.
void OverlayMsad::hop_up(uint32_t child, std::span<float> distance) {
    const auto is_inside = [&](uint32_t source) { return is_within(source, child); };
    const auto hop = [&](float* from, uint32_t source) {
        if (!up_.begin(child, {from})) return;
        const std::span<const float> found = top_.add_offset(up_.cross(), offset(source));
        const std::span<const uint32_t> targets = up_.targets();
        for (size_t r = 0; r < found.size(); ++r) {
            float& known = distance[targets[r]];
            known = std::min(known, found[r]);
            add_way(targets[r], found[r], source);
        }
    };
    top_.own.for_each_source(child, nearest_, distance.data(), offset_of_sources(), is_inside, hop);
}

// Hops from the sources outside of a patch to its inner vertices. A source that is inside has all of its
// distances there already. No hop begins at the vertices inside of a leaf, so that their ways are not kept.
void OverlayMsad::hop_down(uint32_t patch, float radius, const Field& field, Scratch& scratch) {
    if (sources_inside_[patch] == sources_inside_[0]) return;
    const uint32_t first = numbering_.first_inner(patch);
    const auto is_outside = [&](uint32_t source) { return !is_within(source, patch); };
    const auto hop = [&](const float* from, uint32_t source) {
        if (!scratch.sweep.begin(patch, from, radius - offset(source))) return;
        const std::span<const float> found = scratch.add_offset(scratch.sweep.cross(), offset(source));
        lower_corrected(field, first, found, source);
        if (patch >= numbering_.first_leaf()) return;
        for (uint32_t r = 0; r < found.size(); ++r) add_way(first + r, found[r], source);
    };
    scratch.own.for_each_source(patch, nearest_, field.distance.data(), offset_of_sources(), is_outside, hop);
}

void OverlayMsad::add_way(uint32_t border_vertex, float distance, uint32_t source) {
    if (distance < INFINITE) nearest_.add(border_vertex, {distance, source});
}

}
