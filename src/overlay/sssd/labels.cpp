#include "src/overlay/sssd/labels.h"

#include <algorithm>
#include <bit>
#include <memory_resource>
#include <mutex>
#include <numeric>
#include <optional>
#include <span>
#include <vector>

#include "src/overlay/fields/ascend.h"
#include "src/overlay/fields/descend.h"
#include "src/overlay/hops/inner_sweep.h"
#include "src/overlay/tables/codes.h"

namespace geodesic {

namespace {

// A vertex has at most so many labels.
constexpr uint32_t MOST_LABELS = 2;

// Labels that hold codes of two bytes alone have finer steps. They do where those of one byte would be more
// than so many times as coarse as those of the coarsest table, that of the whole mesh.
constexpr float MOST_OF_COARSEST = 3;

// Calls use(patch) for each patch to be labelled.
template <class Use>
void for_each_labelled(const OverlayIndex& index, const Use& use) {
    const Numbering& numbering = index.numbering;
    std::vector<uint8_t> labels(numbering.patch_count(), 0); // how many lie around the patch, or are its own
    for (uint32_t p = 1; p < numbering.first_leaf(); ++p) {
        const uint32_t places = index.rings.size(p);
        labels[p] = labels[numbering.parent[p]];
        if (labels[p] == MOST_LABELS || places == 0 || places > MOST_LABEL_PLACES) continue;
        ++labels[p];
        use(p);
    }
}

// How many vertices are inner vertices of each patch, or of patches in it.
std::vector<uint32_t> vertices_within(const Numbering& numbering) {
    std::vector<uint32_t> within(numbering.patch_count());
    for (uint32_t p = numbering.patch_count(); p-- > 0;) {
        within[p] += numbering.inner_size(p);
        if (p > 0) within[numbering.parent[p]] += within[p];
    }
    return within;
}

// How many rows lead to the border of a labelled patch. `within` is of vertices_within().
uint32_t count_label_rows(const Numbering& numbering, std::span<const uint32_t> within, uint32_t patch) {
    return within[patch] - numbering.inner_size(patch);
}

// Fills Labels::first_rank.
void rank_vertices(const Numbering& numbering, std::span<const uint32_t> within,
                   std::span<uint32_t> first_rank) {
    for (uint32_t p = 0; p < numbering.first_leaf(); ++p) {
        uint32_t next = first_rank[p] + numbering.inner_size(p);
        for (uint32_t child = numbering.child_begin[p]; child < numbering.child_begin[p + 1]; ++child) {
            first_rank[child] = next;
            next += within[child];
        }
    }
}

// Adds the runs of a labelled border, and returns the least quantum of its rows, or 0 where each place is a
// run. `coarsest` is the quantum of the coarsest table.
float choose_runs(const OverlayIndex& index, uint32_t patch, float coarsest, Array<uint16_t>& runs) {
    const size_t before = runs.size();
    const float quantum = find_runs(index.rings, patch, runs);
    if (quantum <= MOST_OF_COARSEST * coarsest) return quantum;
    runs.resize(before + index.rings.size(patch));
    std::iota(runs.begin() + static_cast<ptrdiff_t>(before), runs.end(), uint16_t{0});
    return 0;
}

// Sweeps from the border of a patch down to the inner vertices of all its descendants, with
// FIELDS_AT_ONCE border vertices as sources at a time, and writes the distances into the labels of those
// inner vertices.
class LabelSweep {
public:
    LabelSweep(const OverlayIndex& index, Labels& labels, std::pmr::memory_resource* memory)
        : index_(index), labels_(labels), numbering_(index.numbering), sweep_(index, FIELDS_AT_ONCE, memory),
          distances_(make_room<float>(FIELDS_AT_ONCE * index.numbering.border_vertex_count(), memory)),
          of_leaf_(make_room<float>(FIELDS_AT_ONCE * index.numbering.largest_inner_size(), memory)),
          of_border_(memory), begin_(make_room<size_t>(index.numbering.patch_count(), memory)),
          codes_(memory), of_places_(memory) {}

