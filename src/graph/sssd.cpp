#include <algorithm>

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

// A lower bound that no table entry undercuts (paper 3.4), which makes the search A*.
double bound(const GraphIndex& index, uint32_t a, uint32_t b) {
    return double{index.bound_scale} * straight_distance(index.numbering, a, b);
}

}

float GraphQuery::sssd(uint32_t low, uint32_t high) {
    const float direct = same_leaf_distance(low, high);
    return direct < INFINITE ? direct : static_cast<float>(search(low, high));
}

// The table's distance of two vertices that a leaf or a border has in common; infinity if there is none.
float GraphQuery::same_leaf_distance(uint32_t low, uint32_t high) const {
    if (numbering_.is_border(high)) {
        for (const PatchPosition& a : numbering_.borders_of(low))
            for (const PatchPosition& b : numbering_.borders_of(high))
                if (a.patch == b.patch) return index_.border_row(a.patch, a.position)[b.position];
        return INFINITE;
    }
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
    queue_.push(distance + bound(index_, node, target), node);
}

void GraphQuery::relax_border_vertex(uint32_t node, double distance, uint32_t target) {
    for (const PatchPosition& at : numbering_.borders_of(node)) {
        if (at.patch != top_ && allowed_epoch_[numbering_.parent[at.patch]] != epoch_) continue;
        const auto border = numbering_.border_of(at.patch);
        const float* row = index_.border_row(at.patch, at.position);
        for (size_t i = 0; i < border.size(); ++i) open(border[i], distance + double{row[i]}, target);
    }
}

double GraphQuery::search(uint32_t source, uint32_t target) {
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
        if (key > d + bound(index_, node, target)) continue;
        if (node == target) return d;
        if (!numbering_.is_border(target))
            best = std::min(best, d + double{crossing_distance(index_, node, target)});
        relax_border_vertex(node, d, target);
    }
    return best;
}

}
