#pragma once

#include <algorithm>
#include <cstdint>
#include <functional>

#include "src/base/array.h"

namespace geodesic {

// A priority queue of (key, node) for the searches over borders, smallest first, ties by node. Stale items
// stay in; the reader tells them by the key.
class ArcQueue {
public:
    struct Item {
        double key;
        uint32_t node;

        friend bool operator>(const Item& a, const Item& b) {
            return a.key > b.key || (a.key == b.key && a.node > b.node);
        }
    };

    explicit ArcQueue(std::pmr::memory_resource* memory) : heap_(memory) {}

    bool empty() const { return heap_.empty(); }
    void clear() { heap_.clear(); }

    void push(double key, uint32_t node) {
        heap_.push_back({key, node});
        std::push_heap(heap_.begin(), heap_.end(), std::greater<>{});
    }

    Item pop() {
        std::pop_heap(heap_.begin(), heap_.end(), std::greater<>{});
        const Item item = heap_.back();
        heap_.pop_back();
        return item;
    }

private:
    Array<Item> heap_;
};

}
