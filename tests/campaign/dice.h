#pragma once

#include <cstdint>
#include <random>
#include <vector>

#include "tests/support/meshes.h"

namespace geodesic::campaign {

// Random numbers that are the same on every platform.
class Dice {
public:
    explicit Dice(uint64_t seed) : random_(seed) {}

    uint64_t bits() { return random_(); }
    uint32_t below(uint64_t count) { return static_cast<uint32_t>(random_() % count); }
    uint32_t between(uint32_t low, uint32_t high) { return low + below(uint64_t{high} - low + 1); }
    double real(double low, double high) { return test::uniform(random_, low, high); }
    bool chance(double probability) { return real(0, 1) < probability; }

    template <class T>
    T pick(std::initializer_list<T> items) {
        return items.begin()[below(items.size())];
    }

    template <class T>
    void shuffle(std::vector<T>& items) {
        for (size_t i = items.size(); i > 1; --i) std::swap(items[i - 1], items[below(i)]);
    }

private:
    std::mt19937_64 random_;
};

}
