#pragma once

#include <span>

#include "src/overlay/fields/ascend.h"
#include "src/overlay/hops/inner_sweep.h"
#include "src/overlay/hops/outer_crossing.h"
#include "src/overlay/tables/tables.h"

namespace geodesic {

// Where a path may cross a border. AT_VERTICES serves to measure how much is gained by crossing between
// vertices.
enum class Crossing { BETWEEN_VERTICES, AT_VERTICES };

// Distances from a single source to all destinations over overlay tables, by one sweep up from the source and
// one sweep down to all leaves. It computes one field or a batch of FIELDS_AT_ONCE, each from a source of its
// own: the fields of a batch lie side by side and share the sweep down, which reads each table once. Vertices
// are given by their numbers.
class OverlaySsad {
public:
    // `fields` is 1 or FIELDS_AT_ONCE.
    OverlaySsad(const OverlayIndex& index, std::pmr::memory_resource* memory, size_t fields = 1,
                Crossing crossing = Crossing::BETWEEN_VERTICES);

    // Sets how many threads sweep() uses, at least 1. It is 1 at first.
    void set_threads(uint32_t count);

    // Fills distances[number * fields + i] of every vertex with its distance from the i-th source; there are
    // as many sources as fields. Patches whose whole border is farther than `radius` are skipped: of their
    // vertices, all are infinite but those to which a point knows a way. Offsets of points are not looked at.
    void sweep(std::span<const uint32_t> sources, float radius, std::span<float> distances) {
        sweep(Sources{sources}, radius, distances);
    }
    void sweep(const Sources& sources, float radius, std::span<float> distances);

    // Single steps of a sweep, for one field that is wanted in some patches only. A hop leads from the border
    // of a patch that contains the source to the border of its parent or of another child of that, or from
    // the border of a patch that does not to its inner vertices. The distances of the border that it starts
    // at must be known, and those that it leads to known or infinite.
    void hop_to_border(uint32_t child, uint32_t patch, std::span<float> distance);
    void hop_down(uint32_t patch, std::span<float> distance);

private:
    RingSegments segments_of(uint32_t patch) const;
    void climb(const Sources& sources, std::span<float> distances);
    void mark_known_inside(const Sources& sources);
    void hop_up(uint32_t child, DistanceField distance);
    void cross_up(DistanceField distance);
    void hop_down(uint32_t patch, const Sources& sources, float radius, std::span<float> distances,
                  InnerSweep& sweep) const;

    const OverlayIndex& index_;
    const Numbering& numbering_;
    size_t fields_;
    Array<float> gaps_; // gaps that replace all segments with AT_VERTICES; empty otherwise
    OuterCrossing up_;
    Array<InnerSweep> down_;         // one for each thread
    Array<uint32_t> sources_inside_; // per patch: how many
    // Per patch: whether points may know ways to inner vertices without a hop.
    Array<uint8_t> is_known_inside_;
};

}
