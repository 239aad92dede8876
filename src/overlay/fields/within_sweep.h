#pragma once

#include <memory_resource>
#include <span>

#include "src/overlay/fields/ascend.h"
#include "src/overlay/fields/field_lowering.h"
#include "src/overlay/hops/inner_sweep.h"
#include "src/overlay/hops/outer_crossing.h"
#include "src/overlay/tables/tables.h"

namespace geodesic {

// Distances from a single source to the vertices within a radius, in time that depends on how many there are
// and not on the mesh: the sweep up ends at the first patch whose border no path within the radius crosses,
// and the sweep down enters no such patch. Vertices are given by their numbers.
class WithinSweep {
public:
    struct Found {
        uint32_t number;
        float distance;
    };

    WithinSweep(const OverlayIndex& index, std::pmr::memory_resource* memory);

    // Finds the vertices that are no farther than `radius` from the only one of the sources, in no particular
    // order, with the bits that a whole field has. They stay valid until the next call.
    std::span<const Found> sweep(const Sources& source, float radius);

    // The distance of one of them; infinite for other vertices.
    float distance(uint32_t number) const {
        return distance_[number] <= radius_ ? distance_[number] : INFINITE;
    }

    // The least distance beyond the radius that the latest sweep has seen. If it is infinite, nothing else
    // can be reached from the source.
    float nearest_beyond() const { return nearest_beyond_; }

private:
    void forget();
    void lower(uint32_t number, float way);
    bool may_cross_border(uint32_t patch) const;
    void hop_up(uint32_t child);
    void hop_down_to_children(uint32_t patch, uint32_t left_out);
    void hop_down(uint32_t patch);
    void take_known(const Sources& source);
    void lower_along_steep_edges();
    void collect();

    const OverlayIndex& index_;
    const Numbering& numbering_;
    OuterCrossing up_;
    InnerSweep down_;
    FieldLowering lowering_;
    float radius_ = 0;
    Array<float> distance_; // by number; infinite but for those of `seen_`
    Array<uint32_t> seen_;  // numbers, each once
    Array<Found> found_;    // those within the radius
    float nearest_beyond_ = INFINITE;
};

}
