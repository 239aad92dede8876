#pragma once

#include <atomic>
#include <span>
#include <system_error>
#include <thread>
#include <vector>

#include "src/index/index.h"

namespace geodesic {

// descend(patch, scratch) for a patch and all of its descendants, parents first.
template <class Scratch, class Descend>
void descend_into(const Index& index, uint32_t patch, Scratch& scratch, const Descend& descend) {
    uint32_t first = patch, end = patch + 1;
    for (;;) {
        for (uint32_t p = first; p < end; ++p) descend(p, scratch);
        if (first >= index.first_leaf()) return;
        first = index.child_begin[first];
        end = index.child_begin[end];
    }
}

// descend(patch, scratch) for all patches but the whole mesh, parents first, by as many threads as there is
// scratch: the patches of a level that is fine enough are shared out, each with all that lies inside; those
// above have `top` as scratch.
template <class Scratch, class Descend>
void descend_everywhere(const Index& index, Scratch& top, std::span<Scratch> scratch,
                        const Descend& descend) {
    constexpr size_t PATCHES_PER_THREAD = 3;
    uint32_t level = 1;
    if (scratch.size() > 1)
        while (level < index.level_count() &&
               index.level_begin[level + 1] - index.level_begin[level] < PATCHES_PER_THREAD * scratch.size())
            ++level;
    for (uint32_t p = 1; p < index.level_begin[level]; ++p) descend(p, top);
    std::atomic<uint32_t> next = index.level_begin[level];
    const auto work = [&](Scratch& of_thread) {
        for (uint32_t p; (p = next++) < index.level_begin[level + 1];)
            descend_into(index, p, of_thread, descend);
    };
    std::vector<std::jthread> threads;
    try {
        for (size_t t = 1; t < scratch.size(); ++t)
            threads.emplace_back([&work, &of_thread = scratch[t]] { work(of_thread); });
    } catch (const std::system_error&) { // no more threads: those that there are do all
    }
    work(scratch.front());
}

}
