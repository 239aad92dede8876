#include "src/overlay/sssd/sssd.h"

#include <algorithm>
#include <limits>

#include "src/overlay/codes.h"
#include "src/overlay/unfolding.h"

namespace geodesic {

namespace {

constexpr uint32_t REACH = Rings::REACH;

constexpr size_t WAYS = 3;               // that are measured
constexpr float BESIDE = 1;              // spacings of samples: an end so near to a border lies at it
constexpr float WORTH_MEASURING = 1.05f; // how long over samples, compared to the shortest

// Asks for memory that is going to be read soon.
template <class T>
void prefetch(const T* first, size_t count) {
    constexpr size_t LINE = 64;
    const char* end = reinterpret_cast<const char*>(first + count);
    for (const char* at = reinterpret_cast<const char*>(first); at < end; at += LINE) __builtin_prefetch(at);
}

// Of the samples of a patch's ring, where of_place(k) is that of a place counted over all rings.
template <class OfPlace>
void sample_distances(const OverlayIndex& index, uint32_t patch, const OfPlace& of_place,
                      std::span<float> out) {
    const Rings& rings = index.samples.rings;
    for (uint32_t k = rings.begin[patch]; k < rings.begin[patch + 1]; ++k)
        out[index.samples.sample_of_place[k]] = of_place(index.samples.full_place[k]);
}

// The first level whose borders have few places on average, and labels all of their vertices.
uint32_t first_level_of_short_borders(const OverlayIndex& index) {
    constexpr uint32_t FEW = 128;
    const auto& begin = index.rings.begin;
    for (uint32_t level = 1; level < index.numbering.level_count(); ++level) {
        const uint32_t first = index.numbering.level_begin[level],
                       end = index.numbering.level_begin[level + 1];
        bool whole = begin[end] - begin[first] <= FEW * (end - first);
        for (uint32_t p = first; p < end; ++p) whole = whole && index.is_labelled_whole(p);
        if (whole) return level;
    }
    return index.numbering.level_count();
}

// A parent has a smaller number than its children.
uint32_t lowest_common_patch(const OverlayIndex& index, uint32_t a, uint32_t b) {
    while (a != b) (a > b ? a : b) = index.numbering.parent[std::max(a, b)];
    return a;
}

}

OverlaySssd::OverlaySssd(const OverlayIndex& index, std::pmr::memory_resource* memory)
    : index_(index), numbering_(index.numbering), prepared_level_(first_level_of_short_borders(index)),
      field_(index, memory), rows_(memory), from_(memory), to_(memory), code_(memory), traced_(memory),
      samples_of_first_(memory), code_of_first_(memory), samples_(memory), winners_(memory),
      from_window_(index.rings.largest_size(), memory) {
    for (uint32_t p = 0; p < index.numbering.patch_count(); ++p)
        samples_.resize(std::max(samples_.size(), index_.samples.of(p).size()));
    winners_.resize(samples_.size());
    rows_.reserve(from_window_.size());
    samples_of_first_.resize(samples_.size());
    code_of_first_.resize(samples_.size());
    code_.resize(index.samples.rings.largest_size() + SourceCode::BLOCK);
    for (End* end : {&from_, &to_}) {
        end->borders.reserve(index.numbering.level_count());
        end->distance.resize(samples_.size());
        end->first_code.resize(code_.size());
        end->window_distance.resize(index.numbering.level_count() * from_window_.size());
    }
}

// ---- The two ends, seen from the border of `patch` where they meet

struct OverlaySssd::FromEnd {
    OverlaySssd& search;
    End& end;
    uint32_t patch;

    void samples(std::span<float> out) const { search.cross_samples(end, patch, out); }
    bool trace(Samples samples) const {
        const uint32_t* sample =
            search.index_.samples.sample_of_place.data() + search.index_.samples.rings.begin[patch];
        const std::array<uint16_t, 3> winners{search.winners_[sample[samples.first - 1]],
                                              search.winners_[sample[samples.first]],
                                              search.winners_[sample[samples.first + 1]]};
        return search.trace(end, search.range_of(winners));
    }
    bool trace_near(float reach) const { return search.trace_near(end, reach); }
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
    const OverlayIndex& index;
    uint32_t patch;
    OfPlace of_place;

