// Index files that contradict neither SPEC.md nor themselves, whatever no mesh would give: any hierarchy, any
// borders, any chains, any distances that are symmetric.

#include <algorithm>
#include <cmath>
#include <numeric>
#include <span>

#include "tests/campaign/file_content.h"
#include "tests/campaign/file_random.h"

namespace geodesic::file_campaign {

namespace {

// How large a file is: at most so many of each.
struct Sizes {
    uint32_t levels, children, root_owned, owned, internal;
};

Sizes random_sizes(Random& random) {
    switch (random.below(24)) {
    case 0:
        return {8, 2, 4, 2, 2}; // deep
    case 1:
        return {2, 3, 700, 20, 4}; // borders that are sampled, some of them not labelled whole
    case 2:
        return {3, 2, 450, 60, 3}; // likewise, and labels
    case 3:
        return {2, 30, 40, 4, 3}; // many patches around the same vertices
    case 4:
        return {3, 2, 2, 1, 40}; // large leaves
    case 5:
        return random.one_in(4) ? Sizes{1, 200, 300, 0, 2} // may be out of proportion
                                : Sizes{1, 40, 3, 0, 2};
    case 6:
    case 7:
    case 8:
        return {4, 3, 30, 12, 8};
    default:
        return {3, 3, 5, 3, 3};
    }
}

class Generator {
public:
    explicit Generator(uint64_t seed) : random_(seed), sizes_(random_sizes(random_)) {}

    FileContent content() {
        make_head();
        make_hierarchy();
        share_out_vertices();
        make_borders();
        make_ids();
        content_.has_positions = !random_.one_in(4) || lacks_an_id();
        content_.has_positions ? make_positions() : make_mesh();
        choose_distances();
        if (content_.is_overlay())
            make_overlay_engine();
        else
            make_graph_engine();
        return std::move(content_);
    }

private:
    void make_head() {
        content_.engine = random_.one_in(4) ? 0 : 1;
        content_.metric = random_.one_in(8) ? random_.below(1000) : random_.below(4);
        content_.metric_flags = random_.below(2);
        content_.delta = random_.one_in(4) ? 5 : 0;
        content_.is_canonical = !random_.one_in(4);
        if (random_.one_in(4)) content_.diagonal = random_.one_in(2) ? 0 : 1e300;
    }

    void make_hierarchy() {
        const uint32_t levels = 1 + random_.below(sizes_.levels);
        content_.parent.assign(1, NOTHING);
        content_.level_begin = {0, 1};
        for (uint32_t l = 0; l < levels; ++l) {
            for (uint32_t p = content_.level_begin[l]; p < content_.level_begin[l + 1]; ++p) {
                const uint32_t children = 1 + random_.below(sizes_.children);
                content_.children.push_back(children);
                content_.parent.insert(content_.parent.end(), children, p);
            }
            content_.level_begin.push_back(content_.patch_count());
        }
    }

    uint32_t some_of(uint32_t most) { return random_.one_in(4) ? 0 : random_.below(most + 1); }

    void share_out_vertices() {
        uint32_t number = 0;
        for (uint32_t p = 0; p < content_.inner_count(); ++p) {
            first_owned_.push_back(number);
            const bool is_root = p == 0;
            content_.owned.push_back(some_of(is_root ? sizes_.root_owned : sizes_.owned));
            number += content_.owned.back();
        }
        for (uint32_t leaf = content_.inner_count(); leaf < content_.patch_count(); ++leaf) {
            first_internal_.push_back(number);
            content_.internal.push_back(some_of(sizes_.internal));
            number += content_.internal.back();
        }
        content_.positions.resize(number);
    }

    std::vector<uint32_t> overlay_of(uint32_t patch) const {
        std::vector<uint32_t> overlay = content_.borders[patch];
        overlay.resize(overlay.size() + content_.owned[patch]);
        std::iota(overlay.end() - content_.owned[patch], overlay.end(), first_owned_[patch]);
        return overlay;
    }

    // Every vertex of an overlay is on the border of one child or more.
    void make_borders() {
        content_.borders.resize(content_.patch_count());
        uint32_t child = 1;
        for (uint32_t p = 0; p < content_.inner_count(); ++p) {
            const uint32_t count = content_.children[p];
            const uint32_t shared_one_in = 1 + random_.below(4);
            for (uint32_t v : overlay_of(p)) {
                const uint32_t first = random_.below(count);
                for (uint32_t c = 0; c < count; ++c)
                    if (c == first || random_.one_in(shared_one_in)) content_.borders[child + c].push_back(v);
            }
            for (uint32_t c = 0; c < count; ++c)
                if (random_.one_in(2)) random_.shuffle(content_.borders[child + c]);
            child += count;
        }
    }

