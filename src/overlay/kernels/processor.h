#pragma once

#include <cstddef>

namespace geodesic {

// Kernels come for kinds of processors: any at all, AVX2, AVX-512; how many of these this one can run.
inline size_t runnable_kernels() {
#ifdef __x86_64__
    if (!__builtin_cpu_supports("avx2")) return 1;
    return __builtin_cpu_supports("avx512bw") && __builtin_cpu_supports("avx512vl") ? 3 : 2;
#else
    return 1;
#endif
}

}