    void samples(std::span<float> out) const { sample_distances(index, patch, of_place, out); }
    bool trace(Samples) const { return true; }
    bool trace_near(float) const { return true; }
    void window(Window window, std::span<float> out) const {
        for (uint32_t i = 0; i < window.size(); ++i) out[i] = of_place(window.first + i);
    }
};

// Of places of the first border around a vertex, counted over all rings.
auto OverlaySssd::distances_from(uint32_t vertex) const {
    const uint32_t patch = numbering_.entry(vertex);
    const uint16_t* row =
        index_.hops.inner.data() + index_.inner_row(patch, vertex - numbering_.first_inner(patch));
    return [this, row, patch, first = index_.rings.begin[patch]](size_t place) {
        return index_.distance(row[place - first], patch);
    };
}

float OverlaySssd::distance(uint32_t low, uint32_t high) {
    const uint32_t top = lowest_common_patch(index_, numbering_.entry(low), numbering_.entry(high));
    if (top >= numbering_.first_leaf()) {
        const uint32_t first = numbering_.first_internal(top);
        return index_.distance(
            index_.hops.internal[numbering_.internal_entry(top, low - first, high - first)], top);
    }
    const bool low_is_there = numbering_.entry(low) == top, high_is_there = numbering_.entry(high) == top;
    if (low_is_there && high_is_there)
        return index_.distance(
            index_.overlay_code(top, numbering_.position_at_owner(low), numbering_.position_at_owner(high)),
            top);
    const bool both_climb = !low_is_there && !high_is_there;
    climb(high_is_there ? low : high, top, to_);
    const uint32_t patch = to_.borders.back().patch;
    if (both_climb) {
        climb(low, top, from_);
        return meet(FromEnd{*this, from_, patch}, to_);
    }
    const uint32_t there = low_is_there ? low : high;
    if (const float known = distance_on_border(there, patch, to_.vertex); known < INFINITE) return known;
    const uint32_t position = numbering_.position_at_owner(there);
    const uint16_t* row = index_.hops.outer.data() + index_.outer_row(patch, position);
    const uint32_t first = index_.rings.begin[patch];
    const auto of_place = [&](uint32_t k) { return index_.distance(row[k - first], top); };
    return meet(FromVertex<decltype(of_place)>{index_, patch, of_place}, to_);
}

// To a vertex on the border of a patch that another one lies in; infinite if it is not there, or not known.
float OverlaySssd::distance_on_border(uint32_t border_vertex, uint32_t patch, uint32_t vertex) const {
    for (const BorderPlace& at : numbering_.places_of(border_vertex)) {
        if (at.patch != patch) continue;
        if (patch == numbering_.entry(vertex))
            return distances_from(vertex)(
                index_.rings.begin[patch] +
                index_.rings.place_of_slot[numbering_.border_begin[patch] + at.position]);
        if (index_.is_labelled_whole(patch)) return label_of(vertex, patch).distance(at.position);
    }
    return INFINITE;
}

float OverlaySssd::distance_from(uint32_t source, std::span<const float> known, uint32_t target) {
    const uint32_t entry = numbering_.entry(target);
    if (entry < numbering_.level_begin[prepared_level_]) return known[target];
    uint32_t patch = entry;
    while (patch >= numbering_.level_begin[prepared_level_ + 1]) patch = numbering_.parent[patch];
    if (!numbering_.is_within(numbering_.entry(source), patch)) return distance_over(patch, known, target);
    const uint32_t top = lowest_common_patch(index_, numbering_.entry(source), numbering_.entry(target));
    if (top >= numbering_.first_leaf() || numbering_.entry(target) == top) return known[target];
    climb(target, top, to_);
    const uint32_t waiting = to_.borders.back().patch;
    if (numbering_.entry(source) == top)
        if (const float direct = distance_on_border(source, waiting, target); direct < INFINITE)
            return direct;
    const auto of_place = [&](uint32_t k) { return known[index_.rings.vertex[k]]; };
    return meet(FromVertex<decltype(of_place)>{index_, waiting, of_place}, to_);
}

// Into a patch with all vertices of its border labelled, from a source outside.
float OverlaySssd::distance_over(uint32_t patch, std::span<const float> known, uint32_t target) const {
    const Rings& rings = index_.rings;
    const auto from = [&](size_t k) { return known[rings.vertex[k]]; };
    const auto least_way = [&](const auto& to) {
        float shortest = INFINITE;
        size_t nearest = 0;
        for (size_t k = rings.begin[patch]; k < rings.begin[patch + 1]; ++k) {
            const float sum = from(k) + to(k);
            if (!rings.is_own[k] || !(sum < shortest)) continue;
            shortest = sum;
            nearest = k;
        }
        if (!(shortest < INFINITE)) return INFINITE;
        if (shortest > index_.near[patch]) return straightened(rings, nearest, from, to);
        for (size_t k = rings.begin[patch] + REACH; k + REACH < rings.begin[patch + 1]; ++k)
            shortest = std::min(shortest, straightened(rings, k, from, to));
        return shortest;
    };
    if (patch == numbering_.entry(target)) return least_way(distances_from(target));
    const Label label = label_of(target, patch);
    return least_way([&](size_t k) { return label.distance(rings.position[k]); });
}

// Over the best samples of the border where `to` waits.
template <class From>
float OverlaySssd::meet(const From& from, End& to) {
    const Border& border = to.borders.back();
    const auto distance = std::span(samples_).first(index_.samples.of(border.patch).size());
    from.samples(distance);
    const Rings& rings = index_.samples.rings;
    const auto sum = [&](uint32_t k) {
        return distance[index_.samples.sample_of_place[k]] + to.distance[index_.samples.sample_of_place[k]];
    };
    std::array<std::pair<float, uint32_t>, WAYS> ways; // shortest first
    ways.fill({INFINITE, 0});
    for (uint32_t k = rings.begin[border.patch]; k < rings.begin[border.patch + 1]; ++k) {
        if (!rings.is_own[k] || !(sum(k) < INFINITE) || sum(k) > sum(k - 1) || sum(k) > sum(k + 1)) continue;
        std::pair<float, uint32_t> way{sum(k), k};
        for (auto& kept : ways)
            if (way < kept) std::swap(way, kept);
    }
    const auto is_worth_measuring = [&](const auto& way) {
        return way.first < INFINITE && way.first <= ways[0].first * WORTH_MEASURING;
    };
    float shortest = INFINITE;
    uint32_t beside = place_beside(distance, to);
    for (const auto& way : ways) {
        if (!is_worth_measuring(way)) continue;
        shortest = std::min(shortest, measure_over(from, to, way.second - rings.begin[border.patch]));
        if (way.second == beside) beside = NONE;
    }
    if (beside != NONE)
        shortest = std::min(shortest, measure_over(from, to, beside - rings.begin[border.patch]));
    if (!(shortest <= index_.near[border.patch])) return shortest;
    const float reach = shortest + 2 * index_.samples.longest_gap[border.patch];
    if (!from.trace_near(reach) || !trace_near(to, reach)) return shortest;
    return std::min(shortest, measure(from, to));
}

// The place, in the coarse ring of the border where `to` waits, of the sample that lies nearest to one of the
// two ends, if that end lies beside the border and the other one can be reached from there; otherwise NONE.
// The shortest path passes near that sample, even where samples alone make another way look shorter.
uint32_t OverlaySssd::place_beside(std::span<const float> from_distance, const End& to) const {
    const uint32_t patch = to.borders.back().patch;
    const Rings& rings = index_.samples.rings;
    float least = BESIDE * index_.samples.spacing[patch];
    uint32_t beside = NONE;
    for (uint32_t k = rings.begin[patch]; k < rings.begin[patch + 1]; ++k) {
        const uint32_t sample = index_.samples.sample_of_place[k];
        const float nearer = std::min(from_distance[sample], to.distance[sample]);
        const bool is_passable = from_distance[sample] + to.distance[sample] < INFINITE;
        if (!rings.is_own[k] || !is_passable || nearer >= least) continue;
        least = nearer;
        beside = k;
    }
    return beside;
}

// The way over one of these samples, by its place in the coarse ring; infinite if there is none.
template <class From>
float OverlaySssd::measure_over(const From& from, End& to, uint32_t place) {
    if (!from.trace({place, place}) || !trace(to, {place, place})) return INFINITE;
    return measure(from, to);
}

// The way that is traced, straightened near the place with the least sum, or anywhere if the ends are near.
template <class From>
float OverlaySssd::measure(const From& from, End& to) {
    const Window window = to.borders.back().window;
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
        if (!index_.rings.is_own[k] || !(sum < shortest)) continue;
        shortest = sum;
        nearest = k;
    }
    if (!(shortest < INFINITE)) return INFINITE;
    const auto straightened_near = [&](size_t place) {
        return straightened(index_.rings, place, at(from_distance), at(to_distance));
    };
    if (!to.is_near) return straightened_near(nearest);
    for (size_t k = window.first; k <= window.last; k += 2 * REACH)
        shortest = std::min(shortest, straightened_near(k + REACH));
    return shortest;
}

