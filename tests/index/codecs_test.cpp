// The forms of a file: they hold the same, and what a packed one cannot hold is refused.

#include <algorithm>
#include <array>
#include <cstring>
#include <functional>
#include <map>
#include <random>
#include <tuple>

#include "format/container.h"
#include "src/file/index_file.h"
#include "src/file/sections.h"
#include "src/overlay/tables/codes.h"
#include "tests/capi/calls.h"
#include "tests/capi/refusals.h"
#include "tests/index/changed_section.h"
#include "tests/index/forms.h"
#include "tests/index/told_issues.h"
#include "tests/support/sanitized.h"

using namespace geodesic;
using namespace geodesic::test;

namespace {

StoredIndex stored_in(const Bytes& file) {
    return read_index(format::Container::parse(file, INDEX_TAGS), {.threads = 2});
}

Bytes file_of(StoredIndex stored, uint32_t codec) {
    stored.description.codec = codec;
    return write_index(stored);
}

// A mesh with so many entries that they are rounded, and a part that no path leads to.
const StoredIndex& rounded() {
    static const StoredIndex stored = [] {
        TestMesh mesh = torus(44, 26);
        append(mesh, hills(14, 13), 9);
        auto options = build_options(GEOIDX_METRIC_EXACT);
        options.engine = GEOIDX_ENGINE_OVERLAY;
        options.level_count = 0;
        return stored_in(save(build(mesh, options).get()));
    }();
    return stored;
}

void check_same_codes(const StoredIndex& a, const StoredIndex& b) {
    CHECK(a.shift == b.shift);
    CHECK(a.quantum == b.quantum);
    CHECK(a.position_step == b.position_step);
    CHECK(a.positions == b.positions);
    CHECK(a.overlay_codes == b.overlay_codes);
    CHECK(a.border_internal_codes == b.border_internal_codes);
    CHECK(a.internal_codes == b.internal_codes);
}

// The packed file with the raw bytes of one section of tables changed.
geoidx_status status_with(uint32_t changed, const std::function<void(Bytes&)>& change) {
    const Bytes bytes = with_changed_section(file_of(rounded(), GEOIDX_CODEC_PACKED), changed, change);
    geoidx* index = nullptr;
    const geoidx_status status = geoidx_open_memory(bytes.data(), bytes.size(), nullptr, &index);
    geoidx_close(index);
    if (status == GEOIDX_OK) {
        CHECK(told_issues(bytes).empty());
    } else {
        for (const auto& [tag, number, name] :
             {std::tuple(TAG_BORDER_INTERNAL_TABLES, 107u, "BVIV"),
              std::tuple(TAG_INTERNAL_TABLES, 108u, "IVIV"), std::tuple(TAG_OVERLAY_TABLES, 111u, "OVOV")})
            if (tag == changed) check_told(bytes, number, name);
    }
    return status;
}

size_t entries_in(uint32_t tag) {
    if (tag == TAG_OVERLAY_TABLES) return rounded().overlay_codes.size();
    return tag == TAG_INTERNAL_TABLES ? rounded().internal_codes.size()
                                      : rounded().border_internal_codes.size();
}

constexpr std::array TABLES{TAG_OVERLAY_TABLES, TAG_BORDER_INTERNAL_TABLES, TAG_INTERNAL_TABLES};

}

TEST_CASE("codecs: packed and lossless files hold the same codes" * doctest::skip(SANITIZED)) {
    REQUIRE(std::ranges::count(rounded().shift, 0) < std::ssize(rounded().shift));
    const Bytes packed = file_of(rounded(), GEOIDX_CODEC_PACKED);
    const Bytes lossless = file_of(rounded(), GEOIDX_CODEC_LOSSLESS);
    check_same_codes(stored_in(packed), rounded());
    check_same_codes(stored_in(lossless), rounded());
    CHECK(file_of(stored_in(lossless), GEOIDX_CODEC_PACKED) == packed);
    CHECK(file_of(stored_in(packed), GEOIDX_CODEC_LOSSLESS) == lossless);
    CHECK(packed.size() < lossless.size() / 2);
}

