#pragma once

#include "src/index/index.h"

namespace geodesic {

// function(number, distance) for everything that the table of the patch knows which the vertex lies in:
// inside of it, and on its border.
template <class Function>
void for_each_way_from(const Index& index, uint32_t source, const Function& function) {
    const OverlayTables& tables = index.overlay_tables;
    const uint32_t patch = index.entry(source), first = index.first_inner(patch), own = source - first;
    function(source, 0.f);
    if (index.is_border(source)) {
        const uint32_t position = index.border_size(patch) + own;
        for (uint32_t i = 0; i < index.overlay_size(patch); ++i)
            if (i != position)
                function(index.overlay_number(patch, i),
                         tables.distance(index.overlay_code(patch, i, position), patch));
    } else {
        const auto border = index.border_of(patch);
        for (uint32_t i = 0; i < border.size(); ++i)
            function(border[i], tables.distance(index.crossing_code(patch, i, own), patch));
        for (uint32_t i = 0; i < index.internal_size(patch); ++i)
            if (i != own)
                function(first + i,
                         tables.distance(tables.internal_tables[index.internal_place(patch, own, i)], patch));
    }
}

}