    void label(uint32_t patch) {
        lay_out_distances(patch);
        for (size_t first = 0; first < border_size_; first += FIELDS_AT_ONCE) {
            start(patch, first);
            descend_into(numbering_, patch, [&](uint32_t p) { hop_down(p, first); });
        }
        const float quantum = std::max(quantum_of_distances(), labels_.least_quantum[patch]);
        labels_.quantum[patch] = quantum;
        descend_into(numbering_, patch, [&](uint32_t p) { encode(p, patch, quantum); });
    }

private:
    void lay_out_distances(uint32_t patch) {
        border_size_ = numbering_.border_size(patch);
        size_t inside = 0;
        descend_into(numbering_, patch, [&](uint32_t p) {
            begin_[p] = inside * border_size_;
            inside += numbering_.inner_size(p);
        });
        of_border_.resize(inside * border_size_);
    }

    // Fills the distances in the patch's overlay from FIELDS_AT_ONCE border vertices, the `first` one and
    // those after it. Where fewer are left, the last one is repeated.
    void start(uint32_t patch, size_t first) {
        for (size_t s = 0; s < FIELDS_AT_ONCE; ++s)
            for_each_in_overlay(index_, patch, static_cast<uint32_t>(std::min(first + s, border_size_ - 1)),
                                [&](uint32_t number, float distance) {
                                    distances_[size_t{number} * FIELDS_AT_ONCE + s] = distance;
                                });
    }

    void hop_down(uint32_t patch, size_t first) {
        const uint32_t count = numbering_.inner_size(patch);
        // No hop reads the distances of a leaf.
        float* const inside = patch < numbering_.first_leaf()
                                  ? distances_.get() + size_t{numbering_.first_inner(patch)} * FIELDS_AT_ONCE
                                  : of_leaf_.get();
        if (sweep_.begin(patch, distances_.get()))
            sweep_.cross_to(inside);
        else
            std::fill_n(inside, count * FIELDS_AT_ONCE, INFINITE);
        float* to_border = of_border_.data() + begin_[patch] + first;
        for (uint32_t i = 0; i < count; ++i, to_border += border_size_)
            std::copy_n(inside + i * FIELDS_AT_ONCE, std::min(FIELDS_AT_ONCE, border_size_ - first),
                        to_border);
    }

    // So that the longest one has the largest code. (Distances compare as their bits do, which is quicker.)
    float quantum_of_distances() const {
        constexpr auto NONE_LONGER = std::bit_cast<int32_t>(INFINITE);
        int32_t longest = 0;
        for (const float distance : of_border_) {
            const auto bits = std::bit_cast<int32_t>(distance);
            longest = std::max(longest, bits < NONE_LONGER ? bits : 0);
        }
        return std::bit_cast<float>(longest) / TableCode::LARGEST;
    }

    void encode(uint32_t patch, uint32_t labelled, float quantum) {
        const size_t count = numbering_.inner_size(patch);
        if (count == 0) return;
        codes_.resize(count * border_size_);
        TableCode::round_all({of_border_.data() + begin_[patch], codes_.size()}, steps_per_distance(quantum),
                             codes_.data());
        const auto runs = labels_.runs_of(labelled);
        of_places_.resize(index_.rings.size(labelled));
        uint8_t* row = labels_.rows.get() + label_row_begin(index_, labels_, patch, 0, labelled);
        for (size_t first_of_row = 0; first_of_row < codes_.size(); first_of_row += border_size_) {
            lay_out_by_places(labelled, codes_.data() + first_of_row);
            write_label_row(of_places_, runs, row);
            row += label_row_size(index_, labels_, labelled);
        }
    }

