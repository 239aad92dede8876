#include "tools/mesh_io/text_scanner.h"

#include <charconv>
#include <cstdlib>

#include "tools/mesh_io/mesh_io.h"

namespace geodesic::tools {

namespace {

constexpr std::string_view BLANKS = " \t\v\f\r";

// std::from_chars knows no plus sign.
std::string_view without_plus(std::string_view word) {
    const bool plus = word.size() > 1 && word[0] == '+' && word[1] != '-' && word[1] != '+';
    return plus ? word.substr(1) : word;
}

}

std::string_view take_word(std::string_view& line) {
    const size_t begin = line.find_first_not_of(BLANKS);
    if (begin == std::string_view::npos) {
        line = {};
        return {};
    }
    line.remove_prefix(begin);
    const std::string_view word = line.substr(0, line.find_first_of(BLANKS));
    line.remove_prefix(word.size());
    return word;
}

std::string_view without_byte_order_mark(std::string_view text) {
    constexpr std::string_view MARK = "\xEF\xBB\xBF";
    return text.starts_with(MARK) ? text.substr(MARK.size()) : text;
}

std::optional<double> to_number(std::string_view word) {
    word = without_plus(word);
    double value = 0;
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
    if (end != word.data() + word.size() || word.empty()) return std::nullopt;
    // Too large or too small for a double: strtod gives the infinity or the tiny number that is meant.
    if (error == std::errc::result_out_of_range) return std::strtod(std::string(word).c_str(), nullptr);
    if (error != std::errc{}) return std::nullopt;
    return value;
}

std::optional<int64_t> to_integer(std::string_view word) {
    word = without_plus(word);
    int64_t value = 0;
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
    if (error != std::errc{} || end != word.data() + word.size()) return std::nullopt;
    return value;
}

std::string quoted(std::string_view word) {
    constexpr size_t LONGEST = 32;
    std::string text = "'";
    for (const char c : word.substr(0, LONGEST)) text += c >= ' ' && c <= '~' ? c : '?';
    if (word.size() > LONGEST) text += "...";
    return text + "'";
}

bool TextScanner::next_line(std::string_view& line) {
    if (rest_.empty()) return false;
    const size_t length = rest_.find_first_of("\r\n");
    line = rest_.substr(0, length);
    rest_.remove_prefix(line.size());
    if (rest_.starts_with("\r\n")) {
        rest_.remove_prefix(2);
    } else if (!rest_.empty()) {
        rest_.remove_prefix(1);
    }
    ++line_number_;
    return true;
}

bool TextScanner::next_filled_line(std::string_view& line) {
    while (next_line(line)) {
        line = line.substr(0, line.find('#'));
        if (line.find_first_not_of(BLANKS) != std::string_view::npos) return true;
    }
    return false;
}

std::string_view TextScanner::next_word() {
    for (;;) {
        const std::string_view word = take_word(line_);
        if (!word.empty()) return word;
        if (!next_line(line_)) return {};
    }
}

void TextScanner::fail(const std::string& why) const {
    throw MeshFileError("line " + std::to_string(line_number_) + ": " + why);
}

}
