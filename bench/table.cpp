#include "bench/table.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <functional>

namespace geodesic::bench {

namespace {

std::string shortest(double value) {
    char text[32];
    return std::string(text, std::to_chars(text, text + sizeof text, value).ptr);
}

std::string rounded(double value, int digits) {
    if (!std::isfinite(value)) return "-";
    if (value == 0) return "0";
    const int magnitude = static_cast<int>(std::floor(std::log10(std::abs(value))));
    const int decimals = std::clamp(digits - 1 - magnitude, 0, 9);
    char text[400];
    std::snprintf(text, sizeof text, "%.*f", decimals, value);
    return text;
}

std::string plain(const Cell& cell, const char* no_value) {
    if (const auto* text = std::get_if<std::string>(&cell)) return *text;
    if (const auto* count = std::get_if<uint64_t>(&cell)) return std::to_string(*count);
    const double value = std::get<double>(cell);
    return std::isfinite(value) ? shortest(value) : no_value;
}

std::string json_value(const Cell& cell) {
    const auto* text = std::get_if<std::string>(&cell);
    return text ? json_string(*text) : plain(cell, "null");
}

std::string csv_value(const Cell& cell) {
    const std::string text = plain(cell, "");
    if (text.find_first_of(",\"\n") == std::string::npos) return text;
    std::string quoted = "\"";
    for (const char c : text) quoted += c == '"' ? std::string("\"\"") : std::string(1, c);
    return quoted + '"';
}

// Characters, not bytes: headings have Greek letters.
size_t width_of(const std::string& utf8) {
    return static_cast<size_t>(std::count_if(
        utf8.begin(), utf8.end(), [](char c) { return (static_cast<unsigned char>(c) & 0xC0) != 0x80; }));
}

using Line = std::vector<std::string>;

std::vector<Line> visible_lines(const Table& table) {
    std::vector<Line> lines(1);
    for (const Field& field : table.rows.front())
        if (!field.heading.empty()) lines[0].push_back(field.heading);
    for (const Row& row : table.rows) {
        Line& line = lines.emplace_back();
        for (const Field& field : row)
            if (!field.heading.empty()) line.push_back(to_text(field.value, field.digits));
    }
    return lines;
}

std::vector<size_t> column_widths(const std::vector<Line>& lines) {
    std::vector<size_t> widths(lines.front().size(), 3);
    for (const Line& line : lines)
        for (size_t c = 0; c < line.size(); ++c) widths[c] = std::max(widths[c], width_of(line[c]));
    return widths;
}

std::vector<bool> numeric_columns(const Row& row) {
    std::vector<bool> numeric;
    for (const Field& field : row)
        if (!field.heading.empty()) numeric.push_back(!std::holds_alternative<std::string>(field.value));
    return numeric;
}

std::string aligned(const Line& line, const std::vector<size_t>& widths, const std::vector<bool>& right) {
    std::string text = "|";
    for (size_t c = 0; c < line.size(); ++c) {
        const std::string space(widths[c] - width_of(line[c]), ' ');
        text += ' ' + (right[c] ? space + line[c] : line[c] + space) + " |";
    }
    return text + '\n';
}

std::string ruler(const std::vector<size_t>& widths, const std::vector<bool>& right) {
    std::string text = "|";
    for (size_t c = 0; c < widths.size(); ++c)
        text += ' ' + std::string(widths[c] - 1, '-') + (right[c] ? ":" : "-") + " |";
    return text + '\n';
}

std::string comma_separated(const Row& row, const std::function<std::string(const Field&)>& text_of) {
    std::string line;
    for (const Field& field : row) {
        if (!line.empty()) line += ',';
        line += text_of(field);
    }
    line += '\n';
    return line;
}

}

std::string to_text(const Cell& cell, int digits) {
    const double* value = std::get_if<double>(&cell);
    return value ? rounded(*value, digits) : plain(cell, "-");
}

std::string to_text(const Table& table) {
    if (table.rows.empty()) return "";
    const std::vector<Line> lines = visible_lines(table);
    const std::vector<size_t> widths = column_widths(lines);
    const std::vector<bool> right = numeric_columns(table.rows.front());
    std::string text = aligned(lines[0], widths, right) + ruler(widths, right);
    for (size_t i = 1; i < lines.size(); ++i) text += aligned(lines[i], widths, right);
    return text;
}

std::string to_csv(const Table& table) {
    if (table.rows.empty()) return "";
    std::string text = comma_separated(table.rows.front(), [](const Field& field) { return field.key; });
    for (const Row& row : table.rows)
        text += comma_separated(row, [](const Field& field) { return csv_value(field.value); });
    return text;
}

std::string json_string(std::string_view text) {
    std::string quoted = "\"";
    for (const char c : text) {
        if (c == '"' || c == '\\') quoted += '\\';
        if (static_cast<unsigned char>(c) >= 0x20) {
            quoted += c;
            continue;
        }
        char escaped[8];
        std::snprintf(escaped, sizeof escaped, "\\u%04x", static_cast<unsigned>(c));
        quoted += escaped;
    }
    return quoted + '"';
}

std::string to_json(const Row& row) {
    std::string text;
    for (const Field& field : row)
        text += (text.empty() ? "{" : ", ") + json_string(field.key) + ": " + json_value(field.value);
    return (text.empty() ? "{" : text) + '}';
}

std::string to_json(const Table& table, std::string_view indent) {
    std::string text = "[";
    const char* separator = "\n";
    for (const Row& row : table.rows) {
        text += separator + std::string(indent) + "  " + to_json(row);
        separator = ",\n";
    }
    return text + '\n' + std::string(indent) + ']';
}

}