    // A few coordinates of lattices, so that vertices coincide, or anything.
    void make_positions() {
        content_.triangles.resize(3 * size_t{content_.id_count()});
        choose_step();
        const uint32_t manner = random_.below(4);
        for (auto& position : content_.positions)
            for (int32_t& coordinate : position) {
                if (manner == 0) coordinate = 0;
                if (manner == 1) coordinate = static_cast<int32_t>(random_.below(4));
                if (manner == 2) coordinate = static_cast<int32_t>(random_.below(1000));
                if (manner == 3) coordinate = random_.one_in(2) ? MOST : 0;
            }
    }

    void choose_step() {
        constexpr std::array<float, 5> STEPS{1, 1e-45f, 1e-6f, 1e30f, 3.4e38f};
        constexpr std::array<double, 5> ORIGINS{0, -2, 0.1, -1e30, 1e308};
        content_.position_step = STEPS[random_.one_in(2) ? 0 : random_.below(STEPS.size())];
        for (double& coordinate : content_.position_origin)
            coordinate = ORIGINS[random_.one_in(2) ? 0 : random_.below(ORIGINS.size())];
    }

    bool lacks_an_id() const {
        std::vector<bool> has_one(content_.vertex_count());
        for (const uint32_t number : content_.number_of_id)
            if (number != NOTHING) has_one[number] = true;
        return std::ranges::find(has_one, false) != has_one.end() || has_one.empty();
    }

    // Vertices of a lattice or anywhere, and triangles of any of them. The position of a number is that of
    // its lowest id.
    void make_mesh() {
        choose_step();
        const uint32_t ids = content_.id_count(), manner = random_.below(3);
        for (uint32_t i = 0; i < 3 * ids; ++i) {
            double coordinate = random_.below(4);
            if (manner == 1) coordinate = 1000 * double{random_.unit()} + 0.1 * random_.below(7);
            if (manner == 2) coordinate = random_.one_in(2) ? 3.4e38 : -1e-300;
            content_.mesh_positions.push_back(coordinate);
        }
        for (uint32_t i = 0; i < 3 * ids; ++i) content_.triangles.push_back(random_.below(ids));
        for (uint32_t id = ids; id-- > 0;)
            if (const uint32_t number = content_.number_of_id[id]; number != NOTHING)
                for (size_t k = 0; k < 3; ++k)
                    content_.positions[number][k] = steps_to(content_.mesh_positions[3 * id + k], k);
    }

    int32_t steps_to(double coordinate, size_t k) const {
        const double offset = coordinate - content_.position_origin[k];
        const double steps = std::floor(offset / double{content_.position_step} + 0.5);
        return steps < 0 ? 0 : steps > MOST ? MOST : static_cast<int32_t>(steps);
    }

    void make_ids() {
        const uint32_t count = content_.vertex_count();
        auto& numbers = content_.number_of_id;
        numbers.resize(count);
        std::iota(numbers.begin(), numbers.end(), 0u);
        const uint32_t more = (count == 0 ? 1 : 0) + (random_.one_in(2) ? random_.below(4) : 0);
        for (uint32_t i = 0; i < more; ++i)
            numbers.push_back(count == 0 || random_.one_in(2) ? NOTHING : random_.below(count));
        if (random_.one_in(2)) random_.shuffle(numbers);
        if (random_.one_in(8)) numbers[random_.below(content_.id_count())] = NOTHING;
        // The numbers that are left without an id are added vertices.
        if (random_.one_in(3)) numbers.resize(1 + random_.below(content_.id_count()));
    }

    // ---- Distances: of two vertices, the same wherever they stand.

    void choose_distances() {
        entries_ = random_.below(6);
        reached_ = random_.below(6);
        pair_seed_ = random_.next();
        part_.resize(content_.vertex_count());
        for (uint32_t& part : part_) part = random_.below(reached_ == 1 ? 2 : 4);
        if (reached_ == 1) content_.component = part_;
        if (reached_ == 0) content_.component.assign(content_.vertex_count(), 0);
        unreached_one_in_ = 1 + random_.below(random_.one_in(2) ? 2 : 20);
    }

