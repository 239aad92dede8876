// Indices that keep the mesh: the surface made of it answers as one of the caller's mesh does, bit for bit,
// in each form of the file, and what is wrong with the section is found.
#include <array>
#include <cstring>
#include <functional>
#include <optional>
#include <random>

#include "format/bytes.h"
#include "src/file/sections.h"
#include "tests/capi/calls.h"
#include "tests/capi/counting_allocator.h"
#include "tests/capi/refusals.h"
#include "tests/index/changed_section.h"
#include "tests/index/forms.h"
#include "tests/index/told_issues.h"
#include "tests/support/sanitized.h"
#include "tests/support/temporary_directory.h"

using namespace geodesic;
using namespace geodesic::test;

namespace {

geoidx_build_options keeping_options(uint32_t engine = GEOIDX_ENGINE_OVERLAY, double weld_tolerance = 0) {
    auto options = build_options(GEOIDX_METRIC_EXACT, 2);
    options.engine = engine;
    options.weld_tolerance = weld_tolerance;
    options.store_mesh = 1;
    return options;
}

IndexHandle build_of(const geoidx_mesh& mesh, const geoidx_build_options& options) {
    geoidx* index = nullptr;
    require_success(geoidx_build(&mesh, &options, &index));
    return IndexHandle(index);
}

SurfaceHandle surface_of(const geoidx_mesh& mesh, double weld_tolerance = 0) {
    geoidx_surface_options options;
    geoidx_surface_options_init(&options);
    options.weld_tolerance = weld_tolerance;
    geoidx_surface* surface = nullptr;
    require_success(geoidx_surface_create(&mesh, &options, &surface));
    return SurfaceHandle(surface);
}

SurfaceHandle surface_of(const geoidx* index) {
    geoidx_surface* surface = nullptr;
    require_success(geoidx_surface_of_index(index, nullptr, &surface));
    REQUIRE(surface != nullptr);
    return SurfaceHandle(surface);
}

geoidx_status status_of_surface(const geoidx* index) {
    geoidx_surface* surface = nullptr;
    const geoidx_status status = geoidx_surface_of_index(index, nullptr, &surface);
    const SurfaceHandle owned(surface);
    CHECK((status == GEOIDX_OK) == (surface != nullptr));
    return status;
}

// ---- Meshes that intake has something to do with

// Parts, vertices that no triangle uses, a seam whose sides are welded, triangles that are degenerate, there
// twice, or degenerate once welded, negative zeros.
TestMesh untidy_mesh() {
    TestMesh mesh = components_and_unused();
    append(mesh, seam(9, 8), 400);
    const uint32_t first = 1; // of the hills
    mesh.add_triangle(first, first, first + 1);
    mesh.add_triangle(first + 14 + 1, first + 1, first); // there already, from another corner
    mesh.add_triangle(first + 1, first, first + 14 + 1);
    const uint32_t x = mesh.add_vertex(-0.0, 70, -0.0), y = mesh.add_vertex(0.0, 70, 0.0);
    mesh.add_triangle(x, y, first); // two corners at one place
    const uint32_t a = mesh.add_vertex(500, 0, 0), b = mesh.add_vertex(500, 0, 0);
    mesh.add_triangle(a, b, mesh.add_vertex(501, 0, 0)); // of vertices that no other uses
    mesh.add_vertex(mesh.positions[3], mesh.positions[4], mesh.positions[5]); // unused, at a used one's place
    std::swap(mesh.triangles[0], mesh.triangles[3 * 20]);
    return mesh;
}

// Each position in a larger record, as in a buffer of a graphics card.
template <class Real>
struct StridedMesh {
    struct Record {
        Real position[3];
        uint32_t color, more;
    };
    std::vector<Record> records;
    std::vector<uint32_t> triangles;

