// Index files that contradict nothing and did harm: found by tests/campaign, and shrunk.

#include <functional>
#include <numeric>

#include "tests/campaign/file_content.h"
#include "tests/capi/calls.h"
#include "tests/capi/counting_allocator.h"
#include "tests/index/told_issues.h"

using namespace geodesic;
using namespace geodesic::test;
using file_campaign::FileContent;
using file_campaign::Matrix;
using file_campaign::NO_PATH;

namespace {

// A patch of the last level: its border and how many vertices lie inside.
struct Leaf {
    std::vector<uint32_t> border;
    uint32_t internal;
};

std::vector<uint32_t> first_numbers(uint32_t count) {
    std::vector<uint32_t> numbers(count);
    std::iota(numbers.begin(), numbers.end(), 0u);
    return numbers;
}

Matrix filled(uint64_t rows, uint64_t cols, float code) {
    return {std::vector<float>(rows * cols, code), static_cast<uint32_t>(rows), static_cast<uint32_t>(cols)};
}
Matrix filled_triangle(uint64_t size, float code) {
    return size < 2 ? Matrix{} : filled(size / 2, size - 1 + size % 2, code);
}

// The root owns all border vertices. `levels` - 1 patches lie in each other between it and the leaves, with
// all of these on their borders, which are closed chains if is_closed. code(leaf): of its border-internal
// table.
FileContent content_of(uint32_t border_vertices, uint32_t levels, const std::vector<Leaf>& leaves,
                       bool is_closed, const std::function<float(size_t, size_t)>& code,
                       float overlay_code = 1) {
    FileContent content;
    content.engine = GEOIDX_ENGINE_OVERLAY;
    content.metric_flags = GEOIDX_METRIC_UNFOLDABLE;
    content.level_begin = {0, 1};
    content.parent = {UINT32_MAX};
    content.borders = {{}};
    for (uint32_t level = 1; level < levels; ++level) {
        content.children.push_back(1);
        content.parent.push_back(level - 1);
        content.level_begin.push_back(level + 1);
        content.borders.push_back(first_numbers(border_vertices));
    }
    content.children.push_back(static_cast<uint32_t>(leaves.size()));
    content.owned.assign(levels, 0);
    content.owned[0] = border_vertices;
    uint32_t vertices = border_vertices;
    for (size_t i = 0; i < leaves.size(); ++i) {
        content.parent.push_back(levels - 1);
        content.borders.push_back(leaves[i].border);
        content.internal.push_back(leaves[i].internal);
        Matrix& table = content.border_internal_tables.emplace_back(
            filled(leaves[i].border.size(), leaves[i].internal, 0));
        for (size_t at = 0; at < table.values.size(); ++at)
            table.values[at] = code(i, at / leaves[i].internal);
        content.internal_tables.push_back(filled_triangle(leaves[i].internal, 1));
        vertices += leaves[i].internal;
    }
    content.level_begin.push_back(content.patch_count());
    content.number_of_id = first_numbers(vertices);
    content.positions.resize(vertices);
    content.quantum.assign(content.patch_count(), 1);
    content.overlay_tables.push_back(filled_triangle(border_vertices, overlay_code));
    for (const auto& border : content.borders) {
        const auto size = static_cast<uint32_t>(border.size());
        content.next.emplace_back(size, UINT32_MAX);
        content.segment_length.emplace_back(size, 0.f);
        if (!is_closed || size < 2) continue;
        for (uint32_t i = 0; i < size; ++i) content.next.back()[i] = (i + 1) % size;
        content.segment_length.back().assign(size, 1);
    }
    return content;
}

// Opened and verified, with little memory; what it would take to hold them, the allocator would refuse.
void check_limit(const FileContent& content) {
    const auto file = file_campaign::write_content(content).bytes;
    CountingAllocator allocator;
    geoidx_open_options options;
    geoidx_open_options_init(&options);
    options.allocator = allocator.get();
    geoidx* index = nullptr;
    CHECK(geoidx_open_memory(file.data(), file.size(), &options, &index) == GEOIDX_ERROR_LIMIT);
    CHECK(index == nullptr);
    const auto told = told_issues(file);
    REQUIRE(told.size() == 1);
    CHECK(told[0].number == 200);
    CHECK(told[0].status == GEOIDX_ERROR_LIMIT);
    CHECK(told[0].offset == 0);
}

IndexHandle opened(const FileContent& content) { return open(file_campaign::write_content(content).bytes); }

}

