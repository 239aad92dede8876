#include "src/query/overlay_sssd.h"

#include <algorithm>
#include <limits>

#include "src/index/unfolding.h"

namespace geodesic {

namespace {

constexpr float INFINITE = std::numeric_limits<float>::infinity();
constexpr uint32_t REACH = Rings::REACH;

constexpr size_t WAYS = 2;              // that are measured
constexpr float WORTH_MEASURING = 1.1f; // how long over samples, compared to the shortest

// Asks for memory that is going to be read soon.
template <class T>
void prefetch(const T* first, size_t count) {
    constexpr size_t LINE = 64;
    const char* end = reinterpret_cast<const char*>(first + count);
    for (const char* at = reinterpret_cast<const char*>(first); at < end; at += LINE) __builtin_prefetch(at);
}

// A parent has a smaller number than its children.
uint32_t lowest_common_patch(const Index& index, uint32_t a, uint32_t b) {
    while (a != b) (a > b ? a : b) = index.parent[std::max(a, b)];
    return a;
}

}

OverlaySssd::OverlaySssd(const Index& index, std::pmr::memory_resource* memory)
    : index_(index), tables_(index.overlay_tables), field_(index, memory), rows_(memory), from_(memory),
      to_(memory), samples_(std::ranges::max(index.overlay_tables.sample_count), memory),
      winners_(samples_.size(), memory), from_window_(index.overlay_tables.rings.largest_size(), memory) {
    rows_.reserve(from_window_.size());
    for (End* end : {&from_, &to_}) {
        end->borders.reserve(index.level_count());
        end->distance.reserve(index.level_count() * samples_.size());
        end->winner.reserve(end->distance.capacity());
        end->window_distance.resize(index.level_count() * from_window_.size());
    }
}

// ---- The two ends, seen from the border of `patch` where they meet

struct OverlaySssd::FromEnd {
    OverlaySssd& search;
    End& end;
    uint32_t patch;

    void samples(std::span<float> out) const {
        search.cross_samples(end, search.tables_.coarse_rows[patch], out, search.winners_.data());
    }
    void trace(Samples samples) const {
        search.trace(end, search.samples_before(patch, samples, search.winners_.data()));
    }
    void window(Window window, std::span<float> out) const {
        search.climb_windows(end);
        search.cross_window(
            end, end.borders.size() - 1, window,
            [this](uint32_t place) { return search.overlay_position_at(patch, place); }, out);
    }
};

// of_place(k): its distance from place k.
template <class OfPlace>
struct OverlaySssd::FromVertex {
    const OverlayTables& tables;
    uint32_t patch;
    OfPlace of_place;