    explicit StridedMesh(const TestMesh& mesh) : triangles(mesh.triangles) {
        for (size_t i = 0; i < mesh.positions.size(); i += 3) {
            Record record{{}, 0xffffffff, static_cast<uint32_t>(i)};
            for (size_t k = 0; k < 3; ++k) record.position[k] = static_cast<Real>(mesh.positions[i + k]);
            records.push_back(record);
        }
    }
    geoidx_mesh view() const {
        geoidx_mesh mesh;
        geoidx_mesh_init(&mesh);
        mesh.position_type = sizeof(Real) == sizeof(double) ? GEOIDX_POSITION_DOUBLE : GEOIDX_POSITION_FLOAT;
        mesh.positions = records.data();
        mesh.position_stride = sizeof(Record);
        mesh.vertex_count = records.size();
        mesh.triangles = triangles.data();
        mesh.triangle_count = triangles.size() / 3;
        return mesh;
    }
};

// ---- Answers, as bits

template <class T>
void add_bits(Bytes& bits, const T& value) {
    const auto bytes = std::as_bytes(std::span(&value, 1));
    bits.insert(bits.end(), bytes.begin(), bytes.end());
}

// A whole number.
double drawn(std::mt19937& random, uint32_t below) { return static_cast<double>(random() % below); }

// Points inside of triangles, some of which are degenerate or there twice, so that a call may also fail.
std::vector<geoidx_surface_point> points_on(const geoidx_mesh& mesh, uint32_t count) {
    std::mt19937 random(3);
    std::vector<geoidx_surface_point> points(count);
    for (auto& point : points) {
        const uint64_t last = random() % 6;
        point.triangle =
            static_cast<uint32_t>(last < 5 ? mesh.triangle_count - 1 - last : random() % mesh.triangle_count);
        const double u = drawn(random, 97) / 100 + 0.01, v = (1 - u) * (drawn(random, 97) / 100 + 0.01);
        point.weights[0] = u;
        point.weights[1] = v;
        point.weights[2] = 1 - u - v;
    }
    return points;
}

void add_closest_points(Bytes& bits, const geoidx_mesh& mesh, const geoidx_surface* surface) {
    std::mt19937 random(4);
    for (uint32_t i = 0; i < 200; ++i) {
        const double position[] = {drawn(random, 600), drawn(random, 140) / 10, drawn(random, 60) / 10 - 3};
        geoidx_surface_point point{};
        double distance = 0;
        require_success(geoidx_closest_point(surface, position, &point, &distance));
        CHECK(point.triangle < mesh.triangle_count);
        add_bits(bits, point);
        add_bits(bits, distance);
    }
}

void add_path(Bytes& bits, geoidx_query* query, const geoidx_surface* surface,
              const geoidx_surface_point& from, const geoidx_surface_point& to) {
    for (uint32_t quality : {GEOIDX_PATH_STRAIGHT, GEOIDX_PATH_EXACT}) {
        double length = 0;
        const geoidx_status status = geoidx_query_path(query, surface, &from, &to, quality, &length);
        add_bits(bits, status);
        if (status != GEOIDX_OK) continue;
        uint64_t count = 0;
        require_success(geoidx_query_path_points(query, nullptr, 0, &count));
        std::vector<geoidx_path_point> path(count);
        require_success(geoidx_query_path_points(query, path.data(), count, &count));
        add_bits(bits, length);
        for (const auto& point : path) add_bits(bits, point);
    }
    float distance = 0;
    add_bits(bits, geoidx_query_point_sssd(query, surface, &from, &to, &distance));
    add_bits(bits, distance);
}

// All that a surface is asked, and with a query of the index.
Bytes answers(const geoidx_mesh& mesh, const geoidx* index, const geoidx_surface* surface) {
    Bytes bits;
    add_closest_points(bits, mesh, surface);
    const auto query = query_of(index);
    const auto points = points_on(mesh, 24);
    for (size_t i = 0; i + 1 < points.size(); ++i)
        add_path(bits, query.get(), surface, points[i], points[i + 1]);
    return bits;
}

// In each form the kept mesh gives the surface of the caller's.
void check_kept(const geoidx_mesh& mesh, uint32_t engine, double weld_tolerance = 0) {
    CAPTURE(engine);
    const auto built = build_of(mesh, keeping_options(engine, weld_tolerance));
    CHECK(info_of(built.get()).has_mesh == 1);
    const Bytes right = answers(mesh, built.get(), surface_of(mesh, weld_tolerance).get());
    CHECK(answers(mesh, built.get(), surface_of(built.get()).get()) == right);
    for (uint32_t codec : CODECS) {
        CAPTURE(codec);
        const Bytes file = save(built.get(), codec);
        CHECK(told_issues(file).empty());
        auto opened = open(file);
        CHECK(info_of(opened.get()).has_mesh == 1);
        CHECK(info_of(opened.get()).file_flags == 0);
        CHECK(save(opened.get(), nullptr) == file);
        for (uint32_t other : CODECS) CHECK(save(opened.get(), other) == save(built.get(), other));
        const auto surface = surface_of(opened.get());
        opened.reset(); // which the surface outlives
        CHECK(answers(mesh, built.get(), surface.get()) == right);
    }
}

// ---- A file whose section is changed

const TestMesh& small_kept_mesh() {
    static const TestMesh mesh = [] {
        TestMesh with_unused = hills(6, 5);
        with_unused.add_vertex(9, 9, 9);
        return with_unused;
    }();
    return mesh;
}

const Bytes& small_kept_file() {
    static const Bytes file = save(build(small_kept_mesh(), keeping_options()).get());
    return file;
}

// Where the arrays of the section begin and end: numbers in planes.
constexpr size_t TRIANGLES_BEGIN = 4;
size_t triangles_end() { return TRIANGLES_BEGIN + 4 * small_kept_mesh().triangles.size(); }

Bytes with_mesh_section(const std::function<void(Bytes&)>& change) {
    return with_changed_section(small_kept_file(), TAG_MESH, change);
}

// The section holds another mesh of as many vertices and triangles.
Bytes with_kept(const TestMesh& mesh) {
    const Bytes other = save(build(mesh, keeping_options()).get());
    const Bytes section = format::Container::parse(other, INDEX_TAGS).read_bytes(TAG_MESH, UINT64_MAX);
    return with_mesh_section([&](Bytes& raw) { raw = section; });
}

// It opens, since distances do not need the mesh, and no surface is made of it.
void check_mesh_corrupt(const Bytes& file) {
    const auto index = open(file);
    CHECK(msad(index.get(), 0, small_kept_mesh().vertex_count()) ==
          msad(open(small_kept_file()).get(), 0, small_kept_mesh().vertex_count()));
    check_refused(status_of_surface(index.get()), GEOIDX_ERROR_CORRUPT, "MESH");
    check_told(file, 113, "MESH");
}

}

