#include <algorithm>
#include <limits>

#include "src/graph/query.h"

namespace geodesic {

namespace {

// The patch whose overlay a vertex enters the search in.
uint32_t entry_patch(const GraphIndex& index, uint32_t number) {
    return index.numbering.is_border(number) ? index.numbering.owner[number]
                                             : index.numbering.parent[index.numbering.leaf_of(number)];
}

uint32_t level_of(const GraphIndex& index, uint32_t patch) {
    return static_cast<uint32_t>(
        std::upper_bound(index.numbering.level_begin.begin(), index.numbering.level_begin.end(), patch) -
        index.numbering.level_begin.begin() - 1);
}

float crossing_distance(const GraphIndex& index, uint32_t border_vertex, uint32_t internal_vertex) {
    const uint32_t leaf = index.numbering.leaf_of(internal_vertex);
    const uint32_t position = index.numbering.border_position(leaf, border_vertex);
    if (position == NONE) return INFINITE;
    return index.border_internal_row(leaf, position)[internal_vertex - index.numbering.first_internal(leaf)];
}

}

// A lower bound, which makes the search A* (paper 3.4). No entry of a table that was built undercuts it.
double GraphQuery::bound(uint32_t a, uint32_t b) const {
    return bound_scale_ > 0 ? bound_scale_ * straight_distance(numbering_, a, b) : 0;
}

float GraphQuery::sssd(uint32_t low, uint32_t high) {
    const float direct = same_leaf_distance(low, high);
    return direct < INFINITE ? direct : static_cast<float>(search(low, high));
}

// The table's distance of two border vertices that a border has in common, by the first of these; infinity if
// there is none. Both have their borders in the order of the patches.
float GraphQuery::common_border_distance(uint32_t low, uint32_t high) const {
    const auto of_low = numbering_.borders_of(low), of_high = numbering_.borders_of(high);
    for (size_t i = 0, j = 0; i < of_low.size() && j < of_high.size();) {
        if (of_low[i].patch == of_high[j].patch)
            return index_.border_row(of_low[i].patch, of_low[i].position)[of_high[j].position];
        of_low[i].patch < of_high[j].patch ? ++i : ++j;
    }
    return INFINITE;
}

// The table's distance of two vertices that a leaf or a border has in common; infinity if there is none.
float GraphQuery::same_leaf_distance(uint32_t low, uint32_t high) const {
    if (numbering_.is_border(high)) return common_border_distance(low, high);
    if (numbering_.is_border(low)) return crossing_distance(index_, low, high);
    const uint32_t leaf = numbering_.leaf_of(low);
    if (numbering_.leaf_of(high) != leaf) return INFINITE;
    const uint32_t first = numbering_.first_internal(leaf);
    return index_.internal_distance(leaf, low - first, high - first);
}

// The search may cross the overlays of both vertices' ancestors up to the first common one, and no others.
// What leaves that one and comes back goes over its own border table (which goes beyond paper 3.4).
void GraphQuery::allow_ancestors(uint32_t source, uint32_t target) {
    if (++epoch_ == 0) {
        std::fill(search_epoch_.begin(), search_epoch_.end(), 0u);
        std::fill(allowed_epoch_.begin(), allowed_epoch_.end(), 0u);
        epoch_ = 1;
    }
    uint32_t a = entry_patch(index_, source), b = entry_patch(index_, target);
    uint32_t level_a = level_of(index_, a), level_b = level_of(index_, b);
    allowed_epoch_[a] = allowed_epoch_[b] = epoch_;
    while (a != b) {
        if (level_a >= level_b) {
            allowed_epoch_[a = numbering_.parent[a]] = epoch_;
            --level_a;
        } else {
            allowed_epoch_[b = numbering_.parent[b]] = epoch_;
            --level_b;
        }
    }
    top_ = a;
}

void GraphQuery::open(uint32_t node, double distance, uint32_t target) {
    if (search_epoch_[node] == epoch_ && !(distance < search_distance_[node])) return;
    search_epoch_[node] = epoch_;
    search_distance_[node] = distance;
    queue_.push(distance + bound(node, target), node);
}

void GraphQuery::relax_border_vertex(uint32_t node, double distance, uint32_t target) {
    for (const PatchPosition& at : numbering_.borders_of(node)) {
        if (at.patch != top_ && allowed_epoch_[numbering_.parent[at.patch]] != epoch_) continue;
        const auto border = numbering_.border_of(at.patch);
        const float* row = index_.border_row(at.patch, at.position);
        for (size_t i = 0; i < border.size(); ++i) open(border[i], distance + double{row[i]}, target);
    }
}

// Led by the bound, the search leaves each border vertex once, but for rounding. In a file whose tables
// undercut it, that may be without end; the search by distances alone leaves each once whatever the tables
// hold.
double GraphQuery::search(uint32_t source, uint32_t target) {
    bound_scale_ = double{index_.bound_scale};
    if (const auto distance = search_led(source, target, 4 * uint64_t{numbering_.border_vertex_count()}))
        return *distance;
    bound_scale_ = 0;
    return *search_led(source, target, std::numeric_limits<uint64_t>::max());
}

// Nothing if that takes more steps, each from one border vertex to all that its borders lead to.
std::optional<double> GraphQuery::search_led(uint32_t source, uint32_t target, uint64_t most_steps) {
    allow_ancestors(source, target);
    queue_.clear();
    if (numbering_.is_border(source)) {
        open(source, 0, target);
    } else {
        const uint32_t leaf = numbering_.leaf_of(source), own = source - numbering_.first_internal(leaf);
        const auto border = numbering_.border_of(leaf);
        for (uint32_t i = 0; i < border.size(); ++i)
            open(border[i], index_.border_internal_row(leaf, i)[own], target);
    }
    double best = INFINITE;
    while (!queue_.empty()) {
        const auto [key, node] = queue_.pop();
        if (key >= best) break;
        const double d = search_distance_[node];
        if (key > d + bound(node, target)) continue;
        if (node == target) return d;
        if (most_steps-- == 0) return std::nullopt;
        if (!numbering_.is_border(target))
            best = std::min(best, d + double{crossing_distance(index_, node, target)});
        relax_border_vertex(node, d, target);
    }
    return best;
}

}
