#pragma once

#include <algorithm>
#include <cstring>
#include <limits>

#include "src/overlay/kernels/dispatch.h"
#include "src/overlay/kernels/lanes.h"
#include "src/overlay/kernels/near.h"
#include "src/overlay/kernels/nearest_places.h"
#include "src/overlay/kernels/rounding.h"

namespace geodesic {

// The kernels that cross a border: what Kernels says of prepare_crossing(), cross(), cross_near(),
// cross_near_columns(), cross_few(), cross_samples() and meet() is done by the structs of these names. Only
// dispatch.cpp includes this.

// ---- The border, made ready

template <size_t BYTES>
[[gnu::always_inline]] inline void find_near_range(const BorderFromSource& border, NearRange& range) {
    Floats<BYTES> nearest{}, shortest{}, distance, length;
    nearest += INFINITE;
    for (size_t k = 0; k < border.places; k += Lanes<BYTES>::FLOATS) {
        load(border.distance + k, distance);
        load(border.length + k, length);
        lower(nearest, distance);
        lower<Floats<BYTES>>(shortest, distance < INFINITE ? -length : shortest);
    }
    range = {least_of<BYTES>(nearest), border.near_segments * -least_of<BYTES>(shortest), 1, 0};
    if (range.nearest > range.reach) return;
    const auto is_far = [&](size_t k) { return border.distance[k] > range.reach; };
    for (range.first = 0; is_far(range.first);) ++range.first;
    for (range.last = border.places - 1; is_far(range.last);) --range.last;
}

// Codes of places that are not the border's own are as those of places that are not reached.
template <size_t BYTES>
[[gnu::always_inline]] inline void encode(const BorderFromSource& border, float nearest, const int8_t* is_own,
                                          int16_t* code) {
    using Numbers = typename Lanes<BYTES>::Keys;
    using Codes = typename VectorOf<int16_t, BYTES / 2>::Type;
    using Flags = typename VectorOf<int8_t, BYTES / 4>::Type;
    static_assert(SourceCode::UNREACHED == 0);
    const float scale = steps_per_distance(border.quantum);
    const Floats<BYTES> nearest_lanes = Floats<BYTES>{} + nearest;
    for (size_t k = 0; k < border.places; k += Lanes<BYTES>::FLOATS) {
        Floats<BYTES> distance;
        Numbers codes;
        Flags own;
        load(border.distance + k, distance);
        load(is_own + k, own);
        round_to_codes<BYTES>(distance, nearest_lanes, scale, codes);
        store(__builtin_convertvector(codes & __builtin_convertvector(own, Numbers), Codes), code + k);
    }
    std::fill(code + border.places, code + SourceCode::whole_blocks(border.places), SourceCode::UNREACHED);
}

template <size_t BYTES>
[[gnu::always_inline]] inline void unfold(const BorderFromSource& border, float* feet, float* heights) {
    for (size_t k = 0; k < NearRange::whole_parts(border.places); k += Lanes<BYTES>::FLOATS) {
        Segments<Floats<BYTES>> segments;
        load(border.length + k, segments.length);
        load(border.half_inverse + k, segments.half_inverse);
        Floats<BYTES> from_first, from_second, foot, height;
        load(border.distance + k, from_first);
        load(border.distance + k + 1, from_second);
        segments.place_point(from_first, from_second, foot, height);
        store(foot, feet + k);
        store(height, heights + k);
    }
}

template <size_t BYTES>
struct PrepareCrossing {
    [[gnu::always_inline]] static NearRange run(const BorderFromSource& border, const int8_t* is_own,
                                                int16_t* code, float* foot, float* height) {
        NearRange range;
        find_near_range<BYTES>(border, range);
        if (!(range.nearest < INFINITE)) return range;
        encode<BYTES>(border, range.nearest, is_own, code);
        unfold<BYTES>(border, foot, height);
        return range;
    }
};

// ---- The ways over the nearest places

// Ways to be measured: over these places of a border, each with its row, and to these columns.
struct Ways {
    const int32_t* places;
    const uint16_t* const* rows;
    const uint32_t* columns;

