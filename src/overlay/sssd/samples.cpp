#include "src/overlay/sssd/samples.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>
#include <vector>

#include "src/base/array.h"

namespace geodesic {

namespace {

// A border has about WANTED samples, but no more than MOST_SHARE of its vertices and no fewer than
// LEAST_SHARE of them; and up to twice as many where its edges are longer in some places than in others. A
// border that is long for its mesh has more: samples are about a fortieth of the mesh's extent apart, or
// less, since all pairs that are nearer than some spacings take longer. A chain without samples of another
// border has FEWEST_OF_CHAIN or more, or all of its vertices if these are fewer: where nothing unfolds, each
// vertex is a chain by itself.
constexpr double WANTED = 64, WANTED_PER_EXTENT = 40, MOST_SHARE = 1.0 / 2, LEAST_SHARE = 1.0 / 10;
constexpr uint32_t FEWEST_OF_CHAIN = 3;

// Ways along a border to where it meets the parent's are made longer by this share of a spacing.
constexpr float LONGER_ALONG_BORDER = 0.5f;

// The share of the vertices of a patch's border that are to be samples.
double share_of(const OverlayIndex& index, uint32_t patch) {
    const double size = std::max(1u, index.numbering.border_size(patch));
    const double extent = std::sqrt(static_cast<double>(index.numbering.vertex_count())); // in edges
    return std::clamp(std::max(WANTED / size, WANTED_PER_EXTENT / extent), LEAST_SHARE, MOST_SHARE);
}

// How far samples are to be apart along the chains of a border, on average. Segments longer than this are
// long.
float spacing_of(const OverlayIndex& index, uint32_t patch) {
    double length = 0;
    for_each_segment(index.rings, patch, [&](uint32_t place, float segment) {
        if (index.rings.is_own[place]) length += double{segment};
    });
    const double spacing =
        length / std::max(1.0, share_of(index, patch) * index.numbering.border_size(patch));
    return static_cast<float>(std::min(spacing, double{std::numeric_limits<float>::max()}));
}

// Chooses the samples of all borders, level by level. A vertex that is a sample of one border is a sample of
// all other borders of the same level and of deeper ones that it lies on: where borders have a piece in
// common, a way crosses all of them at one vertex, which samples of different vertices would not show.
// Between such vertices, others are spread evenly, by their number or by length, whichever takes more.
class SampleChoice {
public:
    explicit SampleChoice(const OverlayIndex& index)
        : index_(index), is_sample_(index.numbering.border_vertex_count(), 0) {}

    // Calls use(patch, places) for each patch in their order, with its samples' places in its ring.
    template <class Use>
    void for_each_patch(const Use& use) {
        const auto& level_begin = index_.numbering.level_begin;
        std::vector<uint16_t> places;
        for (uint32_t level = 0; level <= index_.numbering.level_count(); ++level) {
            for (uint32_t p = level_begin[level]; p < level_begin[level + 1]; ++p) mark(p);
            for (uint32_t p = level_begin[level]; p < level_begin[level + 1]; ++p) {
                collect(p, places);
                use(p, places);
            }
        }
    }

private:
    // How many samples are wanted along a piece of a border: `share` for each vertex, or one for each
    // `spacing` of length, whichever is more.
    struct Apart {
        double share, spacing;
    };

    uint8_t& is_sample(uint32_t place) { return is_sample_[index_.rings.vertex[place]]; }

    void mark(uint32_t patch) {
        const float spacing = spacing_of(index_, patch);
        for_each_segment(index_.rings, patch, [&](uint32_t place, float length) {
            if (length > spacing) is_sample(place) = is_sample(place + 1) = 1;
        });
        // Segments without length count as none: a border may have no others.
        const Apart apart{share_of(index_, patch),
                          spacing > 0 ? double{spacing} : std::numeric_limits<double>::infinity()};
        for (const auto& chain : index_.rings.chains_of(patch)) mark_chain(chain, apart);
    }

