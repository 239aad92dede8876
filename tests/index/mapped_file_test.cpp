// Files of which queries read the tables where they lie: from a file, from bytes that are kept or not, and
// what is refused.
#include <cstring>
#include <filesystem>
#include <fstream>
#include <functional>
#include <random>

#include "format/container.h"
#include "src/file/index_file.h"
#include "src/file/sections.h"
#include "tests/capi/calls.h"
#include "tests/capi/counting_allocator.h"
#include "tests/capi/refusals.h"
#include "tests/index/changed_section.h"
#include "tests/index/told_issues.h"
#include "tests/support/sanitized.h"

using namespace geodesic;
using namespace geodesic::test;

namespace {

const TestMesh& mesh() {
    static const TestMesh two_parts = [] {
        TestMesh mesh = torus(40, 30);
        append(mesh, hills(14, 13), 9);
        return mesh;
    }();
    return two_parts;
}

const geoidx* built() {
    static const IndexHandle index = [] {
        auto options = build_options(GEOIDX_METRIC_EXACT);
        options.engine = GEOIDX_ENGINE_OVERLAY;
        return build(mesh(), options);
    }();
    return index.get();
}

const Bytes& mapped() {
    static const Bytes file = save(built(), GEOIDX_CODEC_MAPPED);
    return file;
}

void check_answers(const geoidx* index) {
    const uint32_t count = mesh().vertex_count();
    for (uint32_t source : {0u, 700u, count - 1}) {
        CHECK(msad(index, source, count) == msad(built(), source, count));
        CHECK(sssd(index, source, count / 2) == sssd(built(), source, count / 2));
    }
}

IndexHandle open_with(std::span<const std::byte> file, const geoidx_open_options& options) {
    geoidx* index = nullptr;
    require_success(geoidx_open_memory(file.data(), file.size(), &options, &index));
    return IndexHandle(index);
}

geoidx_open_options open_options(uint32_t flags = 0) {
    geoidx_open_options options;
    geoidx_open_options_init(&options);
    options.flags = flags;
    return options;
}

// The file with one section changed, as it is stored.
Bytes with_section(uint32_t changed, const std::function<void(Bytes&)>& change) {
    return with_changed_section(mapped(), changed, change, format::Packing::None);
}

void set_code(Bytes& raw, size_t index, uint16_t code) {
    std::memcpy(raw.data() + index * sizeof code, &code, sizeof code);
}

// A file in a folder of its own, which is removed again.
class FileOnDisk {
public:
    explicit FileOnDisk(const Bytes& content) {
        std::filesystem::create_directories(folder_);
        std::ofstream(path(), std::ios::binary)
            .write(reinterpret_cast<const char*>(content.data()),
                   static_cast<std::streamsize>(content.size()));
    }
    FileOnDisk(const FileOnDisk&) = delete;
    FileOnDisk& operator=(const FileOnDisk&) = delete;
    ~FileOnDisk() { std::filesystem::remove_all(folder_); }
    std::string path() const { return (folder_ / "index.geoidx").string(); }

private:
    std::filesystem::path folder_ =
        std::filesystem::temp_directory_path() / ("geoidx-mapped-" + std::to_string(std::random_device()()));
};

geoidx_status save_status(const geoidx* index, uint32_t codec) {
    geoidx_save_options options;
    geoidx_save_options_init(&options);
    options.codec = codec;
    uint64_t size = 0;
    return geoidx_save_memory(index, &options, nullptr, 0, &size);
}

IndexHandle open_file(const std::string& path, const geoidx_open_options* options = nullptr) {
    geoidx* index = nullptr;
    require_success(geoidx_open(path.c_str(), options, &index));
    return IndexHandle(index);
}

}

TEST_CASE("mapped: opened from a file, from passing bytes and from kept ones" * doctest::skip(SANITIZED)) {
    const FileOnDisk file(mapped());
    check_answers(open_file(file.path()).get());
    {
        Bytes passing = mapped();
        const auto index = open(passing);
        std::ranges::fill(passing, std::byte{0xff});
        check_answers(index.get());
    }
    std::vector<uint64_t> kept(mapped().size() / sizeof(uint64_t) + 1);
    const auto bytes = std::as_writable_bytes(std::span(kept)).first(mapped().size());
    std::ranges::copy(mapped(), bytes.begin());
    check_answers(open_with(bytes, open_options(GEOIDX_OPEN_BORROW)).get());
    check_answers(open_with(bytes, open_options(GEOIDX_OPEN_BORROW | GEOIDX_OPEN_PAIRS)).get());
}

