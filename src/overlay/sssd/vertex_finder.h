#pragma once

#include <algorithm>
#include <cstdint>
#include <span>

#include "src/base/numbers.h"

namespace geodesic {

// Finds vertices of one border on another, one after the other. Where two borders have a piece in common, one
// goes along the other, to and fro.
class VertexFinder {
public:
    explicit VertexFinder(std::span<const uint32_t> vertices) : vertices_(vertices) {}

    // Returns where the vertex is, or NONE.
    uint32_t find(uint32_t vertex) {
        for (const uint32_t beside : {last_ + 1, last_ - 1})
            if (beside < vertices_.size() && vertices_[beside] == vertex) return last_ = beside;
        const auto found = std::ranges::find(vertices_, vertex);
        if (found == vertices_.end()) return NONE;
        return last_ = static_cast<uint32_t>(found - vertices_.begin());
    }

private:
    std::span<const uint32_t> vertices_;
    uint32_t last_ = NONE; // where a vertex was found
};

}