    // Goes once around a closed chain, from a vertex that is a sample already if there is one, or from one
    // end of an open chain to the other.
    void mark_chain(const Rings::Chain& chain, const Apart& apart) {
        if (!chain.is_closed) is_sample(chain.first) = is_sample(chain.last) = 1;
        const uint32_t count = chain.last - chain.first + 1, steps = count - !chain.is_closed;
        uint32_t start = 0;
        while (start < count && !is_sample(chain.first + start)) ++start;
        const auto place = [&](uint32_t step) { return chain.first + (start + step) % count; };
        uint32_t from = 0;
        for (uint32_t to = 1; to <= steps; ++to) {
            if (to < steps && !is_sample(place(to))) continue;
            const uint32_t fewest =
                to - from < steps ? 1 : std::min(steps, FEWEST_OF_CHAIN - !chain.is_closed);
            mark_between(from, to, place, fewest, apart);
            from = to;
        }
    }

    // Spreads samples from one step along a chain to another, where there are samples already.
    template <class Place>
    void mark_between(uint32_t from, uint32_t to, const Place& place, uint32_t fewest, const Apart& apart) {
        const auto pieces_of_segment = [&](uint32_t step) {
            return std::max(apart.share, double{index_.rings.segment_length[place(step)]} / apart.spacing);
        };
        double wanted = 0;
        for (uint32_t step = from; step < to; ++step) wanted += pieces_of_segment(step);
        const auto pieces = static_cast<uint32_t>(
            std::clamp(std::round(wanted), static_cast<double>(fewest), static_cast<double>(to - from)));
        is_sample(place(from)) = 1;
        double passed = 0;
        for (uint32_t step = from + 1, piece = 1; piece < pieces; ++step) {
            passed += pieces_of_segment(step - 1);
            const bool is_due = passed + pieces_of_segment(step) > wanted * piece / pieces;
            if (!is_due && to - step > pieces - piece) continue;
            is_sample(place(step)) = 1;
            ++piece;
        }
    }

    void collect(uint32_t patch, std::vector<uint16_t>& places) {
        const uint32_t first = index_.rings.begin[patch];
        places.clear();
        for (uint32_t k = first; k < index_.rings.begin[patch + 1]; ++k)
            if (index_.rings.is_own[k] && is_sample(k)) places.push_back(static_cast<uint16_t>(k - first));
    }

    const OverlayIndex& index_;
    std::vector<uint8_t> is_sample_; // per border vertex
};

// The most places of the ring of a child.
uint32_t longest_border_of_child(const OverlayIndex& index, uint32_t patch) {
    const uint32_t first = index.numbering.child_begin[patch], end = index.numbering.child_begin[patch + 1];
    uint32_t longest = 0;
    for (uint32_t child = first; child < end; ++child) longest = std::max(longest, index.rings.size(child));
    return longest;
}

// Of tables across, the children of a patch may have so many codes together for each entry of the patch's
// overlay table, in which all these distances lie. Where thousands of children share a few hundred vertices,
// rows for the samples of each would be out of all proportion, and none has a table. Meshes take up to 8.
constexpr double MOST_ACROSS_EACH = 32;

// Calls use(child) for each child of a patch that has a table across: to which a hop from the longest border
// of its siblings is not made as a whole. begin[p] is the first sample of patch p.
template <class Use>
void for_each_table_across(const OverlayIndex& index, std::span<const uint32_t> begin, uint32_t patch,
                           const Use& use) {
    const uint32_t first = index.numbering.child_begin[patch], end = index.numbering.child_begin[patch + 1];
    const size_t longest = longest_border_of_child(index, patch);
    const auto has_table = [&](uint32_t child) { return index.rings.size(child) * longest > FEW_PAIRS; };
    uint64_t columns = 0;
    for (uint32_t child = first; child < end; ++child)
        if (has_table(child)) columns += begin[child + 1] - begin[child];
    const double vertices = index.numbering.overlay_size(patch), rows = begin[end] - begin[first];
    if (static_cast<double>(columns) * rows > MOST_ACROSS_EACH * vertices * vertices / 2) return;
    for (uint32_t child = first; child < end; ++child)
        if (has_table(child)) use(child);
}

// The number of codes in the tables of all samples. begin[p] is the first sample of patch p.
uint64_t count_codes(const OverlayIndex& index, std::span<const uint32_t> begin) {
    const Numbering& numbering = index.numbering;
    uint64_t codes = 0;
    for (uint32_t p = 0; p < numbering.first_leaf(); ++p) {
        uint64_t columns = begin[p + 1] - begin[p];
        for_each_table_across(index, begin, p,
                              [&](uint32_t child) { columns += begin[child + 1] - begin[child]; });
        codes += columns * (begin[numbering.child_begin[p + 1]] - begin[numbering.child_begin[p]]);
    }
    return codes;
}

// Of a place of a patch's ring: its vertex, and where that is in the parent's overlay.
uint32_t vertex_at(const OverlayIndex& index, uint32_t patch, uint16_t place) {
    return index.rings.vertex[index.rings.begin[patch] + place];
}
uint32_t position_in_parent(const OverlayIndex& index, uint32_t patch, uint16_t place) {
    return index.position_in_parent(patch, index.rings.begin[patch] + place);
}

uint16_t longer_code(uint16_t code, int by) {
    return code == TableCode::UNREACHED ? code
                                        : static_cast<uint16_t>(std::min(code + by, int{TableCode::LARGEST}));
}

class SampleWriter {
public:
    SampleWriter(const OverlayIndex& index, Samples& samples)
        : index_(index), numbering_(index.numbering), samples_(samples), across_(global_heap()) {}