TEST_CASE("kept mesh: its surface answers as the caller's, in either precision" * doctest::skip(SANITIZED)) {
    const TestMesh untidy = untidy_mesh();
    const FloatMesh floats(untidy);
    for (uint32_t engine : ENGINES) {
        check_kept(untidy.view(), engine);
        check_kept(floats.view(), engine);
    }
}

TEST_CASE("kept mesh: positions that are not packed tightly" * doctest::skip(SANITIZED)) {
    const TestMesh mesh = seam(11, 9);
    for (uint32_t engine : ENGINES) {
        check_kept(StridedMesh<float>(mesh).view(), engine);
        check_kept(StridedMesh<double>(mesh).view(), engine);
    }
    // The same section as without the stride.
    const auto options = keeping_options();
    CHECK(save(build_of(StridedMesh<double>(mesh).view(), options).get()) ==
          save(build_of(mesh.view(), options).get()));
}

TEST_CASE("kept mesh: vertices that are welded over a distance" * doctest::skip(SANITIZED)) {
    TestMesh mesh = seam(11, 9);
    for (size_t i = 0; i < mesh.positions.size(); i += 9) mesh.positions[i + 1] += 1e-4;
    append(mesh, hills(7, 6), 40);
    const uint32_t a = mesh.add_vertex(80, 0, 0), b = mesh.add_vertex(80, 0, 1e-4);
    mesh.add_triangle(a, b, mesh.add_vertex(80, 1, 0)); // degenerate only because these two are welded
    for (uint32_t engine : ENGINES) check_kept(mesh.view(), engine, 1e-3);
    const auto index = build_of(mesh.view(), keeping_options(GEOIDX_ENGINE_OVERLAY, 1e-3));
    CHECK(info_of(index.get()).welded_vertex_count < mesh.vertex_count() - 3);
}

TEST_CASE("kept mesh: each small mesh, also where vertices are added" * doctest::skip(SANITIZED)) {
    for (const NamedMesh& named : mesh_zoo()) {
        CAPTURE(named.name);
        const TestMesh& mesh = named.mesh;
        check_kept(mesh.view(), GEOIDX_ENGINE_OVERLAY);
        auto options = keeping_options();
        options.target_error = 1e-9;
        const auto index = shared_index(mesh, options);
        CHECK(answers(mesh.view(), index.get(), surface_of(open(save(index.get())).get()).get()) ==
              answers(mesh.view(), index.get(), surface_of(mesh.view()).get()));
    }
}