TEST_CASE("mapped: what lies in the file takes no memory of the caller's allocator") {
    const FileOnDisk file(mapped());
    const auto bytes_of = [&](const auto& open_index) {
        CountingAllocator memory;
        auto options = open_options(GEOIDX_OPEN_BORROW);
        options.allocator = memory.get();
        const auto index = open_index(options);
        return memory.bytes();
    };
    std::vector<uint64_t> kept(mapped().size() / sizeof(uint64_t) + 1);
    std::memcpy(kept.data(), mapped().data(), mapped().size());
    const uint64_t from_file =
        bytes_of([&](const auto& options) { return open_file(file.path(), &options); });
    const uint64_t borrowed = bytes_of([&](const auto& options) {
        return open_with(std::as_bytes(std::span(kept)).first(mapped().size()), options);
    });
    const uint64_t copied = bytes_of([&](auto options) {
        options.flags = 0;
        return open_with(mapped(), options);
    });
    CHECK(from_file == borrowed);
    CHECK(copied >= borrowed + mapped().size());
    CHECK(borrowed < mapped().size() / 2);
}

TEST_CASE("mapped: a file that is replaced while it is open is still read") {
    const FileOnDisk file(mapped());
    const auto index = open_file(file.path());
    require_success(geoidx_save(index.get(), file.path().c_str(), nullptr));
    const Bytes packed = save(index.get(), GEOIDX_CODEC_PACKED);
    geoidx_save_options options;
    geoidx_save_options_init(&options);
    require_success(geoidx_save(index.get(), file.path().c_str(), &options));
    CHECK(std::filesystem::file_size(file.path()) == packed.size());
    check_answers(index.get());
    check_answers(open_file(file.path()).get());
}

TEST_CASE("mapped: borrowed bytes must be aligned") {
    std::vector<uint64_t> kept(mapped().size() / sizeof(uint64_t) + 2);
    std::byte* const first = reinterpret_cast<std::byte*>(kept.data()) + 2;
    std::memcpy(first, mapped().data(), mapped().size());
    const auto options = open_options(GEOIDX_OPEN_BORROW);
    geoidx* index = not_null();
    check_refused(geoidx_open_memory(first, mapped().size(), &options, &index), GEOIDX_ERROR_INVALID_ARGUMENT,
                  "aligned");
    CHECK(index == nullptr);
    check_answers(open({first, mapped().size()}).get());
}

// The offsets of middles come last, two bytes in the place of a code. They may be any bytes.
size_t first_of_offsets() {
    static const size_t first = [] {
        const size_t codes =
            format::Container::parse(mapped(), INDEX_TAGS).section(TAG_HOP_CODES).raw_size / sizeof(uint16_t);
        size_t refused = 0, accepted = codes;
        while (accepted - refused > 1) {
            const size_t index = (refused + accepted) / 2;
            const Bytes file = with_section(TAG_HOP_CODES, [&](Bytes& raw) { set_code(raw, index, 0x8000); });
            (open_status(file) == GEOIDX_OK ? accepted : refused) = index;
        }
        REQUIRE(accepted < codes);
        return accepted;
    }();
    return first;
}

TEST_CASE("mapped: tables of another size, or with what is no code, are refused") {
    const auto status_with = [](const std::function<void(Bytes&)>& change) {
        const Bytes file = with_section(TAG_HOP_CODES, change);
        const geoidx_status status = open_status(file);
        if (status != GEOIDX_OK) check_told(file, 112, "HOPS");
        return status;
    };
    CHECK(status_with([](Bytes&) {}) == GEOIDX_OK);
    CHECK(status_with([](Bytes& raw) { raw.pop_back(); }) == GEOIDX_ERROR_CORRUPT);
    CHECK(status_with([](Bytes& raw) { raw.resize(raw.size() - 2); }) == GEOIDX_ERROR_CORRUPT);
    CHECK(status_with([](Bytes& raw) { raw.resize(raw.size() + 64); }) == GEOIDX_ERROR_CORRUPT);
    CHECK(status_with([](Bytes& raw) { raw.clear(); }) == GEOIDX_ERROR_CORRUPT);
    for (const size_t index : {size_t{0}, first_of_offsets() / 2, first_of_offsets() - 1})
        CHECK(status_with([&](Bytes& raw) { set_code(raw, index, 0x8000); }) == GEOIDX_ERROR_CORRUPT);
    CHECK(status_with([&](Bytes& raw) { set_code(raw, first_of_offsets(), 0x8000); }) == GEOIDX_OK);
}