    // The codes of the places beside a way's, and three of no meaning.
    [[gnu::always_inline]] EightCodes codes_beside(size_t way) const {
        static_assert(Rings::REACH == 2);
        const uint16_t* const* const row = rows + places[way] - Rings::REACH;
        const size_t c = columns[way];
        return EightCodes{row[0][c], row[1][c], row[2][c], row[3][c], row[4][c]};
    }
    [[gnu::always_inline]] BesideFloats beside(const float* values, size_t way) const {
        return beside_floats(values + places[way] - Rings::REACH);
    }
};

// Codes as distances; infinity where there is no path.
template <size_t BYTES>
[[gnu::always_inline]] inline void decode(const typename Lanes<BYTES>::Keys& codes, float quantum,
                                          Floats<BYTES>& distances) {
    const Floats<BYTES> none = Floats<BYTES>{} + INFINITE;
    distances = codes < TableCode::UNREACHED ? __builtin_convertvector(codes, Floats<BYTES>) * quantum : none;
}

// The distances of the columns of the ways from `first` on, side by side, four each: those from the places
// that segments beside the place begin at, and those from the next ones.
template <size_t BYTES>
[[gnu::always_inline]] inline void distances_beside(const Ways& ways, size_t first, float quantum,
                                                    Floats<BYTES>& of_first, Floats<BYTES>& of_second) {
    constexpr std::make_index_sequence<BYTES / sizeof(uint16_t)> ALL;
    typename VectorOf<uint16_t, BYTES>::Type codes;
    typename Lanes<BYTES>::Keys numbers;
    join([&](size_t i) { return ways.codes_beside(first + i); }, codes);
    widen_four<0>(codes, numbers, ALL);
    decode<BYTES>(numbers, quantum, of_first);
    widen_four<1>(codes, numbers, ALL);
    decode<BYTES>(numbers, quantum, of_second);
}

// Four ways, as many side by side as fit into a vector.
template <size_t BYTES>
[[gnu::always_inline]] inline void measure_four(const BorderFromSource& border, const Ways& ways,
                                                BesideFloats& distances) {
    constexpr size_t SIDE_BY_SIDE = BYTES / sizeof(BesideFloats);
    BesideFloats squares[4], sums[4];
    for (size_t r = 0; r < 4; r += SIDE_BY_SIDE) {
        const auto beside = [&](const float* values, Floats<BYTES>& out) {
            join([&](size_t i) { return ways.beside(values, r + i); }, out);
        };
        SegmentsFromSource<Floats<BYTES>> from_source;
        beside(border.length, from_source.segments.length);
        beside(border.half_inverse, from_source.segments.half_inverse);
        beside(border.foot, from_source.foot);
        beside(border.height, from_source.height);
        Floats<BYTES> first, second, sum, square;
        distances_beside<BYTES>(ways, r, border.quantum, first, second);
        beside(border.distance, sum);
        sum += first;
        from_source.square_across(first, second, square);
        split(sum, sums + r);
        split(square, squares + r);
    }
    BesideFloats over;
    least_lanes(squares, distances);
    take_square_root(distances);
    pick_lanes<Rings::REACH>(sums, over);
    lower(distances, over);
}

// In groups of four, the last one filled up by its first way.
template <size_t BYTES>
[[gnu::always_inline]] inline void measure(const BorderFromSource& shared_border, const Ways& ways,
                                           size_t count, float* distances) {
    const BorderFromSource border = shared_border; // a copy, which no store can change
    BesideFloats measured;
    size_t w = 0;
    for (; w + 4 <= count; w += 4) {
        measure_four<BYTES>(border, {ways.places + w, ways.rows, ways.columns + w}, measured);
        std::memcpy(distances + w, &measured, sizeof measured);
    }
    if (w == count) return;
    int32_t last_places[4];
    uint32_t last_columns[4];
    for (size_t i = 0; i < 4; ++i) {
        const size_t way = w + i < count ? w + i : w;
        last_places[i] = ways.places[way];
        last_columns[i] = ways.columns[way];
    }
    measure_four<BYTES>(border, {last_places, ways.rows, last_columns}, measured);
    for (size_t i = 0; w + i < count; ++i) distances[w + i] = measured[i];
}

template <size_t BYTES>
struct Cross {
    [[gnu::always_inline]] static void run(const BorderFromSource& border, Rows rows, Columns columns,
                                           float* distances, uint16_t* winners) {
        for (size_t done = 0; done < columns.size();) {
            const ColumnRun run = first_run(columns.subspan(done));
            NearestPlaces nearest;
            LeastSums<BYTES, true>::over_all(border.code, rows, run.first, run.last + 1 - run.first, nearest);
            for (size_t first = 0; first < run.columns.size(); first += AT_ONCE) {
                const auto part = run.columns.subspan(first, std::min(AT_ONCE, run.columns.size() - first));
                cross_part(border, rows, nearest, part, run.first, distances + done,
                           winners ? winners + done : nullptr);
                done += part.size();
            }
        }
    }

private:
    static constexpr size_t AT_ONCE = 64;

