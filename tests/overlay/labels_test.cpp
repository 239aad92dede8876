// Labels: the distances of vertices to the border of a patch farther out.
#include "src/overlay/sssd/labels.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <list>
#include <utility>

#include "src/query/query.h"
#include "tests/overlay/overlay_of.h"
#include "tests/support/sanitized.h"

using namespace geodesic;
using namespace geodesic::test;

namespace {

struct Labelled {
    TestMesh mesh;
    geoidx_build_options options;
    OverlayOf built;
    std::vector<uint32_t> ids; // by number

    Labelled(const TestMesh& built_of, const geoidx_build_options& built_with)
        : mesh(built_of), options(built_with), built(mesh, options), ids(ids_by_number(built.index)) {}

    const OverlayIndex& overlay() const { return built.overlay(); }
};

geoidx_build_options options_of_labelled(uint32_t metric, std::vector<uint32_t> patches) {
    auto options = build_options(metric, static_cast<uint32_t>(patches.size()));
    std::ranges::copy(patches, options.patches);
    return options;
}

const std::list<Labelled>& labelled_along_edges() {
    static const std::list<Labelled> built = [] {
        std::list<Labelled> made;
        made.emplace_back(hills(24, 22), options_of_labelled(GEOIDX_METRIC_EDGES, {3, 3, 3}));
        return made;
    }();
    return built;
}

const std::list<Labelled>& on_planes() {
    static const std::list<Labelled> built = [] {
        static const TestMesh square = grid(40, 40, 0.2), strip = pressed(grid(300, 9), 0.008);
        std::list<Labelled> made;
        made.emplace_back(square, options_of_plane(square, {3, 3, 3}));
        made.emplace_back(strip, options_of_plane(strip, {2, 3, 2}));
        return made;
    }();
    return built;
}

// Of so many vertices that rows have a byte a place.
const Labelled& on_large_plane() {
    static const TestMesh large = grid(130, 130, 0.2);
    static const Labelled built(large, options_of_plane(large, {4, 4, 4}));
    return built;
}

// The distance of an inner vertex of `patch` to the i-th vertex of the border of `labelled`.
double label_of(const OverlayIndex& index, uint32_t patch, uint32_t inner, uint32_t labelled, uint32_t i) {
    const Labels& labels = *index.pairs.labels;
    const uint32_t place = index.rings.place_of_slot[index.numbering.border_begin[labelled] + i];
    const uint32_t places = index.rings.size(labelled);
    std::vector<uint16_t> codes(places + LABEL_ROW_PADDING);
    read_label_row(labels.rows.get() + label_row_begin(index, labels, patch, inner, labelled),
                   labels.runs_of(labelled), places, codes.data());
    const uint16_t code = codes[place];
    return code == TableCode::UNREACHED ? double{INFINITE} : code * double{labels.quantum[labelled]};
}

// Of each table that a label was made over, and of the label: half a step for its rounding, and half a one
// for taking it from the table of the parent.
double steps_between(const OverlayIndex& index, uint32_t patch, uint32_t labelled) {
    double sum = 0;
    for (uint32_t p = patch; p != index.numbering.parent[labelled]; p = index.numbering.parent[p])
        sum += std::ldexp(double{index.quantum[p]}, index.shift[p]);
    return sum + double{index.pairs.labels->quantum[labelled]};
}

// Calls check(border vertex, inner vertex, distance, tolerance) for each labelled patch and what lies deeper.
template <class Check>
uint64_t for_each_label(const Labelled& made, const Check& check) {
    const OverlayIndex& index = made.overlay();
    const Numbering& numbering = index.numbering;
    uint64_t count = 0;
    for (uint32_t p = 1; p < numbering.first_leaf(); ++p) {
        if (!index.pairs.labels->is_labelled[p]) continue;
        const auto border = numbering.border_of(p);
        for (uint32_t i = 0; i < border.size(); i += 1 + static_cast<uint32_t>(border.size()) / 12)
            for (uint32_t inside = p + 1; inside < numbering.patch_count(); ++inside) {
                if (!numbering.is_within(inside, p)) continue;
                for (uint32_t inner = 0; inner < numbering.inner_size(inside); ++inner, ++count)
                    check(border[i], numbering.first_inner(inside) + inner,
                          label_of(index, inside, inner, p, i), steps_between(index, inside, p));
            }
    }
    return count;
}

}