TEST_CASE("kept mesh: a file that is mapped, and one that is borrowed") {
    const TestMesh& mesh = small_kept_mesh();
    const TemporaryDirectory directory;
    const std::string path = (directory.path() / "mapped.geoidx").string();
    const auto built = shared_index(mesh, keeping_options());
    geoidx_save_options how;
    geoidx_save_options_init(&how);
    how.codec = GEOIDX_CODEC_MAPPED;
    require_success(geoidx_save(built.get(), path.c_str(), &how));
    geoidx* index = nullptr;
    require_success(geoidx_open(path.c_str(), nullptr, &index));
    const IndexHandle mapped(index);
    const Bytes right = answers(mesh.view(), built.get(), surface_of(mesh.view()).get());
    CHECK(answers(mesh.view(), built.get(), surface_of(mapped.get()).get()) == right);
    CHECK(save(mapped.get(), nullptr) == save(built.get(), GEOIDX_CODEC_MAPPED));
    CHECK(save(mapped.get()) == save(built.get()));

    const Bytes file = save(built.get(), GEOIDX_CODEC_MAPPED);
    std::vector<uint64_t> aligned((file.size() + 7) / 8);
    std::memcpy(aligned.data(), file.data(), file.size());
    geoidx_open_options options;
    geoidx_open_options_init(&options);
    options.flags = GEOIDX_OPEN_BORROW;
    require_success(geoidx_open_memory(aligned.data(), file.size(), &options, &index));
    CHECK(answers(mesh.view(), built.get(), surface_of(IndexHandle(index).get()).get()) == right);
}

TEST_CASE("kept mesh: nothing else of the file changes, and it can be left out") {
    const TestMesh& mesh = small_kept_mesh();
    for (uint32_t engine : ENGINES) {
        auto options = keeping_options(engine);
        const auto keeping = shared_index(mesh, options);
        options.store_mesh = 0;
        const auto plain = shared_index(mesh, options);
        CHECK(info_of(plain.get()).has_mesh == 0);
        for (uint32_t codec : CODECS) {
            const Bytes without = save(plain.get(), codec);
            CHECK(save(keeping.get(), codec, GEOIDX_SAVE_NO_MESH) == without);
            CHECK(save(plain.get(), codec, GEOIDX_SAVE_NO_MESH) == without);
            CHECK(save(open(save(keeping.get(), codec)).get(), codec, GEOIDX_SAVE_NO_MESH) == without);
            const auto opened = open(without);
            CHECK(info_of(opened.get()).has_mesh == 0);
            CHECK(info_of(opened.get()).file_flags == 0);
            check_refused(status_of_surface(opened.get()), GEOIDX_ERROR_INVALID_ARGUMENT, "store_mesh");
        }
    }
}

TEST_CASE("kept mesh: without positions the file still needs the mesh to open, and keeps it") {
    const TestMesh& mesh = small_kept_mesh();
    const auto built = shared_index(mesh, keeping_options());
    const Bytes bare = save(built.get(), GEOIDX_CODEC_PACKED, GEOIDX_SAVE_NO_POSITIONS);
    CHECK(open_status(bare) == GEOIDX_ERROR_INVALID_ARGUMENT);
    CHECK(told_issues(bare).empty());
    const auto opened = open(bare, mesh);
    CHECK(info_of(opened.get()).file_flags == GEOIDX_SAVE_NO_POSITIONS);
    CHECK(save(opened.get()) == save(built.get()));
    CHECK(answers(mesh.view(), opened.get(), surface_of(opened.get()).get()) ==
          answers(mesh.view(), built.get(), surface_of(mesh.view()).get()));
}

TEST_CASE("kept mesh: sections name it, and it is optional") {
    uint32_t count = 0;
    const auto index = open(small_kept_file());
    require_success(geoidx_get_sections(index.get(), nullptr, 0, &count));
    std::vector<geoidx_section> sections(count);
    require_success(geoidx_get_sections(index.get(), sections.data(), count, &count));
    CHECK(std::string(sections.back().tag) == "MESH");
    CHECK(sections.back().raw_size == triangles_end() + sizeof(double) * small_kept_mesh().positions.size());
    CHECK(sections.back().stored_size < sections.back().raw_size);
    // A reader that does not know the section takes the file without it.
    const auto without = std::span(INDEX_TAGS).first(INDEX_TAGS.size() - 1);
    CHECK(format::Container::parse(small_kept_file(), without).has(TAG_MESH));
}

