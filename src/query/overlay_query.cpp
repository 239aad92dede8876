#include "src/query/overlay_query.h"

#include <algorithm>
#include <limits>

namespace geodesic {

namespace {

constexpr float INFINITE = std::numeric_limits<float>::infinity();

static_assert(OverlayTables::PADDING >= MIN_PLUS_BLOCK, "the last row of a table is read in whole blocks");

float decoded(uint16_t code, float quantum) {
    return code == OverlayTables::UNREACHED ? INFINITE : static_cast<float>(code) * quantum;
}

void lower(float& distance, float candidate) { distance = std::min(distance, candidate); }

uint32_t largest_border(const Index& index) {
    uint32_t largest = 0;
    for (uint32_t p = 0; p < index.patch_count(); ++p) largest = std::max(largest, index.border_size(p));
    return largest;
}

uint32_t most_columns(const Index& index) {
    uint32_t most = 0;
    for (uint32_t p = 0; p < index.first_leaf(); ++p) most = std::max(most, index.overlay_size(p));
    for (uint32_t p = index.first_leaf(); p < index.patch_count(); ++p)
        most = std::max(most, index.internal_size(p));
    return most;
}

// A parent has a smaller number than its children.
uint32_t lowest_common_patch(const Index& index, uint32_t a, uint32_t b) {
    while (a != b) (a > b ? a : b) = index.parent[std::max(a, b)];
    return a;
}

}

OverlayQuery::OverlayQuery(const Index& index, std::pmr::memory_resource* memory)
    : index_(index), tables_(index.overlay_tables), rows_(memory), active_rows_(memory),
      active_positions_(memory), best_(min_plus_room(most_columns(index)), memory),
      winner_(best_.size(), memory), gates_(largest_border(index), memory), out_(best_.size(), memory),
      border_distance_(gates_.size(), memory), sources_below_(index.patch_count(), memory), from_(memory),
      to_(memory) {
    rows_.reserve(gates_.size());
    active_rows_.reserve(gates_.size());
    active_positions_.reserve(gates_.size());
    from_.distance.reserve(gates_.size());
    to_.distance.reserve(gates_.size());
}

// ---- One hop: from a border over a table

void OverlayQuery::take_rows(const uint16_t* first, size_t stride, size_t count) {
    rows_.clear();
    for (size_t i = 0; i < count; ++i) rows_.push_back(first + i * stride);
}

// Of its parent's overlay table.
void OverlayQuery::take_rows_of_child(uint32_t child, uint32_t first_column) {
    const uint32_t parent = index_.parent[child];
    rows_.clear();
    for (uint32_t slot = index_.border_begin[child]; slot < index_.border_begin[child + 1]; ++slot)
        rows_.push_back(tables_.tables.data() +
                        index_.overlay_place(parent, index_.overlay_position[slot], first_column));
}

// Distances on a border differ by no more than its table's entries, so that their codes fit.
void OverlayQuery::activate_rows(std::span<const float> distance, float quantum) {
    float nearest = INFINITE;
    for (float d : distance) lower(nearest, d);
    const float scale = quantum > 0 ? 1 / quantum : 0;
    active_rows_.clear();
    active_positions_.clear();
    for (uint32_t i = 0; i < distance.size(); ++i) {
        if (distance[i] == INFINITE) continue;
        const float code = std::min(float{OverlayTables::LARGEST}, (distance[i] - nearest) * scale + 0.5f);
        active_rows_.push_back({rows_[i], static_cast<uint16_t>(code)});
        active_positions_.push_back(i);
    }
}

void OverlayQuery::open(Gate& gate, uint32_t border_patch, std::span<const float> distance,
                        uint32_t position) {
    const auto near = tables_.around(index_.border_begin[border_patch], position);
    for (size_t k = 0; k < std::size(gate.rows); ++k) gate.rows[k] = rows_[near.position[k]];
    gate.segments = UnfoldedSegments(by_segment([&](int k) { return distance[near.position[k]]; }),
                                     FourFloats(near.length, std::experimental::element_aligned));
    gate.distance = distance[position];
    gate.is_open = true;
}

// The way over the gate's vertex, or over one of the segments near it where that is shorter.
float OverlayQuery::through(const Gate& gate, float quantum, size_t column) {
    const uint16_t code = gate.rows[2][column];
    if (code == OverlayTables::UNREACHED) return INFINITE;
    const float best = gate.distance + static_cast<float>(code) * quantum;
    const float square = gate.segments.square_across(
        by_segment([&](int k) { return static_cast<float>(gate.rows[k][column]) * quantum; }));
    return std::min(best, std::sqrt(square));
}

// From the distances of a border over the rows taken: the distances of the columns.
std::span<float> OverlayQuery::hop(uint32_t border_patch, std::span<const float> distance, float quantum,
                                   size_t first_column, size_t columns) {
    const std::span<float> out = std::span(out_).subspan(first_column, columns);
    if (columns == 0) return out;
    activate_rows(distance, quantum);
    if (active_rows_.empty()) {
        std::fill(out.begin(), out.end(), INFINITE);
        return out;
    }
    min_plus(active_rows_, columns, best_.data(), winner_.data());
    for (size_t i = 0; i < active_rows_.size(); ++i) gates_[i].is_open = false;
    for (size_t x = 0; x < columns; ++x) {
        Gate& gate = gates_[winner_[x]];
        if (!gate.is_open) open(gate, border_patch, distance, active_positions_[winner_[x]]);
        out[x] = through(gate, quantum, x);
    }
    return out;
}

// To the parent's overlay: the distances of its border and, at the positions behind them, of what it owns.
// The child's border keeps its own.
std::span<float> OverlayQuery::hop_to_parent(uint32_t child, std::span<const float> distance, bool to_owned) {
    const uint32_t parent = index_.parent[child];
    const uint32_t border = index_.border_size(parent);
    const uint32_t columns = to_owned ? index_.overlay_size(parent) : border;
    take_rows_of_child(child, 0);
    hop(child, distance, tables_.quantum[parent], 0, border);
    take_rows_of_child(child, border);
    hop(child, distance, tables_.quantum[parent], border, columns - border);
    const uint32_t* position = index_.overlay_position.data() + index_.border_begin[child];
    for (size_t i = 0; i < distance.size(); ++i)
        if (position[i] < columns) out_[position[i]] = distance[i];
    return std::span(out_).first(columns);
}

// ---- Multiple sources, all destinations

void OverlayQuery::msad(std::span<const uint32_t> sources, std::span<float> distance) {
    std::fill(distance.begin(), distance.end(), INFINITE);
    std::fill(sources_below_.begin(), sources_below_.end(), 0u);
    for (uint32_t source : sources) start_from(source, distance);
    for (uint32_t p = index_.patch_count() - 1; p > 0; --p)
        if (sources_below_[p]) {
            ascend(p, distance);
            sources_below_[index_.parent[p]] += sources_below_[p];
        }
    // A patch that all sources lie in has its distances already.
    for (uint32_t p = 1; p < index_.patch_count(); ++p)
        if (sources_below_[p] < sources.size())
            p < index_.first_leaf() ? descend(p, distance) : fill_leaf(p, distance);
}

void OverlayQuery::start_from(uint32_t source, std::span<float> distance) {
    lower(distance[source], 0);
    if (index_.is_border(source)) {
        const uint32_t owner = index_.owner[source], position = index_.position_at_owner(source);
        for (uint32_t i = 0; i < index_.overlay_size(owner); ++i)
            lower(distance[index_.overlay_number(owner, i)],
                  decoded(tables_.tables[index_.overlay_place(owner, position, i)], tables_.quantum[owner]));
        ++sources_below_[owner];
        return;
    }
    const uint32_t leaf = index_.leaf_of(source), first = index_.first_internal(leaf), own = source - first;
    const auto border = index_.border_of(leaf);
    const float quantum = tables_.quantum[leaf];
    for (uint32_t i = 0; i < border.size(); ++i)
        lower(distance[border[i]],
              decoded(tables_.crossing_tables[index_.crossing_place(leaf, i, own)], quantum));
    for (uint32_t i = 0; i < index_.internal_size(leaf); ++i)
        if (i != own)
            lower(distance[first + i],
                  decoded(tables_.internal_tables[index_.internal_place(leaf, own, i)], quantum));
    ++sources_below_[leaf];
}

std::span<const float> OverlayQuery::distances_of_border(uint32_t patch, std::span<const float> distance) {
    const auto border = index_.border_of(patch);
    for (size_t i = 0; i < border.size(); ++i) border_distance_[i] = distance[border[i]];
    return std::span(border_distance_).first(border.size());
}

void OverlayQuery::ascend(uint32_t child, std::span<float> distance) {
    const uint32_t parent = index_.parent[child];
    if (index_.border_size(child) == 0) return;
    const auto out = hop_to_parent(child, distances_of_border(child, distance), true);
    for (uint32_t i = 0; i < out.size(); ++i) lower(distance[index_.overlay_number(parent, i)], out[i]);
}

// To the rest of the overlay.
void OverlayQuery::descend(uint32_t patch, std::span<float> distance) {
    const uint32_t border = index_.border_size(patch), size = index_.overlay_size(patch);
    if (border == 0 || size == border) return;
    take_rows(tables_.tables.data() + index_.overlay_place(patch, 0, border), size - border, border);
    const auto out =
        hop(patch, distances_of_border(patch, distance), tables_.quantum[patch], 0, size - border);
    for (size_t i = 0; i < out.size(); ++i) lower(distance[index_.owned_begin[patch] + i], out[i]);
}

void OverlayQuery::fill_leaf(uint32_t leaf, std::span<float> distance) {
    const uint32_t border = index_.border_size(leaf), size = index_.internal_size(leaf);
    if (border == 0 || size == 0) return;
    take_rows(tables_.crossing_tables.data() + index_.crossing_place(leaf, 0, 0), size, border);
    const auto out = hop(leaf, distances_of_border(leaf, distance), tables_.quantum[leaf], 0, size);
    for (size_t i = 0; i < out.size(); ++i) lower(distance[index_.first_internal(leaf) + i], out[i]);
}

// ---- Single source, single destination

float OverlayQuery::sssd(uint32_t low, uint32_t high) {
    const auto entry = [&](uint32_t v) { return index_.is_border(v) ? index_.owner[v] : index_.leaf_of(v); };
    const uint32_t top = lowest_common_patch(index_, entry(low), entry(high));
    if (top >= index_.first_leaf()) {
        const uint32_t first = index_.first_internal(top);
        return decoded(tables_.internal_tables[index_.internal_place(top, low - first, high - first)],
                       tables_.quantum[top]);
    }
    climb(low, top, from_);
    climb(high, top, to_);
    return meet(top, from_, to_);
}

// To the border of the child of `top` that the vertex lies in, or to its place in the overlay of `top`.
void OverlayQuery::climb(uint32_t vertex, uint32_t top, Climber& climber) {
    climber.distance.clear();
    climber.position = NONE;
    if (index_.is_border(vertex)) {
        const uint32_t owner = climber.patch = index_.owner[vertex];
        climber.position = index_.position_at_owner(vertex);
        if (owner == top) return;
        for (uint32_t i = 0; i < index_.border_size(owner); ++i)
            climber.distance.push_back(decoded(
                tables_.tables[index_.overlay_place(owner, climber.position, i)], tables_.quantum[owner]));
        climber.position = NONE;
    } else {
        const uint32_t leaf = climber.patch = index_.leaf_of(vertex);
        const uint32_t own = vertex - index_.first_internal(leaf);
        for (uint32_t i = 0; i < index_.border_size(leaf); ++i)
            climber.distance.push_back(
                decoded(tables_.crossing_tables[index_.crossing_place(leaf, i, own)], tables_.quantum[leaf]));
    }
    while (index_.parent[climber.patch] != top) climb_over(index_.parent[climber.patch], climber);
}

void OverlayQuery::climb_over(uint32_t parent, Climber& climber) {
    const auto out = hop_to_parent(climber.patch, climber.distance, false);
    climber.distance.assign(out.begin(), out.end());
    climber.patch = parent;
}

float OverlayQuery::meet(uint32_t top, const Climber& from, const Climber& to) {
    const auto from_position = [&](uint32_t i) {
        return decoded(tables_.tables[index_.overlay_place(top, from.position, i)], tables_.quantum[top]);
    };
    if (to.position != NONE) return from.position != NONE ? from_position(to.position) : meet(top, to, from);

    const uint32_t first = index_.border_begin[to.patch];
    if (from.position != NONE)
        for (size_t i = 0; i < to.distance.size(); ++i)
            out_[index_.overlay_position[first + i]] = from_position(index_.overlay_position[first + i]);
    else
        hop_to_parent(from.patch, from.distance, true);
    for (size_t i = 0; i < to.distance.size(); ++i)
        border_distance_[i] = out_[index_.overlay_position[first + i]];
    return meet_at_border(to.patch, std::span(border_distance_).first(to.distance.size()), to.distance);
}

float OverlayQuery::meet_at_border(uint32_t patch, std::span<const float> from, std::span<const float> to) {
    float best = INFINITE;
    uint32_t position = 0;
    for (uint32_t i = 0; i < from.size(); ++i)
        if (from[i] + to[i] < best) {
            best = from[i] + to[i];
            position = i;
        }
    if (best == INFINITE) return best;
    return straightened(
        tables_, index_.border_begin[patch], position, [&](uint32_t i) { return from[i]; },
        [&](uint32_t i) { return to[i]; });
}

}
