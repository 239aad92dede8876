#pragma once

#include <chrono>
#include <string>
#include <string_view>

namespace geodesic::tools {

// One line on stderr that shows how far a long work has come, and only where stderr is a terminal. It is
// wiped when it is destroyed, so that an error message stands on a clean line.
class ProgressBar {
public:
    ProgressBar();
    ~ProgressBar();
    ProgressBar(const ProgressBar&) = delete;
    ProgressBar& operator=(const ProgressBar&) = delete;

    // `fraction` is 0 .. 1.
    void show(double fraction, std::string_view stage);

private:
    bool visible_;
    bool drawn_ = false;
    std::string last_stage_;
    std::chrono::steady_clock::time_point last_time_{};
};

// The line itself, at most `width` columns; for a terminal too narrow, the percentage alone.
std::string progress_line(double fraction, std::string_view stage, size_t width);

}
