// Random meshes, each built with random options and asked everything, against the metric itself.

#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <fstream>

#include <sys/resource.h>

#include "tests/campaign/mesh_case.h"

using namespace geodesic::campaign;

namespace {

constexpr const char* USAGE =
    "usage: geoidx_mesh_campaign [--seed N] [--count N] [--seconds N] [--shrink] [--keep FILE]\n"
    "       geoidx_mesh_campaign --replay FILE...\n"
    "Cases of the seeds N, N + 1, ... (1), as many as --count says (100) or as begin within so many seconds\n"
    "of processor time. --shrink makes the mesh of the first finding smaller, --keep writes it, and "
    "--replay\n"
    "checks what was written.\n";

struct Arguments {
    uint64_t seed = 1, count = 100;
    double seconds = 0;
    bool shrink = false;
    std::string keep;
};

[[noreturn]] void wrong_usage() {
    std::fputs(USAGE, stderr);
    std::exit(2);
}

uint64_t number(const char* text) {
    char* end = nullptr;
    const uint64_t value = std::strtoull(text, &end, 10);
    if (*text == 0 || *end != 0) wrong_usage();
    return value;
}

Arguments arguments_of(int count, char** values) {
    Arguments arguments;
    bool is_counted = false;
    for (int i = 1; i < count; ++i) {
        const std::string name = values[i];
        if (name == "--shrink") {
            arguments.shrink = true;
            continue;
        }
        if (++i == count) wrong_usage();
        if (name == "--seed")
            arguments.seed = number(values[i]);
        else if (name == "--count")
            is_counted = true, arguments.count = number(values[i]);
        else if (name == "--seconds")
            arguments.seconds = static_cast<double>(number(values[i]));
        else if (name == "--keep")
            arguments.keep = values[i];
        else
            wrong_usage();
    }
    if (arguments.seconds > 0 && !is_counted) arguments.count = UINT64_MAX;
    return arguments;
}

double processor_seconds() {
    double sum = 0;
    for (int who : {RUSAGE_SELF, RUSAGE_CHILDREN}) {
        rusage usage{};
        getrusage(who, &usage);
        for (const timeval& time : {usage.ru_utime, usage.ru_stime})
            sum += static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
    }
    return sum;
}

void keep_first(const Arguments& arguments, MeshCase failing, Failure failure) {
    if (arguments.shrink) {
        failing = shrunk(std::move(failing), failure.check);
        if (const auto now = failure_of(failing, true)) failure = *now;
        std::printf("shrunk to %zu triangles: %s\n", failing.soup.triangles.size(), failure.text.c_str());
    }
    if (arguments.keep.empty()) return;
    std::ofstream file(arguments.keep);
    write_case(file, failing, failure.text);
    if (!file.flush()) std::fprintf(stderr, "cannot write %s\n", arguments.keep.c_str());
}

int run(const Arguments& arguments) {
    uint64_t done = 0, findings = 0;
    for (; done < arguments.count; ++done) {
        if (arguments.seconds > 0 && processor_seconds() >= arguments.seconds) break;
        const MeshCase next = random_case(arguments.seed + done);
        const auto failure = failure_of(next);
        if (!failure) continue;
        std::printf("seed %llu: %s\n", static_cast<unsigned long long>(arguments.seed + done),
                    failure->text.c_str());
        if (findings++ == 0) keep_first(arguments, next, *failure);
        std::fflush(stdout);
    }
    std::printf("%llu meshes from seed %llu in %.0f s of processor time: %llu findings\n",
                static_cast<unsigned long long>(done), static_cast<unsigned long long>(arguments.seed),
                processor_seconds(), static_cast<unsigned long long>(findings));
    return findings == 0 ? 0 : 1;
}

int replay(int count, char** paths) {
    if (count == 0) wrong_usage();
    int findings = 0;
    for (int i = 0; i < count; ++i) {
        std::ifstream file(paths[i]);
        const MeshCase kept = read_case(file);
        if (kept.soup.triangles.empty()) {
            std::fprintf(stderr, "%s has no triangles or cannot be read\n", paths[i]);
            return 2;
        }
        const auto failure = failure_of(kept);
        if (failure) std::printf("%s: %s\n", paths[i], failure->text.c_str());
        findings += failure.has_value();
    }
    std::printf("%d files: %d findings\n", count, findings);
    return findings == 0 ? 0 : 1;
}

}

int main(int count, char** values) {
    if (count > 1 && std::strcmp(values[1], "--replay") == 0) return replay(count - 2, values + 2);
    return run(arguments_of(count, values));
}