TEST_CASE("codecs: an index answers the same bits, whatever the form of its file" *
          doctest::skip(SANITIZED)) {
    for (const NamedMesh& of : mesh_zoo())
        for (uint32_t metric : {GEOIDX_METRIC_EXACT, GEOIDX_METRIC_EDGES})
            for (uint32_t levels : {0u, 1u, 3u}) {
                CAPTURE(of.name);
                CAPTURE(metric);
                CAPTURE(levels);
                auto options = build_options(metric, levels);
                options.engine = GEOIDX_ENGINE_OVERLAY;
                const auto built = shared_index(of.mesh, options);
                std::map<uint32_t, Bytes> files; // per codec
                for (uint32_t codec : CODECS) files[codec] = save(built.get(), codec);
                for (uint32_t codec : CODECS) {
                    const Bytes& file = files[codec];
                    const auto opened = open(file);
                    CHECK(info_of(opened.get()).codec == codec);
                    CHECK(geoidx_verify(file.data(), file.size(), nullptr, nullptr) == GEOIDX_OK);
                    for (uint32_t other : CODECS) CHECK(save(opened.get(), other) == files[other]);
                    check_same_answers(opened.get(), built.get(), of.mesh.vertex_count());
                }
            }
}

TEST_CASE("codecs: the graph engine has one form") {
    const auto built = shared_index(hills(18, 18), build_options(GEOIDX_METRIC_EXACT, 2));
    CHECK(info_of(built.get()).codec == GEOIDX_CODEC_LOSSLESS);
    for (uint32_t codec : CODECS) {
        CHECK(save(built.get(), codec) == save(built.get(), GEOIDX_CODEC_LOSSLESS));
        CHECK(info_of(open(save(built.get(), codec)).get()).codec == GEOIDX_CODEC_LOSSLESS);
    }
}

TEST_CASE("codecs: packed files hold any codes, however far from their prediction") {
    StoredIndex stored = rounded();
    std::mt19937_64 random(5);
    for (uint8_t& shift : stored.shift) shift = static_cast<uint8_t>(random() % (TableCode::MOST_SHIFT + 1));
    for (float& quantum : stored.quantum) quantum = std::array{0.f, 1e-45f, 1e-3f, 1.f, 3e38f}[random() % 5];
    // The least shift of all is enough for multiples of any.
    for (auto* codes : {&stored.overlay_codes, &stored.border_internal_codes, &stored.internal_codes})
        for (uint16_t& code : *codes)
            code = random() % 5 == 0 ? TableCode::UNREACHED
                                     : static_cast<uint16_t>(random() % 2 << TableCode::MOST_SHIFT);
    check_same_codes(stored_in(file_of(stored, GEOIDX_CODEC_PACKED)), stored);
    std::ranges::fill(stored.shift, uint8_t{0});
    for (auto* codes : {&stored.overlay_codes, &stored.border_internal_codes, &stored.internal_codes})
        for (uint16_t& code : *codes) code = static_cast<uint16_t>(random() % (TableCode::LARGEST + 1));
    check_same_codes(stored_in(file_of(stored, GEOIDX_CODEC_PACKED)), stored);
}

TEST_CASE("codecs: rounded distances are multiples of what the index says, and right to half of it" *
          doctest::skip(SANITIZED)) {
    TestMesh mesh = torus(70, 40);
    auto options = build_options(GEOIDX_METRIC_EXACT);
    options.engine = GEOIDX_ENGINE_OVERLAY;
    options.level_count = 0;
    options.rounding = 0;
    const auto fine = shared_index(mesh, options);
    options.rounding = 1.0 / 16;
    const auto coarse = shared_index(mesh, options);
    CHECK(info_of(coarse.get()).largest_step > 4 * info_of(fine.get()).largest_step);
    CHECK(info_of(coarse.get()).smallest_step > info_of(fine.get()).smallest_step);
    CHECK(save(coarse.get()).size() < save(fine.get()).size() * 3 / 4);
    // Hops round once a level, up and down.
    const double tolerance = 8 * info_of(coarse.get()).largest_step;
    const uint32_t count = mesh.vertex_count();
    for (uint32_t source : {0u, 1000u, count - 1}) {
        const auto expected = msad(fine.get(), source, count), found = msad(coarse.get(), source, count);
        uint64_t wrong = 0;
        for (uint32_t v = 0; v < count; ++v)
            wrong += std::abs(double{expected[v]} - double{found[v]}) > tolerance;
        CHECK(wrong == 0);
    }
}

TEST_CASE("codecs: an index of few entries is not rounded") {
    const TestMesh mesh = hills(18, 18);
    auto options = build_options(GEOIDX_METRIC_EXACT, 2);
    options.engine = GEOIDX_ENGINE_OVERLAY;
    const Bytes by_default = save(build(mesh, options).get());
    options.rounding = 0;
    CHECK(save(build(mesh, options).get()) == by_default);
}

