#pragma once

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include "src/index/stored.h"
#include "src/query/index.h"

namespace geodesic::test {

inline constexpr uint16_t NO_PATH = 0x7fff;

// The border of a patch and its segments: first those of chains, of which one may begin at each position,
// then bridges.
struct StoredBorder {
    std::vector<uint32_t> vertices, before; // per position; NONE if no segment of a chain ends there
    std::vector<uint32_t> begin, end;       // positions, per segment; end is NONE if there is no such one
    std::vector<float> length;              // per segment

    size_t size() const { return vertices.size(); }
    size_t segment_count() const { return end.size(); }

    // The positions where the segments beside a position begin.
    std::vector<uint32_t> beside(uint32_t position) const {
        std::vector<uint32_t> begins;
        for (uint32_t k = position, i = 0; i < 2 && end[k] != NONE; k = end[k], ++i) begins.push_back(k);
        for (uint32_t k = position, i = 0; i < 2 && before[k] != NONE; ++i) {
            k = before[k];
            begins.push_back(k);
        }
        return begins;
    }
};

// The tables of an index as its file has them. Vertices are given by their numbers.
class StoredTables {
public:
    StoredTables(const Index& index, const Numbering& numbering)
        : stored_(restore(index)), numbering_(numbering), first_entry_(1, 0) {
        for (uint32_t p = 0; p < numbering.first_leaf(); ++p) {
            const uint64_t owned = stored_.owned_count[p];
            first_entry_.push_back(first_entry_.back() + owned * numbering.border_size(p) +
                                   (owned > 0 ? owned * (owned - 1) / 2 : 0));
        }
    }

    float quantum(uint32_t patch) const { return stored_.quantum[patch]; }

    StoredBorder border(uint32_t patch) const {
        const auto vertices = numbering_.border_of(patch);
        const auto first = static_cast<std::ptrdiff_t>(numbering_.border_begin[patch]);
        const auto last = first + static_cast<std::ptrdiff_t>(vertices.size());
        const auto& [end, length, bridges] = stored_.segments;
        StoredBorder border{{vertices.begin(), vertices.end()},
                            std::vector<uint32_t>(vertices.size(), NONE),
                            std::vector<uint32_t>(vertices.size()),
                            {end.begin() + first, end.begin() + last},
                            {length.begin() + first, length.begin() + last}};
        for (uint32_t k = 0; k < border.size(); ++k) {
            border.begin[k] = k;
            if (border.end[k] != NONE) border.before[border.end[k]] = k;
        }
        for (const Bridge& bridge : bridges) {
            if (bridge.slot < first || bridge.slot >= last) continue;
            border.begin.push_back(bridge.slot - static_cast<uint32_t>(first));
            border.end.push_back(bridge.end);
            border.length.push_back(bridge.length);
        }
        return border;
    }

    // The codes of a vertex and of each position of a patch's border. Upwards, the vertex is in the overlay
    // of the patch's parent.
    std::vector<uint16_t> row_up(uint32_t patch, uint32_t x) const {
        std::vector<uint16_t> row;
        for (const uint32_t b : numbering_.border_of(patch))
            row.push_back(overlay_code(numbering_.parent[patch], x, b));
        return row;
    }
    // Downwards, it is inside of the patch.
    std::vector<uint16_t> row_down(uint32_t patch, uint32_t x) const {
        std::vector<uint16_t> row;
        if (patch < numbering_.first_leaf()) {
            for (const uint32_t b : numbering_.border_of(patch)) row.push_back(overlay_code(patch, x, b));
            return row;
        }
        uint64_t entry = x - numbering_.first_internal(patch);
        for (uint32_t leaf = numbering_.first_leaf(); leaf < patch; ++leaf)
            entry += uint64_t{numbering_.border_size(leaf)} * numbering_.internal_size(leaf);
        for (uint32_t k = 0; k < numbering_.border_size(patch); ++k, entry += numbering_.internal_size(patch))
            row.push_back(stored_.border_internal_codes[entry]);
        return row;
    }

    // The codes of all pairs of internal vertices of a leaf, of other patches no rows.
    std::vector<std::vector<uint16_t>> between_internal(uint32_t patch) const {
        if (patch < numbering_.first_leaf()) return {};
        uint64_t entry = 0;
        for (uint32_t leaf = numbering_.first_leaf(); leaf < patch; ++leaf)
            for (uint64_t i = 0; i < numbering_.internal_size(leaf); ++i) entry += i;
        const size_t count = numbering_.internal_size(patch);
        std::vector<std::vector<uint16_t>> codes(count, std::vector<uint16_t>(count, 0));
        for (size_t i = 0; i < count; ++i)
            for (size_t j = 0; j < i; ++j, ++entry) codes[i][j] = codes[j][i] = stored_.internal_codes[entry];
        return codes;
    }

private:
    std::optional<uint32_t> position_among_owned(uint32_t patch, uint32_t x) const {
        const uint32_t first = numbering_.owned_begin[patch];
        if (x < first || x >= first + stored_.owned_count[patch]) return std::nullopt;
        return x - first;
    }

    uint16_t overlay_code(uint32_t patch, uint32_t x, uint32_t y) const {
        if (x == y) return 0;
        const auto i = position_among_owned(patch, x), j = position_among_owned(patch, y);
        if (!i && !j) return taken_from_parent(patch, x, y);
        if (!i) return overlay_code(patch, y, x);
        const auto border = numbering_.border_of(patch);
        uint64_t entry = first_entry_[patch];
        if (j) {
            const uint64_t row = std::max(*i, *j), column = std::min(*i, *j);
            entry += uint64_t{stored_.owned_count[patch]} * border.size() + row * (row - 1) / 2 + column;
        } else {
            entry +=
                *i * border.size() + static_cast<uint64_t>(std::ranges::find(border, y) - border.begin());
        }
        return stored_.overlay_codes[entry];
    }

    uint16_t taken_from_parent(uint32_t patch, uint32_t x, uint32_t y) const {
        const uint32_t parent = numbering_.parent[patch];
        const uint16_t code = overlay_code(parent, x, y);
        const double from{quantum(parent)}, to{quantum(patch)};
        if (code == NO_PATH || code == 0 || to == 0) return code;
        return static_cast<uint16_t>(std::clamp(std::floor(code * from / to + 0.5), 1.0, 32766.0));
    }

    StoredIndex stored_;
    const Numbering& numbering_;
    std::vector<uint64_t> first_entry_; // per inner patch: in overlay_codes
};

}
