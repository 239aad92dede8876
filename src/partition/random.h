#pragma once

#include <cstdint>
#include <span>
#include <utility>

namespace geodesic {

// A small random generator (SplitMix64) whose numbers are the same on every platform.
class Random {
public:
    explicit Random(uint64_t seed) : state_(seed) {}

    uint64_t next() {
        uint64_t z = (state_ += 0x9E3779B97F4A7C15u);
        z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9u;
        z = (z ^ (z >> 27)) * 0x94D049BB133111EBu;
        return z ^ (z >> 31);
    }

    // 0 .. bound - 1, bound > 0.
    uint32_t below(uint32_t bound) { return static_cast<uint32_t>(next() % bound); }

    // 0 .. 1, without 1.
    double share() { return static_cast<double>(next() >> 11) * 0x1p-53; }

    template <class T>
    void shuffle(std::span<T> items) {
        for (size_t i = items.size(); i > 1; --i)
            std::swap(items[i - 1], items[below(static_cast<uint32_t>(i))]);
    }

private:
    uint64_t state_;
};

}
