#pragma once

#include "src/overlay/tables.h"

namespace geodesic {

// Calls function(number, distance) for the source itself and for every vertex whose distance from it is an
// entry of the tables of the patch that the source is an inner vertex of: the patch's border and its other
// inner vertices.
template <class Function>
void for_each_way_from(const OverlayIndex& index, uint32_t source, const Function& function) {
    const uint32_t patch = index.numbering.entry(source), first = index.numbering.first_inner(patch),
                   own = source - first;
    function(source, 0.f);
    if (index.numbering.is_border(source)) {
        const uint32_t position = index.numbering.border_size(patch) + own;
        for (uint32_t i = 0; i < index.numbering.overlay_size(patch); ++i)
            if (i != position)
                function(index.numbering.overlay_number(patch, i),
                         index.distance(index.overlay_code(patch, i, position), patch));
    } else {
        const auto border = index.numbering.border_of(patch);
        for (uint32_t i = 0; i < border.size(); ++i)
            function(border[i], index.distance(index.border_internal_code(patch, i, own), patch));
        for (uint32_t i = 0; i < index.numbering.internal_size(patch); ++i)
            if (i != own)
                function(first + i,
                         index.distance(index.hops.internal[index.numbering.internal_entry(patch, own, i)],
                                        patch));
    }
}

}
