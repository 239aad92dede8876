#include "src/query/crossing.h"

#include <algorithm>
#include <cstring>

#include "src/query/lanes.h"
#include "src/query/nearest_places.h"

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
[[gnu::always_inline]] inline float least_of(const Floats<BYTES>& floats) {
    NearFloats four;
    fold(floats, four);
    return std::min(std::min(four[0], four[1]), std::min(four[2], four[3]));
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
    sight = {least_of<BYTES>(nearest), -OverlayTables::NEAR * least_of<BYTES>(shortest), 1, 0};
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
    const Floats<BYTES> largest = Floats<BYTES>{} + float{OverlayTables::LARGEST};
    const float scale = border.quantum > 0 ? 1 / border.quantum : 0;
    for (size_t k = 0; k < border.places; k += Lanes<BYTES>::FLOATS) {
        Floats<BYTES> distance;
        load<BYTES>(border.distance + k, distance);
        const Floats<BYTES> steps = (distance - nearest) * scale + 0.5f;
        Numbers own;
        std::memcpy(&own, is_own + k, sizeof own);
        const Numbers number =
            __builtin_convertvector(steps < largest ? steps : largest, Numbers) + SeenBorder::NEAREST;
        const Codes codes = __builtin_convertvector(
            distance < INFINITE ? number & own : Numbers{} + SeenBorder::NOT_SEEN, Codes);
        std::memcpy(code + k, &codes, sizeof codes);
    }
    std::fill(code + border.places, code + SeenBorder::whole_blocks(border.places), SeenBorder::NOT_SEEN);
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

// Ways to be measured: over these places of a border. From one way to the next, rows are `row_step` pointers
// apart, what is seen of the border `source_step` floats; known when this is compiled.
struct Ways {
    const int32_t* places;
    const uint16_t* const* rows;
    size_t row_step, source_step;

    [[gnu::always_inline]] const uint16_t* codes_near(size_t way) const {
        return rows[way * row_step] + places[way] - Rings::REACH;
    }
    [[gnu::always_inline]] NearFloats of_ring(const float* values, size_t way) const {
        return near_floats(values + places[way] - Rings::REACH);
    }
    [[gnu::always_inline]] NearFloats of_source(const float* values, size_t way) const {
        return near_floats(values + places[way] - Rings::REACH + way * source_step);
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
        const auto of_ring = [&](const float* values, Floats<BYTES>& out) {
            join([&](size_t i) { return ways.of_ring(values, r + i); }, out);
        };
        const auto of_source = [&](const float* values, Floats<BYTES>& out) {
            join([&](size_t i) { return ways.of_source(values, r + i); }, out);
        };
        SeenSegments<Floats<BYTES>> seen;
        of_ring(border.length, seen.segments.length);
        of_ring(border.half_inverse, seen.segments.half_inverse);
        of_source(border.foot, seen.foot);
        of_source(border.height, seen.height);
        Floats<BYTES> first, second, sum, square;
        codes_near<BYTES>(ways, r, first, second);
        first *= border.quantum;
        second *= border.quantum;
        of_source(border.distance, sum);
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
        measure_four<BYTES>(border, {places + r, rows.data() + r, 1, 0}, measured);
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
    measure_four<BYTES>(border, {last_places, last_rows, 1, 0}, measured);
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
        numbers < OverlayTables::UNREACHED ? __builtin_convertvector(numbers, Floats<BYTES>) * quantum : none;
}

// Over the segments from `begin` to `end`, whole parts.
template <size_t BYTES>
[[gnu::always_inline]] inline float straight_way(const SeenBorder& border, size_t begin, size_t end,
                                                 const uint16_t* row) {
    Floats<BYTES> least{};
    least += INFINITE;
    for (size_t k = begin; k < end; k += Lanes<BYTES>::FLOATS) {
        SeenSegments<Floats<BYTES>> seen;
        load<BYTES>(border.length + k, seen.segments.length);
        load<BYTES>(border.half_inverse + k, seen.segments.half_inverse);
        load<BYTES>(border.foot + k, seen.foot);
        load<BYTES>(border.height + k, seen.height);
        Floats<BYTES> from_first, from_second, square;
        decode<BYTES>(row + k, border.quantum, from_first);
        decode<BYTES>(row + k + 1, border.quantum, from_second);
        seen.square_across(from_first, from_second, square);
        lower(least, square);
    }
    return std::sqrt(least_of<BYTES>(least));
}

template <size_t BYTES>
[[gnu::always_inline]] inline void lower_near(const SeenBorder& border, const Sight& sight, Rows rows,
                                              float* distances) {
    const size_t before = std::max(sight.first, size_t{1}) - 1; // the segment before the place
    const size_t begin = before / PART * PART, end = whole_parts(sight.last + 1);
    for (size_t r = 0; r < rows.size(); ++r)
        if (distances[r] <= sight.reach)
            distances[r] = std::min(distances[r], straight_way<BYTES>(border, begin, end, rows[r]));
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

// ---- From several sources

// From each source over one row.
template <size_t BYTES>
[[gnu::always_inline]] inline void measure_each(const SeenBorders& borders, const int32_t* places,
                                                const uint16_t* row, float* distances) {
    SeenBorder border = borders.first;
    const size_t stride = borders.stride;
    NearFloats measured;
    for (size_t i = 0; i < SeenBorders::SOURCES; i += 4) {
        measure_four<BYTES>(border, {places + i, &row, 0, stride}, measured);
        std::memcpy(distances + i, &measured, sizeof measured);
        for (const float** of_source : {&border.distance, &border.foot, &border.height})
            *of_source += 4 * stride;
    }
}

// Over four rows.
template <size_t BYTES>
[[gnu::always_inline]] inline void cross_four(const SeenBorders& borders, const uint16_t* const* rows,
                                              float* distances) {
    constexpr size_t SOURCES = SeenBorders::SOURCES;
    int32_t places[4 * SOURCES];
    const Missing missing = find_nearest_places_of_each<BYTES>(borders, rows, places);
    for (size_t r = 0; r < 4; ++r)
        measure_each<BYTES>(borders, places + r * SOURCES, rows[r], distances + r * SOURCES);
    missing.for_each([&](size_t way) { distances[way] = INFINITE; });
}

template <size_t BYTES>
[[gnu::always_inline]] inline void cross_each(const SeenBorders& borders, Rows rows, float* distances) {
    constexpr size_t SOURCES = SeenBorders::SOURCES;
    size_t r = 0;
    for (; r + 4 <= rows.size(); r += 4) cross_four<BYTES>(borders, rows.data() + r, distances + r * SOURCES);
    if (r == rows.size()) return;
    const uint16_t* last[4];
    float last_distances[4 * SOURCES];
    for (size_t i = 0; i < 4; ++i) last[i] = rows[r + i < rows.size() ? r + i : r];
    cross_four<BYTES>(borders, last, last_distances);
    std::copy_n(last_distances, (rows.size() - r) * SOURCES, distances + r * SOURCES);
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
void lower_near_baseline(const SeenBorder& border, const Sight& sight, Rows rows, float* distances) {
    lower_near<16>(border, sight, rows, distances);
}
void choose_baseline(const SeenBorder& border, Rows rows, uint16_t* winners) {
    choose<16>(border, rows, winners);
}
void cross_each_baseline(const SeenBorders& borders, Rows rows, float* distances) {
    cross_each<16>(borders, rows, distances);
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
[[gnu::target("avx2")]] void lower_near_avx2(const SeenBorder& border, const Sight& sight, Rows rows,
                                             float* distances) {
    lower_near<32>(border, sight, rows, distances);
}
[[gnu::target("avx2")]] void choose_avx2(const SeenBorder& border, Rows rows, uint16_t* winners) {
    choose<32>(border, rows, winners);
}
[[gnu::target("avx2")]] void cross_each_avx2(const SeenBorders& borders, Rows rows, float* distances) {
    cross_each<32>(borders, rows, distances);
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
[[gnu::target("avx512bw,avx512vl")]] void lower_near_avx512(const SeenBorder& border, const Sight& sight,
                                                            Rows rows, float* distances) {
    lower_near<64>(border, sight, rows, distances);
}
[[gnu::target("avx512bw,avx512vl")]] void choose_avx512(const SeenBorder& border, Rows rows,
                                                        uint16_t* winners) {
    choose<64>(border, rows, winners);
}
[[gnu::target("avx512bw,avx512vl")]] void cross_each_avx512(const SeenBorders& borders, Rows rows,
                                                            float* distances) {
    cross_each<64>(borders, rows, distances);
}
#endif

constexpr CrossingKernel KERNELS[] = {
    {"baseline", see_baseline, cross_baseline, lower_near_baseline, choose_baseline, cross_each_baseline},
#ifdef __x86_64__
    {"AVX2", see_avx2, cross_avx2, lower_near_avx2, choose_avx2, cross_each_avx2},
    {"AVX-512", see_avx512, cross_avx512, lower_near_avx512, choose_avx512, cross_each_avx512},
#endif
};

size_t count_kernels() {
#ifdef __x86_64__
    if (!__builtin_cpu_supports("avx2")) return 1;
    return __builtin_cpu_supports("avx512bw") && __builtin_cpu_supports("avx512vl") ? 3 : 2;
#else
    return 1;
#endif
}

}

std::span<const CrossingKernel> crossing_kernels() {
    static const size_t count = count_kernels();
    return std::span(KERNELS).first(count);
}

}
