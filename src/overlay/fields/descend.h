#pragma once

#include <algorithm>
#include <cstdint>
#include <span>

#include "src/base/shared_tasks.h"
#include "src/overlay/tables/tables.h"

namespace geodesic {

// The way down into one patch: calls hop(p) for all descendants p of the patch, parents before children. A
// hop leads from the border of p to its inner vertices. The distances to the overlay of the patch must be
// known before.
template <class Hop>
void descend_into(const Numbering& numbering, uint32_t patch, const Hop& hop) {
    for (uint32_t first = patch, end = patch + 1; first < numbering.first_leaf();) {
        first = numbering.child_begin[first];
        end = numbering.child_begin[end];
        for (uint32_t p = first; p < end; ++p) hop(p);
    }
}

// The way down into the whole mesh: calls hop(p, scratch) for all patches p but the mesh itself, parents
// before children. There are as many threads as elements of `scratch`. The patches of the first level that
// has enough of them are shared out to the threads, each patch with all of its descendants. The levels above
// are done before, with `top` as their scratch. The calling thread takes part, and works alone if no other
// thread can be started. Throws what a hop throws on any thread.
// Of what the threads share, hop(p) may write only what belongs to the inner vertices of p, and read only
// that and what belongs to the border of p. The vertices of this border are inner vertices of patches around
// p, which the same thread has done before, or the levels above: that is why threads can share.
template <class Scratch, class Hop>
void descend_everywhere(const Numbering& numbering, Scratch& top, std::span<Scratch> scratch,
                        const Hop& hop) {
    constexpr size_t PATCHES_PER_THREAD = 3;
    uint32_t level = 1;
    if (scratch.size() > 1)
        while (level < numbering.level_count() &&
               numbering.level_begin[level + 1] - numbering.level_begin[level] <
                   PATCHES_PER_THREAD * scratch.size())
            ++level;
    const uint32_t first = numbering.level_begin[level], count = numbering.level_begin[level + 1] - first;
    for (uint32_t p = 1; p < first; ++p) hop(p, top);
    const auto descend = [&](uint32_t patch, Scratch& own) {
        hop(patch, own);
        descend_into(numbering, patch, [&](uint32_t p) { hop(p, own); });
    };
    if (scratch.size() == 1) {
        for (uint32_t i = 0; i < count; ++i) descend(first + i, scratch.front());
        return;
    }
    SharedTasks tasks(count, [&](uint32_t thread, size_t i) {
        descend(first + static_cast<uint32_t>(i), scratch[thread]);
    });
    tasks.start_threads(1, static_cast<uint32_t>(std::min<size_t>(scratch.size(), count)));
    tasks.work(0);
    tasks.finish();
}

}