TEST_CASE("labels: along edges they are the metric's distances, within the steps of the tables") {
    for (const Labelled& made : labelled_along_edges()) {
        const auto metric = solver(made.mesh, made.options);
        std::vector<double> distances;
        uint32_t source = NONE;
        uint64_t wrong = 0;
        const uint64_t count =
            for_each_label(made, [&](uint32_t border, uint32_t inner, double label, double tolerance) {
                if (std::exchange(source, border) != border)
                    distances = metric_distances(metric.get(), made.ids[border], made.mesh.vertex_count());
                const double distance = distances[made.ids[inner]];
                wrong += !(std::abs(label - distance) <= tolerance + 1e-6 * distance);
            });
        CHECK(wrong == 0);
        CHECK(count > 1000);
    }
}

TEST_CASE("labels: along edges they are those of MSAD from the border vertex, within the steps") {
    for (const Labelled& made : labelled_along_edges()) {
        Query query(made.built.index, std::pmr::get_default_resource());
        std::vector<float> distances(made.mesh.vertex_count());
        uint32_t source = NONE;
        uint64_t wrong = 0;
        for_each_label(made, [&](uint32_t border, uint32_t inner, double label, double tolerance) {
            if (std::exchange(source, border) != border)
                query.msad(std::span(&made.ids[border], 1), INFINITE, distances);
            const double distance = double{distances[made.ids[inner]]};
            wrong += !(std::abs(label - distance) <= 2 * tolerance + 1e-6 * distance);
        });
        CHECK(wrong == 0);
    }
}

TEST_CASE("labels: to the two outermost borders that are neither empty nor have more than 400 places" *
          doctest::skip(SANITIZED)) {
    uint32_t by_level[4] = {}, left_out = 0;
    static const TestMesh square = grid(40, 40, 0.2);
    std::list<Labelled> deep;
    deep.emplace_back(square, options_of_plane(square, {2, 2, 2, 2}));
    std::vector<const Labelled*> all{&deep.front()};
    for (const Labelled& made : on_planes()) all.push_back(&made);
    for (const Labelled* const one : all) {
        const Labelled& made = *one;
        const OverlayIndex& index = made.overlay();
        const Numbering& numbering = index.numbering;
        uint64_t codes = 0;
        for (uint32_t leaf = numbering.first_leaf(); leaf < numbering.patch_count(); ++leaf) {
            std::vector<uint32_t> expected; // from the innermost one
            for (uint32_t p = leaf, level = numbering.level_count(); p != 0; p = numbering.parent[p], --level)
                if (p != leaf && index.rings.size(p) > 0 && index.rings.size(p) <= 400) {
                    expected.push_back(p);
                    ++by_level[level];
                }
            left_out += expected.size() > 2;
            if (expected.size() > 2) expected.erase(expected.begin(), expected.end() - 2);
            for (uint32_t p = leaf; p != 0; p = numbering.parent[p])
                CHECK(index.pairs.labels->is_labelled[p] == (std::ranges::count(expected, p) > 0));
            for (const uint32_t p : expected)
                codes += uint64_t{numbering.inner_size(leaf)} * index.rings.size(p);
        }
        CHECK(count_label_codes(index) >= codes);
    }
    CHECK(by_level[1] > 0);
    CHECK(by_level[2] > 0);
    CHECK(left_out > 0);
}

TEST_CASE("labels: none where there is one level, and where borders are too long") {
    static const TestMesh strip = pressed(grid(500, 7), 0.008);
    for (const auto patches : {std::initializer_list<uint32_t>{4}, {2, 1}}) {
        const OverlayOf made(strip, options_of_plane(strip, patches));
        CHECK(made.overlay().pairs.labels->rows == nullptr);
    }
}

