#include "src/build/border_vertices.h"

#include <algorithm>

namespace geodesic {

namespace {

// The vertex of the caller's mesh with each number, or NONE for an added vertex.
std::vector<uint32_t> vertices_by_number(const Index& index, const Intake& intake) {
    std::vector<uint32_t> vertex_of_number(index.numbering().vertex_count(), NONE);
    for (size_t id = 0; id < index.number_of_id.size(); ++id)
        if (const uint32_t number = index.number_of_id[id]; number != NONE)
            vertex_of_number[number] = intake.vertex_of_id[id];
    return vertex_of_number;
}

}

BorderVertices::BorderVertices(const Index& index, const Intake& intake) : mesh_(intake.mesh) {
    const Numbering& numbering = index.numbering();
    const auto vertex_of_number = vertices_by_number(index, intake);
    for (uint32_t level = 0; level < numbering.level_count(); ++level) {
        std::vector<uint32_t> vertices;
        const uint32_t end = numbering.owned_begin[numbering.level_begin[level + 1]];
        for (uint32_t n = numbering.owned_begin[numbering.level_begin[level]]; n < end; ++n)
            if (vertex_of_number[n] != NONE) vertices.push_back(vertex_of_number[n]);
        if (!vertices.empty()) levels_.push_back(std::move(vertices));
    }
}

uint32_t BorderVertices::on_or_next_to(Random& random) const {
    const auto& vertices = levels_[random.below(static_cast<uint32_t>(levels_.size()))];
    const uint32_t on_border = vertices[random.below(static_cast<uint32_t>(vertices.size()))];
    const auto around = neighbours(mesh_, on_border);
    const uint32_t i = random.below(static_cast<uint32_t>(2 * around.size()));
    return i < around.size() ? around[i] : on_border;
}

std::vector<uint32_t> BorderVertices::in_a_row(Random& random, uint32_t count) const {
    const auto& vertices = levels_[random.below(static_cast<uint32_t>(levels_.size()))];
    const auto size = static_cast<uint32_t>(vertices.size());
    const uint32_t taken = std::min(count, size), first = random.below(size - taken + 1);
    return {vertices.begin() + first, vertices.begin() + first + taken};
}

}
