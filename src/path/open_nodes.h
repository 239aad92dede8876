#pragma once

#include <cstdint>
#include <functional>
#include <queue>
#include <utility>
#include <vector>

namespace geodesic {

// What a search has open, by what is expected in all.
template <class Node>
class OpenNodes {
public:
    void push(double expected, Node&& node) {
        queue_.push({expected, static_cast<uint32_t>(nodes_.size())});
        nodes_.push_back(std::move(node));
    }
    bool empty() const { return queue_.empty(); }
    uint32_t pop() {
        const uint32_t node = queue_.top().second;
        queue_.pop();
        return node;
    }
    const Node& operator[](uint32_t i) const { return nodes_[i]; }

private:
    using Entry = std::pair<double, uint32_t>;
    std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue_;
    std::vector<Node> nodes_;
};

}
