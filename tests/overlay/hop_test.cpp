// The hops of the overlay engine, held against plain loops that are written after the text of format/SPEC.md,
// "Distances of the overlay engine".
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <random>
#include <utility>

#include "src/index/stored.h"
#include "src/overlay/inner_sweep.h"
#include "src/overlay/outer_crossing.h"
#include "src/query/index.h"
#include "tests/overlay/overlay_of.h"

using namespace geodesic;
using namespace geodesic::test;

namespace {

// ---- What is stored

constexpr uint16_t NO_PATH = 0x7fff;
constexpr double NOWHERE = std::numeric_limits<double>::infinity();

// The border of a patch and the segments that begin at its positions.
struct StoredBorder {
    std::vector<uint32_t> vertices, end, before; // end and before: NONE if there is no such segment
    std::vector<float> length;

    size_t size() const { return vertices.size(); }

    // The positions where the segments beside a position begin.
    std::vector<uint32_t> beside(uint32_t position) const {
        std::vector<uint32_t> begins;
        for (uint32_t k = position, i = 0; i < 2 && end[k] != NONE; k = end[k], ++i) begins.push_back(k);
        for (uint32_t k = position, i = 0; i < 2 && before[k] != NONE; ++i) {
            k = before[k];
            begins.push_back(k);
        }
        return begins;
    }
};

// The tables of an index as its file has them. Vertices are given by their numbers.
class StoredTables {
public:
    StoredTables(const Index& index, const Numbering& numbering)
        : stored_(restore(index)), numbering_(numbering), first_entry_(1, 0) {
        for (uint32_t p = 0; p < numbering.first_leaf(); ++p) {
            const uint64_t owned = stored_.owned_count[p];
            first_entry_.push_back(first_entry_.back() + owned * numbering.border_size(p) +
                                   (owned > 0 ? owned * (owned - 1) / 2 : 0));
        }
    }

    float quantum(uint32_t patch) const { return stored_.quantum[patch]; }

    StoredBorder border(uint32_t patch) const {
        const auto vertices = numbering_.border_of(patch);
        const auto first = static_cast<std::ptrdiff_t>(numbering_.border_begin[patch]);
        const auto last = first + static_cast<std::ptrdiff_t>(vertices.size());
        StoredBorder border{{vertices.begin(), vertices.end()},
                            {stored_.segment_end.begin() + first, stored_.segment_end.begin() + last},
                            std::vector<uint32_t>(vertices.size(), NONE),
                            {stored_.segment_length.begin() + first, stored_.segment_length.begin() + last}};
        for (uint32_t k = 0; k < border.size(); ++k)
            if (border.end[k] != NONE) border.before[border.end[k]] = k;
        return border;
    }

    // The codes of a vertex and of each position of a patch's border. Upwards, the vertex is in the overlay
    // of the patch's parent.
    std::vector<uint16_t> row_up(uint32_t patch, uint32_t x) const {
        std::vector<uint16_t> row;
        for (const uint32_t b : numbering_.border_of(patch))
            row.push_back(overlay_code(numbering_.parent[patch], x, b));
        return row;
    }
    // Downwards, it is inside of the patch.
    std::vector<uint16_t> row_down(uint32_t patch, uint32_t x) const {
        std::vector<uint16_t> row;
        if (patch < numbering_.first_leaf()) {
            for (const uint32_t b : numbering_.border_of(patch)) row.push_back(overlay_code(patch, x, b));
            return row;
        }
        uint64_t entry = x - numbering_.first_internal(patch);
        for (uint32_t leaf = numbering_.first_leaf(); leaf < patch; ++leaf)
            entry += uint64_t{numbering_.border_size(leaf)} * numbering_.internal_size(leaf);
        for (uint32_t k = 0; k < numbering_.border_size(patch); ++k, entry += numbering_.internal_size(patch))
            row.push_back(stored_.border_internal_codes[entry]);
        return row;
    }

private:
    std::optional<uint32_t> place_among_owned(uint32_t patch, uint32_t x) const {
        const uint32_t first = numbering_.owned_begin[patch];
        if (x < first || x >= first + stored_.owned_count[patch]) return std::nullopt;
        return x - first;
    }