    [[gnu::always_inline]] static void cross_part(const BorderFromSource& border, Rows rows,
                                                  const NearestPlaces& nearest, Columns columns,
                                                  uint32_t first, float* distances, uint16_t* winners) {
        int32_t places[AT_ONCE];
        const Missing missing = collect_places(border, rows, nearest, columns, first, places);
        if (!missing.is_all(columns.size()))
            measure<BYTES>(border, {places, rows.data(), columns.data()}, columns.size(), distances);
        missing.for_each([&](size_t i) { distances[i] = INFINITE; });
        if (!winners) return;
        for (size_t i = 0; i < columns.size(); ++i) winners[i] = static_cast<uint16_t>(places[i]);
        missing.for_each([&](size_t i) { winners[i] = BorderFromSource::NO_PLACE; });
    }
};

// ---- The ways over all near segments

// As many codes as fit, as distances; infinity where there is no way.
template <size_t BYTES>
[[gnu::always_inline]] inline void decode_row(const uint16_t* codes, float quantum,
                                              Floats<BYTES>& distances) {
    using Numbers = typename Lanes<BYTES>::Keys;
    typename VectorOf<uint16_t, BYTES / 2>::Type narrow;
    std::memcpy(&narrow, codes, sizeof narrow);
    decode<BYTES>(__builtin_convertvector(narrow, Numbers), quantum, distances);
}

// Over the places from `begin` to `end`, whole parts, and the segments that begin at them.
template <size_t BYTES>
[[gnu::always_inline]] inline float way_within(const BorderFromSource& border, size_t begin, size_t end,
                                               const uint16_t* row) {
    Floats<BYTES> least{}, least_square;
    least += INFINITE;
    least_square = least;
    for (size_t k = begin; k < end; k += Lanes<BYTES>::FLOATS) {
        SegmentsFromSource<Floats<BYTES>> from_source;
        load(border.length + k, from_source.segments.length);
        load(border.half_inverse + k, from_source.segments.half_inverse);
        load(border.foot + k, from_source.foot);
        load(border.height + k, from_source.height);
        Floats<BYTES> distance, from_first, from_second, square;
        load(border.distance + k, distance);
        decode_row<BYTES>(row + k, border.quantum, from_first);
        decode_row<BYTES>(row + k + 1, border.quantum, from_second);
        from_source.square_across(from_first, from_second, square);
        lower(least_square, square);
        lower<Floats<BYTES>>(least, distance + from_first);
    }
    return std::min(std::sqrt(least_of<BYTES>(least_square)), least_of<BYTES>(least));
}

template <size_t BYTES>
struct CrossNear {
    [[gnu::always_inline]] static void run(const BorderFromSource& border, const NearRange& range, Rows rows,
                                           float* distances) {
        const size_t begin = range.begin(), end = range.end(border.places);
        for (size_t r = 0; r < rows.size(); ++r) {
            if (distances[r] > range.reach) continue;
            const float way = way_within<BYTES>(border, begin, end, rows[r]);
            if (way < INFINITE) distances[r] = way;
        }
    }
};

// ---- The ways over all near segments, or over few places: columns are side by side, place by place

// The places of a border from `begin` to `end`, and the segments that begin at them, where another place
// follows. over[k] is the distance of place k for ways over it.
struct PlacesCrossed {
    const BorderFromSource& border;
    const float* over;
    size_t begin, end;
};

// The least ways to as many columns as fit, and the first places that ways over places are least at.
template <size_t BYTES>
[[gnu::always_inline]] inline void measure_columns(const PlacesCrossed& crossed, Rows rows, size_t column,
                                                   Floats<BYTES>& ways,
                                                   typename Lanes<BYTES>::Keys& winners) {
    using Distances = Floats<BYTES>;
    const auto& [border, over, begin, end] = crossed;
    Distances least{}, least_square, from_first, from_second, square;
    least += INFINITE;
    least_square = least;
    winners = typename Lanes<BYTES>::Keys{} + BorderFromSource::NO_PLACE;
    decode_row<BYTES>(rows[begin] + column, border.quantum, from_second);
    for (size_t k = begin; k < end; ++k) {
        from_first = from_second;
        const Distances sum = over[k] + from_first;
        winners = sum < least ? typename Lanes<BYTES>::Keys{} + static_cast<int32_t>(k) : winners;
        lower(least, sum);
        if (k + 1 == border.places) break;
        decode_row<BYTES>(rows[k + 1] + column, border.quantum, from_second);
        const SegmentsFromSource<Distances> from_source{
            {Distances{} + border.length[k], Distances{} + border.half_inverse[k]},
            Distances{} + border.foot[k],
            Distances{} + border.height[k]};
        from_source.square_across(from_first, from_second, square);
        lower(least_square, square);
    }
    ways = least_square;
    take_square_root(ways);
    lower(ways, least);
}

template <size_t BYTES>
struct CrossNearColumns {
    [[gnu::always_inline]] static void run(const BorderFromSource& border, const NearRange& range, Rows rows,
                                           size_t first, float* ways) {
        const PlacesCrossed near{border, border.distance, range.begin(),
                                 std::min(range.end(border.places), border.places)};
        for (size_t c = 0; c < Kernels::NEAR_COLUMNS; c += Lanes<BYTES>::FLOATS) {
            Floats<BYTES> measured;
            typename Lanes<BYTES>::Keys winners;
            measure_columns<BYTES>(near, rows, first + c, measured, winners);
            store(measured, ways + c);
        }
    }
};

template <size_t BYTES>
struct CrossFew {
    [[gnu::always_inline]] static void run(const FewPlaces& few, Rows rows, size_t first, size_t count,
                                           float* ways, uint16_t* winners) {
        using Keys = typename Lanes<BYTES>::Keys;
        using Winners = typename VectorOf<uint16_t, BYTES / 2>::Type;
        float foot[FewPlaces::MOST], height[FewPlaces::MOST], over[FewPlaces::MOST];
        const BorderFromSource border{few.places,       nullptr, few.distance, few.length,
                                      few.half_inverse, foot,    height,       few.quantum};
        unfold<BYTES>(border, foot, height);
        leave_own(few, over);
        for (size_t c = 0; c < count; c += Lanes<BYTES>::FLOATS) {
            Floats<BYTES> measured;
            Keys places;
            measure_columns<BYTES>({border, over, 0, few.places}, rows, first + c, measured, places);
            store(measured, ways + c);
            store(__builtin_convertvector(places, Winners), winners + c);
        }
    }

private:
    [[gnu::always_inline]] static void leave_own(const FewPlaces& few, float* over) {
        using Flags = typename VectorOf<int8_t, BYTES / 4>::Type;
        using Keys = typename Lanes<BYTES>::Keys;
        const Floats<BYTES> none = Floats<BYTES>{} + INFINITE;
        for (size_t k = 0; k < few.places; k += Lanes<BYTES>::FLOATS) {
            Floats<BYTES> distance;
            Flags own;
            load(few.distance + k, distance);
            load(few.is_own + k, own);
            store(__builtin_convertvector(own, Keys) != 0 ? distance : none, over + k);
        }
    }
};

// ---- The ways over samples: columns are side by side

template <size_t BYTES>
struct CrossSamples {
    using Codes = typename Lanes<BYTES>::Codes;
    using HalfCodes = typename VectorOf<int16_t, BYTES / 2>::Type;
    using Numbers = typename Lanes<BYTES>::Keys;
    static constexpr size_t LANES = Lanes<BYTES>::CODES;