// ---- Over samples

// The borders around a vertex below `top`, and its distances to the samples of the last one. The first border
// is the outermost one that all distances are known of.
void OverlaySssd::climb(uint32_t vertex, uint32_t top, End& end) {
    end.vertex = vertex;
    end.crossed = 0;
    end.is_near = false;
    end.is_first_encoded = false;
    end.borders.clear();
    const uint32_t entry = numbering_.entry(vertex);
    for (uint32_t patch = entry; patch != top; patch = numbering_.parent[patch]) {
        if (patch != entry && index_.is_labelled_whole(patch)) end.borders.clear();
        end.borders.push_back({patch, {0, 0}, {0, 0}});
    }
    const uint32_t patch = end.borders.back().patch;
    if (patch == entry) {
        sample_distances(index_, patch, distances_from(vertex), end.distance);
    } else {
        const Label label = label_of(vertex, patch);
        const auto samples = index_.samples.of(patch);
        for (uint32_t i = 0; i < samples.size(); ++i)
            end.distance[i] = label.distance(label.is_whole ? samples[i] : i);
    }
}

// From the first to the last one of the last border that is no farther.
OverlaySssd::Samples OverlaySssd::samples_within(const End& end, float reach) const {
    const uint32_t patch = end.borders.back().patch;
    const uint32_t begin = index_.samples.rings.begin[patch], places = index_.samples.rings.size(patch);
    Samples within;
    for (uint32_t k = REACH; k + REACH < places; ++k)
        if (end.distance[index_.samples.sample_of_place[begin + k]] <= reach) within.add(k);
    return within;
}