    uint16_t overlay_code(uint32_t patch, uint32_t x, uint32_t y) const {
        if (x == y) return 0;
        const auto i = place_among_owned(patch, x), j = place_among_owned(patch, y);
        if (!i && !j) return taken_from_parent(patch, x, y);
        if (!i) return overlay_code(patch, y, x);
        const auto border = numbering_.border_of(patch);
        uint64_t entry = first_entry_[patch];
        if (j) {
            const uint64_t row = std::max(*i, *j), column = std::min(*i, *j);
            entry += uint64_t{stored_.owned_count[patch]} * border.size() + row * (row - 1) / 2 + column;
        } else {
            entry +=
                *i * border.size() + static_cast<uint64_t>(std::ranges::find(border, y) - border.begin());
        }
        return stored_.overlay_codes[entry];
    }

    uint16_t taken_from_parent(uint32_t patch, uint32_t x, uint32_t y) const {
        const uint32_t parent = numbering_.parent[patch];
        const uint16_t code = overlay_code(parent, x, y);
        const double from{quantum(parent)}, to{quantum(patch)};
        if (code == NO_PATH || code == 0 || to == 0) return code;
        return static_cast<uint16_t>(std::clamp(std::floor(code * from / to + 0.5), 1.0, 32766.0));
    }

    StoredIndex stored_;
    const Numbering& numbering_;
    std::vector<uint64_t> first_entry_; // per inner patch: in overlay_codes
};

// ---- The text

// What happened in a hop to one vertex.
struct Hop {
    double distance = NOWHERE;
    uint32_t over = NONE;         // b of a hop over vertices
    bool had_sum = true;          // whether any sum counted
    bool is_near = false;         // whether the near rule replaced the distance,
    bool is_other = false;        // by another one
    bool is_straightened = false; // whether a way over a segment beside b was less than that over b
};

// From one source over one border. What decides between sums of steps is in single precision, as the text has
// it: the steps themselves, the distances of middles and their codes. All else is in double precision.
class PlainHop {
public:
    PlainHop(const StoredBorder& border, std::vector<float> distances, float quantum)
        : border_(border), distances_(std::move(distances)), quantum_(quantum) {
        for (uint32_t k = 0; k < border.size(); ++k)
            if (border.end[k] != NONE && distances_[k] < INFINITE)
                near_radius_ = std::max(near_radius_, 5 * double{border.length[k]});
        for (uint32_t k = 0; k < border.size(); ++k) {
            middles_.push_back(middle(k));
            least_ = std::min(least_, distances_[k]);
        }
        least_or_middle_ = least_;
        for (const float m : middles_)
            if (!std::isnan(m)) least_or_middle_ = std::min(least_or_middle_, m);
    }

    bool is_reached() const { return least_ < INFINITE; }

    Hop over_vertices(const std::vector<uint16_t>& row) const {
        Hop hop;
        if (!is_reached()) return hop;
        int32_t least_sum = 32767;
        for (uint32_t b = 0; b < border_.size(); ++b) {
            const int32_t sum = steps(distances_[b], least_) + row[b];
            if (sum >= least_sum) continue;
            least_sum = sum;
            hop.over = b;
        }
        hop.had_sum = least_sum < 32767;
        double least = NOWHERE;
        if (!hop.had_sum) hop.over = first_least_way(row);
        if (hop.over != NONE) {
            least = way_over(row, hop.over);
            const double over_vertex = least;
            for (const uint32_t p : border_.beside(hop.over)) least = std::min(least, way_across(row, p));
            hop.is_straightened = least < over_vertex;
        }
        return follow_near_rule(row, hop, least);
    }

