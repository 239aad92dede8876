#include "tools/progress_bar.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include <sys/ioctl.h>
#include <unistd.h>

namespace geodesic::tools {

namespace {

size_t terminal_width() {
    winsize size{};
    if (ioctl(STDERR_FILENO, TIOCGWINSZ, &size) != 0 || size.ws_col == 0) return 80;
    return size.ws_col;
}

}

std::string progress_line(double fraction, std::string_view stage, size_t width) {
    constexpr size_t LONGEST_BAR = 40;
    constexpr size_t PERCENT_COLUMNS = 5;
    constexpr size_t STAGE_COLUMNS = 26;
    fraction = fraction > 0 ? std::min(fraction, 1.0) : 0; // a NaN counts as 0
    std::string percent = std::to_string(static_cast<int>(std::floor(100 * fraction))).append(1, '%');
    percent.insert(percent.begin(), PERCENT_COLUMNS - percent.size(), ' ');
    // The last column stays free: many terminals would break the line there.
    const size_t taken = PERCENT_COLUMNS + STAGE_COLUMNS + 5;
    if (width <= taken + 4) return percent;
    const size_t columns = std::min(width - taken, LONGEST_BAR);
    const size_t filled = static_cast<size_t>(fraction * static_cast<double>(columns));
    std::string line(columns + 2, '.');
    line.front() = '[';
    line.back() = ']';
    line.replace(1, filled, filled, '#');
    return line.append(percent).append(2, ' ').append(stage.substr(0, STAGE_COLUMNS));
}

ProgressBar::ProgressBar(bool lines_wanted)
    : on_terminal_(isatty(STDERR_FILENO) == 1), lines_wanted_(lines_wanted) {}

ProgressBar::~ProgressBar() {
    if (drawn_) std::fputs("\r\x1b[K", stderr);
}

void ProgressBar::show(double fraction, std::string_view stage) {
    if (on_terminal_)
        draw(fraction, stage);
    else if (lines_wanted_)
        print_lines(fraction, stage);
}

void ProgressBar::draw(double fraction, std::string_view stage) {
    using namespace std::chrono_literals;
    const auto now = std::chrono::steady_clock::now();
    if (drawn_ && stage == last_stage_ && now - last_time_ < 100ms) return;
    last_stage_ = stage;
    last_time_ = now;
    drawn_ = true;
    std::fprintf(stderr, "\r%s\x1b[K", progress_line(fraction, stage, terminal_width()).c_str());
    std::fflush(stderr);
}

// Always ten lines in the end, also where several tens go by at once.
void ProgressBar::print_lines(double fraction, std::string_view stage) {
    const int tens = fraction > 0 ? static_cast<int>(std::floor(10 * std::min(fraction, 1.0))) : 0;
    while (printed_tens_ < tens)
        std::fprintf(stderr, "%3d%%  %.*s\n", 10 * ++printed_tens_, static_cast<int>(stage.size()),
                     stage.data());
    std::fflush(stderr);
}

}
