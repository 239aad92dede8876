#include "src/tables/closure.h"

#include <algorithm>

#include "src/overlay/kernels/unfolding.h"

namespace geodesic {

namespace {

// The share by which a distance must fall to count as shorter. Less is rounding.
constexpr float PROGRESS = 1e-6f;
// The share that a way over border vertices must gain to be straightened, since straightening costs much more
// than a sum.
constexpr float WORTH_STRAIGHTENING = 1e-4f;

bool is_lower(float a, float b, float share) { return a < b * (1 - share); }

// best[x] is the minimum of from + row[x] over the rows that were added, and winner[x] is the first row that
// attains it.
struct LeastSums {
    std::vector<float> best;
    std::vector<uint32_t> winner;

    void begin(size_t columns) {
        best.assign(columns, INFINITE);
        winner.assign(columns, 0);
    }
    void add(uint32_t row, float from, const float* entries) {
        for (size_t x = 0; x < best.size(); ++x) {
            const float sum = from + entries[x];
            winner[x] = sum < best[x] ? row : winner[x];
            best[x] = sum < best[x] ? sum : best[x];
        }
    }
};

// Fills the distances from one vertex of a patch's overlay to all others, over the tables of the children.
class RowFromBelow {
public:
    RowFromBelow(uint32_t patch, const Numbering& numbering, const Slots& slots, const Rings& rings,
                 const DistanceTables& tables, std::span<float> row)
        : patch_(patch), first_slot_(numbering.border_begin[numbering.child_begin[patch]]),
          numbering_(numbering), slots_(slots), rings_(rings), tables_(tables), row_(row),
          changed_(numbering.border_begin[numbering.child_begin[patch + 1]] - first_slot_, uint8_t{0}),
          nearest_changed_(numbering.child_begin[patch + 1] - numbering.child_begin[patch], INFINITE) {}

    void fill(uint32_t source) {
        std::fill(row_.begin(), row_.end(), INFINITE);
        row_[source] = 0;
        mark(source, NONE);
        for (uint32_t child; (child = nearest_changed_child()) != NONE;) cross(child);
    }

private:
    uint32_t nearest_changed_child() const {
        const auto nearest = std::ranges::min_element(nearest_changed_);
        if (*nearest == INFINITE) return NONE;
        return numbering_.child_begin[patch_] + static_cast<uint32_t>(nearest - nearest_changed_.begin());
    }

    // Marks the children that have this vertex on their border, because they are to be crossed from it. The
    // child over which it was reached is left out: its table holds distances on the whole surface, so that
    // crossing it twice in a row gains nothing.
    void mark(uint32_t position, uint32_t reached_over) {
        for (uint32_t slot : slots_.of(patch_, position)) {
            const uint32_t child = slots_.patch_of_slot[slot];
            if (child == reached_over) continue;
            changed_[slot - first_slot_] = 1;
            float& nearest = nearest_changed_[child - numbering_.child_begin[patch_]];
            nearest = std::min(nearest, row_[position]);
        }
    }

    void cross(uint32_t child) {
        const uint32_t first = numbering_.border_begin[child], size = numbering_.border_size(child);
        const auto position = numbering_.positions_in_parent(child);
        const float* table = tables_.overlay[child].data(); // its first rows and columns are the border
        const size_t stride = numbering_.overlay_size(child);
        from_.clear();
        rows_.clear();
        for (uint32_t i = 0; i < size; ++i) {
            from_.push_back(row_[position[i]]);
            if (changed_[first + i - first_slot_]) rows_.push_back(i);
            changed_[first + i - first_slot_] = 0;
        }
        nearest_changed_[child - numbering_.child_begin[patch_]] = INFINITE;

        least_.begin(size);
        for (uint32_t i : rows_) least_.add(i, from_[i], table + i * stride);
        for (uint32_t j = 0; j < size; ++j) {
            if (least_.best[j] == INFINITE) continue;
            const float d = straightened(
                rings_, own_place(rings_, numbering_, child, least_.winner[j]),
                [&](size_t k) { return from_[rings_.position[k]]; },
                [&](size_t k) { return table[rings_.position[k] * stride + j]; });
            if (!is_lower(d, row_[position[j]], PROGRESS)) continue;
            row_[position[j]] = d;
            mark(position[j], child);
        }
    }

