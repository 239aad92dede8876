#include "bench/machine.h"

#include <cstdlib>
#include <fstream>
#include <thread>

#if defined(__GLIBC__)
#include <malloc.h>
#endif

#include "geoidx.h"

namespace geodesic::bench {

namespace {

// What follows the colon in the first line of a file of /proc that begins with `name`.
std::string proc_value(const char* path, const std::string& name) {
    std::ifstream file(path);
    for (std::string line; std::getline(file, line);) {
        if (line.rfind(name, 0) != 0) continue;
        const size_t value = line.find_first_not_of(": \t", line.find(':'));
        return value == std::string::npos ? "" : line.substr(value);
    }
    return "";
}

std::string processor_name() {
    const std::string name = proc_value("/proc/cpuinfo", "model name");
    return name.empty() ? "unknown" : name;
}

std::string compiler_name() {
#if defined(__clang__)
    const std::string name = __VERSION__;
#elif defined(__GNUC__)
    const std::string name = "GCC " __VERSION__;
#else
    const std::string name = "unknown";
#endif
#if defined(NDEBUG)
    return name;
#else
    return name + ", with assertions";
#endif
}

std::string library_version() {
    const uint32_t version = geoidx_version();
    return std::to_string(version / 10000) + "." + std::to_string(version / 100 % 100) + "." +
           std::to_string(version % 100);
}

double load_average() {
    double load[1] = {0};
    return getloadavg(load, 1) == 1 ? load[0] : 0;
}

}

Row machine_description() {
    return {{"cpu", "CPU", processor_name()},
            {"processors", "processors", uint64_t{std::thread::hardware_concurrency()}},
            {"load_average", "load of the last minute", load_average()},
            {"compiler", "compiler", compiler_name()},
            {"geoidx", "geoidx", library_version()}};
}

void forget_peak_memory() {
#if defined(__GLIBC__)
    malloc_trim(0);
#endif
    std::ofstream("/proc/self/clear_refs") << "5";
}

uint64_t peak_memory() {
    const std::string kibibytes = proc_value("/proc/self/status", "VmHWM");
    return std::strtoull(kibibytes.c_str(), nullptr, 10) * 1024;
}

uint64_t heap_memory() {
#if defined(__GLIBC__)
    const auto used = mallinfo2();
    return used.uordblks + used.hblkhd;
#else
    return 0;
#endif
}

}
