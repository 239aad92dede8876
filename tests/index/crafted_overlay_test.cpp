// Index files of the overlay engine with right checksums and wrong content.

#include <cstring>
#include <functional>

#include "format/bytes.h"
#include "format/container.h"
#include "src/file/folded_triangle.h"
#include "src/file/sections.h"
#include "tests/capi/calls.h"
#include "tests/capi/refusals.h"
#include "tests/index/told_issues.h"
#include "tests/support/copied_matrices.h"

using namespace geodesic;
using namespace geodesic::test;

namespace {

// With one level: one overlay table, among all border vertices.
const Bytes& original_file() {
    static const Bytes file = [] {
        auto options = build_options(GEOIDX_METRIC_EXACT, 1);
        options.engine = GEOIDX_ENGINE_OVERLAY;
        options.rounding = 0; // every code is allowed
        return save(build(hills(9, 8), options).get(), GEOIDX_CODEC_LOSSLESS);
    }();
    return file;
}

using Change = std::function<void(Bytes&)>;

// The raw bytes of a section, or of the one folded triangle that it holds.
Bytes raw_bytes(const format::Container& container, uint32_t tag, uint32_t folded_size) {
    if (folded_size == 0) return container.read_bytes(tag, UINT64_MAX);
    const FoldedShape shape = folded_shape(folded_size);
    Bytes raw(size_t{shape.rows} * shape.cols * sizeof(float));
    std::vector<float> values(raw.size() / sizeof(float));
    const format::MatrixTarget target{values, shape.rows, shape.cols};
    container.read_matrices(tag, {&target, 1});
    std::memcpy(raw.data(), values.data(), raw.size());
    return raw;
}

// The file with the raw form of one section changed, or left out where nothing is left of it. All other
// sections are as they were.
Bytes with(uint32_t changed, const Change& change) {
    const auto container = format::Container::parse(original_file(), INDEX_TAGS);
    const auto index = open(original_file());
    const auto border_vertices = static_cast<uint32_t>(info_of(index.get()).border_vertex_count);
    format::ContainerWriter writer(container.mesh_fingerprint());
    for (const format::Section& section : container.sections()) {
        if (section.tag == changed) {
            Bytes raw = raw_bytes(container, changed, changed == TAG_OVERLAY_TABLES ? border_vertices : 0);
            change(raw);
            if (!raw.empty()) writer.add_raw(changed, raw);
        } else if (section.codec == format::Codec::Png) {
            copy_images(container, original_file(), section, writer);
        } else {
            writer.add_bytes(section.tag, container.read_bytes(section.tag, UINT64_MAX));
        }
    }
    return writer.finish();
}

template <class T>
Change set(size_t position, T value) {
    return [=](Bytes& raw) { std::memcpy(raw.data() + position * sizeof value, &value, sizeof value); };
}

void check_corrupt(const std::string& what, uint32_t tag, const Change& change) {
    CAPTURE(what);
    const Bytes file = with(tag, change);
    CHECK(open_status(file) == GEOIDX_ERROR_CORRUPT);
    CHECK(geoidx_verify(file.data(), file.size(), nullptr, nullptr) == GEOIDX_ERROR_CORRUPT);
}

}

TEST_CASE("crafted overlay: unchanged parts make an index that opens") {
    for (uint32_t tag : {TAG_QUANTA, TAG_SEGMENTS, TAG_OVERLAY_TABLES})
        CHECK(open_status(with(tag, [](Bytes&) {})) == GEOIDX_OK);
}

TEST_CASE("crafted overlay: a section that is missing, too short or too long") {
    for (uint32_t tag : {TAG_QUANTA, TAG_SEGMENTS, TAG_OVERLAY_TABLES}) {
        check_corrupt("missing", tag, [](Bytes& raw) { raw.clear(); });
        check_corrupt("too short", tag, [](Bytes& raw) { raw.resize(raw.size() - 4); });
        check_corrupt("too long", tag, [](Bytes& raw) { raw.resize(raw.size() + 4); });
    }
}

TEST_CASE("crafted QUAN") {
    for (float quantum : {-1.0f, -1e-30f, -0.0f, INFINITE, -INFINITE, NOT_A_NUMBER})
        for (size_t patch : {size_t{0}, size_t{3}}) check_corrupt("quantum", TAG_QUANTA, set(patch, quantum));
}

TEST_CASE("crafted SEGM") {
    const auto container = format::Container::parse(original_file(), INDEX_TAGS);
    const size_t slots = raw_bytes(container, TAG_SEGMENTS, 0).size() / 8;
    const Bytes raw = raw_bytes(container, TAG_SEGMENTS, 0);
    const auto next = [&](size_t slot) {
        uint32_t value;
        std::memcpy(&value, raw.data() + slot * sizeof value, sizeof value);
        return value;
    };
    REQUIRE(next(0) == 1);
    REQUIRE(next(1) == 2);
    check_corrupt("to itself", TAG_SEGMENTS, set(0, uint32_t{0}));
    check_corrupt("beyond the border", TAG_SEGMENTS, set(0, uint32_t{100000}));
    check_corrupt("two to one", TAG_SEGMENTS, set(0, uint32_t{2}));
    for (float length : {0.0f, -1.0f, INFINITE, NOT_A_NUMBER})
        check_corrupt("length", TAG_SEGMENTS, set(slots, length));
}