TEST_CASE("mapped: whatever codes a file has, it is answered from or refused") {
    std::mt19937 random(3);
    for (int round = 0; round < 4; ++round) {
        const Bytes file = with_section(TAG_HOP_CODES, [&](Bytes& raw) {
            for (size_t i = 0; i < raw.size() / 2; ++i)
                if (round < 2 || random() % 50 == 0) {
                    const uint32_t end = i < first_of_offsets() ? 0x8000 : 0x10000;
                    set_code(raw, i, static_cast<uint16_t>(round == 0 ? end - 1 : random() % end));
                }
        });
        const auto index = open(file);
        const uint32_t count = mesh().vertex_count();
        for (int i = 0; i < 300; ++i)
            CHECK(sssd(index.get(), static_cast<uint32_t>(random() % count),
                       static_cast<uint32_t>(random() % count)) >= 0);
        for (uint32_t source = 0; source < count; source += 100)
            for (const float d : msad(index.get(), source, count)) CHECK(d >= 0);
        const std::vector<uint32_t> sources{0, 5, 700, count - 1};
        for (const float d : msad(index.get(), sources, count)) CHECK(d >= 0);
        CHECK(save(index.get(), GEOIDX_CODEC_MAPPED) == file);
        check_refused(save_status(index.get(), GEOIDX_CODEC_PACKED), GEOIDX_ERROR_CORRUPT, "HOPS");
        CHECK(geoidx_verify(file.data(), file.size(), nullptr, nullptr) == GEOIDX_ERROR_CORRUPT);
    }
}

// A sanitizer tells of codes that are read where they do not lie as codes have to.
TEST_CASE("mapped: it is verified wherever its bytes lie") {
    const Bytes& file = mapped();
    for (size_t shift = 0; shift < 8; ++shift) {
        Bytes shifted(shift, std::byte{0});
        shifted.insert(shifted.end(), file.begin(), file.end());
        CHECK(geoidx_verify(shifted.data() + shift, file.size(), nullptr, nullptr) == GEOIDX_OK);
    }
}

TEST_CASE("mapped: verifying finds the offset of a middle that does not follow") {
    std::mt19937 random(5);
    for (int round = 0; round < 10; ++round) {
        const size_t index = first_of_offsets() + random() % 1000;
        CAPTURE(index);
        const Bytes file = with_section(TAG_HOP_CODES, [&](Bytes& raw) { raw[2 * index] ^= std::byte{1}; });
        check_told(file, 112, "HOPS");
    }
}

// Border tables and owned tables come first. All of their codes are there twice or more, or are 0; no reader
// can tell what padding should be.
TEST_CASE("mapped: verifying finds the code that does not follow") {
    const size_t codes = format::Container::parse(mapped(), INDEX_TAGS).section(TAG_HOP_CODES).raw_size / 2;
    std::mt19937 random(4);
    int found = 0;
    for (int round = 0; round < 40; ++round) {
        const size_t index = random() % (codes / 4);
        const Bytes file = with_section(TAG_HOP_CODES, [&](Bytes& raw) {
            uint16_t code = 0;
            std::memcpy(&code, raw.data() + 2 * index, sizeof code);
            set_code(raw, index, code ^ 1);
        });
        if (told_issues(file).empty()) continue;
        CAPTURE(index);
        check_told(file, 112, "HOPS");
        ++found;
    }
    CHECK(found >= 30);
}

// Of another form such codes would be refused, or rounded to other distances.
TEST_CASE("mapped: codes that are no multiples of 2^shift are answered from, but not saved in another form") {
    size_t patches = 1;
    for (const uint32_t of_level : info_of(built()).patch_count) patches += of_level;
    for (const size_t patch : {size_t{0}, patches - 1}) { // the whole mesh, and a leaf
        CAPTURE(patch);
        const Bytes file = with_section(
            TAG_QUANTA, [&](Bytes& raw) { raw[patches * sizeof(float) + patch] = std::byte{14}; });
        const auto index = open(file);
        check_answers(index.get());
        CHECK(save(index.get(), GEOIDX_CODEC_MAPPED) == file);
        for (const uint32_t codec : {GEOIDX_CODEC_PACKED, GEOIDX_CODEC_LOSSLESS})
            check_refused(save_status(index.get(), codec), GEOIDX_ERROR_CORRUPT, "HOPS");
        check_told(file, 112, "HOPS");
    }
}