    [[gnu::always_inline]] static void run(const SampledBorder& border, const TableRows& rows,
                                           float* distances, uint16_t* winners) {
        const float nearest = nearest_of(border, rows.size());
        if (!(nearest < INFINITE)) {
            std::fill_n(distances, SourceCode::whole_blocks(rows.columns), INFINITE);
            return;
        }
        round_all<BYTES>(border.distance, rows.size(), Floats<BYTES>{} + nearest,
                         steps_per_distance(border.quantum), border.code);
        LeastSums<BYTES, false>::over_all(border.code, rows, 0, SourceCode::whole_blocks(rows.columns),
                                          DecodeColumns{nearest, border.quantum, distances, winners});
        for (const Samples::LongSegment& segment : border.long_segments)
            straighten(border, segment, rows, distances, winners);
    }

private:
    struct DecodeColumns {
        float nearest, quantum;
        float* distances;
        uint16_t* winners;

        [[gnu::always_inline]] void operator()(size_t c, const Codes& least, const Codes& sample) const {
            store(sample, winners + c);
            int16_t sums[LANES];
            store(least, sums);
            for (size_t half = 0; half < LANES; half += LANES / 2)
                decode(sums + half, nearest, quantum, distances + c + half);
        }
    };

    [[gnu::always_inline]] static float nearest_of(const SampledBorder& border, size_t samples) {
        Floats<BYTES> nearest{}, distance;
        nearest += INFINITE;
        for (size_t i = 0; i < samples; i += Lanes<BYTES>::FLOATS) {
            load(border.distance + i, distance);
            lower(nearest, distance);
        }
        return least_of<BYTES>(nearest);
    }

