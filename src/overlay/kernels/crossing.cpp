#include "src/overlay/kernels/crossing.h"

#include <algorithm>
#include <cstring>

#include "src/overlay/kernels/lanes.h"
#include "src/overlay/kernels/nearest_places.h"
#include "src/overlay/kernels/processor.h"
#include "src/overlay/near.h"

namespace geodesic {

namespace {

// So many rows at a time: first their nearest places, then the ways over them, so that the processor has
// several rows at work at once.
constexpr size_t ROWS = 64;

// ---- The border as seen from a source

// Floats that the widest vector holds, so that results are of the same ones whatever the width.
constexpr size_t PART = Lanes<64>::FLOATS;
constexpr size_t whole_parts(size_t places) { return (places + PART - 1) / PART * PART; }

template <size_t BYTES>
[[gnu::always_inline]] inline void load(const float* first, Floats<BYTES>& floats) {
    std::memcpy(&floats, first, sizeof floats);
}

template <size_t BYTES>
[[gnu::always_inline]] inline void look(const SeenBorder& border, Sight& sight) {
    Floats<BYTES> nearest{}, shortest{}, distance, length;
    nearest += INFINITE;
    for (size_t k = 0; k < border.places; k += Lanes<BYTES>::FLOATS) {
        load<BYTES>(border.distance + k, distance);
        load<BYTES>(border.length + k, length);
        lower(nearest, distance);
        lower<Floats<BYTES>>(shortest, distance < INFINITE ? -length : shortest);
    }
    sight = {least_of<BYTES>(nearest), near_radius(-least_of<BYTES>(shortest)), 1, 0};
    if (sight.nearest > sight.reach) return;
    const auto is_far = [&](size_t k) { return border.distance[k] > sight.reach; };
    for (sight.first = 0; is_far(sight.first);) ++sight.first;
    for (sight.last = border.places - 1; is_far(sight.last);) --sight.last;
}

template <size_t BYTES>
[[gnu::always_inline]] inline void encode(const SeenBorder& border, float nearest, const int32_t* is_own,
                                          int16_t* code) {
    using Numbers = typename Lanes<BYTES>::Keys;
    using Codes [[gnu::vector_size(BYTES / 2)]] = int16_t;
    const Floats<BYTES> largest = Floats<BYTES>{} + float{TableCode::LARGEST};
    const float scale = border.quantum > 0 ? 1 / border.quantum : 0;
    for (size_t k = 0; k < border.places; k += Lanes<BYTES>::FLOATS) {
        Floats<BYTES> distance;
        load<BYTES>(border.distance + k, distance);
        const Floats<BYTES> steps = (distance - nearest) * scale + 0.5f;
        Numbers own;
        std::memcpy(&own, is_own + k, sizeof own);
        const Numbers number =
            __builtin_convertvector(steps < largest ? steps : largest, Numbers) + SourceCode::NEAREST;
        const Codes codes = __builtin_convertvector(
            distance < INFINITE ? number & own : Numbers{} + SourceCode::UNREACHED, Codes);
        std::memcpy(code + k, &codes, sizeof codes);
    }
    std::fill(code + border.places, code + SourceCode::whole_blocks(border.places), SourceCode::UNREACHED);
}

template <size_t BYTES>
[[gnu::always_inline]] inline void unfold(const SeenBorder& border, float* feet, float* heights) {
    for (size_t k = 0; k < whole_parts(border.places); k += Lanes<BYTES>::FLOATS) {
        Segments<Floats<BYTES>> segments;
        load<BYTES>(border.length + k, segments.length);
        load<BYTES>(border.half_inverse + k, segments.half_inverse);
        Floats<BYTES> from_first, from_second, foot, height;
        load<BYTES>(border.distance + k, from_first);
        load<BYTES>(border.distance + k + 1, from_second);
        segments.place_point(from_first, from_second, foot, height);
        std::memcpy(feet + k, &foot, sizeof foot);
        std::memcpy(heights + k, &height, sizeof height);
    }
}

template <size_t BYTES>
[[gnu::always_inline]] inline void see(const SeenBorder& border, const int32_t* is_own, int16_t* code,
                                       float* foot, float* height, Sight& sight) {
    look<BYTES>(border, sight);
    if (!(sight.nearest < INFINITE)) return;
    encode<BYTES>(border, sight.nearest, is_own, code);
    unfold<BYTES>(border, foot, height);
}

// ---- The ways over the nearest places

// Ways to be measured: over these places of a border, and these rows.
struct Ways {
    const int32_t* places;
    const uint16_t* const* rows;