TEST_CASE("mapped: sections that do not go together are refused") {
    const Bytes packed = save(built());
    for (const auto& [meta_of, rest_of] : {std::pair(&packed, &mapped()), std::pair(&mapped(), &packed)}) {
        const auto meta = format::Container::parse(*meta_of, INDEX_TAGS).read_bytes(TAG_META, 1000);
        const auto rest = format::Container::parse(*rest_of, INDEX_TAGS);
        format::ContainerWriter writer(rest.mesh_fingerprint());
        for (const format::Section& section : rest.sections()) {
            const Bytes raw = rest.read_bytes(section.tag, UINT64_MAX);
            writer.add_raw(section.tag, section.tag == TAG_META ? meta : raw);
        }
        const Bytes file = writer.finish();
        CHECK(open_status(file) == GEOIDX_ERROR_CORRUPT);
        check_told(file, 111, "OVOV"); // missing, or there and not to be
    }
    // Compressed, it could not be read where it lies.
    const auto container = format::Container::parse(mapped(), INDEX_TAGS);
    format::ContainerWriter writer(container.mesh_fingerprint());
    for (const format::Section& section : container.sections())
        writer.add_bytes(section.tag, container.read_bytes(section.tag, UINT64_MAX));
    const Bytes compressed = writer.finish();
    CHECK(open_status(compressed) == GEOIDX_ERROR_CORRUPT);
    check_told(compressed, 112, "HOPS");
}

TEST_CASE("open limits: vertices and memory") {
    for (const uint32_t codec : {GEOIDX_CODEC_PACKED, GEOIDX_CODEC_LOSSLESS, GEOIDX_CODEC_MAPPED}) {
        CAPTURE(codec);
        const Bytes file = save(built(), codec);
        const auto status_with = [&](const geoidx_open_options& options) {
            geoidx* index = not_null();
            const auto status = geoidx_open_memory(file.data(), file.size(), &options, &index);
            CHECK((status == GEOIDX_OK) == (index != nullptr));
            geoidx_close(index);
            return status;
        };
        auto options = open_options();
        options.max_vertices = mesh().vertex_count();
        CHECK(status_with(options) == GEOIDX_OK);
        --options.max_vertices;
        check_refused(status_with(options), GEOIDX_ERROR_LIMIT, "max_vertices");

        CountingAllocator memory;
        options = open_options();
        options.allocator = memory.get();
        uint64_t needed = 0;
        {
            const auto index = open_with(file, options);
            needed = memory.bytes();
        }
        // Arrays grow on the way, so that opening needs a little more for a while.
        options.max_memory = 2 * needed + file.size();
        CHECK(status_with(options) == GEOIDX_OK);
        options.max_memory = needed * 9 / 10;
        check_refused(status_with(options), GEOIDX_ERROR_LIMIT, "max_memory");
        options.max_memory = 100;
        check_refused(status_with(options), GEOIDX_ERROR_LIMIT, "max_memory");
        CHECK(memory.bytes() == 0);
    }
}

// Scratch of a query is kept for the next one, for which there may be no room either.
TEST_CASE("open limits: whatever memory there is, a query is answered or refused") {
    const TestMesh mesh = hills(5, 4);
    const Bytes file = save(build(mesh, default_options()).get(), GEOIDX_CODEC_MAPPED);
    uint32_t refused = 0, answered = 0;
    for (uint64_t limit = 1000; answered < 100; ++limit) {
        auto options = open_options();
        options.max_memory = limit;
        geoidx* opened = nullptr;
        if (geoidx_open_memory(file.data(), file.size(), &options, &opened) != GEOIDX_OK) continue;
        const IndexHandle index(opened);
        std::vector<float> distances(mesh.vertex_count());
        const uint32_t source = 3;
        const auto status = geoidx_msad(index.get(), &source, 1, distances.data(), mesh.vertex_count());
        CHECK((status == GEOIDX_OK || status == GEOIDX_ERROR_LIMIT));
        ++(status == GEOIDX_OK ? answered : refused);
    }
    CHECK(refused > 100);
}

TEST_CASE("open limits: what pairs need counts, too") {
    CountingAllocator memory;
    auto options = open_options();
    options.allocator = memory.get();
    const Bytes file = save(built());
    uint64_t with_fields = 0, with_pairs = 0;
    {
        const auto index = open_with(file, options);
        msad(index.get(), 0, mesh().vertex_count());
        with_fields = memory.bytes();
        sssd(index.get(), 0, 1000);
        with_pairs = memory.bytes();
    }
    REQUIRE(with_pairs > with_fields + 50'000);
    options.max_memory = with_fields + (with_pairs - with_fields) / 2;
    const auto index = open_with(file, options);
    const auto field = msad(index.get(), 0, mesh().vertex_count());
    float distance = 0;
    check_refused(geoidx_sssd(index.get(), 0, 1000, &distance), GEOIDX_ERROR_LIMIT, "max_memory");
    CHECK(msad(index.get(), 0, mesh().vertex_count()) == field);
}
