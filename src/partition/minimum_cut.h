#pragma once

#include <cstdint>
#include <vector>

#include "src/base/numbers.h"

namespace geodesic {

// Parts two nodes of a network by cutting those links that cost least in all. The links are found by the
// largest flow from one node to the other: it is as large as the cheapest cut (Dinic's algorithm).
class MinimumCut {
public:
    // Begins a network of `node_count` nodes without links.
    void begin(uint32_t node_count);
    // Links two nodes. Cutting the link costs `cost`; the costs of all links together must fit into 64 bits.
    void link(uint32_t a, uint32_t b, uint64_t cost);

    // Parts `source` from `sink`, another node. To be called once after links are made.
    void cut(uint32_t source, uint32_t sink);
    // Whether a node is still linked to the source, by links that are not cut. Of several cheapest cuts it
    // is the one nearest to the source.
    bool is_with_source(uint32_t node) const { return is_with_source_[node] != 0; }

private:
    // One direction of a link. The other direction is the arc whose number differs in the last bit.
    struct Arc {
        uint32_t to;
        uint32_t next; // of the same node, or NONE
        uint64_t room; // how much more can flow this way
    };

    bool count_steps(uint32_t source, uint32_t sink);
    void find_side_of(uint32_t source);
    bool find_path(uint32_t source, uint32_t sink);
    void fill_path();

    std::vector<Arc> arcs_;
    std::vector<uint32_t> first_arc_;  // per node
    std::vector<uint32_t> steps_;      // per node: to the sink, over arcs with room, or NONE
    std::vector<uint32_t> arc_to_try_; // per node: arcs before this one lead no farther
    std::vector<uint32_t> queue_;
    std::vector<uint32_t> path_;          // arcs from the source
    std::vector<uint8_t> is_with_source_; // per node
};

}
