// The samples of borders, over which SSSD looks for ways first.
#include "src/overlay/samples.h"

#include <algorithm>
#include <cmath>
#include <list>

#include "tests/overlay/overlay_of.h"

using namespace geodesic;
using namespace geodesic::test;

namespace {

// Two patches with one long open border between them, and many, closed borders among theirs.
const TestMesh& strip() {
    static const TestMesh mesh = pressed(grid(400, 9), 0.01);
    return mesh;
}
const TestMesh& square() {
    static const TestMesh mesh = pressed(grid(400, 11), 0.025);
    return mesh;
}

const std::list<OverlayOf>& built() {
    static const std::list<OverlayOf> all = [] {
        std::list<OverlayOf> made;
        made.emplace_back(strip(), options_of_plane(strip(), {2, 4}));
        made.emplace_back(square(), options_of_plane(square(), {12}));
        return made;
    }();
    return all;
}

// From one sample to the next one of the same chain, in vertices.
void check_spacing(const Chain& chain, std::vector<uint32_t> samples) {
    const auto vertices = static_cast<uint32_t>(chain.positions.size());
    REQUIRE(!samples.empty());
    if (chain.is_closed) {
        samples.push_back(samples.front() + vertices);
    } else {
        CHECK(samples.front() == chain.positions.front());
        CHECK(samples.back() == chain.positions.back());
    }
    uint32_t shortest = NONE, longest = 0;
    for (size_t i = 0; i + 1 < samples.size(); ++i) {
        shortest = std::min(shortest, samples[i + 1] - samples[i]);
        longest = std::max(longest, samples[i + 1] - samples[i]);
    }
    if (samples.size() < 2) return;
    CHECK(longest - shortest <= 1);
    CHECK(longest <= 7);
}

}

TEST_CASE("samples: on the border, evenly spaced along each chain, the ends of open ones among them") {
    uint32_t open_chains = 0, closed_chains = 0;
    for (const OverlayOf& of : built()) {
        const OverlayIndex& overlay = of.overlay();
        for (uint32_t p = 1; p < overlay.numbering.patch_count(); ++p) {
            const auto samples = overlay.pairs.samples.of(p);
            const uint32_t size = overlay.numbering.border_size(p);
            CHECK(std::ranges::is_sorted(samples, std::less_equal<>()));
            CHECK(samples.size() >= std::min(size, 64u));
            for (const Chain& chain : chains_of_ring(overlay.rings, p)) {
                std::vector<uint32_t> of_chain;
                for (const uint32_t sample : samples)
                    if (sample >= chain.positions.front() && sample <= chain.positions.back())
                        of_chain.push_back(sample);
                check_spacing(chain, of_chain);
                if (of_chain.size() == chain.positions.size()) continue;
                ++(chain.is_closed ? closed_chains : open_chains);
            }
            if (size > 0) CHECK(samples.back() < size);
        }
    }
    CHECK(open_chains > 0);
    CHECK(closed_chains > 0);
}

TEST_CASE("samples: as many as are foreseen") {
    for (const OverlayOf& of : built()) {
        const OverlayIndex& overlay = of.overlay();
        for (uint32_t p = 0; p < overlay.numbering.patch_count(); ++p) {
            const SampleCount count = count_samples(overlay, p);
            CHECK(count.samples == overlay.pairs.samples.of(p).size());
            CHECK(count.places == overlay.pairs.samples.rings.size(p));
        }
    }
}

TEST_CASE("samples: a place of a coarse ring names its vertex, its sample and its place among all") {
    for (const OverlayOf& of : built()) {
        const OverlayIndex& overlay = of.overlay();
        const Rings& coarse = overlay.pairs.samples.rings;
        for (uint32_t p = 1; p < overlay.numbering.patch_count(); ++p) {
            std::vector<uint32_t> own_places(overlay.pairs.samples.of(p).size(), 0);
            for (uint32_t k = coarse.begin[p]; k < coarse.begin[p + 1]; ++k) {
                const uint32_t full = overlay.pairs.samples.full_place[k];
                const uint32_t sample = overlay.pairs.samples.sample_of_place[k];
                REQUIRE(sample < own_places.size());
                CHECK(overlay.pairs.samples.of(p)[sample] == coarse.position[k]);
                CHECK(overlay.rings.vertex[full] == overlay.numbering.border_of(p)[coarse.position[k]]);
                CHECK(overlay.rings.is_own[full] == -1);
                if (coarse.is_own[k]) ++own_places[sample];
            }
            for (const uint32_t count : own_places) CHECK(count == 1);
        }
    }
}

TEST_CASE("samples: a coarse segment is a straight line on a plane, but for steps and calibration") {
    const OverlayOf& of = built().front();
    const OverlayIndex& overlay = of.overlay();
    const Rings& coarse = overlay.pairs.samples.rings;
    const auto ids = ids_by_number(of.index);
    const auto id_at = [&](uint32_t k) {
        return ids[overlay.rings.vertex[overlay.pairs.samples.full_place[k]]];
    };
    uint32_t segments = 0;
    for (uint32_t k = coarse.begin[1]; k < coarse.begin[3]; ++k) {
        if (std::isnan(coarse.segment_length[k])) continue;
        const double line = strip().straight(id_at(k), id_at(k + 1));
        CHECK(std::abs(double{coarse.segment_length[k]} - line) <=
              0.51 * double{overlay.quantum[0]} + 0.02 * line);
        ++segments;
    }
    CHECK(segments > 50);
}

TEST_CASE("samples: their tables are rows of the tables of all, for the samples of parent and children") {
    uint64_t entries = 0, wrong = 0;
    for (const OverlayOf& of : built()) {
        const OverlayIndex& overlay = of.overlay();
        const Numbering& numbering = overlay.numbering;
        const Samples& samples = overlay.pairs.samples;
        for (uint32_t p = 1; p < numbering.patch_count(); ++p) {
            const uint32_t parent = numbering.parent[p], places = samples.rings.size(p);
            const size_t end = parent + 1 < numbering.first_leaf() ? samples.row_begin[parent + 1]
                                                                   : samples.row_position.size();
            const size_t rows = end - samples.row_begin[parent];
            const auto overlay_position = [&](uint32_t position) {
                return numbering.overlay_position[numbering.border_begin[p] + position];
            };
            for (uint32_t i = 0; i < samples.of(p).size(); ++i)
                wrong += samples.row_position[samples.row_begin[parent] + samples.first_row[p] + i] !=
                         overlay_position(samples.of(p)[i]);
            if (places == overlay.rings.size(p)) continue; // all vertices are samples
            for (size_t row = 0; row < rows; ++row)
                for (uint32_t k = 0; k < places; ++k) {
                    const uint32_t from = samples.row_position[samples.row_begin[parent] + row];
                    const uint32_t to = overlay_position(samples.rings.position[samples.rings.begin[p] + k]);
                    wrong += samples.tables[samples.table_begin[p] + row * places + k] !=
                             overlay.overlay_code(parent, from, to);
                    ++entries;
                }
        }
    }
    CHECK(wrong == 0);
    CHECK(entries > 1000);
}