// Of a patch that a vertex lies in beyond its first one.
OverlaySssd::Label OverlaySssd::label_of(uint32_t vertex, uint32_t patch) const {
    const uint32_t entry = numbering_.entry(vertex);
    const int16_t* label = index_.labels.codes.data() + index_.labels.begin[entry] +
                           uint64_t{vertex - numbering_.first_inner(entry)} * index_.labels.offset[entry] +
                           index_.labels.offset[patch];
    const uint32_t nearest = static_cast<uint32_t>(static_cast<uint16_t>(label[0])) +
                             0x10000u * static_cast<uint32_t>(static_cast<uint16_t>(label[1]));
    return {nearest, index_.quantum[numbering_.parent[patch]], label + Labels::HEAD,
            index_.is_labelled_whole(patch)};
}

// A row of the coarse table of a patch.
const uint16_t* OverlaySssd::coarse_row(uint32_t patch, uint32_t row) const {
    const uint32_t places = index_.samples.rings.size(patch);
    if (places < index_.rings.size(patch))
        return index_.samples.tables.data() + index_.samples.table_begin[patch] + size_t{row} * places;
    const uint32_t parent = numbering_.parent[patch];
    return index_.hops.outer.data() +
           index_.outer_row(patch, index_.samples.row_position[index_.samples.row_begin[parent] + row]);
}

// From the last border of an end to the samples of a sibling's; winners_ are the places that the ways come
// over, NO_PLACE for samples that cannot be reached.
void OverlaySssd::cross_samples(const End& end, uint32_t sibling, std::span<float> out) {
    const uint32_t patch = end.borders.back().patch;
    const Rings& rings = index_.samples.rings;
    const uint32_t places = rings.size(patch);
    const uint32_t* sample = index_.samples.sample_of_place.data() + rings.begin[patch];
    rows_.resize(out.size());
    for (uint32_t i = 0; i < out.size(); ++i) {
        rows_[i] = coarse_row(patch, index_.samples.first_row[sibling] + i);
        prefetch(rows_[i], places);
    }
    for (float& d : field_.begin(rings, rings.begin[patch], places, index_.quantum[numbering_.parent[patch]]))
        d = end.distance[*sample++];
    if (!field_.finish()) {
        std::ranges::fill(out, INFINITE);
        std::fill_n(winners_.begin(), out.size(), SeenBorder::NO_PLACE);
        return;
    }
    field_.cross(rows_, out.data(), winners_.data());
}

