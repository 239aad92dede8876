// The rows of labels in memory: codes in one byte a place.
#include "src/overlay/sssd/label_rows.h"

#include <algorithm>
#include <random>

#include "tests/overlay/overlay_of.h"

using namespace geodesic;
using namespace geodesic::test;

namespace {

using Codes = std::vector<uint16_t>;

// What is read of a row that was written, of which nothing else is known but its size.
Codes there_and_back(const Codes& codes, const Codes& runs) {
    const size_t size = label_row_size(codes.size(), runs.size());
    std::vector<uint8_t> row(size + LABEL_ROW_PADDING, 0xee);
    write_label_row(codes, runs, row.data());
    CHECK(std::all_of(row.begin() + static_cast<ptrdiff_t>(size), row.end(),
                      [](uint8_t byte) { return byte == 0xee; }));
    Codes read(codes.size() + LABEL_ROW_PADDING);
    read_label_row(row.data(), runs, codes.size(), read.data());
    read.resize(codes.size());
    return read;
}

// Codes that change by up to so many steps from one place to the next, and by any number where a run begins.
Codes random_codes(size_t places, const Codes& runs, int most, uint32_t seed) {
    std::mt19937 random(seed);
    Codes codes(places);
    for (size_t place = 0; place < places; ++place) {
        const bool begins = std::ranges::binary_search(runs, place);
        const int step = static_cast<int>(random() % static_cast<uint32_t>(2 * most + 1)) - most;
        codes[place] = static_cast<uint16_t>(
            begins ? random() % 32767 : static_cast<uint32_t>(std::clamp(codes[place - 1] + step, 0, 32766)));
    }
    return codes;
}

}

TEST_CASE("label rows: what is written is read, for runs of all lengths") {
    uint32_t different = 0, seed = 0;
    for (size_t places = 1; places < 80; ++places)
        for (size_t apart = 1; apart < 30; ++apart) {
            Codes runs;
            for (size_t first = 0; first < places; first += apart)
                runs.push_back(static_cast<uint16_t>(first));
            const Codes codes = random_codes(places, runs, 127, ++seed);
            different += there_and_back(codes, runs) != codes;
        }
    CHECK(different == 0);
}

TEST_CASE("label rows: steps of up to 127 fit") {
    for (const int step : {127, -127}) {
        const Codes codes{500, static_cast<uint16_t>(500 + step), 500};
        CHECK(there_and_back(codes, {0}) == codes);
    }
    CHECK(there_and_back({500, 628, 628}, {0}) == Codes{500, 627, 628});
    CHECK(there_and_back({500, 372, 372}, {0}) == Codes{500, 373, 372});
}

TEST_CASE("label rows: one byte a place, and two more where a run begins; or two bytes a place") {
    CHECK(label_row_size(300, 1) == 302);
    CHECK(label_row_size(300, 40) == 380);
    CHECK(label_row_size(300, 300) == 600);
}

TEST_CASE("label rows: a step that does not fit is made up by those after it") {
    Codes codes(40, 1000);
    std::fill(codes.begin() + 10, codes.begin() + 25, uint16_t{1400});
    std::fill(codes.begin() + 25, codes.end(), uint16_t{900});
    const Codes read = there_and_back(codes, {0});
    for (size_t place = 0; place < codes.size(); ++place) {
        const bool is_behind_a_jump = (place >= 10 && place < 13) || (place >= 25 && place < 28);
        CHECK((read[place] == codes[place]) != is_behind_a_jump);
    }
}

TEST_CASE("label rows: no path stays none, and takes the rest of its run with it") {
    Codes codes(30, TableCode::UNREACHED);
    CHECK(there_and_back(codes, {0}) == codes);
    std::fill(codes.begin() + 12, codes.begin() + 20, uint16_t{77});
    CHECK(there_and_back(codes, {0, 12, 20}) == codes);
    CHECK(there_and_back(codes, {0, 20}) == Codes(30, TableCode::UNREACHED));
}

TEST_CASE("label rows: runs begin with each bridge") {
    static const TestMesh mesh = pages(5, 10, 16);
    const OverlayOf made(mesh, options_of_plane(mesh, {4, 3}));
    const Rings& rings = made.overlay().rings;
    size_t bridges = 0;
    for (uint32_t patch = 1; patch < made.overlay().numbering.patch_count(); ++patch) {
        Array<uint16_t> runs(std::pmr::get_default_resource());
        const float longest = 124 * find_runs(rings, patch, runs);
        CHECK(std::ranges::is_sorted(runs));
        for_each_bridge(rings, patch, [&](uint32_t place, float length) {
            CHECK(std::ranges::binary_search(runs, place - rings.begin[patch]));
            const bool is_long = length > longest * 1.0001f;
            CHECK((!is_long || std::ranges::binary_search(runs, place + 1 - rings.begin[patch])));
            ++bridges;
        });
    }
    CHECK(bridges > 10);
}

TEST_CASE("label rows: runs begin with each chain and behind long segments, of which there are few") {
    static const TestMesh mesh = hills(30, 24);
    const OverlayOf made(mesh, options_of_plane(mesh, {3, 3}));
    const Rings& rings = made.overlay().rings;
    size_t longer_of_all = 0;
    for (uint32_t patch = 1; patch < made.overlay().numbering.patch_count(); ++patch) {
        const uint32_t ring = rings.begin[patch];
        Array<uint16_t> runs(std::pmr::get_default_resource());
        const float longest = 124 * find_runs(rings, patch, runs);
        CHECK(std::ranges::is_sorted(runs));
        size_t chains = 0, segments = 0, longer = 0;
        for (const auto& chain : rings.chains_of(patch)) {
            CHECK(std::ranges::binary_search(runs, chain.first - Rings::REACH - ring));
            ++chains;
        }
        for (uint32_t place = ring; place < rings.begin[patch + 1]; ++place) {
            if (std::isnan(rings.segment_length[place])) continue;
            const bool is_long = rings.segment_length[place] > longest * 1.0001f;
            if (is_long) CHECK(std::ranges::binary_search(runs, place + 1 - ring));
            segments += rings.is_own[place] != 0;
            longer += rings.is_own[place] != 0 && is_long;
        }
        CHECK(longer <= segments / 16);
        longer_of_all += longer;
        // Two places at each end of a closed chain repeat segments.
        CHECK(runs.size() <= chains + longer + 4 * chains);
    }
    CHECK(longer_of_all > 0);
}
