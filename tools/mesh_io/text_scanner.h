#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace geodesic::tools {

// The next word (separated by blanks) at the front of `line`, which is shortened by it; empty at the end.
std::string_view take_word(std::string_view& line);

// The text without the mark that some editors put before UTF-8.
std::string_view without_byte_order_mark(std::string_view text);

// The whole word as a number, or nothing. "nan" and "inf" are numbers here: the library refuses them by name.
std::optional<double> to_number(std::string_view word);
std::optional<int64_t> to_integer(std::string_view word);

// "'word'" for a message, shortened and free of control characters.
std::string quoted(std::string_view word);

// Goes through a text line by line; lines end with LF, CRLF or CR.
class TextScanner {
public:
    explicit TextScanner(std::string_view text) : rest_(text) {}

    bool next_line(std::string_view& line);
    // The next line that holds something besides a comment begun by '#', with that comment cut off.
    bool next_filled_line(std::string_view& line);
    // The next word, from this line or a later one; `line_number` is then the word's. Empty at the end.
    std::string_view next_word();

    size_t line_number() const { return line_number_; }
    size_t bytes_left() const { return rest_.size() + line_.size(); }

    [[noreturn]] void fail(const std::string& why) const;

private:
    std::string_view rest_;
    std::string_view line_;
    size_t line_number_ = 0;
};

}
