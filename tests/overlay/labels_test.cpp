// Labels: the distances of vertices to the borders of the patches that they lie in.
#include "src/overlay/labels.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <list>
#include <utility>

#include "src/query/query.h"
#include "tests/overlay/overlay_of.h"

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

geoidx_build_options options_of(uint32_t metric, std::vector<uint32_t> patches) {
    auto options = build_options(metric, static_cast<uint32_t>(patches.size()));
    std::ranges::copy(patches, options.patches);
    return options;
}

// Without segments, so that every border vertex is a sample.
const std::list<Labelled>& along_edges() {
    static const std::list<Labelled> built = [] {
        std::list<Labelled> made;
        made.emplace_back(hills(24, 22), options_of(GEOIDX_METRIC_EDGES, {3, 3, 3}));
        return made;
    }();
    return built;
}

// One with a border of more vertices than are labelled whole.
const std::list<Labelled>& on_planes() {
    static const std::list<Labelled> built = [] {
        static const TestMesh square = grid(40, 40, 0.2), strip = pressed(grid(500, 9), 0.008);
        std::list<Labelled> made;
        made.emplace_back(square, options_of_plane(square, {3, 3, 3}));
        made.emplace_back(strip, options_of_plane(strip, {2, 3, 2}));
        return made;
    }();
    return built;
}

// The distance of an inner vertex of `patch` to the i-th labelled vertex of the border of `labelled`.
double label_of(const OverlayIndex& index, uint32_t patch, uint32_t inner, uint32_t labelled, uint32_t i) {
    const Labels& labels = index.pairs.labels;
    const int16_t* label = labels.codes.data() + labels.begin[patch] +
                           uint64_t{inner} * labels.offset[patch] + labels.offset[labelled];
    if (label[2 + i] == SourceCode::UNREACHED) return double{INFINITE};
    const double nearest{std::bit_cast<float>(uint32_t{static_cast<uint16_t>(label[1])} << 16 |
                                              static_cast<uint16_t>(label[0]))};
    return (nearest + label[2 + i] + 32768) * double{index.quantum[index.numbering.parent[labelled]]};
}

std::vector<uint32_t> labelled_vertices(const OverlayIndex& index, uint32_t patch) {
    const auto border = index.numbering.border_of(patch);
    std::vector<uint32_t> vertices;
    if (index.is_labelled_whole(patch)) return {border.begin(), border.end()};
    for (const uint32_t position : index.pairs.samples.of(patch)) vertices.push_back(border[position]);
    return vertices;
}

// Of each table that a label was made over: half a step for its rounding, and half a one for taking it from
// the table of the parent.
double steps_between(const OverlayIndex& index, uint32_t patch, uint32_t labelled) {
    double sum = 0;
    for (uint32_t p = patch; p != index.numbering.parent[labelled]; p = index.numbering.parent[p])
        sum += std::ldexp(double{index.quantum[p]}, index.shift[p]);
    const uint32_t outer = index.numbering.parent[labelled];
    return sum + std::ldexp(double{index.quantum[outer]}, index.shift[outer]);
}

uint32_t first_parent_of_leaves(const Numbering& numbering) {
    return numbering.parent[numbering.first_leaf()];
}

// Calls check(distance of the i-th labelled vertex, inner vertex, i) for each patch and what lies deeper.
template <class Check>
uint64_t for_each_label(const Labelled& made, const Check& check) {
    const OverlayIndex& index = made.overlay();
    const Numbering& numbering = index.numbering;
    uint64_t count = 0;
    for (uint32_t labelled = 1; labelled < first_parent_of_leaves(numbering); ++labelled) {
        const auto vertices = labelled_vertices(index, labelled);
        for (uint32_t i = 0; i < vertices.size(); i += 1 + static_cast<uint32_t>(vertices.size()) / 12)
            for (uint32_t p = labelled + 1; p < numbering.patch_count(); ++p) {
                if (!numbering.is_within(p, labelled)) continue;
                for (uint32_t inner = 0; inner < numbering.inner_size(p); ++inner, ++count)
                    check(vertices[i], numbering.first_inner(p) + inner,
                          label_of(index, p, inner, labelled, i), steps_between(index, p, labelled));
            }
    }
    return count;
}

}

TEST_CASE("labels: along edges they are the metric's distances, within the steps of the tables") {
    for (const Labelled& made : along_edges()) {
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
    for (const Labelled& made : along_edges()) {
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

TEST_CASE("labels: to all of a border of up to 400 vertices, to the samples of a larger one") {
    uint32_t whole = 0, sampled = 0;
    for (const Labelled& made : on_planes()) {
        const OverlayIndex& index = made.overlay();
        for (uint32_t p = 1; p < first_parent_of_leaves(index.numbering); ++p) {
            const uint32_t size = index.numbering.border_size(p);
            const auto expected =
                size <= 400 ? size : static_cast<uint32_t>(index.pairs.samples.of(p).size());
            CHECK(index.label_size(p) == expected);
            for (uint32_t child = index.numbering.child_begin[p]; child < index.numbering.child_begin[p + 1];
                 ++child)
                CHECK(index.pairs.labels.offset[child] - index.pairs.labels.offset[p] == 2 + expected);
            ++(size <= 400 ? whole : sampled);
        }
    }
    CHECK(whole > 0);
    CHECK(sampled > 0);
}

TEST_CASE("labels: none to the borders of the whole mesh and of parents of leaves") {
    for (const Labelled& made : on_planes()) {
        const Numbering& numbering = made.overlay().numbering;
        const auto& offset = made.overlay().pairs.labels.offset;
        for (uint32_t leaf = numbering.first_leaf(); leaf < numbering.patch_count(); ++leaf)
            CHECK(offset[leaf] == offset[numbering.parent[leaf]]);
        for (uint32_t p = 1; numbering.parent[p] == 0; ++p) CHECK(offset[p] == 0);
    }
}

TEST_CASE("labels: on a plane, straight lines that cross borders between vertices") {
    for (const Labelled& made : on_planes()) {
        double sum = 0;
        uint64_t too_short = 0;
        const uint64_t count =
            for_each_label(made, [&](uint32_t border, uint32_t inner, double label, double tolerance) {
                const double line = made.mesh.straight(made.ids[border], made.ids[inner]);
                // What is calibrated is shortened by its mean error.
                too_short += label < line * 0.97 - tolerance;
                sum += std::abs(label - line) / line;
            });
        CHECK(too_short == 0);
        CHECK(sum / static_cast<double>(count) < 0.01);
    }
}

TEST_CASE("labels: to a border that cannot be reached there is no distance") {
    TestMesh mesh = hills(20, 18);
    append(mesh, hills(20, 18), 100);
    const Labelled made(mesh, options_of(GEOIDX_METRIC_EDGES, {3, 3, 2}));
    const auto metric = solver(mesh, made.options);
    uint64_t wrong = 0;
    for_each_label(made, [&](uint32_t border, uint32_t inner, double label, double) {
        const bool is_apart = (made.ids[border] < 360) != (made.ids[inner] < 360);
        wrong += std::isinf(label) != is_apart;
    });
    CHECK(wrong == 0);
}
