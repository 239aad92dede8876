#pragma once

#include <algorithm>
#include <cstdint>
#include <functional>
#include <vector>

namespace geodesic {

// A priority queue of (distance, item), smallest first, ties by item so that the order is always the same.
class EventQueue {
public:
    struct Event {
        double distance;
        uint32_t item;

        friend bool operator>(const Event& a, const Event& b) {
            return a.distance > b.distance || (a.distance == b.distance && a.item > b.item);
        }
    };

    bool empty() const { return heap_.empty(); }
    void clear() { heap_.clear(); }
    const Event& top() const { return heap_.front(); }

    void push(double distance, uint32_t item) {
        heap_.push_back({distance, item});
        std::push_heap(heap_.begin(), heap_.end(), std::greater<>{});
    }

    Event pop() {
        std::pop_heap(heap_.begin(), heap_.end(), std::greater<>{});
        const Event event = heap_.back();
        heap_.pop_back();
        return event;
    }

private:
    std::vector<Event> heap_;
};

}
