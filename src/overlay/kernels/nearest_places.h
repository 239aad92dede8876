#pragma once

#include <bit>

#include "src/overlay/kernels/dispatch.h"
#include "src/overlay/kernels/lanes.h"

namespace geodesic {

// Those of up to 64 that have no way.
struct Missing {
    uint64_t bits = 0;
    template <class Function>
    void for_each(const Function& function) const {
        for (uint64_t left = bits; left; left &= left - 1)
            function(static_cast<size_t>(std::countr_zero(left)));
    }
};

// A key is a sum, and below it a place: the least one is the first place with the least sum.
constexpr int32_t PLACE_BITS = 16, PLACE_MASK = 0xffff;

// Of each 16 bytes the keys of the four low places, and of the four high ones.
template <size_t BYTES, size_t... I>
[[gnu::always_inline]] inline void
make_keys(const typename Lanes<BYTES>::Codes& sum, const typename Lanes<BYTES>::Codes& place,
          typename Lanes<BYTES>::Keys& low, typename Lanes<BYTES>::Keys& high, std::index_sequence<I...>) {
    using Keys = typename Lanes<BYTES>::Keys;
    constexpr auto lane = [](size_t i, size_t half) {
        return static_cast<int>(i / 8 * 8 + half * 4 + i % 8 / 2 + i % 2 * sizeof...(I));
    };
    low = reinterpret_cast<Keys>(__builtin_shufflevector(place, sum, lane(I, 0)...));
    high = reinterpret_cast<Keys>(__builtin_shufflevector(place, sum, lane(I, 1)...));
}

// Where the number of vectors that hold the places is known, 1 .. 8, the border's codes stay in registers;
// BLOCKS = 0: any number.
template <size_t BYTES, size_t BLOCKS>
struct NearestPlaces {
    using Codes = typename Lanes<BYTES>::Codes;
    using Keys = typename Lanes<BYTES>::Keys;
    static constexpr size_t LANES = Lanes<BYTES>::CODES;

    [[gnu::always_inline]] static void find(const BorderFromSource& border, Rows rows, int32_t* keys) {
        Codes codes[BLOCKS + 1];
        for (size_t b = 0; b < BLOCKS; ++b) load(border.code + b * LANES, codes[b]);
        size_t r = 0;
        for (; r + 4 <= rows.size(); r += 4) find_four(border, codes, rows.data() + r, keys + r);
        if (r == rows.size()) return;
        const uint16_t* last[4];
        int32_t last_keys[4];
        for (size_t i = 0; i < 4; ++i) last[i] = rows[r + i < rows.size() ? r + i : r];
        find_four(border, codes, last, last_keys);
        for (size_t i = 0; r + i < rows.size(); ++i) keys[r + i] = last_keys[i];
    }

private:
    // The border's codes of a block, from a register if they are in one.
    [[gnu::always_inline]] static void read(const BorderFromSource& border, const Codes* codes, size_t block,
                                            Codes& code) {
        if constexpr (BLOCKS)
            code = codes[block];
        else
            load(border.code + block * LANES, code);
    }

    [[gnu::always_inline]] static void find_four(const BorderFromSource& border, const Codes* codes,
                                                 const uint16_t* const* rows, int32_t* keys) {
        const size_t blocks = BLOCKS ? BLOCKS : (border.places + LANES - 1) / LANES;
        Codes lanes;
        for (size_t i = 0; i < LANES; ++i) lanes[i] = static_cast<int16_t>(i);
        Codes least[4], place[4], here = lanes;
        Codes code, entries;
        read(border, codes, 0, code);
        for (size_t i = 0; i < 4; ++i) {
            load(rows[i], entries);
            least[i] = entries + code;
            place[i] = lanes;
        }
        for (size_t b = 1; b < blocks; ++b) {
            here += static_cast<int16_t>(LANES);
            read(border, codes, b, code);
            for (size_t i = 0; i < 4; ++i) {
                load(rows[i] + b * LANES, entries);
                const Codes sum = entries + code;
                place[i] = sum < least[i] ? here : place[i];
                lower(least[i], sum);
            }
        }
        FourKeys row_keys[4];
        for (size_t i = 0; i < 4; ++i) {
            Keys low, high;
            make_keys<BYTES>(least[i], place[i], low, high, std::make_index_sequence<LANES>());
            lower(low, high);
            fold(low, row_keys[i]);
        }
        FourKeys least_keys;
        least_lanes(row_keys, least_keys);
        std::memcpy(keys, &least_keys, sizeof least_keys);
    }
};

template <size_t BYTES>
[[gnu::always_inline]] inline void find_keys(const BorderFromSource& border, Rows rows, int32_t* keys) {
    switch ((border.places + Lanes<BYTES>::CODES - 1) / Lanes<BYTES>::CODES) {
    case 1:
        return NearestPlaces<BYTES, 1>::find(border, rows, keys);
    case 2:
        return NearestPlaces<BYTES, 2>::find(border, rows, keys);
    case 3:
        return NearestPlaces<BYTES, 3>::find(border, rows, keys);
    case 4:
        return NearestPlaces<BYTES, 4>::find(border, rows, keys);
    case 5:
        return NearestPlaces<BYTES, 5>::find(border, rows, keys);
    case 6:
        return NearestPlaces<BYTES, 6>::find(border, rows, keys);
    case 7:
        return NearestPlaces<BYTES, 7>::find(border, rows, keys);
    case 8:
        return NearestPlaces<BYTES, 8>::find(border, rows, keys);
    default:
        return NearestPlaces<BYTES, 0>::find(border, rows, keys);
    }
}

// One place after the other, by distances, of which codes are rounded, for what the sums of codes do not tell
// apart: ways of which one end is out of reach. Returns NO_PLACE if there is no way.
inline int32_t find_nearest_place(const BorderFromSource& border, const uint16_t* row) {
    float least = INFINITE;
    int32_t nearest = BorderFromSource::NO_PLACE;
    for (size_t k = 0; k < border.places; ++k) {
        if (border.code[k] == SourceCode::UNREACHED || row[k] == TableCode::UNREACHED) continue;
        const float sum = border.distance[k] + static_cast<float>(row[k]) * border.quantum;
        if (sum >= least) continue;
        least = sum;
        nearest = static_cast<int32_t>(k);
    }
    return nearest;
}

// Of each of up to 64 rows. Where there is no way, the place is some one.
template <size_t BYTES>
[[gnu::always_inline]] inline Missing find_nearest_places(const BorderFromSource& border, Rows rows,
                                                          int32_t* places) {
    Missing missing;
    find_keys<BYTES>(border, rows, places);
    int32_t most = SourceCode::NO_SUM * (1 << PLACE_BITS) - 1;
    for (size_t r = 0; r < rows.size(); ++r) most = std::max(most, places[r]);
    if (most >= SourceCode::NO_SUM * (1 << PLACE_BITS)) [[unlikely]]
        for (size_t r = 0; r < rows.size(); ++r) {
            if (places[r] < SourceCode::NO_SUM * (1 << PLACE_BITS)) continue;
            places[r] = find_nearest_place(border, rows[r]);
            if (places[r] != BorderFromSource::NO_PLACE) continue;
            places[r] = Rings::REACH;
            missing.bits |= uint64_t{1} << r;
        }
    for (size_t r = 0; r < rows.size(); ++r) places[r] &= PLACE_MASK;
    return missing;
}

}