    Random of_pair(uint32_t a, uint32_t b) const {
        return Random(pair_seed_ ^ (uint64_t{std::min(a, b)} << 32 | std::max(a, b)) * 0x9E3779B97F4A7C15u);
    }

    bool is_reached(uint32_t a, uint32_t b) const {
        switch (reached_) {
        case 0:
            return true;
        case 1:
            return part_[a] == part_[b];
        case 2:
            return part_[a] != 0 && part_[b] != 0; // some vertices are reached by none
        case 3:
            return part_[a] != part_[b];
        case 4:
            return false;
        default:
            return !of_pair(a, b).one_in(unreached_one_in_);
        }
    }

    double straight(uint32_t a, uint32_t b) const {
        double square = 0;
        for (size_t k = 0; k < 3; ++k) {
            const double difference = content_.positions[a][k] - content_.positions[b][k];
            square += difference * difference;
        }
        return double{content_.position_step} * std::sqrt(square);
    }

    float distance(uint32_t a, uint32_t b) const {
        constexpr std::array<float, 8> ANY{0, 1e-45f, 1e-38f, 1, 1e19f, 1e30f, 3.4e38f, 0.1f};
        if (!is_reached(a, b)) return NO_PATH;
        Random random = of_pair(a, b);
        switch (entries_) {
        case 0:
            return 0;
        case 1:
            return 3.4e38f;
        case 2:
            return ANY[random.below(ANY.size())];
        case 3:
            return random.unit();
        default:
            return static_cast<float>(std::min(straight(a, b), 3.4e38));
        }
    }

    // A multiple of 2^shift.
    float code(uint32_t a, uint32_t b, float quantum) const {
        if (!is_reached(a, b)) return NO_PATH;
        const auto unit = static_cast<float>(1 << content_.shift);
        return std::floor(code_before_shift(a, b, quantum) / unit) * unit;
    }

    float code_before_shift(uint32_t a, uint32_t b, float quantum) const {
        constexpr float LARGEST = 32766;
        Random random = of_pair(a, b);
        switch (entries_) {
        case 0:
            return 0;
        case 1:
            return LARGEST;
        case 2:
            return static_cast<float>(random.below(4));
        case 3:
            return static_cast<float>(random.below(32767));
        default:
            if (!(quantum > 0)) return 0;
            return static_cast<float>(
                std::min(std::round(straight(a, b) / double{quantum}), double{LARGEST}));
        }
    }

    // ---- Tables

    template <class Entry>
    static Matrix rectangle(std::span<const uint32_t> rows, std::span<const uint32_t> cols,
                            const Entry& entry) {
        Matrix matrix{{}, static_cast<uint32_t>(rows.size()), static_cast<uint32_t>(cols.size())};
        for (uint32_t a : rows)
            for (uint32_t b : cols) matrix.values.push_back(entry(a, b));
        return matrix;
    }

    // Line r: row n - 1 - r, then row r or r + 1.
    template <class Entry>
    static Matrix folded(std::span<const uint32_t> vertices, const Entry& entry) {
        const auto n = static_cast<uint32_t>(vertices.size());
        Matrix matrix{{}, n / 2, n == 0 ? 0 : n - 1 + n % 2};
        const auto add_row = [&](uint32_t row) {
            for (uint32_t j = 0; j < row; ++j) matrix.values.push_back(entry(vertices[row], vertices[j]));
        };
        for (uint32_t r = 0; r < matrix.rows; ++r) {
            add_row(n - 1 - r);
            add_row(r + n % 2);
        }
        return matrix;
    }

    std::vector<uint32_t> internals_of(uint32_t leaf) const {
        std::vector<uint32_t> numbers(content_.internal[leaf - content_.inner_count()]);
        std::iota(numbers.begin(), numbers.end(), first_internal_[leaf - content_.inner_count()]);
        return numbers;
    }

    template <class EntryOf>
    void make_leaf_tables(const EntryOf& entry_of) {
        for (uint32_t leaf = content_.inner_count(); leaf < content_.patch_count(); ++leaf) {
            const auto internals = internals_of(leaf);
            content_.border_internal_tables.push_back(
                rectangle(content_.borders[leaf], internals, entry_of(leaf)));
            content_.internal_tables.push_back(folded(internals, entry_of(leaf)));
        }
    }