    Hop over_middles(const std::vector<uint16_t>& row) const {
        Hop hop;
        if (!is_reached()) return hop;
        int32_t least_sum = 32767;
        for (uint32_t b = 0; b < border_.size(); ++b) {
            least_sum = std::min(least_sum, steps(distances_[b], least_or_middle_) + row[b]);
            const float code = middle_code(row, b);
            if (std::isnan(middles_[b]) || std::isnan(code)) continue;
            least_sum =
                std::min(least_sum, steps(middles_[b], least_or_middle_) + static_cast<int32_t>(code));
        }
        hop.had_sum = least_sum < 32767;
        if (hop.had_sum)
            return follow_near_rule(row, hop, double{least_or_middle_} + least_sum * double{quantum_});
        const uint32_t b = first_least_way(row);
        return follow_near_rule(row, hop, b == NONE ? NOWHERE : way_over(row, b));
    }

private:
    // More than every sum where there is no distance.
    int32_t steps(float distance, float least) const {
        if (!(distance < INFINITE)) return 1 << 20;
        const float inverse = quantum_ == 0 ? 0 : 1 / quantum_;
        return static_cast<int32_t>(std::trunc(std::min((distance - least) * inverse + 0.5f, 32766.0f)));
    }

    // The distance of the source from the middle of the segment that begins at p, NaN if there is none.
    float middle(uint32_t p) const {
        if (border_.end[p] == NONE) return NAN;
        const float at_p = distances_[p], at_q = distances_[border_.end[p]], length = border_.length[p];
        return std::sqrt(0.5f * (at_p * at_p + at_q * at_q) - 0.25f * (length * length));
    }
    // The same for x, as a code.
    float middle_code(const std::vector<uint16_t>& row, uint32_t p) const {
        if (border_.end[p] == NONE || row[p] == NO_PATH || row[border_.end[p]] == NO_PATH) return NAN;
        const float at_p = row[p], at_q = row[border_.end[p]], length = border_.length[p] / quantum_;
        return std::trunc(std::sqrt(0.5f * (at_p * at_p + at_q * at_q) - 0.25f * (length * length)) + 0.5f);
    }

    double to_vertex(const std::vector<uint16_t>& row, uint32_t b) const {
        return row[b] == NO_PATH ? NOWHERE : row[b] * double{quantum_};
    }
    double way_over(const std::vector<uint16_t>& row, uint32_t b) const {
        return double{distances_[b]} + to_vertex(row, b);
    }
    uint32_t first_least_way(const std::vector<uint16_t>& row) const {
        double least = NOWHERE;
        uint32_t first = NONE;
        for (uint32_t b = 0; b < border_.size(); ++b)
            if (const double way = way_over(row, b); way < least) {
                least = way;
                first = b;
            }
        return first;
    }

    // The way over the segment that begins at p, straightened; infinite if there is none.
    double way_across(const std::vector<uint16_t>& row, uint32_t p) const {
        const uint32_t q = border_.end[p];
        if (q == NONE) return NOWHERE;
        const double length{border_.length[p]};
        const auto along = [&](double from_p, double from_q) {
            return (from_p - from_q) * (from_p + from_q) * (0.5 / length) + 0.5 * length;
        };
        const auto off = [](double from_p, double x) { return std::sqrt((from_p - x) * (from_p + x)); };
        const double source_p{distances_[p]}, source_q{distances_[q]};
        const double target_p = to_vertex(row, p), target_q = to_vertex(row, q);
        const double xs = along(source_p, source_q), ys = off(source_p, xs);
        const double xt = along(target_p, target_q), yt = off(target_p, xt);
        if (std::isnan(xs) || std::isnan(ys) || std::isnan(xt) || std::isnan(yt)) return NOWHERE;
        const double crossing = xs * yt + xt * ys;
        if (!(0 < crossing && crossing < length * (ys + yt))) return NOWHERE;
        return std::sqrt((xs - xt) * (xs - xt) + (ys + yt) * (ys + yt));
    }