// Lets the ways at hand be those to samples of the last border. What is known of another way is kept as long
// as it covers them, from the first border on. Returns whether there are such ways; if not, those at hand
// stay.
bool OverlaySssd::trace(End& end, Samples samples) {
    for (size_t b = end.borders.size(); b-- > 0;) {
        if (samples.are_none()) return false;
        end.borders[b].traced = window_of(end.borders[b].patch, samples);
        if (b > 0) samples = samples_before(end, b, samples);
    }
    size_t kept = 0;
    while (kept < end.crossed && end.borders[kept].window.covers(end.borders[kept].traced)) ++kept;
    end.crossed = kept;
    for (size_t b = kept; b < end.borders.size(); ++b) end.borders[b].window = end.borders[b].traced;
    for (size_t b = 0; b < end.borders.size(); ++b) prefetch_window(end, b);
    return true;
}

// Lets all ways over the samples up to a distance be at hand, for another end that is near. Returns whether
// there are any.
bool OverlaySssd::trace_near(End& end, float reach) {
    end.is_near = true;
    end.crossed = 0;
    return trace(end, samples_within(end, reach));
}

// Those of the border before that the ways to these samples and to their neighbours come over.
OverlaySssd::Samples OverlaySssd::samples_before(End& end, size_t b, Samples samples) {
    const uint32_t patch = end.borders[b].patch, before = end.borders[b - 1].patch;
    const Rings& rings = index_.samples.rings;
    if (b == 1)
        encode_first(end);
    else
        spread(label_of(end.vertex, before), before, code_);
    const uint32_t* sample = index_.samples.sample_of_place.data() + rings.begin[patch];
    rows_.clear();
    for (uint32_t k = samples.first - 1; k <= samples.last + 1; ++k)
        rows_.push_back(coarse_row(before, sample[k]));
    SeenBorder border{};
    border.places = rings.size(before);
    border.code = b == 1 ? end.first_code.data() : code_.data();
    traced_.resize(rows_.size());
    crossing_kernels().back().choose(border, rows_, traced_.data());
    return range_of(traced_);
}

// To the places of a coarse ring, from a label.
void OverlaySssd::spread(const Label& label, uint32_t patch, std::span<int16_t> out) const {
    const Rings& rings = index_.samples.rings;
    const uint32_t first = rings.begin[patch], places = rings.size(patch);
    const uint32_t* code_at =
        (label.is_whole ? rings.position : index_.samples.sample_of_place).data() + first;
    for (uint32_t k = 0; k < places; ++k)
        out[k] = rings.is_own[first + k] ? label.codes[code_at[k]] : SourceCode::UNREACHED;
    std::ranges::fill(out.subspan(places, SourceCode::BLOCK), SourceCode::UNREACHED);
}

// The samples of the first border, by the quantum of the second one's rows.
void OverlaySssd::encode_first(End& end) {
    if (end.is_first_encoded) return;
    end.is_first_encoded = true;
    const uint32_t patch = end.borders.front().patch;
    if (patch != numbering_.entry(end.vertex)) {
        spread(label_of(end.vertex, patch), patch, end.first_code);
        return;
    }
    const auto distances = std::span(samples_of_first_).first(index_.samples.of(patch).size());
    sample_distances(index_, patch, distances_from(end.vertex), distances);
    const StepsOf steps(distances, index_.quantum[numbering_.parent[patch]]);
    for (size_t i = 0; i < distances.size(); ++i) code_of_first_[i] = steps.code(distances[i]);
    spread({0, 0, code_of_first_.data(), false}, patch, end.first_code);
}

OverlaySssd::Samples OverlaySssd::range_of(std::span<const uint16_t> winners) const {
    Samples range;
    for (const uint16_t winner : winners)
        if (winner != SeenBorder::NO_PLACE) range.add(winner);
    return range;
}