    [[gnu::always_inline]] const uint16_t* codes_near(size_t way) const {
        return rows[way] + places[way] - Rings::REACH;
    }
    [[gnu::always_inline]] NearFloats near(const float* values, size_t way) const {
        return near_floats(values + places[way] - Rings::REACH);
    }
};

// The codes of the ways from `first` on, side by side, four each: those of the places that segments near the
// place begin at, and those of the next ones.
template <size_t BYTES>
[[gnu::always_inline]] inline void codes_near(const Ways& ways, size_t first, Floats<BYTES>& of_first,
                                              Floats<BYTES>& of_second) {
    constexpr std::make_index_sequence<BYTES / sizeof(uint16_t)> ALL;
    typename VectorOf<uint16_t, BYTES>::Type codes;
    typename Lanes<BYTES>::Keys numbers;
    join([&](size_t i) { return load_eight(ways.codes_near(first + i)); }, codes);
    widen_four<0>(codes, numbers, ALL);
    of_first = __builtin_convertvector(numbers, Floats<BYTES>);
    widen_four<1>(codes, numbers, ALL);
    of_second = __builtin_convertvector(numbers, Floats<BYTES>);
}

// Four ways, as many side by side as fit into a vector.
template <size_t BYTES>
[[gnu::always_inline]] inline void measure_four(const SeenBorder& border, const Ways& ways,
                                                NearFloats& distances) {
    constexpr size_t SIDE_BY_SIDE = BYTES / sizeof(NearFloats);
    NearFloats squares[4], sums[4];
    for (size_t r = 0; r < 4; r += SIDE_BY_SIDE) {
        const auto near = [&](const float* values, Floats<BYTES>& out) {
            join([&](size_t i) { return ways.near(values, r + i); }, out);
        };
        SeenSegments<Floats<BYTES>> seen;
        near(border.length, seen.segments.length);
        near(border.half_inverse, seen.segments.half_inverse);
        near(border.foot, seen.foot);
        near(border.height, seen.height);
        Floats<BYTES> first, second, sum, square;
        codes_near<BYTES>(ways, r, first, second);
        first *= border.quantum;
        second *= border.quantum;
        near(border.distance, sum);
        sum += first;
        seen.square_across(first, second, square);
        split(sum, sums + r);
        split(square, squares + r);
    }
    NearFloats over;
    least_lanes(squares, distances);
    take_square_root(distances);
    pick_lanes<Rings::REACH>(sums, over);
    lower(distances, over);
}

// Each over its row, in groups of four, the last one filled up by its first way.
template <size_t BYTES>
[[gnu::always_inline]] inline void measure(const SeenBorder& seen_border, const int32_t* places, Rows rows,
                                           float* distances) {
    const SeenBorder border = seen_border; // which nothing that is written can change
    const size_t count = rows.size();
    NearFloats measured;
    size_t r = 0;
    for (; r + 4 <= count; r += 4) {
        measure_four<BYTES>(border, {places + r, rows.data() + r}, measured);
        std::memcpy(distances + r, &measured, sizeof measured);
    }
    if (r == count) return;
    int32_t last_places[4];
    const uint16_t* last_rows[4];
    for (size_t i = 0; i < 4; ++i) {
        const size_t way = r + i < count ? r + i : r;
        last_places[i] = places[way];
        last_rows[i] = rows[way];
    }
    measure_four<BYTES>(border, {last_places, last_rows}, measured);
    for (size_t i = 0; r + i < count; ++i) distances[r + i] = measured[i];
}

template <size_t BYTES>
[[gnu::always_inline]] inline void cross(const SeenBorder& border, Rows rows, float* distances,
                                         uint16_t* winners) {
    int32_t places[ROWS];
    for (size_t done = 0; done < rows.size(); done += ROWS) {
        const Rows part = rows.subspan(done, std::min(ROWS, rows.size() - done));
        const Missing missing = find_nearest_places<BYTES>(border, part, places);
        measure<BYTES>(border, places, part, distances + done);
        missing.for_each([&](size_t r) { distances[done + r] = INFINITE; });
        if (!winners) continue;
        for (size_t r = 0; r < part.size(); ++r) winners[done + r] = static_cast<uint16_t>(places[r]);
        missing.for_each([&](size_t r) { winners[done + r] = SeenBorder::NO_PLACE; });
    }
}

// ---- The ways over all near segments

// As many codes as fit, as distances; infinity where there is no way.
template <size_t BYTES>
[[gnu::always_inline]] inline void decode(const uint16_t* codes, float quantum, Floats<BYTES>& distances) {
    using Numbers = typename Lanes<BYTES>::Keys;
    typename VectorOf<uint16_t, BYTES / 2>::Type narrow;
    std::memcpy(&narrow, codes, sizeof narrow);
    const Numbers numbers = __builtin_convertvector(narrow, Numbers);
    const Floats<BYTES> none = Floats<BYTES>{} + INFINITE;
    distances =
        numbers < TableCode::UNREACHED ? __builtin_convertvector(numbers, Floats<BYTES>) * quantum : none;
}

// Over the places from `begin` to `end`, whole parts, and the segments that begin at them.
template <size_t BYTES>
[[gnu::always_inline]] inline float way_within(const SeenBorder& border, size_t begin, size_t end,
                                               const uint16_t* row) {
    Floats<BYTES> least{}, least_square;
    least += INFINITE;
    least_square = least;
    for (size_t k = begin; k < end; k += Lanes<BYTES>::FLOATS) {
        SeenSegments<Floats<BYTES>> seen;
        load<BYTES>(border.length + k, seen.segments.length);
        load<BYTES>(border.half_inverse + k, seen.segments.half_inverse);
        load<BYTES>(border.foot + k, seen.foot);
        load<BYTES>(border.height + k, seen.height);
        Floats<BYTES> distance, from_first, from_second, square;
        load<BYTES>(border.distance + k, distance);
        decode<BYTES>(row + k, border.quantum, from_first);
        decode<BYTES>(row + k + 1, border.quantum, from_second);
        seen.square_across(from_first, from_second, square);
        lower(least_square, square);
        lower<Floats<BYTES>>(least, distance + from_first);
    }
    return std::min(std::sqrt(least_of<BYTES>(least_square)), least_of<BYTES>(least));
}

template <size_t BYTES>
[[gnu::always_inline]] inline void cross_near(const SeenBorder& border, const Sight& sight, Rows rows,
                                              float* distances) {
    const size_t before = std::max(sight.first, size_t{Rings::REACH}) - Rings::REACH;
    const size_t begin = before / PART * PART,
                 end = whole_parts(std::min(sight.last + Rings::REACH, border.places));
    for (size_t r = 0; r < rows.size(); ++r) {
        if (distances[r] > sight.reach) continue;
        const float way = way_within<BYTES>(border, begin, end, rows[r]);
        if (way < INFINITE) distances[r] = way;
    }
}

template <size_t BYTES>
[[gnu::always_inline]] inline void choose(const SeenBorder& border, Rows rows, uint16_t* winners) {
    int32_t places[ROWS];
    for (size_t done = 0; done < rows.size(); done += ROWS) {
        const Rows part = rows.subspan(done, std::min(ROWS, rows.size() - done));
        find_keys<BYTES>(border, part, places);
        const Missing missing =
            take_places(places, part.size(), [&](size_t r) { return choose_place(border, part[r]); });
        for (size_t r = 0; r < part.size(); ++r) winners[done + r] = static_cast<uint16_t>(places[r]);
        missing.for_each([&](size_t r) { winners[done + r] = SeenBorder::NO_PLACE; });
    }
}

// ---- For each kind of processor

Sight see_baseline(const SeenBorder& border, const int32_t* is_own, int16_t* code, float* foot,
                   float* height) {
    Sight sight;
    see<16>(border, is_own, code, foot, height, sight);
    return sight;
}
void cross_baseline(const SeenBorder& border, Rows rows, float* distances, uint16_t* winners) {
    cross<16>(border, rows, distances, winners);
}
void cross_near_baseline(const SeenBorder& border, const Sight& sight, Rows rows, float* distances) {
    cross_near<16>(border, sight, rows, distances);
}
void choose_baseline(const SeenBorder& border, Rows rows, uint16_t* winners) {
    choose<16>(border, rows, winners);
}

#ifdef __x86_64__
[[gnu::target("avx2")]] Sight see_avx2(const SeenBorder& border, const int32_t* is_own, int16_t* code,
                                       float* foot, float* height) {
    Sight sight;
    see<32>(border, is_own, code, foot, height, sight);
    return sight;
}
[[gnu::target("avx2")]] void cross_avx2(const SeenBorder& border, Rows rows, float* distances,
                                        uint16_t* winners) {
    cross<32>(border, rows, distances, winners);
}
[[gnu::target("avx2")]] void cross_near_avx2(const SeenBorder& border, const Sight& sight, Rows rows,
                                             float* distances) {
    cross_near<32>(border, sight, rows, distances);
}
[[gnu::target("avx2")]] void choose_avx2(const SeenBorder& border, Rows rows, uint16_t* winners) {
    choose<32>(border, rows, winners);
}

[[gnu::target("avx512bw,avx512vl")]] Sight see_avx512(const SeenBorder& border, const int32_t* is_own,
                                                      int16_t* code, float* foot, float* height) {
    Sight sight;
    see<64>(border, is_own, code, foot, height, sight);
    return sight;
}
[[gnu::target("avx512bw,avx512vl")]] void cross_avx512(const SeenBorder& border, Rows rows, float* distances,
                                                       uint16_t* winners) {
    cross<64>(border, rows, distances, winners);
}
[[gnu::target("avx512bw,avx512vl")]] void cross_near_avx512(const SeenBorder& border, const Sight& sight,
                                                            Rows rows, float* distances) {
    cross_near<64>(border, sight, rows, distances);
}
[[gnu::target("avx512bw,avx512vl")]] void choose_avx512(const SeenBorder& border, Rows rows,
                                                        uint16_t* winners) {
    choose<64>(border, rows, winners);
}
#endif

constexpr CrossingKernel KERNELS[] = {
    {"baseline", see_baseline, cross_baseline, cross_near_baseline, choose_baseline},
#ifdef __x86_64__
    {"AVX2", see_avx2, cross_avx2, cross_near_avx2, choose_avx2},
    {"AVX-512", see_avx512, cross_avx512, cross_near_avx512, choose_avx512},
#endif
};

}

std::span<const CrossingKernel> crossing_kernels() { return std::span(KERNELS).first(runnable_kernels()); }

}