    Hop follow_near_rule(const std::vector<uint16_t>& row, Hop hop, double found) const {
        hop.distance = found;
        if (double{least_} > near_radius_ || found > near_radius_) return hop;
        double least = NOWHERE;
        for (uint32_t b = 0; b < border_.size(); ++b)
            least = std::min({least, way_over(row, b), way_across(row, b)});
        hop.is_near = true;
        hop.is_other = std::abs(least - found) > 1e-3 * found;
        hop.distance = least;
        return hop;
    }

    const StoredBorder& border_;
    std::vector<float> distances_; // per position
    float quantum_;
    double near_radius_ = 0;
    std::vector<float> middles_; // per position: NaN if no middle is there
    float least_ = INFINITE, least_or_middle_ = INFINITE;
};

// ---- What is hopped over

struct Field {
    uint32_t source;
    std::vector<float> distance; // by number
};

constexpr size_t AT_ONCE = InnerSweep::MOST_SOURCES;

struct Built {
    TestMesh mesh;
    Index index;
    StoredTables tables;
    std::vector<Field> fields;

    Built(const TestMesh& of, const geoidx_build_options& options)
        : Built(of, options, overlay_of(of, options)) {}
    Built(const TestMesh& of, const geoidx_build_options& options, Index made)
        : mesh(of), index(std::move(made)), tables(index, overlay().numbering) {
        const auto ids = ids_by_number(index);
        const auto metric = solver(mesh, options);
        const auto vertices = static_cast<uint32_t>(ids.size());
        for (uint32_t i = 0; i < 2 * AT_ONCE; ++i) {
            const uint32_t source = i * vertices / (2 * AT_ONCE);
            const auto by_id = metric_distances(metric.get(), ids[source], mesh.vertex_count());
            Field field{source, {}};
            for (const uint32_t id : ids) field.distance.push_back(static_cast<float>(by_id[id]));
            fields.push_back(field);
        }
        for (const float farther : {INFINITE, 1000.f})
            for (uint32_t i = 0; i < AT_ONCE; ++i) add_farther_in_parts(fields[2 * i], farther);
    }
    Built(const Built&) = delete; // because the tables refer into the index
    Built& operator=(const Built&) = delete;

    // The field once more, with parts of all borders out of reach, or farther than all steps.
    void add_farther_in_parts(Field field, float farther) {
        for (size_t k = 0; k < field.distance.size(); ++k)
            if (k % 8 < 3) field.distance[k] += farther;
        fields.push_back(std::move(field));
    }