    [[gnu::always_inline]] static void straighten(const SampledBorder& border,
                                                  const Samples::LongSegment& segment, const TableRows& rows,
                                                  float* distances, uint16_t* winners) {
        using Distances = Floats<BYTES>;
        constexpr size_t FLOATS = Lanes<BYTES>::FLOATS;
        SegmentsFromSource<Distances> from_source;
        from_source.segments.length = Distances{} + segment.length;
        from_source.segments.half_inverse = Distances{} + 0.5f / segment.length;
        const Distances from_first = Distances{} + border.distance[segment.first],
                        from_second = Distances{} + border.distance[segment.second];
        from_source.segments.place_point(from_first, from_second, from_source.foot, from_source.height);
        for (size_t c = 0; c < SourceCode::whole_blocks(rows.columns); c += FLOATS) {
            Distances to_first, to_second, way, known;
            decode_row<BYTES>(rows[segment.first] + c, border.quantum, to_first);
            decode_row<BYTES>(rows[segment.second] + c, border.quantum, to_second);
            from_source.square_across(to_first, to_second, way);
            take_square_root(way);
            load(distances + c, known);
            HalfCodes winner;
            load(winners + c, winner);
            const Numbers is_shorter = way < known;
            const Numbers first = Numbers{} + static_cast<int32_t>(segment.first);
            winner = __builtin_convertvector(is_shorter ? first : __builtin_convertvector(winner, Numbers),
                                             HalfCodes);
            store(winner, winners + c);
            lower(known, way);
            store(known, distances + c);
        }
    }

    // Sums without a way are told from others by the sign of a difference. For AVX-512, GCC 12 compiles a
    // comparison of widened sums lane by lane, which takes nearly as long as all rows.
    [[gnu::always_inline]] static void decode(const int16_t* sums, float nearest, float quantum,
                                              float* distances) {
        HalfCodes half;
        load(sums, half);
        const Numbers sum = __builtin_convertvector(half, Numbers);
        Floats<BYTES> distance;
        decode_sums<HalfCodes, Floats<BYTES>>(half, quantum, Floats<BYTES>{} + nearest, distance);
        const Numbers has_no_way = (SourceCode::NO_SUM - 1 - sum) >> 31;
        const Numbers none = reinterpret_cast<Numbers>(Floats<BYTES>{} + INFINITE);
        store((reinterpret_cast<Numbers>(distance) & ~has_no_way) | (none & has_no_way), distances);
    }
};

// ---- Where two ends meet

template <size_t BYTES>
struct Meet {
    [[gnu::always_inline]] static float run(const BorderBetween& border) {
        Floats<BYTES> least{}, least_square;
        least += INFINITE;
        least_square = least;
        for (size_t k = 0; k < border.places; k += Lanes<BYTES>::FLOATS) {
            SegmentsFromSource<Floats<BYTES>> from_source;
            load(border.length + k, from_source.segments.length);
            load(border.half_inverse + k, from_source.segments.half_inverse);
            Floats<BYTES> first, second, sum, square;
            load(border.from + k, first);
            load(border.from + k + 1, second);
            from_source.segments.place_point(first, second, from_source.foot, from_source.height);
            sum = first;
            load(border.to + k, first);
            load(border.to + k + 1, second);
            sum += first;
            from_source.square_across(first, second, square);
            lower(least_square, square);
            lower(least, sum);
        }
        return std::min(std::sqrt(least_of<BYTES>(least_square)), least_of<BYTES>(least));
    }
};

}
