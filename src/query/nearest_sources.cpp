#include <algorithm>

#include "src/base/four_at_a_time.h"
#include "src/query/query.h"

namespace geodesic {

// The engine names sources by their numbers; a source that no triangle uses is the nearest to itself alone.
void Query::nearest_sources(std::span<const uint32_t> source_ids, std::span<uint32_t> nearest,
                            std::span<float> distances) {
    check_count("vertex_count", nearest.size(), 1);
    take_sources(source_ids);
    const uint32_t vertices = index_.numbering().vertex_count();
    nearest_.resize(vertices);
    position_at_.resize(vertices, NONE);
    std::visit(
        [&](auto& engine) {
            engine.nearest_sources(sources_, std::span(distance_).first(vertices), nearest_);
        },
        engine_);
    for (const uint32_t source : sources_) distance_[source] = 0;
    write_positions(source_ids, nearest);
    if (distances.empty()) return;
    write_by_id(distances);
    for (const uint32_t id : unused_sources_) distances[id] = 0;
}

// Of a source that is repeated the first position is written last, and stays. All ids are read before any
// answer is written: see take_sources().
void Query::write_positions(std::span<const uint32_t> source_ids, std::span<uint32_t> nearest) {
    const uint32_t* const number_of_id = index_.number_of_id.data();
    unused_positions_.clear();
    unused_positions_.reserve(unused_sources_.size()); // which may throw, so before positions are noted
    for (size_t i = source_ids.size(); i-- > 0;)
        if (const uint32_t number = number_of_id[source_ids[i]]; number != NONE)
            position_at_[number] = static_cast<uint32_t>(i);
        else
            unused_positions_.emplace_back(source_ids[i], static_cast<uint32_t>(i));
    four_at_a_time(nearest.size(), [&](size_t id) {
        const uint32_t number = number_of_id[id], source = number == NONE ? NONE : nearest_[number];
        nearest[id] = source == NONE ? NONE : position_at_[source];
    });
    for (const auto& [id, position] : unused_positions_) nearest[id] = position;
    for (const uint32_t number : sources_) position_at_[number] = NONE;
}

}