    const OverlayIndex& overlay() const { return std::get<OverlayIndex>(index.engine); }
    const Numbering& numbering() const { return overlay().numbering; }
    bool is_source_in(const Field& field, uint32_t patch) const {
        return numbering().is_within(numbering().innermost_patch(field.source), patch);
    }
};

geoidx_build_options options_of(uint32_t metric, std::vector<uint32_t> patches) {
    auto options = build_options(metric, static_cast<uint32_t>(patches.size()));
    std::ranges::copy(patches, options.patches);
    return options;
}

// Without the triangles that lie in any of some circles.
TestMesh with_holes(TestMesh mesh) {
    constexpr double HOLES[][3] = {{6, 6, 2.5}, {18, 7, 3.2}, {8, 17, 3}, {19, 18, 2.2}, {13, 12, 1.6}};
    std::vector<uint32_t> kept;
    for (size_t t = 0; t < mesh.triangles.size(); t += 3) {
        const double* corner = &mesh.positions[3 * size_t{mesh.triangles[t]}];
        if (std::ranges::none_of(
                HOLES, [&](const auto& h) { return std::hypot(corner[0] - h[0], corner[1] - h[1]) < h[2]; }))
            kept.insert(kept.end(), mesh.triangles.begin() + static_cast<std::ptrdiff_t>(t),
                        mesh.triangles.begin() + static_cast<std::ptrdiff_t>(t) + 3);
    }
    mesh.triangles = kept;
    return mesh;
}

const Built& on_closed() {
    static const Built built(pressed(torus(30, 14), 1.3), options_of(GEOIDX_METRIC_EXACT, {3, 3}));
    return built;
}
const Built& with_open_chains() {
    static const Built built(with_holes(hills(26, 24)), options_of(GEOIDX_METRIC_EXACT, {3, 3}));
    return built;
}
const Built& in_parts() {
    static const Built built = [] {
        TestMesh mesh = components_and_unused();
        append(mesh, hills(12, 13), 400);
        append(mesh, torus(14, 8), 500);
        return Built(mesh, options_of(GEOIDX_METRIC_EXACT, {2, 2, 3}));
    }();
    return built;
}
const Built& along_edges() {
    static const Built built(hills(24, 22), options_of(GEOIDX_METRIC_EDGES, {3, 3}));
    return built;
}

// The same with most of the tables' entries without a path, so that sums of steps often do not count.
Built with_few_paths(const Built& of, const geoidx_build_options& options) {
    StoredIndex stored = restore(of.index);
    std::mt19937 random(5);
    for (auto* codes : {&stored.overlay_codes, &stored.border_internal_codes})
        for (uint16_t& code : *codes)
            if (random() % 6 != 0) code = NO_PATH;
    Index index(std::pmr::get_default_resource());
    prepare_without_pairs(stored, index);
    return {of.mesh, options, std::move(index)};
}

// ---- The comparison

struct Tally {
    uint64_t hops = 0, near = 0, far = 0, other_by_near = 0, straightened = 0, unreached = 0, without_sum = 0;
    uint64_t wrong = 0, wrong_places = 0;

