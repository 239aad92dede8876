#include "src/overlay/kernels/dispatch.h"

#include "src/overlay/kernels/bounded_sweep.h"
#include "src/overlay/kernels/crossing.h"
#include "src/overlay/kernels/polygon.h"
#include "src/overlay/kernels/sweep.h"
#include "src/overlay/kernels/turning.h"

namespace geodesic {

namespace {

// The bodies of all kernels are templates over the width of a vector, in bytes, and are always inlined. Each
// struct below is an instruction set, and its run() is the function that a body is inlined into, so that the
// body is compiled for that set.
//
// Nothing else may be compiled for more than any processor has. That is why run() carries an attribute, and
// no file is compiled with flags of an instruction set: the flags would hold for inline functions of the
// standard library, too, of which the linker keeps one copy for the whole library, perhaps this one, and
// processors without the set would stop there.

struct Baseline {
    static constexpr const char* NAME = "baseline";

    template <template <size_t> class Kernel, class Result, class... Arguments>
    static Result run(Arguments... arguments) {
        return Kernel<16>::run(arguments...);
    }
};

#ifdef __x86_64__
struct Avx2 {
    static constexpr const char* NAME = "AVX2";
    static bool is_runnable() { return __builtin_cpu_supports("avx2"); }

    template <template <size_t> class Kernel, class Result, class... Arguments>
    [[gnu::target("avx2")]] static Result run(Arguments... arguments) {
        return Kernel<32>::run(arguments...);
    }
};

struct Avx512 {
    static constexpr const char* NAME = "AVX-512";
    static bool is_runnable() {
        return Avx2::is_runnable() && __builtin_cpu_supports("avx512bw") &&
               __builtin_cpu_supports("avx512vl");
    }

    template <template <size_t> class Kernel, class Result, class... Arguments>
    [[gnu::target("avx512bw,avx512vl")]] static Result run(Arguments... arguments) {
        return Kernel<64>::run(arguments...);
    }
};
#endif

// In the order of the members of Kernels, whose types tell run() its result and its arguments.
template <class Set>
constexpr Kernels kernels_of() {
    return {Set::NAME,
            Set::template run<PrepareCrossing>,
            Set::template run<Cross>,
            Set::template run<CrossNear>,
            Set::template run<CrossNearColumns>,
            Set::template run<CrossFew>,
            Set::template run<CrossSamples>,
            Set::template run<Meet>,
            Set::template run<LookOut>,
            Set::template run<PrepareSweepOfOne>,
            Set::template run<PrepareSweepOfEach>,
            Set::template run<Sweep>,
            Set::template run<SweepEach>,
            Set::template run<SweepBounded>,
            Set::template run<TurnSquares>};
}

// A processor that runs one of them runs all before it.
#ifdef __x86_64__
constexpr Kernels KERNELS[] = {kernels_of<Baseline>(), kernels_of<Avx2>(), kernels_of<Avx512>()};
size_t count_runnable() { return 1 + size_t{Avx2::is_runnable()} + size_t{Avx512::is_runnable()}; }
#else
constexpr Kernels KERNELS[] = {kernels_of<Baseline>()};
size_t count_runnable() { return 1; }
#endif

}

std::span<const Kernels> runnable_kernels() { return std::span(KERNELS).first(count_runnable()); }

}