    void write() {
        const uint32_t patch_count = numbering_.patch_count();
        samples_.begin.assign(1, 0);
        samples_.long_begin.assign(1, 0);
        SampleChoice(index_).for_each_patch([&](uint32_t patch, std::span<const uint16_t> places) {
            samples_.place.insert(samples_.place.end(), places.begin(), places.end());
            samples_.begin.push_back(static_cast<uint32_t>(samples_.place.size()));
            samples_.spacing.push_back(spacing_of(index_, patch));
            add_pieces(patch);
            add_long_segments(patch);
        });
        samples_.codes.reserve(count_codes(index_, samples_.begin) + TableCode::PADDING);
        for (uint32_t p = 0; p < patch_count; ++p) write_up(p);
        samples_.across_begin.assign(patch_count, Samples::NO_TABLE);
        for (uint32_t p = 0; p < numbering_.first_leaf(); ++p) write_across_children_of(p);
        samples_.codes.resize(samples_.codes.size() + TableCode::PADDING, TableCode::UNREACHED);
    }

private:
    // The last piece of a closed chain leads back to its first sample.
    void add_pieces(uint32_t patch) {
        const auto places = samples_.of(patch);
        const uint32_t ring = index_.rings.begin[patch];
        const auto length = [&](uint32_t begin, uint32_t end) {
            float sum = 0;
            for (uint32_t k = begin; k < end; ++k) sum += index_.rings.segment_length[k];
            return sum;
        };
        const auto add = [&](uint32_t segments, float piece) {
            const float excess = piece - MOST_LONGER * samples_.spacing[patch];
            samples_.excess.push_back(segments > 1 && excess > 0 ? excess : 0);
        };
        const auto add_of_chain = [&](const Rings::Chain& chain, uint32_t first, uint32_t last) {
            for (uint32_t i = first; i < last; ++i)
                add(places[i + 1] - places[i], length(ring + places[i], ring + places[i + 1]));
            if (!chain.is_closed) return add(0, 0);
            const uint32_t begin = ring + places[last], end = ring + places[first];
            add(chain.last + 1 - begin + end - chain.first,
                length(begin, chain.last + 1) + length(chain.first, end));
        };
        for_each_chain_of_samples(index_.rings, samples_, patch, add_of_chain);
    }

    // A segment that closes a chain ends at a place that repeats the chain's first vertex.
    void add_long_segments(uint32_t patch) {
        const auto sample_at = [&](uint32_t place) {
            const uint32_t own = own_place(index_.rings, numbering_, patch, index_.rings.position[place]);
            return first_sample_from(index_.rings, samples_, patch, own);
        };
        for_each_segment(index_.rings, patch, [&](uint32_t place, float length) {
            if (length > samples_.spacing[patch])
                samples_.long_segments.push_back({sample_at(place), sample_at(place + 1), length});
        });
        samples_.long_begin.push_back(static_cast<uint32_t>(samples_.long_segments.size()));
    }

    // Makes room for a table and returns it.
    uint16_t* add_table(size_t rows, size_t columns) {
        samples_.codes.resize(samples_.codes.size() + rows * columns);
        return samples_.codes.data() + samples_.codes.size() - rows * columns;
    }