    void add(const Hop& expected, float answer) {
        const bool is_reached = expected.distance < NOWHERE;
        ++hops;
        near += expected.is_near;
        far += !expected.is_near && is_reached;
        other_by_near += expected.is_other;
        straightened += expected.is_straightened;
        unreached += !is_reached;
        without_sum += !expected.had_sum && is_reached;
        const double difference = std::abs(double{answer} - expected.distance);
        wrong += is_reached ? !(difference <= 1e-5 * expected.distance) : answer != INFINITE;
    }
    void add(const Hop& expected, float answer, uint32_t over) {
        add(expected, answer);
        wrong_places += over != expected.over;
    }
};

PlainHop plain_hop(const StoredBorder& border, const Field& field, float quantum) {
    std::vector<float> distances;
    for (const uint32_t v : border.vertices) distances.push_back(field.distance[v]);
    return {border, distances, quantum};
}

// The position on the border of the place that a kernel names.
uint32_t position_of(const OverlayIndex& index, uint32_t patch, uint16_t winner) {
    if (winner == BorderFromSource::NO_PLACE) return NONE;
    return index.rings.position[index.rings.begin[patch] + winner];
}

Tally hop_up(const Built& built) {
    const Numbering& numbering = built.numbering();
    OuterCrossing crossing(built.overlay(), std::pmr::get_default_resource());
    std::vector<uint16_t> winners(numbering.largest_overlay_size());
    Tally tally;
    for (uint32_t child = 1; child < numbering.patch_count(); ++child) {
        const uint32_t parent = numbering.parent[child];
        const StoredBorder border = built.tables.border(child);
        std::vector<std::vector<uint16_t>> rows;
        for (uint32_t i = 0; i < numbering.overlay_size(parent); ++i)
            rows.push_back(built.tables.row_up(child, numbering.overlay_number(parent, i)));
        for (const Field& field : built.fields) {
            if (!built.is_source_in(field, child)) continue;
            const PlainHop plain = plain_hop(border, field, built.tables.quantum(parent));
            auto distance = field.distance;
            const bool is_reached = crossing.begin(child, {distance.data()});
            CHECK(is_reached == plain.is_reached());
            if (!is_reached) continue;
            const auto answers = crossing.cross(winners.data());
            REQUIRE(answers.size() == rows.size());
            for (uint32_t i = 0; i < rows.size(); ++i) {
                const uint32_t x = numbering.overlay_number(parent, i);
                if (std::ranges::find(border.vertices, x) != border.vertices.end())
                    CHECK(answers[i] == INFINITE); // its distance is known
                else
                    tally.add(plain.over_vertices(rows[i]), answers[i],
                              position_of(built.overlay(), child, winners[i]));
            }
        }
    }
    return tally;
}

std::vector<std::vector<uint16_t>> rows_down(const Built& built, uint32_t patch) {
    std::vector<std::vector<uint16_t>> rows;
    for (uint32_t i = 0; i < built.numbering().inner_size(patch); ++i)
        rows.push_back(built.tables.row_down(patch, built.numbering().first_inner(patch) + i));
    return rows;
}

// Calls hop(patch, rows, plain, sweep) for every source outside of a patch that reaches its border.
template <class OneHop>
void for_each_hop_down(const Built& built, const OneHop& hop) {
    InnerSweep sweep(built.overlay(), 1, std::pmr::get_default_resource());
    for (uint32_t patch = 1; patch < built.numbering().patch_count(); ++patch) {
        const StoredBorder border = built.tables.border(patch);
        const auto rows = rows_down(built, patch);
        for (const Field& field : built.fields) {
            if (built.is_source_in(field, patch)) continue;
            const PlainHop plain = plain_hop(border, field, built.tables.quantum(patch));
            const bool is_begun = sweep.begin(patch, field.distance.data());
            CHECK(is_begun == (plain.is_reached() && !rows.empty()));
            if (is_begun) hop(patch, rows, plain, sweep);
        }
    }
}

Tally hop_down(const Built& built) {
    Tally tally;
    for_each_hop_down(built, [&](uint32_t, const auto& rows, const PlainHop& plain, InnerSweep& sweep) {
        const auto answers = sweep.cross();
        REQUIRE(answers.size() == rows.size());
        for (size_t i = 0; i < rows.size(); ++i) tally.add(plain.over_middles(rows[i]), answers[i]);
    });
    return tally;
}

// Over vertices instead of middles.
Tally hop_down_straightened(const Built& built) {
    std::vector<uint16_t> winners(built.numbering().largest_inner_size());
    Tally tally;
    for_each_hop_down(built, [&](uint32_t patch, const auto& rows, const PlainHop& plain, InnerSweep& sweep) {
        const auto answers = sweep.cross(winners.data());
        REQUIRE(answers.size() == rows.size());
        for (size_t i = 0; i < rows.size(); ++i)
            tally.add(plain.over_vertices(rows[i]), answers[i],
                      position_of(built.overlay(), patch, winners[i]));
    });
    return tally;
}

// From AT_ONCE sources side by side, some of which may not reach the border.
Tally hop_down_at_once(const Built& built) {
    const Numbering& numbering = built.numbering();
    InnerSweep sweep(built.overlay(), AT_ONCE, std::pmr::get_default_resource());
    Tally tally;
    for (size_t first = 0; first < built.fields.size(); first += AT_ONCE) {
        std::vector<float> distances;
        for (uint32_t v = 0; v < numbering.vertex_count(); ++v)
            for (size_t i = 0; i < AT_ONCE; ++i) distances.push_back(built.fields[first + i].distance[v]);
        for (uint32_t patch = 1; patch < numbering.patch_count(); ++patch) {
            const StoredBorder border = built.tables.border(patch);
            const auto rows = rows_down(built, patch);
            if (!sweep.begin(patch, distances.data())) continue;
            const auto answers = sweep.cross();
            REQUIRE(answers.size() == rows.size() * AT_ONCE);
            for (size_t i = 0; i < AT_ONCE; ++i) {
                const PlainHop plain =
                    plain_hop(border, built.fields[first + i], built.tables.quantum(patch));
                for (size_t r = 0; r < rows.size(); ++r)
                    tally.add(plain.over_middles(rows[r]), answers[r * AT_ONCE + i]);
            }
        }
    }
    return tally;
}

struct Tallies {
    Tally up, down, straightened, at_once;
    std::array<const Tally*, 4> all() const { return {&up, &down, &straightened, &at_once}; }
};

void check_answers(const Tally& tally) {
    CHECK(tally.hops > 500);
    CHECK(tally.wrong == 0);
    CHECK(tally.wrong_places == 0);
}

Tallies check_hops(const Built& built) {
    const Tallies tallies{hop_up(built), hop_down(built), hop_down_straightened(built),
                          hop_down_at_once(built)};
    for (const Tally* tally : tallies.all()) check_answers(*tally);
    return tallies;
}

// The near rule and the ways over segments took part.
void check_rules_applied(const Tallies& tallies) {
    for (const Tally* tally : tallies.all()) {
        CHECK(tally->near > 100);
        CHECK(tally->far > 100);
        CHECK(tally->other_by_near > 0);
    }
    CHECK(tallies.up.straightened > 100);
    CHECK(tallies.straightened.straightened > 100);
}

// How many segments close a chain, and how many positions end an open one.
std::pair<uint32_t, uint32_t> count_chains(const Built& built) {
    uint32_t closed = 0, open = 0;
    for (uint32_t patch = 1; patch < built.numbering().patch_count(); ++patch) {
        const StoredBorder border = built.tables.border(patch);
        for (uint32_t k = 0; k < border.size(); ++k) {
            open += border.end[k] == NONE;
            closed += border.end[k] <= k;
        }
    }
    return {closed, open};
}

}

