#pragma once

#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace geodesic::file_campaign {

// Numbers that a seed decides on every platform (splitmix64).
class Random {
public:
    explicit Random(uint64_t seed) : state_(seed) {}

    uint64_t next() {
        uint64_t z = state_ += 0x9E3779B97F4A7C15u;
        z = (z ^ z >> 30) * 0xBF58476D1CE4E5B9u;
        z = (z ^ z >> 27) * 0x94D049BB133111EBu;
        return z ^ z >> 31;
    }
    // 0 .. count - 1; 0 if count is 0.
    uint32_t below(uint64_t count) { return count == 0 ? 0 : static_cast<uint32_t>(next() % count); }
    bool one_in(uint32_t count) { return below(count) == 0; }
    float unit() { return static_cast<float>(next() >> 40) * 0x1p-24f; }

    template <class T>
    void shuffle(std::vector<T>& values) {
        for (size_t i = values.size(); i > 1; --i) std::swap(values[i - 1], values[below(i)]);
    }

private:
    uint64_t state_;
};

}
