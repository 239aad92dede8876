#include "src/query/query.h"

#include <algorithm>
#include <limits>
#include <string>

#include "format/error.h"

namespace geodesic {

namespace {

constexpr float INFINITE = std::numeric_limits<float>::infinity();

std::variant<GraphQuery, OverlayQuery> make_engine(const Index& index, std::pmr::memory_resource* memory) {
    if (index.engine == GEOIDX_ENGINE_OVERLAY) return OverlayQuery(index, memory);
    return GraphQuery(index, memory);
}

}

Query::Query(const Index& index, std::pmr::memory_resource* memory)
    : index_(index), engine_(make_engine(index, memory)), sources_(memory),
      distance_(index.vertex_count(), memory) {}

uint32_t Query::number_of(uint32_t id) const {
    if (id >= index_.id_count)
        throw Error(GEOIDX_ERROR_INVALID_ARGUMENT, "vertex " + std::to_string(id) +
                                                       " is out of range: the mesh has " +
                                                       std::to_string(index_.id_count) + " vertices");
    return index_.number_of_id[id];
}

float Query::sssd(uint32_t source_id, uint32_t target_id) {
    const uint32_t a = number_of(source_id), b = number_of(target_id);
    if (source_id == target_id) return 0;
    if (a == NONE || b == NONE) return INFINITE;
    if (a == b) return 0;
    return std::visit([&](auto& engine) { return engine.sssd(std::min(a, b), std::max(a, b)); }, engine_);
}

void Query::msad(std::span<const uint32_t> source_ids, std::span<float> distances) {
    if (distances.size() != index_.id_count)
        throw Error(GEOIDX_ERROR_INVALID_ARGUMENT, "distance_count is " + std::to_string(distances.size()) +
                                                       ", but the mesh has " +
                                                       std::to_string(index_.id_count) + " vertices");
    if (source_ids.empty()) throw Error(GEOIDX_ERROR_INVALID_ARGUMENT, "there is no source");
    sources_.clear();
    for (uint32_t id : source_ids)
        if (const uint32_t source = number_of(id); source != NONE) sources_.push_back(source);
    std::visit([&](auto& engine) { engine.msad(sources_, distance_); }, engine_);
    for (size_t id = 0; id < distances.size(); ++id) {
        const uint32_t number = index_.number_of_id[id];
        distances[id] = number == NONE ? INFINITE : distance_[number];
    }
    for (uint32_t id : source_ids) distances[id] = 0; // also a source that no triangle uses
}

}
