#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <limits>
#include <span>

#include "src/index/index.h"

namespace geodesic {

// A monotone queue of nodes by distance in steps of a fixed width (Dial 1969): within a step the order is
// any. It holds distances up to BUCKETS steps beyond the smallest one in it, so that pushing and popping cost
// the same however many there are.
class BucketQueue {
public:
    static constexpr uint32_t BUCKETS = 1024;

    explicit BucketQueue(std::pmr::memory_resource* memory) : entries_(memory), popped_(memory) {
        heads_.fill(NONE);
    }

    // Empty it must be. Distances from `smallest` on, none of them over `smallest` + `range` nor more than
    // `range` above one that was popped before.
    void begin(float smallest, float range, float least_step) {
        const float step = std::max(least_step, range * (1.0f / (BUCKETS - 8)));
        smallest_ = smallest;
        steps_per_distance_ = step > std::numeric_limits<float>::min() ? 1 / step : 0;
        current_ = 0;
        entries_.clear();
    }

    void push(float distance, uint32_t node) {
        const auto bucket = static_cast<uint32_t>((distance - smallest_) * steps_per_distance_) % BUCKETS;
        entries_.push_back({node, heads_[bucket]});
        heads_[bucket] = static_cast<uint32_t>(entries_.size() - 1);
        occupied_[bucket / 64] |= uint64_t{1} << bucket % 64;
    }

    // All nodes of the smallest step that has some, until the next call; none if the queue is empty. A node
    // pushed into that very step meanwhile comes with the next call.
    std::span<const uint32_t> pop_step() {
        popped_.clear();
        if (!advance()) return {};
        for (uint32_t i = heads_[current_]; i != NONE; i = entries_[i].next)
            popped_.push_back(entries_[i].node);
        heads_[current_] = NONE;
        occupied_[current_ / 64] &= ~(uint64_t{1} << current_ % 64);
        return popped_;
    }

private:
    struct Entry {
        uint32_t node, next;
    };

    bool advance() {
        uint64_t word = occupied_[current_ / 64] >> current_ % 64 << current_ % 64;
        for (uint32_t i = current_ / 64, steps = 0; steps <= occupied_.size(); ++steps) {
            if (word) {
                current_ = i * 64 + static_cast<uint32_t>(std::countr_zero(word));
                return true;
            }
            i = (i + 1) % static_cast<uint32_t>(occupied_.size());
            word = occupied_[i];
        }
        return false;
    }

    Array<Entry> entries_;
    Array<uint32_t> popped_;
    std::array<uint32_t, BUCKETS> heads_;
    std::array<uint64_t, BUCKETS / 64> occupied_{};
    float smallest_ = 0, steps_per_distance_ = 0;
    uint32_t current_ = 0;
};

}
