#include "tests/campaign/isolated.h"

#include <csignal>
#include <cstring>
#include <system_error>

#include <fcntl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include "tests/campaign/finding.h"

namespace geodesic::campaign {

namespace {

constexpr int FOUND = 77;            // exit status of a process that reports a Finding
constexpr rlim_t MOST_SECONDS = 600; // of the processor: more is an endless loop

[[noreturn]] void fail(const char* call) { throw std::system_error(errno, std::generic_category(), call); }

void write_all(int file, const std::string& text) {
    for (size_t done = 0; done < text.size();) {
        const ssize_t count = write(file, text.data() + done, text.size() - done);
        if (count <= 0) return;
        done += static_cast<size_t>(count);
    }
}

std::string read_all(int file) {
    std::string text;
    char part[4096];
    for (ssize_t count; (count = read(file, part, sizeof part)) > 0;)
        text.append(part, static_cast<size_t>(count));
    return text;
}

// In the new process. The name of the check comes first, ended by a zero.
[[noreturn]] void run(const std::function<void()>& check, int report, bool quiet) {
    const rlimit limit{MOST_SECONDS, MOST_SECONDS};
    setrlimit(RLIMIT_CPU, &limit);
    if (quiet)
        if (const int nothing = open("/dev/null", O_WRONLY); nothing >= 0) dup2(nothing, STDERR_FILENO);
    try {
        check();
    } catch (const Finding& finding) {
        write_all(report, finding.check + '\0' + finding.what());
        _exit(FOUND);
    } catch (const std::exception& error) {
        write_all(report, std::string("exception") + '\0' + error.what());
        _exit(FOUND);
    }
    _exit(0);
}

std::optional<Failure> read_status(int status, const std::string& report) {
    if (WIFSIGNALED(status)) return Failure{"crash", std::string("crash: ") + strsignal(WTERMSIG(status))};
    if (WEXITSTATUS(status) == 0) return std::nullopt;
    if (WEXITSTATUS(status) != FOUND)
        return Failure{"crash", "crash: exit status " + std::to_string(WEXITSTATUS(status))};
    const std::string check = report.c_str();
    return Failure{check, report.substr(std::min(report.size(), check.size() + 1))};
}

}

std::optional<Failure> failure_of(const std::function<void()>& check, bool quiet) {
    int ends[2];
    if (pipe(ends) != 0) fail("pipe");
    const pid_t process = fork();
    if (process < 0) fail("fork");
    if (process == 0) {
        close(ends[0]);
        run(check, ends[1], quiet);
    }
    close(ends[1]);
    const std::string report = read_all(ends[0]);
    close(ends[0]);
    int status = 0;
    while (waitpid(process, &status, 0) < 0)
        if (errno != EINTR) fail("waitpid");
    return read_status(status, report);
}

}