TEST_CASE("kept mesh: arguments are checked") {
    auto options = keeping_options();
    for (uint32_t value : {2u, 0x80000000u}) {
        options.store_mesh = value;
        check_build_refused(two_triangles(), options, GEOIDX_ERROR_INVALID_ARGUMENT, "store_mesh");
    }
    // An older caller's struct ends before it.
    options.struct_size = offsetof(geoidx_build_options, store_mesh);
    CHECK(info_of(build(two_triangles(), options).get()).has_mesh == 0);

    const auto index = open(small_kept_file());
    geoidx_surface* surface = nullptr;
    check_refused(geoidx_surface_of_index(nullptr, nullptr, &surface), GEOIDX_ERROR_INVALID_ARGUMENT,
                  "index");
    CHECK(surface == nullptr);
    check_refused(geoidx_surface_of_index(index.get(), nullptr, nullptr), GEOIDX_ERROR_INVALID_ARGUMENT,
                  "out");
}

TEST_CASE("kept mesh: opening refuses a section that is no mesh of these counts") {
    REQUIRE(status_of_surface(open(with_mesh_section([](Bytes&) {})).get()) == GEOIDX_OK);
    for (const auto& change : std::initializer_list<std::function<void(Bytes&)>>{
             [](Bytes& raw) { raw.pop_back(); }, [](Bytes& raw) { raw.push_back({}); },
             [](Bytes& raw) { raw.clear(); }, [](Bytes& raw) { raw.resize(3); },
             [](Bytes& raw) { raw.erase(raw.end() - 24, raw.end()); }}) {
        const Bytes file = with_mesh_section(change);
        check_refused(open_status(file), GEOIDX_ERROR_CORRUPT, "MESH");
        check_told(file, 113, "MESH");
    }
    const auto container = format::Container::parse(small_kept_file(), INDEX_TAGS);
    format::ContainerWriter writer(container.mesh_fingerprint());
    for (const format::Section& section : container.sections())
        if (section.tag == TAG_MESH)
            writer.add_images(section.tag, container.read_bytes(section.tag, UINT64_MAX));
        else
            writer.add_bytes(section.tag, container.read_bytes(section.tag, UINT64_MAX));
    const Bytes images = writer.finish();
    check_refused(open_status(images), GEOIDX_ERROR_CORRUPT, "MESH");
    check_told(images, 113, "MESH");
}

TEST_CASE("kept mesh: counts that no mesh can have are refused before anything is multiplied") {
    for (uint64_t triangles : {uint64_t{0}, uint64_t{1} << 32, UINT64_MAX / 12, UINT64_MAX}) {
        const Bytes file = with_changed_section(small_kept_file(), TAG_META, [&](Bytes& raw) {
            format::store_little_endian(triangles, raw.data() + 8);
        });
        check_refused(open_status(file), GEOIDX_ERROR_CORRUPT, "MESH");
        check_told(file, 113, "MESH");
    }
}

TEST_CASE("kept mesh: a section that holds another mesh, or none, gives no surface") {
    check_mesh_corrupt(with_mesh_section([](Bytes& raw) { raw[0] = std::byte{0}; })); // floats of this size
    check_mesh_corrupt(with_mesh_section([](Bytes& raw) { raw[0] = std::byte{2}; }));
    check_mesh_corrupt(with_mesh_section([](Bytes& raw) { raw[TRIANGLES_BEGIN] ^= std::byte{2}; }));
    check_mesh_corrupt(with_mesh_section([](Bytes& raw) { raw[triangles_end() - 1] ^= std::byte{0x40}; }));
    check_mesh_corrupt(with_mesh_section([](Bytes& raw) { // all triangles are degenerate
        std::fill(raw.begin() + TRIANGLES_BEGIN, raw.begin() + static_cast<ptrdiff_t>(triangles_end()),
                  std::byte{0});
    }));
    check_mesh_corrupt(with_mesh_section([](Bytes& raw) { // the exponents: infinities and NaNs
        std::fill(raw.end() - 6, raw.end(), std::byte{0xff});
    }));
    TestMesh other = small_kept_mesh();
    other.positions[31] += 1;
    check_mesh_corrupt(with_kept(other));
    other = small_kept_mesh();
    std::swap(other.triangles[0], other.triangles[1]);
    check_mesh_corrupt(with_kept(other));
}