TEST_CASE("harmful file: patches with an empty border, which no path leaves") {
    const auto content =
        content_of(2, 1, {{{0, 1}, 2}, {{}, 2}, {{}, 1}}, false, [](size_t, size_t) { return 1.f; });
    const auto index = opened(content);
    const uint32_t vertices = content.id_count();
    const uint32_t part_of[] = {0, 0, 0, 0, 1, 1, 2};
    for (uint32_t a = 0; a < vertices; ++a)
        for (uint32_t b = 0; b < vertices; ++b) {
            CAPTURE(a);
            CAPTURE(b);
            CHECK((sssd(index.get(), a, b) < NO_PATH) == (part_of[a] == part_of[b]));
            CHECK((msad(index.get(), a, vertices)[b] < NO_PATH) == (part_of[a] == part_of[b]));
        }
}

TEST_CASE("harmful file: a border of which one vertex is reached, beside an empty one") {
    const auto content = content_of(
        2, 1, {{{}, 3}, {{0, 1}, 2}}, true, [](size_t, size_t row) { return row == 0 ? NO_PATH : 16010.f; },
        NO_PATH);
    const auto index = opened(content);
    for (uint32_t alone : {2u, 3u, 4u})
        for (uint32_t other : {0u, 1u, 5u, 6u}) {
            CHECK(sssd(index.get(), alone, other) == NO_PATH);
            CHECK(sssd(index.get(), 0, other) == (other == 0 ? 0 : NO_PATH));
        }
    CHECK(sssd(index.get(), 1, 5) == 16010);
    CHECK(sssd(index.get(), 5, 6) == 1);
}

TEST_CASE("harmful file: a vertex that the border around it cannot be reached from, after a pair that can") {
    // The first pair's way crosses late on a long border, the second one's border has one vertex.
    const std::vector<Leaf> leaves{{first_numbers(300), 1}, {{0}, 1}, {{0, 299}, 1}};
    const auto content =
        content_of(300, 1, leaves, true, [](size_t leaf, size_t) { return leaf == 1 ? NO_PATH : 0.f; });
    const auto index = opened(content);
    const auto query = query_of(index.get());
    const uint32_t reached = 300, unreached = 301, other = 302;
    for (int turn = 0; turn < 3; ++turn) {
        float distance = -1;
        require_success(geoidx_query_sssd(query.get(), reached, other, &distance));
        CHECK(distance < NO_PATH);
        require_success(geoidx_query_sssd(query.get(), unreached, other, &distance));
        CHECK(distance == NO_PATH);
        require_success(geoidx_query_sssd(query.get(), reached, unreached, &distance));
        CHECK(distance == NO_PATH);
    }
}

// Tables up lead from each leaf to the border of its parent, which is the same one.
TEST_CASE("harmful file: the same border around many leaves, gigabytes from a few thousand bytes") {
    // Of a closed chain every second vertex is a sample, so that it takes more of them to be out of
    // proportion than of vertices without segments, which are samples one and all.
    for (bool is_closed : {false, true}) {
        const uint32_t border = is_closed ? 1400 : 700, count = is_closed ? 600 : 300;
        const std::vector<Leaf> leaves(count, {first_numbers(border), 0});
        check_limit(content_of(border, 2, leaves, is_closed, [](size_t, size_t) { return 1.f; }));
    }
}

TEST_CASE("harmful file: the same border around many leaves of the root, which have no tables across") {
    const std::vector<Leaf> leaves(300, {first_numbers(700), 0});
    for (bool is_closed : {false, true}) {
        const auto file =
            file_campaign::write_content(content_of(700, 1, leaves, is_closed, [](size_t, size_t) {
                return 1.f;
            })).bytes;
        geoidx_open_options options;
        geoidx_open_options_init(&options);
        options.max_memory = uint64_t{64} << 20;
        geoidx* index = nullptr;
        require_success(geoidx_open_memory(file.data(), file.size(), &options, &index));
        CHECK(sssd(IndexHandle(index).get(), 3, 500) == 1);
    }
}

TEST_CASE("harmful file: a long border around many vertices gives no labels to it") {
    std::vector<Leaf> leaves(70000, {{}, 1});
    leaves[0] = {first_numbers(400), 0};
    const auto content = content_of(400, 3, leaves, true, [](size_t, size_t) { return 1.f; });
    const std::vector<std::byte> file = file_campaign::write_content(content).bytes;
    geoidx_open_options options;
    geoidx_open_options_init(&options);
    options.max_memory = uint64_t{64} << 20;
    geoidx* index = nullptr;
    require_success(geoidx_open_memory(file.data(), file.size(), &options, &index));
    CHECK(sssd(IndexHandle(index).get(), 400, 401) == NO_PATH);
}

TEST_CASE("harmful file: labels in proportion are fine, however few the tables") {
    std::vector<Leaf> leaves(3000, {{}, 1});
    leaves[0] = {first_numbers(10), 0};
    const auto content = content_of(10, 3, leaves, true, [](size_t, size_t) { return 1.f; });
    CHECK(sssd(opened(content).get(), 10, 11) == NO_PATH);
}
