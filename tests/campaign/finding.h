#pragma once

#include <cstdarg>
#include <cstdio>
#include <stdexcept>
#include <string>

namespace geodesic::campaign {

// What must hold of every case and does not hold of this one.
struct Finding : std::runtime_error {
    Finding(std::string name, const std::string& values)
        : std::runtime_error(name + ": " + values), check(std::move(name)) {}
    std::string check; // a short name, the same for all cases that fail in this way
};

[[gnu::format(printf, 1, 2)]] inline std::string formatted(const char* format, ...) {
    char text[512];
    va_list values;
    va_start(values, format);
    std::vsnprintf(text, sizeof text, format, values);
    va_end(values);
    return text;
}

template <class... Values>
void expect(bool holds, const char* check, const char* format, Values... values) {
    if (!holds) throw Finding(check, formatted(format, values...));
}

}
