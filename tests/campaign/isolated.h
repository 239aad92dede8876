#pragma once

#include <functional>
#include <optional>
#include <string>

namespace geodesic::campaign {

struct Failure {
    std::string check; // Finding's, or "crash"
    std::string text;
};

// Runs `check` in a process of its own, so that a crash, a sanitizer's report or an endless loop is a failure
// like any other; nothing if it ends without a Finding. Only for a process with one thread. `quiet`: what the
// process prints to standard error is lost.
std::optional<Failure> failure_of(const std::function<void()>& check, bool quiet);

}