    void make_graph_engine() {
        const auto entry = [this](uint32_t a, uint32_t b) { return distance(a, b); };
        for (uint32_t p = 1; p < content_.patch_count(); ++p)
            content_.border_tables.push_back(folded(content_.borders[p], entry));
        make_leaf_tables([&](uint32_t) { return entry; });
        if (entries_ >= 4) content_.bound_scale = random_.below(2) ? 0.99f : 0;
    }

    void make_overlay_engine() {
        content_.is_packed = random_.one_in(2);
        content_.shift = static_cast<uint8_t>(random_.one_in(2) ? 0 : random_.below(15));
        make_quanta();
        for (uint32_t p = 0; p < content_.patch_count(); ++p) make_chains(p);
        const auto entry_of = [this](uint32_t patch) {
            return [this, quantum = content_.quantum[patch]](uint32_t a, uint32_t b) {
                return code(a, b, quantum);
            };
        };
        for (uint32_t p = 0; p < content_.inner_count(); ++p) {
            const auto overlay = overlay_of(p);
            const auto owned = std::span(overlay).last(content_.owned[p]);
            content_.overlay_tables.push_back(rectangle(owned, content_.borders[p], entry_of(p)));
            content_.overlay_tables.push_back(folded(owned, entry_of(p)));
        }
        make_leaf_tables(entry_of);
    }

    void make_quanta() {
        constexpr std::array<float, 8> ANY{0, 1e-45f, 1e-38f, 1e-20f, 1, 1e20f, 3.4e38f, 1e34f};
        const float all = ANY[random_.below(ANY.size())];
        const uint32_t manner = random_.below(4);
        for (uint32_t p = 0; p < content_.patch_count(); ++p) {
            float quantum = 1e-4f * (1 + random_.unit());
            if (manner == 0) quantum = all;
            if (manner == 1) quantum = ANY[random_.below(ANY.size())];
            content_.quantum.push_back(quantum);
        }
    }

    // Cuts a border into runs, each of which is a chain, open or closed, or a vertex by itself.
    void make_chains(uint32_t patch) {
        constexpr std::array<float, 6> LENGTHS{1e-45f, 1e-30f, 1e-3f, 1, 1e20f, 3.4e38f};
        const auto size = static_cast<uint32_t>(content_.borders[patch].size());
        std::vector<uint32_t>& next = content_.next.emplace_back(size, NOTHING);
        std::vector<float>& length = content_.segment_length.emplace_back(size, 0.f);
        if (!(content_.metric_flags & 1)) return;
        const uint32_t most = 1 + random_.below(random_.one_in(2) ? 4 : std::max(size, 1u));
        const bool any_length = random_.one_in(3);
        for (uint32_t begin = 0; begin < size;) {
            const uint32_t end = begin + 1 + random_.below(std::min(most, size - begin));
            for (uint32_t i = begin; i + 1 < end; ++i) next[i] = i + 1;
            if (end - begin > 1 && random_.one_in(2)) next[end - 1] = begin;
            for (uint32_t i = begin; i < end; ++i)
                if (next[i] != NOTHING)
                    length[i] = any_length ? LENGTHS[random_.below(LENGTHS.size())] : 0.01f + random_.unit();
            begin = end;
        }
        if (random_.one_in(3)) make_bridges(patch);
    }

    void make_bridges(uint32_t patch) {
        uint32_t slot = 0;
        for (uint32_t p = 0; p < patch; ++p) slot += static_cast<uint32_t>(content_.borders[p].size());
        const auto size = static_cast<uint32_t>(content_.borders[patch].size());
        for (uint32_t i = 0; i + 1 < size; ++i)
            if (random_.one_in(4))
                content_.bridges.push_back(
                    {slot + i, i + 1 + random_.below(size - i - 1), 0.01f + random_.unit()});
    }

    static constexpr int32_t MOST = (1 << 23) - 1; // steps of a position

    Random random_;
    const Sizes sizes_;
    FileContent content_;
    std::vector<uint32_t> first_owned_, first_internal_;
    uint32_t entries_ = 0, reached_ = 0, unreached_one_in_ = 1;
    uint64_t pair_seed_ = 0;
    std::vector<uint32_t> part_; // per vertex number
};

}

FileContent random_content(uint64_t seed) { return Generator(seed).content(); }

}
