// Random index files, each asked everything: geoidx_file_campaign [--seed N] [--count N] [--seconds N]
// [--output FILE]. A seed alone reproduces its case, and --output writes the file of it.

#include <chrono>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <string>
#include <unistd.h>

#include "tests/campaign/file_queries.h"

using namespace geodesic::file_campaign;

extern "C" void __sanitizer_set_death_callback(void (*callback)()) __attribute__((weak));

namespace {

struct Arguments {
    uint64_t seed = 1, count = 1, seconds = UINT64_MAX;
    std::string output;
};

Arguments arguments_of(int count, char** values) {
    Arguments arguments;
    bool is_counted = false;
    for (int i = 1; i < count; i += 2) {
        const std::string name = values[i];
        if (i + 1 == count) std::exit(2);
        if (name == "--output") {
            arguments.output = values[i + 1];
            continue;
        }
        const uint64_t number = std::strtoull(values[i + 1], nullptr, 10);
        if (name == "--seed") {
            arguments.seed = number;
        } else if (name == "--count") {
            arguments.count = number;
            is_counted = true;
        } else if (name == "--seconds") {
            arguments.seconds = number;
        } else {
            std::exit(2);
        }
    }
    if (!is_counted && arguments.seconds != UINT64_MAX) arguments.count = UINT64_MAX;
    return arguments;
}

volatile uint64_t seed_at_hand = 0;

// Of a case that ends the process.
void tell_seed() {
    char text[80];
    const int size = std::snprintf(text, sizeof text, "geoidx_file_campaign: it was --seed %llu\n",
                                   static_cast<unsigned long long>(seed_at_hand));
    [[maybe_unused]] const auto written = write(STDERR_FILENO, text, static_cast<size_t>(size));
}

void on_crash(int signal) {
    tell_seed();
    std::signal(signal, SIG_DFL);
    std::raise(signal);
}

void tell_seed_of_crashes() {
    if (__sanitizer_set_death_callback) {
        __sanitizer_set_death_callback(tell_seed);
        return;
    }
    for (int signal : {SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT}) std::signal(signal, on_crash);
}

bool run_case(uint64_t seed, const std::string& output) {
    const FileContent content = random_content(seed);
    const WrittenFile file = write_content(content);
    if (!output.empty())
        std::ofstream(output, std::ios::binary)
            .write(reinterpret_cast<const char*>(file.bytes.data()),
                   static_cast<std::streamsize>(file.bytes.size()));
    return ask_everything(content, file, seed);
}

}

int main(int count, char** values) {
    const Arguments arguments = arguments_of(count, values);
    tell_seed_of_crashes();
    const auto begin = std::chrono::steady_clock::now();
    uint64_t done = 0, opened = 0;
    for (; done < arguments.count; ++done) {
        const std::chrono::duration<double> passed = std::chrono::steady_clock::now() - begin;
        if (passed.count() > static_cast<double>(arguments.seconds)) break;
        seed_at_hand = arguments.seed + done;
        try {
            opened += run_case(seed_at_hand, arguments.output);
        } catch (const Broken& broken) {
            std::fprintf(stderr, "does not hold: %s\n", broken.what());
            tell_seed();
            return 1;
        }
    }
    std::printf("%llu files, of which %llu were opened\n", static_cast<unsigned long long>(done),
                static_cast<unsigned long long>(opened));
    constexpr uint64_t MANY = 100;
    if (done < MANY || opened >= done - done / 10) return 0;
    std::fprintf(stderr, "more than a tenth of the files were refused\n");
    return 1;
}
