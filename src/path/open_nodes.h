#pragma once

#include <algorithm>
#include <cstdint>
#include <utility>
#include <vector>

#include "src/base/numbers.h"
#include "src/metric/metric.h"

namespace geodesic {

// What a search has open, by what is expected in all: a heap of four children each, since a search opens more
// nodes than it comes to. One node is kept beside the heap: mostly a search comes to the best of the nodes
// that it opened last, which then never enters the heap.
template <class Node>
class OpenNodes {
public:
    void push(double expected, const Node& node) {
        Entry entry{expected, static_cast<uint32_t>(nodes_.size())};
        nodes_.push_back(node);
        if (entry < beside_) std::swap(entry, beside_);
        if (entry.node != NONE) rise(entry);
    }
    bool empty() const { return beside_.node == NONE && heap_.empty(); }
    uint32_t pop() {
        if (heap_.empty() || beside_ < heap_.front()) return std::exchange(beside_, Entry{}).node;
        const uint32_t node = heap_.front().node;
        const Entry last = heap_.back();
        heap_.pop_back();
        if (!heap_.empty()) sink(last);
        return node;
    }
    const Node& operator[](uint32_t i) const { return nodes_[i]; }
    void clear() {
        beside_ = {};
        heap_.clear();
        nodes_.clear();
    }

private:
    static constexpr size_t CHILDREN = 4;
    struct Entry {
        double expected = UNREACHABLE;
        uint32_t node = NONE;

        // Of two that are expected to be as long, the one that was opened first. It is told
        // without branches, which processors would mispredict.
        bool operator<(const Entry& other) const {
            return (expected < other.expected) | ((expected == other.expected) & (node < other.node));
        }
    };

    void rise(const Entry& entry) {
        heap_.push_back(entry);
        size_t at = heap_.size() - 1;
        for (; at > 0 && entry < heap_[(at - 1) / CHILDREN]; at = (at - 1) / CHILDREN)
            heap_[at] = heap_[(at - 1) / CHILDREN];
        heap_[at] = entry;
    }

    // From the root, which is free.
    void sink(const Entry& entry) {
        size_t at = 0;
        for (size_t child; (child = CHILDREN * at + 1) < heap_.size();) {
            const size_t end = std::min(child + CHILDREN, heap_.size());
            for (size_t other = child + 1; other < end; ++other)
                child = heap_[other] < heap_[child] ? other : child;
            if (!(heap_[child] < entry)) break;
            heap_[at] = heap_[child];
            at = child;
        }
        heap_[at] = entry;
    }

    Entry beside_; // of no node: NONE
    std::vector<Entry> heap_;
    std::vector<Node> nodes_;
};

}
