#pragma once

#include <bit>
#include <limits>

#include "src/overlay/kernels/dispatch.h"
#include "src/overlay/kernels/lanes.h"

namespace geodesic {

// Over which place of a border each column of a table has its least way, by sums of codes. Each place has a
// row of the table.

// With SKIP, rows of places that are not reached are left out; without, their sums are NO_SUM or more.
template <size_t BYTES, bool SKIP>
struct LeastSums {
    using Codes = typename Lanes<BYTES>::Codes;
    static constexpr size_t LANES = Lanes<BYTES>::CODES;

    // Calls use(c, sums, places), for `count` columns from `first` on, up to whole vectors, with the least
    // sums of a vector of columns from first + c on, and the first places that they are over.
    template <class AnyRows, class Use>
    [[gnu::always_inline]] static void over_all(const int16_t* code, const AnyRows& rows, size_t first,
                                                size_t count, Use&& use) {
        size_t c = 0;
        for (; c + AT_ONCE * LANES <= count; c += AT_ONCE * LANES)
            over_columns<AT_ONCE>(code, rows, first, c, use);
        for (; c + 3 * LANES < count; c += 4 * LANES) over_columns<4>(code, rows, first, c, use);
        for (; c + LANES < count; c += 2 * LANES) over_columns<2>(code, rows, first, c, use);
        if (c < count) over_columns<1>(code, rows, first, c, use);
    }

private:
    // So many vectors of columns go through the rows together, so that each code of the border is read once
    // for all of them.
    static constexpr size_t AT_ONCE = BYTES < 64 ? 4 : 8;

    template <size_t VECTORS, class AnyRows, class Use>
    [[gnu::always_inline]] static void over_columns(const int16_t* code, const AnyRows& rows, size_t first,
                                                    size_t c, Use&& use) {
        Codes least[VECTORS], place[VECTORS], here{};
        for (size_t v = 0; v < VECTORS; ++v) {
            least[v] = Codes{} + std::numeric_limits<int16_t>::max();
            place[v] = Codes{};
        }
        const AnyRows row = rows; // a copy, which no store can change
        for (size_t k = 0; k < row.size(); ++k, here += 1) {
            if (SKIP && code[k] == SourceCode::UNREACHED) continue;
            const Codes from = Codes{} + code[k];
            for (size_t v = 0; v < VECTORS; ++v) {
                Codes entries;
                load(row[k] + first + c + v * LANES, entries);
                const Codes sum = entries + from;
                place[v] = sum < least[v] ? here : place[v];
                lower(least[v], sum);
            }
        }
        for (size_t v = 0; v < VECTORS; ++v) use(c + v * LANES, least[v], place[v]);
    }
};

// Columns that follow each other in a list and lie side by side, or nearly so, in a table.
struct ColumnRun {
    static constexpr size_t MOST = 256, WIDEST_GAP = 32;

    Columns columns;
    uint32_t first, last; // the outermost ones
};

// The run at the beginning of a list that is not empty.
inline ColumnRun first_run(Columns columns) {
    uint32_t first = columns[0], last = first;
    size_t count = 1;
    for (; count < std::min(columns.size(), ColumnRun::MOST); ++count) {
        const uint32_t column = columns[count], low = std::min(first, column), high = std::max(last, column);
        if (high - low >= ColumnRun::MOST || column > last + ColumnRun::WIDEST_GAP ||
            column + ColumnRun::WIDEST_GAP < first)
            break;
        first = low;
        last = high;
    }
    return {columns.first(count), first, last};
}

// The columns at the beginning of a list that is not empty which lie within a block of so many of a table: a
// kernel takes these together. The list need not be sorted.
inline ColumnRun first_block(Columns columns, uint32_t width) {
    uint32_t first = columns[0], last = first;
    size_t count = 1;
    for (; count < columns.size(); ++count) {
        const uint32_t low = std::min(first, columns[count]), high = std::max(last, columns[count]);
        if (high - low >= width) break;
        first = low;
        last = high;
    }
    return {columns.first(count), first, last};
}

// The least sums of the columns of a run and of those between them, from the first one on, and the places
// that these are over. Where a sum is NO_SUM or more, it does not tell a place.
struct NearestPlaces {
    static constexpr size_t ROOM = SourceCode::whole_blocks(ColumnRun::MOST);

    template <class Codes>
    [[gnu::always_inline]] void operator()(size_t c, const Codes& least, const Codes& place) {
        store(least, sums + c);
        store(place, places + c);
    }

    int16_t sums[ROOM];
    uint16_t places[ROOM];
};

// Those of up to 64 columns that have no way.
struct Missing {
    uint64_t bits = 0;
    bool is_all(size_t count) const { return static_cast<size_t>(std::popcount(bits)) == count; }
    template <class Function>
    void for_each(const Function& function) const {
        for (uint64_t left = bits; left; left &= left - 1)
            function(static_cast<size_t>(std::countr_zero(left)));
    }
};

// One place after the other, by distances, of which codes are rounded, for what the sums of codes do not tell
// apart: ways of which one end is out of reach. Returns NO_PLACE if there is no way.
inline int32_t find_nearest_place(const BorderFromSource& border, Rows rows, size_t column) {
    float least = INFINITE;
    int32_t nearest = BorderFromSource::NO_PLACE;
    for (size_t k = 0; k < border.places; ++k) {
        const uint16_t code = rows[k][column];
        if (border.code[k] == SourceCode::UNREACHED || code == TableCode::UNREACHED) continue;
        const float sum = border.distance[k] + static_cast<float>(code) * border.quantum;
        if (sum >= least) continue;
        least = sum;
        nearest = static_cast<int32_t>(k);
    }
    return nearest;
}

// The places of up to 64 columns, counted from `first`, of which those without a way are returned. These get
// the place of another column, if there is one, so that the ways to all of them can be measured alike.
[[gnu::always_inline]] inline Missing collect_places(const BorderFromSource& border, Rows rows,
                                                     const NearestPlaces& nearest, Columns columns,
                                                     uint32_t first, int32_t* places) {
    Missing missing;
    int16_t most = std::numeric_limits<int16_t>::min();
    for (size_t i = 0; i < columns.size(); ++i) {
        places[i] = nearest.places[columns[i] - first];
        most = std::max(most, nearest.sums[columns[i] - first]);
    }
    if (most < SourceCode::NO_SUM) [[likely]]
        return missing;
    int32_t any_place = BorderFromSource::NO_PLACE;
    for (size_t i = 0; i < columns.size(); ++i) {
        if (nearest.sums[columns[i] - first] >= SourceCode::NO_SUM)
            places[i] = find_nearest_place(border, rows, columns[i]);
        if (places[i] == BorderFromSource::NO_PLACE)
            missing.bits |= uint64_t{1} << i;
        else
            any_place = places[i];
    }
    missing.for_each([&](size_t i) { places[i] = any_place; });
    return missing;
}

}