TEST_CASE("crafted SEGM: bridges") {
    struct Stored {
        uint32_t begin, end;
        float length;
    };
    const auto added = [](const std::vector<Stored>& bridges) {
        return [=](Bytes& raw) {
            const auto bytes = std::as_bytes(std::span(bridges));
            raw.insert(raw.end(), bytes.begin(), bytes.end());
        };
    };
    CHECK(open_status(with(TAG_SEGMENTS, added({{0, 3, 1.5f}, {0, 5, 1}, {2, 4, 1}}))) == GEOIDX_OK);
    for (float length : {0.0f, -1.0f, INFINITE, NOT_A_NUMBER})
        check_corrupt("length", TAG_SEGMENTS, added({{0, 3, 1}, {0, 5, length}}));
    check_corrupt("back", TAG_SEGMENTS, added({{3, 0, 1}}));
    check_corrupt("to itself", TAG_SEGMENTS, added({{3, 3, 1}}));
    check_corrupt("beyond the border", TAG_SEGMENTS, added({{0, 100000, 1}}));
    check_corrupt("from no position", TAG_SEGMENTS, added({{100000000, 3, 1}}));
    check_corrupt("one twice", TAG_SEGMENTS, added({{0, 3, 1}, {0, 3, 1}}));
    check_corrupt("other ends out of order", TAG_SEGMENTS, added({{0, 5, 1}, {0, 3, 1}}));
    check_corrupt("beginnings out of order", TAG_SEGMENTS, added({{2, 4, 1}, {0, 3, 1}}));
    check_corrupt("very many", TAG_SEGMENTS, added(std::vector<Stored>(100000, {0, 3, 1})));
    check_told(with(TAG_SEGMENTS, added({{0, 3, -1.0f}})), 110, "SEGM");
    check_told(with(TAG_SEGMENTS, added({{3, 0, 1}})), 110, "SEGM");
}

// On the border of the first patch, which is a leaf, three vertices that a chain joins again and again. Edges
// lead from these to other vertices of the border: a walk along it ends where it began.
TEST_CASE("crafted SEGM: points beside a closed chain of tiny segments") {
    const TestMesh mesh = hills(9, 8);
    const auto tiny = [](Bytes& raw) {
        const size_t slots = raw.size() / 8;
        std::vector<uint32_t> next(slots, NONE);
        std::vector<float> length(slots, 0);
        for (uint32_t i = 0; i < 3; ++i) {
            next[i] = (i + 1) % 3;
            length[i] = 1e-45f;
        }
        std::memcpy(raw.data(), next.data(), 4 * slots);
        std::memcpy(raw.data() + 4 * slots, length.data(), 4 * slots);
    };
    const auto index = open(with(TAG_SEGMENTS, tiny));
    const geoidx_mesh view = mesh.view();
    geoidx_surface* made = nullptr;
    require_success(geoidx_surface_create(&view, nullptr, &made));
    const SurfaceHandle surface(made);
    const auto query = query_of(index.get());
    std::vector<float> distances(mesh.vertex_count());
    for (uint32_t triangle = 0; triangle < mesh.triangle_count(); ++triangle) {
        const geoidx_surface_point source{triangle, 0, {0.2, 0.3, 0.5}};
        CHECK(geoidx_query_point_msad(query.get(), surface.get(), &source, 1, nullptr, distances.data(),
                                      mesh.vertex_count()) == GEOIDX_OK);
    }
}

TEST_CASE("crafted OVOV") {
    for (float code : {0.5f, -1.0f, 32767.0f, 65536.0f, 1e30f, 1e-30f, NOT_A_NUMBER, -INFINITE})
        for (size_t entry : {size_t{0}, size_t{5}}) {
            CAPTURE(code);
            check_corrupt("code", TAG_OVERLAY_TABLES, set(entry, code));
        }
    CHECK(open_status(with(TAG_OVERLAY_TABLES, set(0, 32766.0f))) == GEOIDX_OK);
    CHECK(open_status(with(TAG_OVERLAY_TABLES, set(0, INFINITE))) == GEOIDX_OK);
}

// Numbers are those of SPEC.md.
TEST_CASE("crafted overlay: wrong content is told by the number of its section, where the section begins") {
    check_told(with(TAG_QUANTA, set(0, -1.0f)), 109, "QUAN");
    check_told(with(TAG_QUANTA, [](Bytes& raw) { raw.pop_back(); }), 109, "QUAN");
    check_told(with(TAG_QUANTA, [](Bytes& raw) { raw.push_back(std::byte{0}); }), 109, "QUAN");
    const auto container = format::Container::parse(original_file(), INDEX_TAGS);
    const size_t slots = raw_bytes(container, TAG_SEGMENTS, 0).size() / 8;
    check_told(with(TAG_SEGMENTS, set(slots, 0.0f)), 110, "SEGM");
    check_told(with(TAG_SEGMENTS, set(0, uint32_t{0})), 110, "SEGM"); // a segment to itself
    check_told(with(TAG_SEGMENTS, [](Bytes& raw) { raw.pop_back(); }), 110, "SEGM");
    check_told(with(TAG_OVERLAY_TABLES, set(0, 0.5f)), 111, "OVOV");
    check_told(with(TAG_OVERLAY_TABLES, set(0, -1.0f)), 111, "OVOV");
    check_told(with(TAG_OVERLAY_TABLES, [](Bytes& raw) { raw.resize(raw.size() - 4); }), 111, "OVOV");
    const auto missing = told_issues(with(TAG_SEGMENTS, [](Bytes& raw) { raw.clear(); }));
    REQUIRE(missing.size() == 1);
    CHECK(missing[0].number == 110);
    CHECK(missing[0].offset == 0);
}