TEST_CASE("codecs: damaged residuals are refused") {
    for (const uint32_t tag : TABLES) {
        CHECK(status_with(tag, [](Bytes&) {}) == GEOIDX_OK);
        CHECK(status_with(tag, [](Bytes& raw) { raw.pop_back(); }) == GEOIDX_ERROR_CORRUPT);
        CHECK(status_with(tag, [](Bytes& raw) { raw.push_back({}); }) == GEOIDX_ERROR_CORRUPT);
        CHECK(status_with(tag, [](Bytes& raw) { raw.resize(raw.size() + 2); }) == GEOIDX_ERROR_CORRUPT);
        CHECK(status_with(tag, [](Bytes& raw) { raw.clear(); }) == GEOIDX_ERROR_CORRUPT);
        // An entry far off without its two bytes, and entries below 0.
        CHECK(status_with(tag, [](Bytes& raw) { raw[0] = std::byte{0x80}; }) == GEOIDX_ERROR_CORRUPT);
        CHECK(status_with(tag, [](Bytes& raw) { std::ranges::fill(raw, std::byte{0x81}); }) ==
              GEOIDX_ERROR_CORRUPT);
        // Far off, and its two bytes say no path, or more than a code can be. Behind it, entries are
        // predicted from it, so that the others are far off, too.
        const auto all_far_off = [&](Bytes& raw, uint16_t first) {
            const size_t entries = entries_in(tag);
            raw.assign(3 * entries, std::byte{0});
            std::fill_n(raw.begin(), entries, std::byte{0x80});
            std::memcpy(raw.data() + entries, &first, sizeof first);
        };
        CHECK(status_with(tag, [&](Bytes& raw) { all_far_off(raw, 0xffff); }) == GEOIDX_OK);
        CHECK(status_with(tag, [&](Bytes& raw) { all_far_off(raw, 0xfffe); }) == GEOIDX_ERROR_CORRUPT);
        CHECK(status_with(tag, [&](Bytes& raw) { all_far_off(raw, 0x7fff); }) == GEOIDX_ERROR_CORRUPT);
    }
}

TEST_CASE("codecs: save options are checked, and NULL means the form of the file that was opened") {
    const auto built = shared_index(hills(18, 18), build_options(GEOIDX_METRIC_EXACT, 2));
    geoidx_save_options options;
    geoidx_save_options_init(&options);
    options.codec = 3;
    uint64_t size = 0;
    check_refused(geoidx_save_memory(built.get(), &options, nullptr, 0, &size), GEOIDX_ERROR_INVALID_ARGUMENT,
                  "codec");
    check_refused(geoidx_save(built.get(), "/tmp/never-written.gidx", &options),
                  GEOIDX_ERROR_INVALID_ARGUMENT, "codec");
    auto overlay = build_options(GEOIDX_METRIC_EXACT, 2);
    overlay.engine = GEOIDX_ENGINE_OVERLAY;
    const auto index = shared_index(hills(18, 18), overlay);
    const Bytes lossless = save(index.get(), GEOIDX_CODEC_LOSSLESS);
    const auto opened = open(lossless);
    require_success(geoidx_save_memory(opened.get(), nullptr, nullptr, 0, &size));
    Bytes again(size);
    require_success(geoidx_save_memory(opened.get(), nullptr, again.data(), size, &size));
    CHECK(again == lossless);
}

TEST_CASE("sections: those of the file, none of an index that was built") {
    const auto built = shared_index(hills(18, 18), build_options(GEOIDX_METRIC_EXACT, 2));
    uint32_t count = 99;
    require_success(geoidx_get_sections(built.get(), nullptr, 0, &count));
    CHECK(count == 0);
    const Bytes file = save(built.get());
    const auto opened = open(file);
    require_success(geoidx_get_sections(opened.get(), nullptr, 0, &count));
    CHECK(count == 8);
    std::vector<geoidx_section> sections(count + 1);
    sections[3].raw_size = 12345;
    require_success(geoidx_get_sections(opened.get(), sections.data(), 3, &count));
    CHECK(sections[3].raw_size == 12345);
    require_success(geoidx_get_sections(opened.get(), sections.data(), count + 1, &count));
    CHECK(std::string(sections[0].tag) == "META");
    CHECK(sections[0].raw_size == 184);
    uint64_t end = 48 + 48 * uint64_t{count};
    for (uint32_t i = 0; i < count; ++i) {
        CHECK(sections[i].offset == (end + 63) / 64 * 64);
        end = sections[i].offset + sections[i].stored_size;
    }
    CHECK(end == file.size());
    check_refused(geoidx_get_sections(nullptr, nullptr, 0, &count), GEOIDX_ERROR_INVALID_ARGUMENT, "index");
    check_refused(geoidx_get_sections(built.get(), nullptr, 1, &count), GEOIDX_ERROR_INVALID_ARGUMENT,
                  "sections");
    check_refused(geoidx_get_sections(built.get(), nullptr, 0, nullptr), GEOIDX_ERROR_INVALID_ARGUMENT,
                  "count");
}
