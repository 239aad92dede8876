#pragma once

#include <algorithm>
#include <cstdint>
#include <span>

#include "src/base/shared_tasks.h"
#include "src/overlay/tables.h"

namespace geodesic {

// Calls descend(patch, scratch) for a patch and all of its descendants, parents before children.
template <class Scratch, class Descend>
void descend_into(const OverlayIndex& index, uint32_t patch, Scratch& scratch, const Descend& descend) {
    uint32_t first = patch, end = patch + 1;
    for (;;) {
        for (uint32_t p = first; p < end; ++p) descend(p, scratch);
        if (first >= index.numbering.first_leaf()) return;
        first = index.numbering.child_begin[first];
        end = index.numbering.child_begin[end];
    }
}

// Calls descend(patch, scratch) for all patches but the whole mesh, parents before children. There are as
// many threads as elements of `scratch`. The patches of the first level that has enough of them are shared
// out to the threads, each patch with all of its descendants. The levels above are done before, with `top` as
// their scratch. The calling thread takes part, and works alone if no other thread can be started. Throws
// what descend throws on any thread.
template <class Scratch, class Descend>
void descend_everywhere(const OverlayIndex& index, Scratch& top, std::span<Scratch> scratch,
                        const Descend& descend) {
    constexpr size_t PATCHES_PER_THREAD = 3;
    uint32_t level = 1;
    if (scratch.size() > 1)
        while (level < index.numbering.level_count() &&
               index.numbering.level_begin[level + 1] - index.numbering.level_begin[level] <
                   PATCHES_PER_THREAD * scratch.size())
            ++level;
    for (uint32_t p = 1; p < index.numbering.level_begin[level]; ++p) descend(p, top);
    const uint32_t first = index.numbering.level_begin[level],
                   count = index.numbering.level_begin[level + 1] - first;
    if (scratch.size() == 1) {
        for (uint32_t i = 0; i < count; ++i) descend_into(index, first + i, scratch.front(), descend);
        return;
    }
    SharedTasks tasks(count, [&](uint32_t thread, size_t i) {
        descend_into(index, first + static_cast<uint32_t>(i), scratch[thread], descend);
    });
    tasks.start_threads(1, static_cast<uint32_t>(std::min<size_t>(scratch.size(), count)));
    tasks.work(0);
    tasks.finish();
}

}
