// Rows of tables that have them in part, or as columns.
#include "src/overlay/hops/turned_rows.h"

#include <algorithm>
#include <random>
#include <span>
#include <vector>

#include <doctest/doctest.h>

using namespace geodesic;

namespace {

constexpr size_t PADDING = 64; // that kernels may read

// The code of two vertices.
uint16_t code_of(uint32_t i, uint32_t j) { return static_cast<uint16_t>(i * 241 + j * 7 + 1); }
uint16_t code_among(uint32_t i, uint32_t j) { return code_of(std::max(i, j), std::min(i, j)); }

std::vector<uint16_t> matrix(uint32_t rows, uint32_t columns) {
    std::vector<uint16_t> codes;
    for (uint32_t i = 0; i < rows; ++i)
        for (uint32_t j = 0; j < columns; ++j) codes.push_back(code_of(i, j));
    codes.resize(codes.size() + PADDING);
    return codes;
}

std::vector<uint16_t> half(uint32_t rows) {
    std::vector<uint16_t> codes;
    for (uint32_t i = 0; i < rows; ++i)
        for (uint32_t j = 0; j < HalfTable::columns(i); ++j) codes.push_back(code_among(i, j));
    CHECK(codes.size() == HalfTable::size(rows));
    codes.resize(codes.size() + PADDING);
    return codes;
}

// The entries from first to last that are wrong, of these rows.
template <class Code>
uint64_t wrong_entries(TurnedRows& turned, const TurnableTable& table, const std::vector<uint32_t>& rows,
                       uint32_t first, uint32_t last, const Code& code) {
    turned.begin(table, first, last);
    for (const uint32_t row : rows) turned.announce(row);
    turned.turn();
    uint64_t wrong = 0;
    for (const uint32_t row : rows) {
        const uint16_t* entries = turned.next_row(row);
        for (uint32_t i = first; i <= last; ++i)
            wrong += entries[i - TurnedRows::first_entry(first)] != code(row, i);
    }
    return wrong;
}

// Up, down, to and fro, each row twice, and none.
std::vector<std::vector<uint32_t>> orders(uint32_t count) {
    std::vector<uint32_t> up(count);
    for (uint32_t i = 0; i < count; ++i) up[i] = i;
    std::vector<uint32_t> shuffled = up, twice = up;
    std::ranges::shuffle(shuffled, std::mt19937(count));
    twice.insert(twice.end(), up.begin(), up.end());
    return {up, {up.rbegin(), up.rend()}, shuffled, twice, {}};
}

const std::vector<std::pair<uint32_t, uint32_t>> PARTS = {{0, 0},   {0, 69},  {7, 8},   {33, 34},
                                                          {31, 65}, {40, 40}, {64, 69}, {5, 68}};

}

TEST_CASE("turned rows: columns of a table") {
    TurnedRows turned(std::pmr::get_default_resource());
    const auto codes = matrix(70, 53);
    for (const auto& rows : orders(53))
        for (const auto& [first, last] : PARTS)
            CHECK(wrong_entries(turned, {codes.data(), 70, 53}, rows, first, last,
                                [](uint32_t column, uint32_t row) { return code_of(row, column); }) == 0);
}

TEST_CASE("turned rows: rows of a half table") {
    TurnedRows turned(std::pmr::get_default_resource());
    const auto codes = half(70);
    for (const auto& rows : orders(70))
        for (const auto& [first, last] : PARTS)
            CHECK(wrong_entries(turned, {codes.data(), 70, 0, true}, rows, first, last, code_among) == 0);
}

TEST_CASE("turned rows: by every kernel") {
    const auto codes = matrix(TurnedSquares::ROWS, 40);
    const uint16_t* rows[TurnedSquares::ROWS];
    for (uint32_t i = 0; i < TurnedSquares::ROWS; ++i) rows[i] = codes.data() + i * 40;
    for (const Kernels& kernels : runnable_kernels()) {
        CAPTURE(kernels.name);
        std::vector<uint16_t> out(2 * TurnedSquares::SIDE * 50);
        const TurnedSquares squares[] = {{16, out.data()}, {3, out.data() + TurnedSquares::SIDE * 50}};
        kernels.turn_squares(rows, std::span(squares), 50);
        uint64_t wrong = 0;
        for (uint32_t square = 0; square < 2; ++square)
            for (uint32_t c = 0; c < TurnedSquares::SIDE; ++c)
                for (uint32_t r = 0; r < TurnedSquares::ROWS; ++r)
                    wrong += squares[square].out[c * 50 + r] !=
                             code_of(r, static_cast<uint32_t>(squares[square].first_column) + c);
        CHECK(wrong == 0);
    }
}
