#pragma once

#include <chrono>
#include <string>
#include <string_view>

namespace geodesic::tools {

// Shows on stderr how far a long work has come. On a terminal it is one line that is drawn again and again,
// and wiped when this is destroyed, so that an error message stands on a clean line. Elsewhere it is a line
// every ten percent, and only where `lines_wanted`.
class ProgressBar {
public:
    explicit ProgressBar(bool lines_wanted);
    ~ProgressBar();
    ProgressBar(const ProgressBar&) = delete;
    ProgressBar& operator=(const ProgressBar&) = delete;

    // `fraction` is 0 .. 1.
    void show(double fraction, std::string_view stage);

private:
    void draw(double fraction, std::string_view stage);
    void print_lines(double fraction, std::string_view stage);

    bool on_terminal_;
    bool lines_wanted_;
    bool drawn_ = false;
    int printed_tens_ = 0;
    std::string last_stage_;
    std::chrono::steady_clock::time_point last_time_{};
};

// The line of a terminal, at most `width` columns; for a terminal too narrow, the percentage alone.
std::string progress_line(double fraction, std::string_view stage, size_t width);

}
