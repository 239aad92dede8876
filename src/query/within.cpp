// What is near: the vertices within a radius, and the nearest targets.
#include <algorithm>
#include <cmath>

#include "format/error.h"
#include "src/query/query.h"

namespace geodesic {

namespace {

// Each sweep for the nearest targets looks this many times as far as the one before, or as the nearest vertex
// that the one before left out.
constexpr float GROWTH = 2;

// Sweeps that find `count` of evenly spread targets visit about vertices * count / targets vertices. A pair
// takes as long as sweeping this many; that the last sweep looks too far is included.
constexpr uint64_t SWEPT_VERTICES_PER_PAIR = 64;

// How far a sweep must look so that it misses no distance that, with `offset` added, is rounded to `radius`
// or less. Negative if there is none.
float radius_without(float offset, float radius) {
    if (offset == 0 || radius == INFINITE) return radius;
    if (radius < offset) return -1;
    const float beyond = std::nextafter(radius, INFINITE);
    return std::nextafter(static_cast<float>(double{beyond} - double{offset}), INFINITE);
}

}

const IdsOfNumbers& Query::ids_of_numbers() {
    if (!ids_of_numbers_) ids_of_numbers_.emplace(index_, distance_.get_allocator().resource());
    return *ids_of_numbers_;
}

std::span<const WithinSweep::Found> Query::numbers_within(uint32_t source, float radius) {
    if (auto* const overlay = std::get_if<OverlayQuery>(&engine_)) return overlay->within(source, radius);
    const auto field = std::span(distance_).first(index_.numbering().vertex_count());
    std::get<GraphQuery>(engine_).msad({&source, 1}, radius, field);
    return found_in(field, radius);
}

std::span<const WithinSweep::Found> Query::found_in(std::span<const float> field, float radius) {
    within_.clear();
    for (uint32_t v = 0; v < field.size(); ++v)
        if (field[v] <= radius && field[v] < INFINITE) within_.push_back({v, field[v]});
    return within_;
}

std::span<const WithinSweep::Found> Query::numbers_within(const PointSources& only, float radius) {
    if (takes(only.points.front())) return std::get<OverlayQuery>(engine_).point_within(only, radius);
    fill_point_field(only);
    return found_in(point_field_, radius);
}

std::span<const Query::Found> Query::within(std::span<const uint32_t> source_ids, float radius) {
    if (!(radius >= 0)) refuse_argument("the radius is negative or NaN");
    take_sources(source_ids);
    ranked_.clear();
    size_t different = 0;
    for (const uint32_t source : sources_) {
        for (const auto& [number, distance] : numbers_within(source, radius))
            ranked_.push_back({distance, number});
        if (sources_.size() > 1) keep_least_if_many(different);
    }
    if (sources_.size() > 1) keep_least();
    replace_numbers();
    for (const uint32_t id : source_ids)
        if (number_of(id) == NONE) ranked_.push_back({0, id});
    std::ranges::sort(ranked_);
    // A source that no triangle uses may have been given twice.
    ranked_.erase(std::unique(ranked_.begin(), ranked_.end()), ranked_.end());
    return ranked_;
}

std::span<const Query::Found> Query::point_within(const PointSources& sources, float radius) {
    if (!(radius >= 0)) refuse_argument("the radius is negative or NaN");
    ranked_.clear();
    size_t different = 0;
    for (size_t i = 0; i < sources.points.size(); ++i) {
        const float offset = sources.offset(i), swept = radius_without(offset, radius);
        if (swept < 0) continue;
        for (const auto& [number, distance] : numbers_within(sources.only(i), swept))
            if (const float whole = offset + distance; whole <= radius && whole < INFINITE)
                ranked_.push_back({whole, number});
        if (sources.points.size() > 1) keep_least_if_many(different);
    }
    if (sources.points.size() > 1) keep_least();
    replace_numbers();
    std::ranges::sort(ranked_);
    return ranked_;
}

void Query::sweep_within(const PointSources& source, float radius) {
    swept_field_ = !takes(source.points.front());
    numbers_within(source, radius);
}

float Query::distance_within(uint32_t number) const {
    return swept_field_ ? point_field_[number] : std::get<OverlayQuery>(engine_).distance_within(number);
}

float Query::nearest_beyond() const {
    return swept_field_ ? INFINITE : std::get<OverlayQuery>(engine_).nearest_beyond();
}

// Keeps the least distance of each vertex that several sources have found.
void Query::keep_least() {
    std::ranges::sort(ranked_, [](const Found& a, const Found& b) {
        return a.which < b.which || (a.which == b.which && a.distance < b.distance);
    });
    const auto is_same = [](const Found& a, const Found& b) { return a.which == b.which; };
    ranked_.erase(std::unique(ranked_.begin(), ranked_.end(), is_same), ranked_.end());
}

// Keeps `ranked_` in proportion to the vertices that are found, however many sources find each: where it has
// more than twice as many entries as different vertices, and some thousand, only the nearest of each vertex
// stays. `different` is how many there were when this was last done; it begins with 0.
void Query::keep_least_if_many(size_t& different) {
    constexpr size_t FEW = 1 << 12;
    if (ranked_.size() < 2 * different + FEW) return;
    keep_least();
    different = ranked_.size();
}

// Replaces numbers by ids: more where vertices were welded, none for an added vertex.
void Query::replace_numbers() {
    const IdsOfNumbers& ids = ids_of_numbers();
    for (size_t i = 0, count = ranked_.size(); i < count; ++i) {
        const uint32_t first = ids.first(ranked_[i].which);
        ranked_[i].which = first;
        if (first == NONE) continue;
        for (uint32_t id = ids.next(first); id != NONE; id = ids.next(id))
            ranked_.push_back({ranked_[i].distance, id});
    }
    std::erase_if(ranked_, [](const Found& found) { return found.which == NONE; });
}

std::span<const Query::Found> Query::nearest_targets(uint32_t source_id, std::span<const uint32_t> target_ids,
                                                     size_t count) {
    const uint32_t source = number_of(source_id);
    for (const uint32_t id : target_ids) number_of(id);
    count = std::min(count, target_ids.size());
    ranked_.clear();
    if (count == 0) return ranked_;
    if (source == NONE || targets_are_few(target_ids.size(), count, 1))
        rank_by_pairs(source_id, target_ids);
    else
        rank_by_sweeps(source, target_ids, count);
    std::ranges::sort(ranked_);
    ranked_.resize(std::min(count, ranked_.size()));
    return ranked_;
}

bool Query::targets_are_few(uint64_t targets, uint64_t count, uint64_t pairs) const {
    return pairs_are_faster(pairs * targets, 1) &&
           targets * targets * pairs * SWEPT_VERTICES_PER_PAIR < count * index_.numbering().vertex_count();
}

void Query::rank_by_pairs(uint32_t source_id, std::span<const uint32_t> target_ids) {
    for (uint32_t i = 0; i < target_ids.size(); ++i)
        if (const float distance = sssd(source_id, target_ids[i]); distance < INFINITE)
            ranked_.push_back({distance, i});
}

// Notes which targets there are at each vertex, while they are looked for.
class Query::TargetsAtNumbers {
public:
    TargetsAtNumbers(Query& query, std::span<const uint32_t> target_ids)
        : query_(query), target_ids_(target_ids) {
        query_.position_at_.resize(query_.index_.numbering().vertex_count(), NONE);
        query_.next_target_.resize(target_ids.size());
        for (size_t i = target_ids.size(); i-- > 0;) {
            const uint32_t number = query_.number_of(target_ids[i]);
            if (number == NONE) continue;
            query_.next_target_[i] = query_.position_at_[number];
            query_.position_at_[number] = static_cast<uint32_t>(i);
        }
    }
    ~TargetsAtNumbers() {
        for (const uint32_t id : target_ids_)
            if (const uint32_t number = query_.index_.number_of_id[id]; number != NONE)
                query_.position_at_[number] = NONE;
    }
    TargetsAtNumbers(const TargetsAtNumbers&) = delete;
    TargetsAtNumbers& operator=(const TargetsAtNumbers&) = delete;

    // Calls use(i) for each target at a vertex.
    template <class Use>
    void for_each_at(uint32_t number, const Use& use) const {
        for (uint32_t i = query_.position_at_[number]; i != NONE; i = query_.next_target_[i]) use(i);
    }

private:
    Query& query_;
    std::span<const uint32_t> target_ids_;
};

// Looks farther until enough targets are found, or nothing else can be reached.
void Query::rank_by_sweeps(uint32_t source, std::span<const uint32_t> target_ids, size_t count) {
    const TargetsAtNumbers targets(*this, target_ids);
    const auto* const overlay = std::get_if<OverlayQuery>(&engine_);
    for (float radius = overlay ? 0 : INFINITE;;) {
        ranked_.clear();
        for (const auto& [number, distance] : numbers_within(source, radius))
            targets.for_each_at(number, [&, d = distance](uint32_t i) { ranked_.push_back({d, i}); });
        if (ranked_.size() >= count || radius == INFINITE) return;
        const float beyond = overlay->nearest_beyond();
        if (beyond == INFINITE) return;
        radius = std::max(radius, beyond) * GROWTH;
    }
}

}