TEST_CASE("kept mesh: positions that differ by less than a float can tell have the fingerprint") {
    TestMesh other = small_kept_mesh();
    other.positions[31] = std::nextafter(other.positions[31], 100.0);
    const auto index = open(with_kept(other));
    CHECK(answers(other.view(), index.get(), surface_of(index.get()).get()) ==
          answers(other.view(), index.get(), surface_of(other.view()).get()));
}

TEST_CASE("kept mesh: what VERT says of used vertices must be so in the mesh") {
    const uint32_t vertices = small_kept_mesh().vertex_count(), unused = vertices - 1;
    // Gives an id the number of another one.
    const auto with_number_of = [&](uint32_t id, uint32_t other) {
        return with_changed_section(small_kept_file(), TAG_VERTICES, [&](Bytes& raw) {
            for (size_t plane = 8; plane < raw.size(); plane += vertices)
                raw[plane + id] = raw[plane + other];
        });
    };
    // The only triangle at vertex 5, a corner, is that with 4 and 11.
    for (const Bytes& file : {with_number_of(7, unused), with_number_of(4, 11)}) {
        check_refused(status_of_surface(open(file).get()), GEOIDX_ERROR_CORRUPT, "MESH");
        check_told(file, 113, "MESH");
    }
}

TEST_CASE("kept mesh: stored bytes that are no zstd are issue 100") {
    const auto container = format::Container::parse(small_kept_file(), INDEX_TAGS);
    for (size_t at : {size_t{0}, size_t{5}, size_t{12}, size_t{200}}) {
        format::ContainerWriter writer(container.mesh_fingerprint());
        for (const format::Section& section : container.sections()) {
            if (section.tag != TAG_MESH) {
                writer.add_bytes(section.tag, container.read_bytes(section.tag, UINT64_MAX));
                continue;
            }
            format::StoredBytes stored = container.view_stored(section.tag);
            Bytes changed(stored.bytes.begin(), stored.bytes.end());
            changed[at] ^= std::byte{0x5a};
            stored.bytes = changed;
            writer.add_stored(section.tag, stored);
        }
        const Bytes file = writer.finish();
        // Not every bit of a frame is one that zstd can tell to be wrong, but the fingerprint does.
        CHECK(status_of_surface(open(file).get()) == GEOIDX_ERROR_CORRUPT);
        const auto told = told_issues(file);
        REQUIRE(told.size() == 1);
        CHECK((told[0].number == 100 || told[0].number == 113));
        CHECK(told[0].offset == begin_of_section(file, "MESH"));
        if (at == 0) CHECK(told[0].number == 100);
    }
}

TEST_CASE("kept mesh: an index takes the packed mesh from its allocator, and a surface nothing") {
    const TestMesh& mesh = small_kept_mesh();
    const Bytes with = small_kept_file();
    const Bytes without = save(open(with).get(), GEOIDX_CODEC_PACKED, GEOIDX_SAVE_NO_MESH);
    const auto taken = [](const Bytes& file, const std::function<void(const geoidx*)>& use) {
        CountingAllocator allocator;
        geoidx_open_options options;
        geoidx_open_options_init(&options);
        options.allocator = allocator.get();
        geoidx* index = nullptr;
        require_success(geoidx_open_memory(file.data(), file.size(), &options, &index));
        const IndexHandle owned(index);
        use(index);
        return allocator.bytes();
    };
    const auto use_nothing = [](const geoidx*) {};
    const uint64_t more = taken(with, use_nothing) - taken(without, use_nothing);
    const uint64_t packed = format::Container::parse(with, INDEX_TAGS).view_stored(TAG_MESH).bytes.size();
    CHECK(more >= packed);
    CHECK(more < packed + 200); // the list of sections is longer, too
    CHECK(taken(with, [](const geoidx* index) { surface_of(index); }) == taken(with, use_nothing));

    CountingAllocator allocator;
    auto options = keeping_options();
    options.allocator = allocator.get();
    auto built = build(mesh, options);
    CHECK(save(built.get()) == with);
    built.reset();
    CHECK(allocator.bytes() == 0);
    CHECK(allocator.mistakes() == 0);
}

TEST_CASE("kept mesh: what max_memory allows covers the section") {
    const auto container = format::Container::parse(small_kept_file(), INDEX_TAGS);
    uint64_t decoded = 0;
    for (const format::Section& section : container.sections()) decoded += section.raw_size;
    geoidx_open_options options;
    geoidx_open_options_init(&options);
    options.max_memory = decoded - 1;
    check_refused(open_status(small_kept_file(), &options), GEOIDX_ERROR_LIMIT, "max_memory");
}