    const uint32_t patch_, first_slot_;
    const Numbering& numbering_;
    const Slots& slots_;
    const Rings& rings_;
    const DistanceTables& tables_;
    std::span<float> row_;
    std::vector<uint8_t> changed_;       // per slot of the children
    std::vector<float> nearest_changed_; // per child: the smallest distance of a changed slot
    std::vector<float> from_;
    std::vector<uint32_t> rows_;
    LeastSums least_;
};

void make_symmetric(std::vector<float>& table, size_t size) {
    for (size_t i = 0; i < size; ++i)
        for (size_t j = 0; j < i; ++j)
            table[i * size + j] = table[j * size + i] = std::min(table[i * size + j], table[j * size + i]);
}

// Lowers one row of a patch's overlay table by paths that leave the patch over its border and come back.
class RowFromAbove {
public:
    RowFromAbove(uint32_t patch, const Numbering& numbering, const Rings& rings, const DistanceTables& tables,
                 std::span<const float> outside)
        : numbering_(numbering), rings_(rings), patch_(patch), border_(numbering.border_size(patch)),
          size_(numbering.overlay_size(patch)), table_(tables.overlay[patch]), outside_(outside) {}

    void fill(size_t row, std::span<float> out) {
        const std::span<const float> old = table_.subspan(row * size_, size_);
        std::copy(old.begin(), old.end(), out.begin());
        from_.assign(old.data(), old.data() + border_);
        if (!lower(from_, {outside_.data(), border_ * border_}, border_, out.first(border_))) return;
        from_.assign(out.data(), out.data() + border_);
        lower(from_, table_.first(border_ * size_), size_, out);
    }

private:
    // Lowers out[x] to the least way from the border over a table with one row for each border vertex.
    // Returns whether any entry became shorter.
    bool lower(std::span<const float> from, std::span<const float> table, size_t stride,
               std::span<float> out) {
        least_.begin(out.size());
        for (uint32_t i = 0; i < border_; ++i) least_.add(i, from[i], table.data() + i * stride);

        bool any = false;
        for (size_t x = 0; x < out.size(); ++x) {
            if (!is_lower(least_.best[x], out[x], WORTH_STRAIGHTENING)) continue;
            out[x] = straightened(
                rings_, own_place(rings_, numbering_, patch_, least_.winner[x]),
                [&](size_t k) { return from[rings_.position[k]]; },
                [&](size_t k) { return table[rings_.position[k] * stride + x]; });
            any = true;
        }
        return any;
    }

    const Numbering& numbering_;
    const Rings& rings_;
    const uint32_t patch_;
    const size_t border_, size_;
    std::span<const float> table_, outside_;
    std::vector<float> from_;
    LeastSums least_;
};

// The part of the parent's table that holds the distances between the border vertices of a patch.
std::vector<float> border_block(uint32_t patch, const Numbering& numbering, const DistanceTables& tables) {
    const uint32_t parent = numbering.parent[patch];
    const size_t stride = numbering.overlay_size(parent);
    std::vector<float> block;
    for (const uint32_t i : numbering.positions_in_parent(patch))
        for (const uint32_t j : numbering.positions_in_parent(patch))
            block.push_back(tables.overlay[parent][i * stride + j]);
    return block;
}

}

void close_from_below(uint32_t patch, const Numbering& numbering, const Slots& slots, const Rings& rings,
                      Workers& workers, DistanceTables& tables) {
    const size_t size = numbering.overlay_size(patch);
    std::vector<float>& table = tables.overlay[patch];
    workers.run(size, [&](FieldSolver&, size_t i) {
        RowFromBelow(patch, numbering, slots, rings, tables, std::span(table).subspan(i * size, size))
            .fill(static_cast<uint32_t>(i));
    });
    make_symmetric(table, size);
}

void close_from_above(uint32_t patch, const Numbering& numbering, const Rings& rings, Workers& workers,
                      DistanceTables& tables) {
    const size_t size = numbering.overlay_size(patch);
    const auto outside = border_block(patch, numbering, tables);
    std::vector<float> lowered(size * size);
    workers.run(size, [&](FieldSolver&, size_t i) {
        RowFromAbove(patch, numbering, rings, tables, outside)
            .fill(i, std::span(lowered).subspan(i * size, size));
    });
    make_symmetric(lowered, size);
    tables.overlay[patch] = std::move(lowered);
}

}
