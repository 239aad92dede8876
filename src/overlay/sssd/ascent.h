#pragma once

#include <memory_resource>
#include <span>

#include "src/overlay/sssd/coarse_hop.h"
#include "src/overlay/tables.h"

namespace geodesic {

// The distances from a vertex to the border of a patch around it, as the vertex's label holds them.
struct BorderLabel {
    float nearest; // The distance of the nearest vertex, in whole steps of the quantum.
    float quantum;
    const int16_t* codes;
    bool is_whole; // There is a code for each position in the border; otherwise, one for each sample.

    float distance(uint32_t i) const {
        const auto steps = static_cast<float>(codes[i] - SourceCode::NEAREST);
        return codes[i] == SourceCode::UNREACHED ? INFINITE : (nearest + steps) * quantum;
    }
};

// Reads the label of a vertex for a labelled patch around it other than the innermost one.
BorderLabel label_of(const OverlayIndex& index, uint32_t vertex, uint32_t patch);

// The distances that a row of a table holds, one for each place of a ring. Places are counted over all rings.
struct RingRow {
    const uint16_t* codes;
    size_t first; // The first place of the ring.
    float quantum;

    float operator()(size_t place) const { return TableCode::distance(codes[place - first], quantum); }
};

// The distances that a label holds for a whole border, for each place of its ring.
struct RingLabel {
    BorderLabel label;
    const uint32_t* position; // Of each place, in its border.

    float operator()(size_t place) const { return label.distance(position[place]); }
};

// The row of a vertex to the ring of the innermost patch around it.
RingRow inner_row_of(const OverlayIndex& index, uint32_t vertex);

// Calls use(distance_to), where distance_to(place) is the distance from the vertex to a place of the patch's
// ring. The patch must be the innermost one around the vertex, or one whose border is labelled whole.
template <class Use>
auto with_ring_distances(const OverlayIndex& index, uint32_t vertex, uint32_t patch, const Use& use) {
    if (patch == index.numbering.innermost_patch(vertex)) return use(inner_row_of(index, vertex));
    return use(RingLabel{label_of(index, vertex, patch), index.rings.position.data()});
}

// Writes the distance of each sample of a patch's border, where distance_to(place) is that of a place.
template <class DistanceTo>
void read_samples(const OverlayIndex& index, uint32_t patch, const DistanceTo& distance_to,
                  std::span<float> out) {
    const Rings& rings = index.pairs.samples.rings;
    for (uint32_t k = rings.begin[patch]; k < rings.begin[patch + 1]; ++k)
        out[index.pairs.samples.sample_of_place[k]] = distance_to(index.pairs.samples.full_place[k]);
}

// One end of a path and the borders around it that the path crosses, up to the patch where the ends meet.
struct Ascent {
    Ascent(const OverlayIndex& index, std::pmr::memory_resource* memory);

    uint32_t last_patch() const { return patches.back(); }

    uint32_t vertex = 0;
    // The patches whose borders the path crosses. front() is the first border, the outermost one of which the
    // index holds all distances from the vertex; back() is the last one, of a child of the patch where the
    // ends meet. Each is the parent of the one before it.
    Array<uint32_t> patches;
    Array<float> sample_distances; // From the vertex to the samples of the last patch's border, once read.
    // To the samples of the second patch's border, once read, if that is a parent of leaves: no label has
    // these.
    ReachedSamples around_leaf;
};

// Climbs from a vertex up to a child of `top`. The borders begin with the outermost one for which the index
// holds the distances to all vertices: those inside of it need not be crossed.
void climb(const OverlayIndex& index, uint32_t vertex, uint32_t top, Ascent& ascent);

// Reads the distances of the vertex from the samples of the last border, and of the one around its leaf if
// the path crosses it.
void read_samples(const OverlayIndex& index, BorderCrossing& crossing, Ascent& ascent);

}
