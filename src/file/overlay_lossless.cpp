// The tables of the overlay engine as matrices of floats, which hold codes.
#include <algorithm>
#include <string>

#include "src/base/number_text.h"
#include "src/base/numbers.h"
#include "src/file/code_tables.h"
#include "src/file/sections.h"
#include "src/file/tables.h"
#include "src/overlay/tables/codes.h"

namespace geodesic {

namespace {

float value_of(uint16_t code) { return code == TableCode::UNREACHED ? INFINITE : static_cast<float>(code); }

std::vector<float> values_of(const std::vector<uint16_t>& codes) {
    std::vector<float> values(codes.size());
    for (size_t i = 0; i < codes.size(); ++i) values[i] = value_of(codes[i]);
    return values;
}

uint16_t code_of(float value) {
    if (value == INFINITE) return TableCode::UNREACHED;
    const auto code = static_cast<uint16_t>(std::min(value, float{TableCode::LARGEST}));
    if (static_cast<float>(code) != value)
        refuse_as_corrupt("a table holds " + number_text(value) + ", which is no code of a distance");
    return code;
}

std::vector<uint16_t> codes_of(const std::vector<float>& values, const std::vector<uint8_t>& shift,
                               std::span<const CodeTable> tables) {
    std::vector<uint16_t> codes(values.size());
    for (size_t i = 0; i < values.size(); ++i) codes[i] = code_of(values[i]);
    if (const auto code = code_between_steps(codes, shift, tables))
        refuse_as_corrupt("a table holds " + *code);
    return codes;
}

TableSection overlay_section(const StoredIndex& stored) {
    TableSection section(TAG_OVERLAY_TABLES);
    for (size_t p = 0; p < stored.owned_count.size(); ++p) {
        section.add(stored.owned_count[p], p > 0 ? stored.border_size[p - 1] : 0); // the root has no border
        section.add_below_diagonal(stored.owned_count[p]);
    }
    return section;
}

}

void write_lossless_tables(const StoredIndex& stored, format::ContainerWriter& writer) {
    overlay_section(stored).write(values_of(stored.overlay_codes), writer);
    border_internal_section(stored).write(values_of(stored.border_internal_codes), writer);
    internal_section(stored).write(values_of(stored.internal_codes), writer);
}

void read_lossless_tables(const format::Container& container, uint32_t threads, StoredIndex& stored) {
    const auto read = [&](uint32_t tag, const TableSection& section, std::span<const CodeTable> tables) {
        return about_section(
            tag, [&] { return codes_of(section.read(container, threads), stored.shift, tables); });
    };
    stored.overlay_codes = read(TAG_OVERLAY_TABLES, overlay_section(stored), overlay_tables(stored));
    stored.border_internal_codes =
        read(TAG_BORDER_INTERNAL_TABLES, border_internal_section(stored), border_internal_tables(stored));
    stored.internal_codes = read(TAG_INTERNAL_TABLES, internal_section(stored), internal_tables(stored));
}

}
