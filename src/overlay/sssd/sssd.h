#pragma once

#include <memory_resource>
#include <span>

#include "src/overlay/sssd/ascent.h"
#include "src/overlay/sssd/border_crossing.h"
#include "src/overlay/sssd/border_range.h"
#include "src/overlay/sssd/candidates.h"
#include "src/overlay/sssd/measured_path.h"

namespace geodesic {

// Single source, single destination on overlay tables. Both ends climb to the children of the lowest patch
// that has them both and meet on the border of one of these children. Short borders are crossed as a whole.
// Of longer ones, samples give a few candidates; each is then measured over all vertices of the border ranges
// around it. Vertices are given by their numbers. An object is the scratch of one thread.
class OverlaySssd {
public:
    OverlaySssd(const OverlayIndex& index, std::pmr::memory_resource* memory);

    // Requires low < high; callers pass both orders of a pair this way, so that both get the same bits.
    float distance(uint32_t low, uint32_t high);

    // Returns the distance from a source that was prepared: known[number] are its distances to the borders of
    // all patches down to prepared_level(), as OverlaySsad::sweep_borders() gives them.
    float distance_from(uint32_t source, std::span<const float> known, uint32_t target);
    uint32_t prepared_level() const { return prepared_level_; }

private:
    struct End {
        End(const OverlayIndex& index, std::pmr::memory_resource* memory)
            : ascent(index, memory), ranges(index, memory), measured(index, memory) {}
        void climb(const OverlayIndex& index, uint32_t vertex, uint32_t top);
        void read_samples(const OverlayIndex& index, BorderCrossing& crossing);

        Ascent ascent;
        BorderRanges ranges;
        MeasuredEnd measured;
    };

    // What the border where `to_` ends its climb is reached from: an end that has climbed, too, or a vertex
    // whose distances to that border are known.
    struct Climber;
    template <class DistanceTo>
    struct KnownVertex;

    // Where `to_` has climbed to: the ends meet on the border of this patch.
    uint32_t meeting_patch() const { return to_.ascent.last_patch(); }

    float distance_inside(uint32_t patch, uint32_t low, uint32_t high) const;
    float distance_to_border(uint32_t patch, uint32_t border_vertex, uint32_t vertex) const;

    template <class From>
    float meet(const From& from);
    template <class From>
    float measure(const From& from);

    const OverlayIndex& index_;
    const Numbering& numbering_;
    const uint32_t prepared_level_;
    BorderCrossing crossing_;
    End from_, to_;
    // The other end's distances to the samples of the meeting border.
    ReachedSamples samples_;
    Array<float> from_distances_;
};

}