    // The overlay of a patch begins with its border. Of a vertex that lies on the border below, too, the
    // distance is known there. Other ways to it are made longer, so that they are not taken for shorter ones
    // by rounding; those back from the parent's border need them.
    void write_up(uint32_t patch) {
        samples_.up_begin.push_back(samples_.codes.size());
        if (patch == 0) return;
        const uint32_t parent = numbering_.parent[patch];
        const auto from = samples_.of(patch), to = samples_.of(parent);
        // Of a file that nobody built this may be no number, which is 0 then.
        const float longer =
            LONGER_ALONG_BORDER * samples_.spacing[patch] * steps_per_distance(index_.quantum[parent]);
        const int longer_by = static_cast<int>(std::min(std::max(0.f, longer), float{TableCode::LARGEST}));
        uint16_t* entry = add_table(from.size(), to.size());
        for (const uint16_t k : from) {
            const uint16_t* const row = index_.row_to_ring(parent, position_in_parent(index_, patch, k));
            for (const uint16_t place : to) {
                const uint32_t position = index_.rings.position[index_.rings.begin[parent] + place];
                if (!index_.is_on_border(patch, position))
                    *entry++ = row[place];
                else if (vertex_at(index_, parent, place) == vertex_at(index_, patch, k))
                    *entry++ = 0;
                else
                    *entry++ = longer_code(row[place], longer_by);
            }
        }
    }

    void write_across_children_of(uint32_t patch) {
        const uint32_t first = numbering_.child_begin[patch], end = numbering_.child_begin[patch + 1];
        const uint32_t rows = samples_.begin[end] - samples_.begin[first];
        for_each_table_across(index_, samples_.begin, patch, [&](uint32_t child) {
            samples_.across_begin[child] = samples_.codes.size();
            const size_t columns = samples_.of(child).size();
            uint16_t* row = add_table(rows, columns);
            across_.begin(index_, samples_, child);
            for (uint32_t sibling = first; sibling < end; ++sibling)
                for (const uint16_t from : samples_.of(sibling)) {
                    across_.fill(sibling, from, row);
                    row += columns;
                }
        });
    }

    const OverlayIndex& index_;
    const Numbering& numbering_;
    Samples& samples_;
    RowsAcross across_;
};

}

uint64_t count_sample_codes(const OverlayIndex& index) {
    std::vector<uint32_t> begin(1, 0);
    SampleChoice(index).for_each_patch([&](uint32_t, std::span<const uint16_t> places) {
        begin.push_back(begin.back() + static_cast<uint32_t>(places.size()));
    });
    return count_codes(index, begin);
}

void RowsAcross::begin(const OverlayIndex& index, const Samples& samples, uint32_t patch) {
    index_ = &index;
    patch_ = patch;
    const uint32_t parent = index.numbering.parent[patch];
    targets_.clear();
    for (const uint16_t place : samples.of(patch))
        targets_.push_back({vertex_at(index, patch, place),
                            index.overlay_column(parent, position_in_parent(index, patch, place))});
}

void RowsAcross::fill(uint32_t sibling, uint16_t from, uint16_t* row) const {
    const uint32_t parent = index_->numbering.parent[patch_];
    const uint32_t position = position_in_parent(*index_, sibling, from);
    if (index_->is_on_border(patch_, position)) {
        for (const Target& to : targets_)
            *row++ = vertex_at(*index_, sibling, from) == to.vertex ? 0 : TableCode::UNREACHED;
        return;
    }
    for (const Target& to : targets_) *row++ = index_->overlay_code(parent, position, to.column);
}

NeighbouringSamples neighbouring_samples(const OverlayIndex& index, uint32_t patch, uint32_t sample) {
    const Samples& samples = index.pairs.samples;
    const auto places = samples.of(patch);
    const uint32_t ring = index.rings.begin[patch];
    const Rings::Chain& chain = index.rings.chain_at(patch, ring + places[sample]);
    NeighbouringSamples beside{NONE, NONE};
    if (sample > 0 && ring + places[sample - 1] >= chain.first) beside.previous = sample - 1;
    if (sample + 1 < places.size() && ring + places[sample + 1] <= chain.last) beside.next = sample + 1;
    if (!chain.is_closed) return beside;
    if (beside.next == NONE) beside.next = first_sample_from(index.rings, samples, patch, chain.first);
    if (beside.previous == NONE)
        beside.previous = first_sample_from(index.rings, samples, patch, chain.last + 1) - 1;
    return beside;
}

void make_samples(const OverlayIndex& index, Samples& samples) { SampleWriter(index, samples).write(); }

}
