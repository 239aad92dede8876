#pragma once

#include <memory_resource>
#include <span>

#include "src/overlay/overlay_crossing.h"
#include "src/overlay/tables.h"

namespace geodesic {

// Hops of one field from the border of a patch to one other border in the overlay of its parent, where the
// rest of the overlay is not wanted. The distances of a field lie by number; those of the border that a hop
// starts at must be known, and those that it leads to known or infinite: it lowers them.
class BorderHop {
public:
    BorderHop(const OverlayIndex& index, std::pmr::memory_resource* memory);

    // To the border of the parent, which is not the whole mesh.
    void hop_to_parent(uint32_t child, std::span<float> distance);

    // To the border of another child of the parent.
    void hop_to_sibling(uint32_t child, uint32_t sibling, std::span<float> distance);

private:
    // Vertices of the parent's overlay: their numbers, and where they are in a part of its rows.
    struct Targets {
        explicit Targets(std::pmr::memory_resource* memory) : numbers(memory), columns(memory) {}

        Array<uint32_t> numbers, columns;
    };

    void begin(uint32_t child);
    void add(uint32_t position);
    void cross(std::span<float> distance);
    void lower(const Targets& targets, std::span<float> distance) const;

    const OverlayIndex& index_;
    OverlayCrossing crossing_;
    uint32_t child_ = 0, parent_ = 0;
    Targets on_ring_, owned_;
    Array<float> ways_;
};

}
