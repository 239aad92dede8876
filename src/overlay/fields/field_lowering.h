#pragma once

#include <algorithm>
#include <cstdint>
#include <memory_resource>
#include <span>
#include <tuple>

#include "src/base/array.h"
#include "src/base/numbers.h"
#include "src/overlay/kernels/dispatch.h"
#include "src/overlay/tables/steep_edges.h"

namespace geodesic {

// Lowers fields along steep edges, when all hops have been made. Where the larger one of the distances of an
// edge's two ends is more than the lesser one plus the edge's limit, it becomes that sum, until this is so
// for no edge. Then a lowered distance was too long, or that of the other end is too short, and the lowered
// one is too short by no larger share. What is nearest is lowered first, so that each vertex is lowered once.
class FieldLowering {
public:
    FieldLowering(const SteepEdges& steep, std::pmr::memory_resource* memory)
        : steep_(steep), ways_(memory), edges_of_batch_(memory) {}

    // Where `source`, which may be empty, says of each vertex which source its distance comes from, a lowered
    // one has the source of the vertex at the other end.
    void lower(std::span<float> distance, std::span<uint32_t> source = {});

    // Lowers FIELDS_AT_ONCE fields that lie side by side at each vertex.
    void lower_each(std::span<float> distances);
    // Whether any of the fields is to be lowered at either end of an edge, by the distances of both ends in
    // all of them.
    static bool is_steep(const float* first, const float* second, float limit);

    // Lowers those distances of a field that become no more than `radius`. All vertices whose distances are
    // no more than it must be among the numbers. known(number) is the distance of any vertex, and
    // lower(number, distance, from) makes it less, by an edge from another vertex. Returns the least distance
    // beyond the radius that one would be lowered to, infinity if there is none.
    template <class Known, class Lower>
    float lower_within(float radius, std::span<const uint32_t> numbers, const Known& known,
                       const Lower& lower) {
        ways_.clear();
        if (steep_.edges.empty()) return INFINITE;
        for (const uint32_t number : numbers)
            if (known(number) <= radius) add_ways_from(number, known);
        return lower_all(radius, known, lower);
    }

private:
    struct Way {
        float length;
        uint32_t to, from;
    };
    static constexpr auto LONGER = [](const Way& a, const Way& b) {
        return std::tie(a.length, a.to, a.from) > std::tie(b.length, b.to, b.from);
    };

    void add(const Way& way) {
        ways_.push_back(way);
        std::ranges::push_heap(ways_, LONGER);
    }
    template <class Known>
    void add_way(uint32_t from, uint32_t to, float limit, const Known& known) {
        if (known(from) + limit < known(to)) add({known(from) + limit, to, from});
    }
    template <class Known>
    void add_ways_along(const VertexPair& edge, const Known& known) {
        add_way(edge.first, edge.second, edge.distance, known);
        add_way(edge.second, edge.first, edge.distance, known);
    }
    template <class Known>
    void add_ways_from(uint32_t from, const Known& known) {
        for (const auto& [other, limit] : steep_.of(from)) add_way(from, other, limit, known);
    }
    template <class Known, class Lower>
    float lower_all(float radius, const Known& known, const Lower& lower) {
        while (!ways_.empty()) {
            std::ranges::pop_heap(ways_, LONGER);
            const Way least = ways_.back();
            ways_.pop_back();
            if (!(least.length < known(least.to))) continue;
            if (least.length > radius) return least.length;
            lower(least.to, least.length, least.from);
            add_ways_from(least.to, known);
        }
        return INFINITE;
    }

    const SteepEdges& steep_;
    Array<Way> ways_;                // a heap, the shortest one first
    Array<uint32_t> edges_of_batch_; // edges that are steep in some of several fields
};

}
