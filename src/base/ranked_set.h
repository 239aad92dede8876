#pragma once

#include <bit>
#include <cstdint>
#include <span>
#include <vector>

namespace geodesic {

// A set of numbers below some count, and the rank of each: how many smaller ones there are in the set. It
// takes two bits for each number below the count.
class RankedSet {
public:
    RankedSet() = default;
    // Of numbers in ascending order. Where there are none it takes no memory.
    RankedSet(std::span<const uint32_t> numbers, uint32_t count) {
        if (numbers.empty()) return;
        words_.resize(count / BITS + 1);
        for (const uint32_t number : numbers) words_[number / BITS].bits |= bit(number);
        uint32_t smaller = 0;
        for (Word& word : words_) {
            word.smaller = smaller;
            smaller += static_cast<uint32_t>(std::popcount(word.bits));
        }
    }

    bool contains(uint32_t number) const {
        return !words_.empty() && (words_[number / BITS].bits & bit(number)) != 0;
    }
    uint32_t rank(uint32_t number) const {
        const Word& word = words_[number / BITS];
        return word.smaller + static_cast<uint32_t>(std::popcount(word.bits & (bit(number) - 1)));
    }

private:
    static constexpr uint32_t BITS = 64;
    struct Word {
        uint64_t bits = 0;
        uint32_t smaller = 0; // numbers in the words before
    };
    static uint64_t bit(uint32_t number) { return uint64_t{1} << number % BITS; }

    std::vector<Word> words_;
};

}