// What climb_windows() is going to read.
void OverlaySssd::prefetch_window(const End& end, size_t b) const {
    const auto& [patch, window, traced] = end.borders[b];
    const Rings& rings = index_.rings;
    prefetch(rings.segment_length.data() + window.first, window.size());
    prefetch(rings.half_inverse.data() + window.first, window.size());
    prefetch(rings.is_own.data() + window.first, window.size());
    if (b + 1 == end.borders.size()) return;
    const Window next = end.borders[b + 1].window;
    const uint16_t* rows =
        index_.hops.outer.data() + index_.outer_row(patch, 0) + (window.first - rings.begin[patch]);
    for (uint32_t k = next.first; k <= next.last; ++k)
        prefetch(rows + size_t{position_at(k)} * rings.size(patch), window.size());
}

// ---- Over windows

// The vertices from the second sample before to the second one after, or of whole chains where these are not
// beside each other.
OverlaySssd::Window OverlaySssd::window_of(uint32_t patch, Samples samples) const {
    const uint32_t* place = index_.samples.full_place.data() + index_.samples.rings.begin[patch];
    const uint32_t first = place[samples.first - REACH], last = place[samples.last + REACH];
    if (first <= place[samples.first] && place[samples.last] <= last) return {first, last};
    const auto chain = [&](uint32_t k) { return index_.rings.chains[index_.rings.chain[place[k]]]; };
    return {chain(samples.first).first - REACH, chain(samples.last).last + REACH};
}

std::span<float> OverlaySssd::window_distances(End& end, size_t b) const {
    return std::span(end.window_distance).subspan(b * from_window_.size(), end.borders[b].window.size());
}

// The distances of an end from the windows of its borders, but those that are known from another way.
void OverlaySssd::climb_windows(End& end) {
    if (end.crossed == 0) read_first_window(end);
    for (size_t b = std::max<size_t>(end.crossed, 1); b < end.borders.size(); ++b)
        cross_window(
            end, b - 1, end.borders[b].window, [&](uint32_t place) { return position_at(place); },
            window_distances(end, b));
    end.crossed = end.borders.size();
}

void OverlaySssd::read_first_window(End& end) {
    const auto& [patch, window, traced] = end.borders.front();
    const auto out = window_distances(end, 0);
    if (patch == numbering_.entry(end.vertex)) {
        const auto of_place = distances_from(end.vertex);
        for (uint32_t i = 0; i < out.size(); ++i) out[i] = of_place(window.first + i);
    } else {
        const Label label = label_of(end.vertex, patch);
        for (uint32_t i = 0; i < out.size(); ++i) out[i] = label.distance(position_at(window.first + i));
    }
}

// From a window to the places that stand at these positions of the overlay of the patch's parent.
template <class OverlayPosition>
void OverlaySssd::cross_window(End& end, size_t b, Window to, const OverlayPosition& overlay_position,
                               std::span<float> out) {
    const Border& border = end.borders[b];
    const auto distance = window_distances(end, b);
    const Window& window = border.window;
    const uint32_t first = std::max(window.first, index_.rings.begin[border.patch] + REACH) - REACH;
    const uint32_t last = std::min(window.last + REACH, index_.rings.begin[border.patch + 1] - 1);
    const auto places =
        field_.begin(index_.rings, first, last - first + 1, index_.quantum[numbering_.parent[border.patch]]);
    const auto inside = places.subspan(window.first - first, window.size());
    std::fill(places.begin(), inside.begin(), INFINITE);
    std::ranges::copy(distance, inside.begin());
    std::fill(inside.end(), places.end(), INFINITE);
    if (!field_.finish()) {
        std::ranges::fill(out, INFINITE);
        return;
    }
    const uint16_t* rows = index_.hops.outer.data() + index_.outer_row(border.patch, 0) +
                           (first - index_.rings.begin[border.patch]);
    rows_.resize(to.size());
    for (uint32_t i = 0; i < to.size(); ++i)
        rows_[i] = rows + size_t{overlay_position(to.first + i)} * index_.rings.size(border.patch);
    field_.cross(rows_, out.data());
    if (end.is_near) field_.cross_near(rows_, out.data());
}

}
