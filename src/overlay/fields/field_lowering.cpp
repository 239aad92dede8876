#include "src/overlay/fields/field_lowering.h"

#include "src/overlay/kernels/lanes.h"

namespace geodesic {

bool FieldLowering::is_steep(const float* first, const float* second, float limit) {
    FourKeys steep{};
    for (size_t i = 0; i < FIELDS_AT_ONCE; i += 4) {
        Floats<16> a, b;
        load(first + i, a);
        load(second + i, b);
        steep |= (a + limit < b) | (b + limit < a);
    }
    return any(steep);
}

void FieldLowering::lower(std::span<float> distance, std::span<uint32_t> source) {
    ways_.clear();
    const auto known = [&](uint32_t number) { return distance[number]; };
    for (const VertexPair& edge : steep_.edges) add_ways_along(edge, known);
    lower_all(INFINITE, known, [&](uint32_t to, float way, uint32_t from) {
        distance[to] = way;
        if (!source.empty()) source[to] = source[from];
    });
}

void FieldLowering::lower_each(std::span<float> distances) {
    edges_of_batch_.clear();
    for (uint32_t e = 0; e < steep_.edges.size(); ++e) {
        const auto& [first, second, limit] = steep_.edges[e];
        const float* const at = distances.data();
        if (is_steep(at + first * FIELDS_AT_ONCE, at + second * FIELDS_AT_ONCE, limit))
            edges_of_batch_.push_back(e);
    }
    for (size_t i = 0; i < FIELDS_AT_ONCE; ++i) {
        ways_.clear();
        const auto known = [&](uint32_t number) -> float& { return distances[number * FIELDS_AT_ONCE + i]; };
        for (const uint32_t e : edges_of_batch_) add_ways_along(steep_.edges[e], known);
        lower_all(INFINITE, known, [&](uint32_t to, float way, uint32_t) { known(to) = way; });
    }
}

}
