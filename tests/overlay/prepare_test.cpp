// From what is stored to what is answered from, and back.
#include "src/overlay/prepare/prepare.h"

#include <cmath>
#include <random>

#include "src/overlay/fields/ssad.h"
#include "tests/overlay/overlay_of.h"
#include "tests/support/sanitized.h"

using namespace geodesic;
using namespace geodesic::test;

namespace {

StoredIndex stored_of(const TestMesh& mesh, const geoidx_build_options& options) {
    Index index(std::pmr::get_default_resource());
    build_index(mesh.view(), options, index);
    return restore(index);
}

// Prepared and restored.
StoredIndex there_and_back(const StoredIndex& stored) {
    Index index(std::pmr::get_default_resource());
    prepare(stored, index);
    return restore(index);
}

// Other numbers in every table, no two of which are likely to be alike, so that none can stand in for
// another one.
void shuffle_tables(StoredIndex& stored, uint32_t seed) {
    std::mt19937 random(seed);
    const auto number = [&] { return 1 + static_cast<float>(random() % 1000000) / 1000; };
    for (auto* table : {&stored.border_tables, &stored.border_internal_tables, &stored.internal_tables})
        for (float& distance : *table) distance = number();
    for (float& quantum : stored.quantum) quantum = number();
    for (size_t slot = 0; slot < stored.segments.end.size(); ++slot)
        stored.segments.length[slot] = stored.segments.end[slot] == NONE ? 0 : number();
    for (Bridge& bridge : stored.segments.bridges) bridge.length = number();
    for (auto* codes : {&stored.overlay_codes, &stored.border_internal_codes, &stored.internal_codes})
        for (uint16_t& code : *codes) code = static_cast<uint16_t>(random() % 0x8000);
}

void check_same(const StoredIndex& a, const StoredIndex& b) {
    CHECK(a.description == b.description);
    CHECK(a.level_count == b.level_count);
    CHECK(a.child_count == b.child_count);
    CHECK(a.number_of_id == b.number_of_id);
    CHECK(a.positions == b.positions);
    CHECK(a.owned_count == b.owned_count);
    CHECK(a.internal_count == b.internal_count);
    CHECK(a.border_size == b.border_size);
    CHECK(a.border == b.border);
    CHECK(a.border_tables == b.border_tables);
    CHECK(a.border_internal_tables == b.border_internal_tables);
    CHECK(a.internal_tables == b.internal_tables);
    CHECK(a.quantum == b.quantum);
    CHECK(a.segments.end == b.segments.end);
    CHECK(a.segments.length == b.segments.length);
    CHECK(a.segments.bridges == b.segments.bridges);
    CHECK(a.overlay_codes == b.overlay_codes);
    CHECK(a.border_internal_codes == b.border_internal_codes);
    CHECK(a.internal_codes == b.internal_codes);
}

}

TEST_CASE("prepare and restore: every field comes back, of both engines, whatever the tables hold" *
          doctest::skip(SANITIZED)) {
    uint32_t seed = 0;
    for (const auto& [name, mesh] : mesh_zoo())
        for (const uint32_t engine : {GEOIDX_ENGINE_GRAPH, GEOIDX_ENGINE_OVERLAY})
            for (const uint32_t levels : {1u, 3u}) {
                const auto& surface_name = name; // clang 14 captures no structured binding
                CAPTURE(surface_name);
                CAPTURE(engine);
                CAPTURE(levels);
                auto options = build_options(GEOIDX_METRIC_EXACT, levels);
                options.engine = engine;
                StoredIndex stored = stored_of(mesh, options);
                shuffle_tables(stored, ++seed);
                check_same(there_and_back(stored), stored);
            }
}

TEST_CASE("prepare and restore: bridges come back") {
    auto options = build_options(GEOIDX_METRIC_EXACT, 2);
    options.engine = GEOIDX_ENGINE_OVERLAY;
    const StoredIndex stored = stored_of(pages(4, 8, 12), options);
    CHECK(stored.segments.bridges.size() > 2);
    check_same(there_and_back(stored), stored);
}

TEST_CASE("prepare: without segments, paths cross borders at their vertices") {
    const TestMesh mesh = grid(24, 22, 0.2);
    auto options = build_options(GEOIDX_METRIC_EXACT, 2);
    options.engine = GEOIDX_ENGINE_OVERLAY;
    StoredIndex stored = stored_of(mesh, options);
    const OverlayOf with(stored);
    CHECK(std::ranges::count(stored.segments.end, NONE) < std::ssize(stored.segments.end) / 2);
    stored.segments = BorderSegments(stored.border.size());
    const OverlayOf without(stored);
    const OverlayIndex& overlay = without.overlay();
    for (const float longest : overlay.longest_segment) CHECK(longest == 0);
    for (const float length : overlay.rings.segment_length) CHECK(std::isnan(length));

    const uint32_t count = mesh.vertex_count();
    uint64_t shorter = 0, longer = 0, wrong = 0;
    for (uint32_t source = 0; source < count; source += 41) {
        std::vector<float> between(count), at_vertices(count);
        const auto memory = std::pmr::get_default_resource();
        OverlaySsad(with.overlay(), memory).sweep({&source, 1}, INFINITE, between);
        OverlaySsad(overlay, memory).sweep({&source, 1}, INFINITE, at_vertices);
        for (uint32_t v = 0; v < count; ++v) {
            const double line = straight_distance(overlay.numbering, source, v);
            shorter += double{at_vertices[v]} < double{between[v]} * 0.999;
            longer += double{at_vertices[v]} > double{between[v]} * 1.005;
            wrong += !(double{at_vertices[v]} >= line * 0.97 && double{at_vertices[v]} <= line * 1.3);
        }
    }
    CHECK(shorter == 0);
    CHECK(longer > 500); // of 13 sources
    CHECK(wrong == 0);
}
