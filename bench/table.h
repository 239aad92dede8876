#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace geodesic::bench {

using Cell = std::variant<std::string, uint64_t, double>; // not finite: no value

// One value of a row under two names: the key, with its unit, for programs, the heading for people. A field
// without a heading is for programs only.
struct Field {
    std::string key;
    std::string heading;
    Cell value;
    int digits = 3; // significant ones, for people
};

using Row = std::vector<Field>;

// All rows have the fields of the first one.
struct Table {
    std::string key;
    std::string title;
    std::vector<Row> rows;
};

// Aligned rows with bars, as Markdown has them.
std::string to_text(const Table& table);
std::string to_csv(const Table& table);

// An array of objects; `indent` is put before each of its lines but the first.
std::string to_json(const Table& table, std::string_view indent);
std::string to_json(const Row& row);
std::string json_string(std::string_view text);

// In words for people; "-" without a value.
std::string to_text(const Cell& cell, int digits);

}
