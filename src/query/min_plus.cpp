#include "src/query/min_plus.h"

#include <algorithm>

namespace geodesic {

namespace {

// Columns side by side, read from any address.
template <size_t BYTES>
struct Vector {
    using Codes [[gnu::vector_size(BYTES), gnu::aligned(2), gnu::may_alias]] = uint16_t;
};

// One row after the other: what is best so far stays in the first-level cache. Always inlined, so that it is
// compiled for the processor of its caller.
template <size_t BYTES>
[[gnu::always_inline]] inline void lower_rows(std::span<const MinPlusRow> rows, size_t room, uint16_t* best,
                                              uint16_t* winner) {
    using Codes = typename Vector<BYTES>::Codes;
    for (size_t r = 0; r < rows.size(); ++r) {
        const Codes start = Codes{} + rows[r].start, row = Codes{} + static_cast<uint16_t>(r);
        for (size_t x = 0; x < room; x += BYTES / sizeof(uint16_t)) {
            Codes& lowest = *reinterpret_cast<Codes*>(best + x);
            Codes& lowest_row = *reinterpret_cast<Codes*>(winner + x);
            const Codes sum = *reinterpret_cast<const Codes*>(rows[r].entries + x) + start;
            const auto is_lower = sum < lowest;
            lowest_row = is_lower ? row : lowest_row;
            lowest = is_lower ? sum : lowest;
        }
    }
}

void lower_baseline(std::span<const MinPlusRow> rows, size_t room, uint16_t* best, uint16_t* winner) {
    lower_rows<16>(rows, room, best, winner);
}

#ifdef __x86_64__
[[gnu::target("avx2")]] void lower_avx2(std::span<const MinPlusRow> rows, size_t room, uint16_t* best,
                                        uint16_t* winner) {
    lower_rows<32>(rows, room, best, winner);
}

[[gnu::target("avx512bw")]] void lower_avx512(std::span<const MinPlusRow> rows, size_t room, uint16_t* best,
                                              uint16_t* winner) {
    lower_rows<64>(rows, room, best, winner);
}
#endif

constexpr MinPlusKernel KERNELS[] = {
    {"baseline", lower_baseline},
#ifdef __x86_64__
    {"AVX2", lower_avx2},
    {"AVX-512", lower_avx512},
#endif
};

size_t count_kernels() {
#ifdef __x86_64__
    if (!__builtin_cpu_supports("avx2")) return 1;
    return __builtin_cpu_supports("avx512bw") ? 3 : 2;
#else
    return 1;
#endif
}

}

std::span<const MinPlusKernel> min_plus_kernels() {
    static const size_t count = count_kernels();
    return std::span(KERNELS).first(count);
}

void min_plus(std::span<const MinPlusRow> rows, size_t columns, uint16_t* best, uint16_t* winner,
              const MinPlusKernel& kernel) {
    const size_t room = min_plus_room(columns);
    std::fill_n(best, room, UINT16_MAX);
    std::fill_n(winner, room, uint16_t{0});
    kernel.lower(rows, room, best, winner);
}

}
