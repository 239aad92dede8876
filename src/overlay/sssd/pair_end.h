#pragma once

#include <cstdint>
#include <memory_resource>

#include "src/overlay/hops/border_part.h"
#include "src/overlay/sssd/ascent.h"
#include "src/overlay/sssd/measured_path.h"
#include "src/overlay/sssd/sampled_ascent.h"
#include "src/overlay/tables/tables.h"

namespace geodesic {

// One of the two ends of a pair: its ascent, the ways over samples, and what is measured of the borders that
// it climbs over. The object is used for one end after the other.
struct PairEnd {
    PairEnd(const OverlayIndex& index, std::pmr::memory_resource* memory)
        : ascent(index, memory), sampled(index, memory), parts(memory), measured(index, memory) {
        parts.reserve(index.numbering.level_count());
    }

    // Climbs to a child of `top`. The index must have had require_pair_tables().
    void climb(const OverlayIndex& index, const PathEnd& of, uint32_t top, bool with_labels);

    // Whether the end does not climb, since the lowest patch around both ends owns it: its distances are
    // then entries of that patch's overlay table.
    bool is_at_top() const { return ascent.patches.empty(); }
    // Whether any border of the ascent has segments.
    bool crosses_segments(const OverlayIndex& index) const;

    // Takes the whole of each border. Returns whether each has any vertex: around a component of its own
    // there may be none.
    bool take_whole_borders(const OverlayIndex& index);
    // Takes the parts near the way over samples to a sample of the last border, where `last_part` is, and
    // asks for what hops read of them.
    void take_parts(const OverlayIndex& index, uint32_t sample, const BorderPart& last_part);
    // Takes the parts of all borders that a way no longer than this can cross.
    void take_parts_within(const OverlayIndex& index, float length);
    // Moves the parts to where a shorter way may be than the one that was measured, which crosses the last
    // border at this place. Returns whether any has moved.
    bool move_parts(const OverlayIndex& index, uint32_t place_of_last);

    Ascent ascent;
    SampledAscent sampled;
    Array<BorderPart> parts; // one for each patch of the ascent
    MeasuredEnd measured;
};

// The part of a border near the way to a sample of the next border that comes over a sample of this one.
// `sampled` has both borders, and the next one is its border number `next`.
BorderPart part_before(const OverlayIndex& index, uint32_t patch, const SampledAscent& sampled, size_t next,
                       uint32_t before, uint32_t sample);

}