TEST_CASE("labels: separate parts, whose borders are empty, have labels to the borders inside") {
    TestMesh mesh = hills(20, 18);
    append(mesh, hills(20, 18), 100);
    const Labelled made(mesh, options_of_labelled(GEOIDX_METRIC_EDGES, {1, 3, 2}));
    const OverlayIndex& index = made.overlay();
    for (uint32_t p = 1; p < index.numbering.level_begin[2]; ++p) CHECK(index.rings.size(p) == 0);
    CHECK(count_label_codes(index) > 0);
}

TEST_CASE("labels: to a border that no vertex inside reaches there is no distance") {
    const OverlayOf made(hills(20, 18), options_of_labelled(GEOIDX_METRIC_EDGES, {3, 2}));
    StoredIndex stored = restore(made.index);
    std::ranges::fill(stored.border_internal_codes, TableCode::UNREACHED);
    const OverlayOf cut(stored);
    const OverlayIndex& index = cut.overlay();
    uint64_t reached = 0, all = 0;
    for (uint32_t leaf = index.numbering.first_leaf(); leaf < index.numbering.patch_count(); ++leaf)
        for (uint32_t inner = 0; inner < index.numbering.inner_size(leaf); ++inner)
            for (uint32_t i = 0; i < index.numbering.border_size(index.numbering.parent[leaf]); ++i, ++all)
                reached += !std::isinf(label_of(index, leaf, inner, index.numbering.parent[leaf], i));
    CHECK(reached == 0);
    CHECK(all > 1000);
}

TEST_CASE("labels: pairs make those that they need, and no others, and get the same bits in any order") {
    for (const Labelled& made : on_planes()) {
        Index opened(std::pmr::get_default_resource());
        prepare(restore(made.built.index), opened);
        const auto& index = std::get<OverlayIndex>(opened.engine);
        Query whole(made.built.index, std::pmr::get_default_resource());
        Query query(opened, std::pmr::get_default_resource());
        const auto labels_made = [&] {
            return std::ranges::count_if(index.pairs.labels->are_made,
                                         [](const auto& made) { return made.load(); });
        };
        const uint32_t count = made.mesh.vertex_count();
        CHECK(query.sssd(0, count - 1) == whole.sssd(0, count - 1));
        CHECK(labels_made() <= 2);
        uint32_t different = 0;
        for (uint32_t a = 0; a < count; a += 37)
            for (uint32_t b = count - 1; b > a + 41; b -= 41)
                different += query.sssd(a, b) != whole.sssd(a, b);
        CHECK(different == 0);
        CHECK(labels_made() > 2);
        CHECK(labels_made() <= std::ranges::count(index.pairs.labels->is_labelled, 1));
    }
}

TEST_CASE("labels: left out on demand, and pairs are answered over the borders inside") {
    for (const Labelled& made : on_planes()) {
        Index bare(std::pmr::get_default_resource());
        prepare(restore(made.built.index), bare);
        leave_out_labels(bare);
        Query with(made.built.index, std::pmr::get_default_resource());
        Query without(bare, std::pmr::get_default_resource());
        uint32_t different = 0;
        for (uint32_t a = 0; a < made.mesh.vertex_count(); a += 37)
            for (uint32_t b = a + 1; b < made.mesh.vertex_count(); b += 41) {
                const double line = made.mesh.straight(a, b);
                const double far = double{without.sssd(a, b)}, near = double{with.sssd(a, b)};
                CHECK(std::abs(far - line) <= 0.03 * line);
                CHECK(std::abs(near - line) <= 0.03 * line);
                different += far != near;
            }
        CHECK(different > 0);
        CHECK(std::get<OverlayIndex>(bare.engine).pairs.labels->rows == nullptr);
    }
}

