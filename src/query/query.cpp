#include "src/query/query.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <string>

#include "format/error.h"
#include "src/base/four_at_a_time.h"
#include "src/base/threads.h"
#include "src/overlay/kernels/lanes.h"

namespace geodesic {

namespace {

std::variant<GraphQuery, OverlayQuery> make_engine(const Index& index, std::pmr::memory_resource* memory) {
    if (const auto* const overlay = std::get_if<OverlayIndex>(&index.engine))
        return OverlayQuery(*overlay, memory);
    return GraphQuery(std::get<GraphIndex>(index.engine), memory);
}

}

Query::Query(const Index& index, std::pmr::memory_resource* memory)
    : index_(index), engine_(make_engine(index, memory)), order_(memory), sources_(memory),
      unused_sources_(memory), batch_ids_(memory), unused_positions_(memory),
      distance_(index.numbering().vertex_count(), memory), corner_fields_{Array<float>(memory),
                                                                          Array<float>(memory),
                                                                          Array<float>(memory)},
      point_field_(memory), offsets_(memory), end_fields_{Array<float>(memory), Array<float>(memory)},
      pair_ids_(memory), nearest_(memory), position_at_(memory), next_target_(memory), within_(memory),
      ranked_(memory) {}

uint32_t Query::number_of(uint32_t id) const {
    if (id >= index_.description.id_count)
        refuse_argument("vertex " + std::to_string(id) + " is out of range: the mesh has " +
                        std::to_string(index_.description.id_count) + " vertices");
    return index_.number_of_id[id];
}

float Query::sssd(uint32_t source_id, uint32_t target_id) {
    const uint32_t a = number_of(source_id), b = number_of(target_id);
    if (source_id == target_id) return 0;
    if (a == NONE || b == NONE) return INFINITE;
    if (a == b) return 0;
    return std::visit([&](auto& engine) { return engine.sssd(std::min(a, b), std::max(a, b)); }, engine_);
}

// Pairs that begin near each other are answered one after the other, since they read the same tables, which
// are in the cache then.
void Query::sssd_each(std::span<const uint32_t> ids, std::span<float> distances) {
    constexpr size_t AT_ONCE = 1 << 16;
    for (uint32_t id : ids) number_of(id);
    for (size_t done = 0; done < distances.size(); done += AT_ONCE) {
        order_.clear();
        for (size_t i = done; i < std::min(done + AT_ONCE, distances.size()); ++i) {
            const uint32_t a = number_of(ids[2 * i]), b = number_of(ids[2 * i + 1]);
            order_.emplace_back(uint64_t{std::min(a, b)} << 32 | std::max(a, b),
                                static_cast<uint32_t>(i - done));
        }
        std::ranges::sort(order_);
        for (const auto& [pair, position] : order_) {
            const size_t i = done + position;
            distances[i] = sssd(ids[2 * i], ids[2 * i + 1]);
        }
    }
}

void Query::prepare(uint32_t source_id) {
    const uint32_t source = number_of(source_id);
    prepared_id_ = NONE; // unless this succeeds
    if (source != NONE) std::visit([&](auto& engine) { engine.prepare(source); }, engine_);
    prepared_ = source;
    prepared_id_ = source_id;
}

void Query::require_prepared() const {
    if (prepared_id_ == NONE) refuse_argument("no source has been prepared");
}

float Query::prepared_sssd(uint32_t target_id) {
    require_prepared();
    const uint32_t target = number_of(target_id);
    if (target_id == prepared_id_) return 0;
    if (prepared_ == NONE || target == NONE) return INFINITE;
    if (prepared_ == target) return 0;
    return std::visit([&](auto& engine) { return engine.prepared_sssd(target); }, engine_);
}

void Query::check_count(const char* name, uint64_t count, uint64_t fields) const {
    if (count != fields * index_.description.id_count)
        refuse_argument(std::string(name) + " is " + std::to_string(count) + ", but the mesh has " +
                        std::to_string(index_.description.id_count) + " vertices" +
                        (fields == 1 ? "" : " and there are " + std::to_string(fields) + " sources"));
}

void Query::write_by_id(std::span<float> field) const {
    const uint32_t* const number_of_id = index_.number_of_id.data();
    const float* const by_number = distance_.data();
    four_at_a_time(field.size(), [&](size_t id) {
        const uint32_t number = number_of_id[id];
        field[id] = number == NONE ? INFINITE : by_number[number];
    });
}

// Of fields that lie side by side: the one pass over them reads each line of memory once.
void Query::write_by_id(const SideBySide& fields) const {
    const uint32_t* const number_of_id = index_.number_of_id.data();
    const float* const by_number = distance_.data();
    using FourFloats = Floats<16>;
    FourFloats unreached{};
    unreached += INFINITE;
    size_t id = 0;
    constexpr size_t AHEAD = 32;
    for (; id + 4 <= index_.description.id_count; id += 4) {
        if (id + AHEAD + 4 <= index_.description.id_count)
            for (size_t j = 0; j < 4; ++j)
                if (const uint32_t number = number_of_id[id + AHEAD + j]; number != NONE)
                    __builtin_prefetch(by_number + size_t{number} * fields.size());
        for (size_t i = 0; i < fields.size(); i += 4) {
            FourFloats four[4];
            for (size_t j = 0; j < 4; ++j) {
                const uint32_t number = number_of_id[id + j];
                four[j] = unreached;
                if (number != NONE) load(by_number + size_t{number} * fields.size() + i, four[j]);
            }
            transpose(four);
            for (size_t j = 0; j < 4; ++j) std::memcpy(fields[i + j] + id, &four[j], sizeof four[j]);
        }
    }
    for (; id < index_.description.id_count; ++id) {
        const uint32_t number = number_of_id[id];
        for (size_t i = 0; i < fields.size(); ++i)
            fields[i][id] = number == NONE ? INFINITE : by_number[size_t{number} * fields.size() + i];
    }
}

// Takes the numbers of sources, in an order of their own, so that answers do not depend on that of the ids;
// and the ids of those that no triangle uses. Once distances are written, the ids given are not read again,
// since both may overlap.
void Query::take_sources(std::span<const uint32_t> source_ids) {
    if (source_ids.empty()) refuse_argument("there is no source");
    sources_.clear();
    unused_sources_.clear();
    for (uint32_t id : source_ids)
        if (const uint32_t source = number_of(id); source != NONE)
            sources_.push_back(source);
        else
            unused_sources_.push_back(id);
    std::ranges::sort(sources_);
    sources_.erase(std::unique(sources_.begin(), sources_.end()), sources_.end());
}

// Returns the distances from the sources that were taken, by number.
std::span<const float> Query::field_within(float radius) {
    const auto by_number = std::span(distance_).first(index_.numbering().vertex_count());
    std::visit([&](auto& engine) { engine.msad(sources_, radius, by_number); }, engine_);
    for (const uint32_t source : sources_) by_number[source] = 0;
    return by_number;
}

void Query::msad(std::span<const uint32_t> source_ids, float radius, std::span<float> distances) {
    check_count("distance_count", distances.size(), 1);
    if (!(radius >= 0)) refuse_argument("the radius is negative or NaN");
    take_sources(source_ids);
    field_within(radius);
    write_by_id(distances);
    if (radius < INFINITE)
        for (float& d : distances)
            if (d > radius) d = INFINITE;
    for (uint32_t id : unused_sources_) distances[id] = 0;
}

void Query::set_threads(uint32_t count) {
    count = thread_count(count);
    if (auto* const overlay = std::get_if<OverlayQuery>(&engine_)) overlay->set_threads(count);
}

// How many fields are best swept together, if so many are left.
size_t Query::fields_at_once(size_t left) const {
    return left >= OverlayQuery::FEWEST_AT_ONCE && std::holds_alternative<OverlayQuery>(engine_)
               ? std::min(FIELDS_AT_ONCE, left)
               : 1;
}

void Query::ssad_each(std::span<const uint32_t> source_ids, std::span<float> distances) {
    check_count("distance_count", distances.size(), source_ids.size());
    for (uint32_t id : source_ids) number_of(id);
    batch_ids_.assign(source_ids.begin(), source_ids.end()); // see take_sources()
    for (size_t done = 0; done < batch_ids_.size();) {
        const size_t count = fields_at_once(batch_ids_.size() - done);
        const auto ids = std::span<const uint32_t>(batch_ids_).subspan(done, count);
        const auto fields =
            distances.subspan(done * index_.description.id_count, count * index_.description.id_count);
        if (count == 1)
            msad(ids, INFINITE, fields);
        else
            ssad_at_once(ids, fields);
        done += count;
    }
}

// Sweeps the fields of as many sources as fields_at_once() says.
Query::FieldsByNumber Query::fields_from(std::span<const uint32_t> source_ids) {
    FieldsByNumber fields{};
    sources_.clear();
    for (size_t i = 0; i < source_ids.size(); ++i) {
        const uint32_t source = number_of(source_ids[i]);
        fields.lane[i] = source == NONE ? NONE : static_cast<uint32_t>(sources_.size());
        if (source != NONE) sources_.push_back(source);
    }
    if (sources_.empty()) return fields;
    if (source_ids.size() == 1) {
        fields.distances = field_within(INFINITE).data();
        fields.stride = 1;
        return fields;
    }
    fields.stride = FIELDS_AT_ONCE;
    sources_.resize(fields.stride, sources_.back()); // the last source is repeated
    distance_.resize(fields.stride * index_.numbering().vertex_count());
    std::get<OverlayQuery>(engine_).ssad_each(sources_, distance_);
    fields.distances = distance_.data();
    return fields;
}

void Query::ssad_at_once(std::span<const uint32_t> source_ids, std::span<float> distances) {
    const FieldsByNumber fields = fields_from(source_ids);
    SideBySide by_id{};
    float* last = nullptr;
    for (size_t i = 0; i < source_ids.size(); ++i) {
        const auto field = distances.subspan(i * index_.description.id_count, index_.description.id_count);
        if (fields.lane[i] == NONE)
            std::ranges::fill(field, INFINITE);
        else
            by_id[fields.lane[i]] = last = field.data();
    }
    if (last) {
        std::ranges::replace(by_id, static_cast<float*>(nullptr), last);
        write_by_id(by_id);
    }
    for (size_t i = 0; i < source_ids.size(); ++i)
        distances[i * index_.description.id_count + source_ids[i]] = 0;
}

}