    void samples(std::span<float> out) const {
        for (uint32_t k = tables.coarse_rings.begin[patch]; k < tables.coarse_rings.begin[patch + 1]; ++k)
            out[tables.coarse_samples[k]] = of_place(tables.coarse_places[k]);
    }
    void trace(Samples) const {}
    void window(Window window, std::span<float> out) const {
        for (uint32_t i = 0; i < window.size(); ++i) out[i] = of_place(window.first + i);
    }
};

float OverlaySssd::distance(uint32_t low, uint32_t high) {
    const uint32_t top = lowest_common_patch(index_, index_.entry(low), index_.entry(high));
    if (top >= index_.first_leaf()) {
        const uint32_t first = index_.first_internal(top);
        return tables_.distance(
            tables_.internal_tables[index_.internal_place(top, low - first, high - first)], top);
    }
    const bool low_is_there = index_.entry(low) == top, high_is_there = index_.entry(high) == top;
    if (low_is_there && high_is_there)
        return tables_.distance(
            index_.overlay_code(top, index_.position_at_owner(low), index_.position_at_owner(high)), top);
    const bool both_climb = !low_is_there && !high_is_there;
    prefetch_climb(high_is_there ? low : high, top);
    if (both_climb) prefetch_climb(low, top);
    climb(high_is_there ? low : high, top, to_);
    const uint32_t patch = to_.borders.back().patch;
    if (both_climb) {
        climb(low, top, from_);
        return meet(FromEnd{*this, from_, patch}, to_);
    }
    const uint32_t position = index_.position_at_owner(low_is_there ? low : high);
    const uint16_t* row = tables_.outer_tables.data() + index_.outer_row(patch, position);
    const uint32_t first = tables_.rings.begin[patch];
    const auto of_place = [&](uint32_t k) { return tables_.distance(row[k - first], top); };
    return meet(FromVertex<decltype(of_place)>{tables_, patch, of_place}, to_);
}

float OverlaySssd::distance_from(uint32_t source, std::span<const float> known, uint32_t target) {
    const uint32_t top = lowest_common_patch(index_, index_.entry(source), index_.entry(target));
    if (top >= index_.first_leaf() || index_.entry(target) == top) return known[target];
    climb(target, top, to_);
    const auto of_place = [&](uint32_t k) { return known[tables_.rings.vertex[k]]; };
    return meet(FromVertex<decltype(of_place)>{tables_, to_.borders.back().patch, of_place}, to_);
}

// Over the best samples of the border where `to` waits.
template <class From>
float OverlaySssd::meet(const From& from, End& to) {
    const Border& border = to.borders.back();
    const auto distance = std::span(samples_).first(tables_.sample_count[border.patch]);
    from.samples(distance);
    const Rings& rings = tables_.coarse_rings;
    const auto sum = [&](uint32_t k) {
        return distance[tables_.coarse_samples[k]] + to.distance[border.samples + tables_.coarse_samples[k]];
    };
    std::array<std::pair<float, uint32_t>, WAYS> ways; // shortest first
    ways.fill({INFINITE, 0});
    for (uint32_t k = rings.begin[border.patch]; k < rings.begin[border.patch + 1]; ++k) {
        if (!rings.is_own[k] || !(sum(k) < INFINITE) || sum(k) > sum(k - 1) || sum(k) > sum(k + 1)) continue;
        std::pair<float, uint32_t> way{sum(k), k};
        for (auto& kept : ways)
            if (way < kept) std::swap(way, kept);
    }
    float shortest = INFINITE;
    for (const auto& [length, place] : ways)
        if (length < INFINITE && length <= ways[0].first * WORTH_MEASURING)
            shortest = std::min(shortest, measure(from, to, place));
    return shortest;
}

// The way over one of these samples, by its place in all coarse rings.
template <class From>
float OverlaySssd::measure(const From& from, End& to, uint32_t coarse_place) {
    const Border& border = to.borders.back();
    const uint32_t place = coarse_place - tables_.coarse_rings.begin[border.patch];
    from.trace({place, place});
    trace(to, {place, place});
    const Window window = border.window;
    const auto from_distance = std::span(from_window_).first(window.size());
    from.window(window, from_distance);
    climb_windows(to);
    const auto to_distance = window_distances(to, to.borders.size() - 1);

    const auto at = [&](std::span<const float> distance) {
        return [&, distance](size_t k) {
            return k >= window.first && k <= window.last ? distance[k - window.first] : INFINITE;
        };
    };
    float shortest = INFINITE;
    size_t nearest = window.first;
    for (uint32_t k = window.first; k <= window.last; ++k) {
        const float sum = from_distance[k - window.first] + to_distance[k - window.first];
        if (!tables_.rings.is_own[k] || !(sum < shortest)) continue;
        shortest = sum;
        nearest = k;
    }
    return shortest < INFINITE ? straightened(tables_.rings, nearest, at(from_distance), at(to_distance))
                               : INFINITE;
}

// Of places of the first border around a vertex, counted over all rings.
auto OverlaySssd::distances_from(uint32_t vertex) const {
    const uint32_t patch = index_.entry(vertex);
    const uint16_t* row =
        tables_.inner_tables.data() + index_.inner_row(patch, vertex - index_.first_inner(patch));
    return [this, row, patch, first = tables_.rings.begin[patch]](uint32_t place) {
        return tables_.distance(row[place - first], patch);
    };
}

// ---- Over samples

// What climb() is going to read: most of the time it would wait for it, border after border.
void OverlaySssd::prefetch_climb(uint32_t vertex, uint32_t top) const {
    const Rings& rings = tables_.coarse_rings;
    for (uint32_t patch = index_.entry(vertex); patch != top; patch = index_.parent[patch]) {
        const uint32_t first = rings.begin[patch], places = rings.size(patch);
        prefetch(rings.segment_length.data() + first, places);
        prefetch(rings.half_inverse.data() + first, places);
        prefetch(rings.is_own.data() + first, places);
        prefetch(tables_.coarse_samples.data() + first, places);
        prefetch(tables_.coarse_places.data() + first, places);
        if (index_.parent[patch] != top)
            prefetch(tables_.coarse_tables.data() + tables_.coarse_begin[patch],
                     size_t{places} * tables_.sample_count[index_.parent[patch]]);
    }
}

void OverlaySssd::climb(uint32_t vertex, uint32_t top, End& end) {
    end.vertex = vertex;
    end.crossed = 0;
    uint32_t patch = index_.entry(vertex);
    end.borders.assign(1, {patch, 0, {0, 0}});
    end.distance.resize(tables_.sample_count[patch]);
    end.winner.resize(end.distance.size());
    const auto distance = distances_from(vertex);
    for (uint32_t k = tables_.coarse_rings.begin[patch]; k < tables_.coarse_rings.begin[patch + 1]; ++k)
        end.distance[tables_.coarse_samples[k]] = distance(tables_.coarse_places[k]);
    for (; index_.parent[patch] != top; patch = index_.parent[patch]) {
        const uint32_t parent = index_.parent[patch], count = tables_.sample_count[parent];
        const auto first = static_cast<uint32_t>(end.distance.size());
        end.distance.resize(size_t{first} + count);
        end.winner.resize(end.distance.size());
        cross_samples(end, 0, std::span(end.distance).last(count), end.winner.data() + first);
        end.borders.push_back({parent, first, {0, 0}});
    }
}

// From the last border of an end over rows of its coarse table.
void OverlaySssd::cross_samples(const End& end, uint32_t first_row, std::span<float> out, uint16_t* winners) {
    const uint32_t patch = end.borders.back().patch;
    const float* distance = end.distance.data() + end.borders.back().samples;
    const Rings& rings = tables_.coarse_rings;
    const uint32_t places = rings.size(patch);
    const uint32_t* sample = tables_.coarse_samples.data() + rings.begin[patch];
    for (float& d : field_.begin(rings, rings.begin[patch], places, tables_.quantum[index_.parent[patch]]))
        d = distance[*sample++];
    if (!field_.finish()) {
        std::ranges::fill(out, INFINITE);
        return;
    }
    const uint16_t* row =
        tables_.coarse_tables.data() + tables_.coarse_begin[patch] + size_t{first_row} * places;
    rows_.resize(out.size());
    for (size_t i = 0; i < out.size(); ++i) rows_[i] = row + i * places;
    field_.cross(rows_, out.data(), winners);
}

// Lets the ways at hand be those to samples of the last border.
void OverlaySssd::trace(End& end, Samples samples) const {
    for (size_t b = end.borders.size(); b-- > 0;) {
        Border& border = end.borders[b];
        const Window window =
            b > 0 || end.borders.size() == 1 ? window_of(border.patch, samples) : whole_ring(border.patch);
        if (window != border.window) end.crossed = std::min(end.crossed, b);
        border.window = window;
        if (b > 0) samples = samples_before(border.patch, samples, end.winner.data() + border.samples);
    }
    for (size_t b = 0; b < end.borders.size(); ++b) prefetch_window(end, b);
}

// What climb_windows() is going to read.
void OverlaySssd::prefetch_window(const End& end, size_t b) const {
    const auto& [patch, samples, window] = end.borders[b];
    const Rings& rings = tables_.rings;
    prefetch(rings.segment_length.data() + window.first, window.size());
    prefetch(rings.half_inverse.data() + window.first, window.size());
    prefetch(rings.is_own.data() + window.first, window.size());
    if (b + 1 == end.borders.size()) return;
    const Window next = end.borders[b + 1].window;
    const uint16_t* rows =
        tables_.outer_tables.data() + index_.outer_row(patch, 0) + (window.first - rings.begin[patch]);
    for (uint32_t k = next.first; k <= next.last; ++k)
        prefetch(rows + size_t{position_at(k)} * rings.size(patch), window.size());
}

OverlaySssd::Window OverlaySssd::whole_ring(uint32_t patch) const {
    return {tables_.rings.begin[patch], tables_.rings.begin[patch + 1] - 1};
}

// The samples of the border before that the ways to these and to their neighbours come over.
OverlaySssd::Samples OverlaySssd::samples_before(uint32_t patch, Samples samples,
                                                 const uint16_t* winners) const {
    const uint32_t* sample = tables_.coarse_samples.data() + tables_.coarse_rings.begin[patch];
    Samples before{UINT16_MAX, 0};
    for (uint32_t k = samples.first - 1; k <= samples.last + 1; ++k) {
        const uint16_t winner = winners[sample[k]];
        if (winner == SeenBorder::NO_PLACE) continue;
        before.first = std::min<uint32_t>(before.first, winner);
        before.last = std::max<uint32_t>(before.last, winner);
    }
    return before;
}

// ---- Over windows

// The vertices from the second sample before to the second one after, or of whole chains where these are not
// beside each other.
OverlaySssd::Window OverlaySssd::window_of(uint32_t patch, Samples samples) const {
    const uint32_t* place = tables_.coarse_places.data() + tables_.coarse_rings.begin[patch];
    const uint32_t first = place[samples.first - REACH], last = place[samples.last + REACH];
    if (first <= place[samples.first] && place[samples.last] <= last) return {first, last};
    const auto chain = [&](uint32_t k) { return tables_.rings.chains[tables_.rings.chain[place[k]]]; };
    return {chain(samples.first).first - REACH, chain(samples.last).last + REACH};
}

std::span<float> OverlaySssd::window_distances(End& end, size_t b) const {
    return std::span(end.window_distance).subspan(b * from_window_.size(), end.borders[b].window.size());
}

// The distances of an end from the windows of its borders, but those that are known from another way.
void OverlaySssd::climb_windows(End& end) {
    if (end.crossed == 0) {
        const auto of_place = distances_from(end.vertex);
        uint32_t place = end.borders.front().window.first;
        for (float& d : window_distances(end, 0)) d = of_place(place++);
    }
    for (size_t b = std::max<size_t>(end.crossed, 1); b < end.borders.size(); ++b)
        cross_window(
            end, b - 1, end.borders[b].window, [&](uint32_t place) { return position_at(place); },
            window_distances(end, b));
    end.crossed = end.borders.size();
}

// From a window to the places that stand at these positions of the overlay of the patch's parent.
template <class OverlayPosition>
void OverlaySssd::cross_window(End& end, size_t b, Window to, const OverlayPosition& overlay_position,
                               std::span<float> out) {
    const Border& border = end.borders[b];
    const auto distance = window_distances(end, b);
    const Window& window = border.window;
    const uint32_t first = std::max(window.first, tables_.rings.begin[border.patch] + REACH) - REACH;
    const uint32_t last = std::min(window.last + REACH, tables_.rings.begin[border.patch + 1] - 1);
    const auto places =
        field_.begin(tables_.rings, first, last - first + 1, tables_.quantum[index_.parent[border.patch]]);
    const auto inside = places.subspan(window.first - first, window.size());
    std::fill(places.begin(), inside.begin(), INFINITE);
    std::ranges::copy(distance, inside.begin());
    std::fill(inside.end(), places.end(), INFINITE);
    if (!field_.finish()) {
        std::ranges::fill(out, INFINITE);
        return;
    }
    const uint16_t* rows = tables_.outer_tables.data() + index_.outer_row(border.patch, 0) +
                           (first - tables_.rings.begin[border.patch]);
    rows_.resize(to.size());
    for (uint32_t i = 0; i < to.size(); ++i)
        rows_[i] = rows + size_t{overlay_position(to.first + i)} * index_.ring_size(border.patch);
    field_.cross(rows_, out.data(), nullptr);
}

}
