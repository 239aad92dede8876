#pragma once

#include <memory_resource>
#include <optional>
#include <span>

#include "src/overlay/msad.h"
#include "src/overlay/pair_tables.h"
#include "src/overlay/ssad.h"
#include "src/overlay/sssd/prepared_source.h"
#include "src/overlay/sssd/sssd.h"

namespace geodesic {

// Queries over overlay tables, which are fixed sequences of min-plus products. Where the metric unfolds, a
// path may cross a border between two vertices.
class OverlayQuery {
public:
    OverlayQuery(const OverlayIndex& index, std::pmr::memory_resource* memory)
        : index_(index), memory_(memory), field_(index, memory), nearest_(index, memory),
          batch_(index, memory, FIELDS_AT_ONCE), prepared_(index, memory) {}

    // Requires low < high; callers pass both orders of a pair this way, so that both get the same bits.
    float sssd(uint32_t low, uint32_t high) { return pairs().distance(low, high); }

    // Prepares a source: prepared_sssd() then answers distances from it.
    void prepare(uint32_t source) { prepared_.prepare(source, field_); }
    float prepared_sssd(uint32_t target) { return prepared_.distance(target); }

    // Sets how many threads msad() uses.
    void set_threads(uint32_t count) {
        field_.set_threads(count);
        nearest_.set_threads(count);
    }

    // Fills distance[number] of every vertex. Vertices of patches beyond the radius may be infinite.
    void msad(std::span<const uint32_t> sources, float radius, std::span<float> distance) {
        if (sources.size() == 1)
            field_.sweep(sources, radius, distance);
        else
            nearest_.sweep(sources, radius, distance);
    }

    // Fills distances[number * FIELDS_AT_ONCE + i] with the distance from the i-th of FIELDS_AT_ONCE sources.
    // For fewer than FEWEST_AT_ONCE different ones it is faster to call msad() for each.
    static constexpr size_t FIELDS_AT_ONCE = OverlaySsad::MOST_FIELDS, FEWEST_AT_ONCE = 8;
    void ssad_each(std::span<const uint32_t> sources, std::span<float> distances) {
        batch_.sweep(sources, INFINITE, distances);
    }

private:
    // The first pair of all makes the tables that pairs need, and the first one of this object its scratch.
    OverlaySssd& pairs() {
        if (pairs_) return *pairs_;
        require_pair_tables(index_);
        return pairs_.emplace(index_, memory_);
    }

    const OverlayIndex& index_;
    std::pmr::memory_resource* const memory_;
    std::optional<OverlaySssd> pairs_;
    OverlaySsad field_;
    OverlayMsad nearest_;
    OverlaySsad batch_;
    PreparedSource prepared_;
};

}