TEST_CASE("hop: as the text has it on a closed, curved surface") {
    check_rules_applied(check_hops(on_closed()));
    CHECK(count_chains(on_closed()).first > 0);
}

TEST_CASE("hop: as the text has it on a surface with holes") {
    check_rules_applied(check_hops(with_open_chains()));
    CHECK(count_chains(with_open_chains()).second > with_open_chains().numbering().patch_count());
}

TEST_CASE("hop: as the text has it where the surface is in parts") {
    const Tallies tallies = check_hops(in_parts());
    check_rules_applied(tallies);
    CHECK(tallies.at_once.unreached > 1000); // some of the sources are in other parts
}

TEST_CASE("hop: as the text has it along edges, where there are no segments") {
    const Tallies tallies = check_hops(along_edges());
    CHECK(count_chains(along_edges()).first == 0);
    for (const Tally* tally : tallies.all()) CHECK(tally->far == tally->hops);
}

TEST_CASE("hop: as the text has it where tables lack paths") {
    const Built built = with_few_paths(along_edges(), options_of(GEOIDX_METRIC_EDGES, {3, 3}));
    const Tallies tallies = check_hops(built);
    for (const Tally* tally : tallies.all()) {
        CHECK(tally->without_sum > 10);
        CHECK(tally->unreached > 10);
    }
}

// Over middles only: here a vertex may have a path to one end of a segment and none to the other, which are
// joined by an edge, so that no mesh has that.
TEST_CASE("hop: as the text has it where tables lack paths to an end of a segment") {
    const Built built = with_few_paths(with_open_chains(), options_of(GEOIDX_METRIC_EXACT, {3, 3}));
    for (const Tally& tally : {hop_down(built), hop_down_at_once(built)}) {
        check_answers(tally);
        CHECK(tally.near > 100);
        CHECK(tally.without_sum > 10);
    }
}
