#include "src/partition/minimum_cut.h"

#include <algorithm>

namespace geodesic {

void MinimumCut::begin(uint32_t node_count) {
    arcs_.clear();
    first_arc_.assign(node_count, NONE);
}

void MinimumCut::link(uint32_t a, uint32_t b, uint64_t cost) {
    for (const auto& [from, to] : {std::pair{a, b}, std::pair{b, a}}) {
        arcs_.push_back({to, first_arc_[from], cost});
        first_arc_[from] = static_cast<uint32_t>(arcs_.size() - 1);
    }
}

void MinimumCut::cut(uint32_t source, uint32_t sink) {
    while (count_steps(source, sink)) {
        arc_to_try_ = first_arc_;
        while (find_path(source, sink)) fill_path();
    }
    find_side_of(source);
}

// Counts back from the sink, so that paths from the source run into no dead ends but those that are filled.
// Returns whether the source is reached: nodes that are farther do not matter.
bool MinimumCut::count_steps(uint32_t source, uint32_t sink) {
    steps_.assign(first_arc_.size(), NONE);
    steps_[sink] = 0;
    queue_.assign(1, sink);
    for (size_t done = 0; done < queue_.size(); ++done) {
        const uint32_t node = queue_[done];
        for (uint32_t a = first_arc_[node]; a != NONE; a = arcs_[a].next) {
            if (arcs_[a ^ 1].room == 0 || steps_[arcs_[a].to] != NONE) continue;
            steps_[arcs_[a].to] = steps_[node] + 1;
            if (arcs_[a].to == source) return true;
            queue_.push_back(arcs_[a].to);
        }
    }
    return false;
}

void MinimumCut::find_side_of(uint32_t source) {
    is_with_source_.assign(first_arc_.size(), 0);
    is_with_source_[source] = 1;
    queue_.assign(1, source);
    for (size_t done = 0; done < queue_.size(); ++done)
        for (uint32_t a = first_arc_[queue_[done]]; a != NONE; a = arcs_[a].next) {
            if (arcs_[a].room == 0 || is_with_source_[arcs_[a].to]) continue;
            is_with_source_[arcs_[a].to] = 1;
            queue_.push_back(arcs_[a].to);
        }
}

// Looks for a shortest path over arcs with room. Where a node leads no farther, the path goes back to the
// node before it, and the next arc is tried there.
bool MinimumCut::find_path(uint32_t source, uint32_t sink) {
    path_.clear();
    for (uint32_t node = source; node != sink;) {
        const uint32_t a = arc_to_try_[node];
        if (a == NONE) {
            if (path_.empty()) return false;
            node = arcs_[path_.back() ^ 1].to;
            path_.pop_back();
            arc_to_try_[node] = arcs_[arc_to_try_[node]].next;
        } else if (arcs_[a].room > 0 && steps_[arcs_[a].to] + 1 == steps_[node]) {
            path_.push_back(a);
            node = arcs_[a].to;
        } else {
            arc_to_try_[node] = arcs_[a].next;
        }
    }
    return true;
}

void MinimumCut::fill_path() {
    uint64_t room = arcs_[path_.front()].room;
    for (const uint32_t a : path_) room = std::min(room, arcs_[a].room);
    for (const uint32_t a : path_) {
        arcs_[a].room -= room;
        arcs_[a ^ 1].room += room;
    }
}

}