TEST_CASE("labels: on a plane, straight lines that cross borders between vertices") {
    for (const Labelled& made : on_planes()) {
        double sum = 0;
        uint64_t too_short = 0;
        const uint64_t count =
            for_each_label(made, [&](uint32_t border, uint32_t inner, double label, double tolerance) {
                const double line = made.mesh.straight(made.ids[border], made.ids[inner]);
                // What is calibrated is shortened by its median error.
                too_short += label < line * 0.97 - tolerance;
                sum += std::abs(label - line) / line;
            });
        CHECK(too_short == 0);
        CHECK(sum / static_cast<double>(count) < 0.01);
    }
}

TEST_CASE("labels: where distances are many segments long, rows have a byte a place") {
    const Labelled& made = on_large_plane();
    const OverlayIndex& index = made.overlay();
    const Labels& labels = *index.pairs.labels;
    double sum = 0;
    uint64_t wrong = 0;
    const uint64_t count =
        for_each_label(made, [&](uint32_t border, uint32_t inner, double label, double tolerance) {
            const double line = made.mesh.straight(made.ids[border], made.ids[inner]);
            wrong += !(std::abs(label - line) <= 0.03 * line + tolerance);
            sum += std::abs(label - line) / line;
        });
    CHECK(wrong == 0);
    CHECK(sum / static_cast<double>(count) < 0.005);
    uint32_t labelled = 0;
    for (uint32_t p = 1; p < index.numbering.first_leaf(); ++p)
        if (labels.is_labelled[p]) {
            CHECK(labels.runs_of(p).size() < index.rings.size(p) / 4);
            CHECK(labels.quantum[p] <= 3 * index.quantum[0]);
            ++labelled;
        }
    CHECK(labelled > 1);
    CHECK(labels.rows.get_deleter().size < sizeof(uint16_t) * count_label_codes(index));
}

TEST_CASE("labels: distances of few of their steps are those without labels") {
    const Labelled& made = on_large_plane();
    Index bare(std::pmr::get_default_resource());
    prepare(restore(made.built.index), bare);
    leave_out_labels(bare);
    Query with(made.built.index, std::pmr::get_default_resource());
    Query without(bare, std::pmr::get_default_resource());
    const auto& labels = *made.overlay().pairs.labels;
    const float few = 1000 * std::ranges::max(labels.quantum);
    uint32_t near = 0, different = 0, far = 0, far_and_different = 0;
    for (uint32_t a = 0; a + 131 < made.mesh.vertex_count(); a += 17)
        for (const uint32_t b : {a + 1, a + 131, (a * 7919) % made.mesh.vertex_count()}) {
            if (a == b) continue;
            const float distance = without.sssd(a, b);
            const bool differs = with.sssd(a, b) != distance;
            (distance < 0.9f * few ? near : far) += 1;
            (distance < 0.9f * few ? different : far_and_different) += differs;
        }
    CHECK(different == 0);
    CHECK(near > 1000);
    CHECK(far_and_different > far / 10);
}

TEST_CASE("labels: where distances are few segments long, rows have two bytes a place") {
    for (const Labelled& made : on_planes()) {
        const OverlayIndex& index = made.overlay();
        const Labels& labels = *index.pairs.labels;
        for (uint32_t p = 1; p < index.numbering.first_leaf(); ++p) {
            if (!labels.is_labelled[p]) continue;
            Array<uint16_t> runs(std::pmr::get_default_resource());
            const float needed = find_runs(index.rings, p, runs);
            const float coarsest = std::ranges::max(index.quantum);
            CHECK((labels.runs_of(p).size() == index.rings.size(p)) == (needed > 3 * coarsest));
        }
    }
}

TEST_CASE("labels: to a border that cannot be reached there is no distance") {
    TestMesh mesh = hills(20, 18);
    append(mesh, hills(20, 18), 100);
    const Labelled made(mesh, options_of_labelled(GEOIDX_METRIC_EDGES, {3, 3, 2}));
    const auto metric = solver(mesh, made.options);
    uint64_t wrong = 0;
    for_each_label(made, [&](uint32_t border, uint32_t inner, double label, double) {
        const bool is_apart = (made.ids[border] < 360) != (made.ids[inner] < 360);
        wrong += std::isinf(label) != is_apart;
    });
    CHECK(wrong == 0);
}
