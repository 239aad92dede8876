#pragma once

#include <chrono>
#include <ctime>

namespace geodesic::bench {

// Seconds.
struct Duration {
    double wall = 0;
    double cpu = 0;
};

// CPU time is the calling thread's, or that of all threads of the process.
enum class CpuTime { of_thread, of_process };

inline double cpu_seconds(CpuTime whose) {
    timespec time{};
    clock_gettime(whose == CpuTime::of_thread ? CLOCK_THREAD_CPUTIME_ID : CLOCK_PROCESS_CPUTIME_ID, &time);
    return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

// The CPU clock is a system call, so it is read outside the interval of the wall clock.
template <typename Work>
Duration time_of(Work&& work, CpuTime whose = CpuTime::of_thread) {
    using Clock = std::chrono::steady_clock;
    const double cpu = cpu_seconds(whose);
    const Clock::time_point start = Clock::now();
    work();
    const Clock::time_point end = Clock::now();
    return {std::chrono::duration<double>(end - start).count(), cpu_seconds(whose) - cpu};
}

}
