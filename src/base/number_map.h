#pragma once

#include <bit>
#include <cstdint>
#include <vector>

#include "src/base/numbers.h"

namespace geodesic {

// Values of some of many numbers, such as those of the vertices that a search meets. Unlike a node of
// std::unordered_map, none is allocated by itself.
template <class T>
class NumberMap {
public:
    // The value of a number, T{} at first. The next number that is new moves it.
    T& operator[](uint32_t number) {
        if (2 * (count_ + 1) > slots_.size()) grow();
        Slot& slot = slot_of(number);
        if (slot.number == NONE) {
            slot.number = number;
            ++count_;
        }
        return slot.value;
    }

    void clear() {
        slots_.assign(slots_.size(), {});
        count_ = 0;
    }

private:
    static constexpr size_t FEWEST_SLOTS = 64;
    struct Slot {
        uint32_t number = NONE;
        T value{};
    };

    // The slot with the number, or the one where it belongs.
    Slot& slot_of(uint32_t number) {
        constexpr uint32_t GOLDEN = 0x9e3779b9; // spreads numbers that are close to each other
        size_t i = (number * GOLDEN) >> shift_;
        while (slots_[i].number != number && slots_[i].number != NONE) i = (i + 1) & (slots_.size() - 1);
        return slots_[i];
    }

    void grow() {
        std::vector<Slot> old(slots_.empty() ? FEWEST_SLOTS : 2 * slots_.size());
        old.swap(slots_);
        shift_ = 32 - std::countr_zero(slots_.size());
        for (Slot& slot : old)
            if (slot.number != NONE) slot_of(slot.number) = slot;
    }

    std::vector<Slot> slots_; // a power of two, at least half of them without a number
    size_t count_ = 0;
    int shift_ = 0;
};

}