    // Fills of_places_ from the codes of the border's vertices. Along a chain these are in the ring's order.
    void lay_out_by_places(uint32_t labelled, const uint16_t* codes) {
        const uint32_t ring = index_.rings.begin[labelled];
        uint16_t* const of_places = of_places_.data();
        const auto repeat = [&](uint32_t place) {
            of_places[place - ring] = codes[index_.rings.position[place]];
        };
        for (const auto& [first, last, is_closed] : index_.rings.chains_of(labelled)) {
            for (uint32_t i = 1; i <= Rings::REACH; ++i) repeat(first - i);
            std::copy_n(codes + index_.rings.position[first], last + 1 - first, of_places + (first - ring));
            for (uint32_t i = 1; i <= Rings::REACH; ++i) repeat(last + i);
        }
        for_each_bridge(index_.rings, labelled, [&](uint32_t place, float) {
            repeat(place);
            repeat(place + 1);
        });
    }

    const OverlayIndex& index_;
    Labels& labels_;
    const Numbering& numbering_;
    InnerSweep sweep_;
    Room<float> distances_; // [number * FIELDS_AT_ONCE + source], from the current sources to border vertices
    Room<float> of_leaf_;   // the same to the inner vertices of a leaf
    // From the whole border: a row for each inner vertex of each descendant.
    Array<float> of_border_;
    Room<size_t> begin_; // per patch: where its rows begin in of_border_
    size_t border_size_ = 0;
    Array<uint16_t> codes_;     // of the rows of one patch, by border vertices
    Array<uint16_t> of_places_; // of one of these rows, by places
};

// Makes the labels of labelled patches that have none yet.
void make_labels_of(const OverlayIndex& index, std::span<const uint32_t> patches) {
    Labels& labels = *index.pairs.labels;
    const std::lock_guard only_one(index.pairs.making);
    std::optional<LabelSweep> sweep;
    for (const uint32_t patch : patches) {
        if (labels.are_made[patch].load(std::memory_order_relaxed)) continue;
        if (!sweep) sweep.emplace(index, labels, labels.quantum.get_allocator().resource());
        sweep->label(patch);
        labels.are_made[patch].store(true, std::memory_order_release);
    }
}

}

uint64_t count_label_codes(const OverlayIndex& index) {
    const auto within = vertices_within(index.numbering);
    uint64_t codes = 0;
    for_each_labelled(index, [&](uint32_t patch) {
        codes += uint64_t{count_label_rows(index.numbering, within, patch)} * index.rings.size(patch);
    });
    return codes;
}

Labels lay_out_labels(const OverlayIndex& index, std::pmr::memory_resource* memory) {
    const Numbering& numbering = index.numbering;
    const auto within = vertices_within(numbering);
    const float coarsest = std::ranges::max(index.quantum);
    Labels labels(numbering.patch_count(), memory);
    rank_vertices(numbering, within, labels.first_rank);
    uint64_t bytes = 0;
    for_each_labelled(index, [&](uint32_t patch) {
        labels.is_labelled[patch] = 1;
        labels.begin[patch] = bytes;
        labels.run_begin[patch] = static_cast<uint32_t>(labels.runs.size());
        labels.least_quantum[patch] = choose_runs(index, patch, coarsest, labels.runs);
        labels.run_count[patch] = static_cast<uint32_t>(labels.runs.size()) - labels.run_begin[patch];
        bytes += uint64_t{count_label_rows(numbering, within, patch)} * label_row_size(index, labels, patch) +
                 LABEL_ROW_PADDING;
    });
    if (bytes > 0) labels.rows = make_room<uint8_t>(bytes, memory);
    return labels;
}

void make_labels(const OverlayIndex& index, uint32_t patch) { make_labels_of(index, std::span(&patch, 1)); }

void make_all_labels(const OverlayIndex& index) {
    std::vector<uint32_t> patches;
    const Array<uint8_t>& is_labelled = index.pairs.labels->is_labelled;
    for (uint32_t p = 0; p < is_labelled.size(); ++p)
        if (is_labelled[p]) patches.push_back(p);
    make_labels_of(index, patches);
}

}
