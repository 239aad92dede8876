// A valid index cut at every length and with every byte changed.

#include <cstring>
#include <filesystem>
#include <fstream>

#include "tests/capi/refusals.h"
#include "tests/support/filled_pipe.h"
#include "tests/support/temporary_directory.h"

using namespace geodesic::test;

namespace {

const TestMesh& small_mesh() {
    static const TestMesh mesh = grid(5, 4, 0.2);
    return mesh;
}

// A few KB, two levels, all sections with content.
Bytes small_index(uint32_t engine = GEOIDX_ENGINE_GRAPH, uint32_t flags = 0, uint32_t store_mesh = 0) {
    auto options = build_options(GEOIDX_METRIC_EXACT, 2);
    options.engine = engine;
    options.store_mesh = store_mesh;
    options.patches[0] = options.patches[1] = 2;
    return save(build(small_mesh(), options).get(), GEOIDX_CODEC_PACKED, flags);
}

// Of both engines, with positions and without, and with the mesh.
std::vector<Bytes> small_indices() {
    std::vector<Bytes> files;
    for (uint32_t engine : {GEOIDX_ENGINE_GRAPH, GEOIDX_ENGINE_OVERLAY})
        for (uint32_t flags : {uint32_t{0}, uint32_t{GEOIDX_SAVE_NO_POSITIONS}})
            files.push_back(small_index(engine, flags));
    files.push_back(small_index(GEOIDX_ENGINE_OVERLAY, 0, 1));
    return files;
}

geoidx_status status_of(const Bytes& bytes) { return open_status(bytes, small_mesh().view()); }

struct Issues {
    geoidx_status first = GEOIDX_OK;
    uint64_t count = 0, stop_after = UINT64_MAX, file_size = 0, misplaced = 0, unnamed = 0;

    static int32_t add(void* user, const geoidx_issue* issue) {
        auto& issues = *static_cast<Issues*>(user);
        if (issues.count++ == 0) issues.first = issue->status;
        issues.misplaced += issue->offset > issues.file_size;
        issues.unnamed += issue->number == 0 || !issue->message || std::strlen(issue->message) == 0;
        return issues.count < issues.stop_after;
    }
};

// Both doors refuse, verify for a reason that it names.
bool is_refused(const Bytes& bytes) {
    const geoidx_status status = status_of(bytes);
    Issues issues;
    issues.file_size = bytes.size();
    const geoidx_status verified = geoidx_verify(bytes.data(), bytes.size(), Issues::add, &issues);
    return status < 0 && verified == status && issues.count > 0 && issues.first == verified &&
           issues.unnamed == 0 && issues.misplaced == 0;
}

}

TEST_CASE("an index cut at any length is refused") {
    for (const Bytes& whole : small_indices()) {
        REQUIRE(whole.size() < 10000);
        for (size_t size = 0; size < whole.size(); ++size) {
            const Bytes cut(whole.begin(),
                            whole.begin() + static_cast<std::ptrdiff_t>(size)); // no byte beyond
            if (!is_refused(cut) || status_of(cut) != GEOIDX_ERROR_TRUNCATED) {
                CAPTURE(whole.size());
                CAPTURE(size);
                CHECK(is_refused(cut));
                CHECK(status_of(cut) == GEOIDX_ERROR_TRUNCATED);
            }
        }
    }
}

TEST_CASE("an index with any byte changed is refused") {
    for (const Bytes& whole : small_indices()) {
        Bytes changed = whole;
        for (size_t i = 0; i < whole.size(); ++i) {
            for (int flip : {0x01, 0x80, 0xFF, 0x24}) {
                changed[i] = whole[i] ^ static_cast<std::byte>(flip);
                if (is_refused(changed)) continue;
                CAPTURE(whole.size());
                CAPTURE(i);
                CAPTURE(flip);
                CHECK(is_refused(changed));
            }
            changed[i] = whole[i];
        }
        CHECK(status_of(changed) == GEOIDX_OK);
    }
}

TEST_CASE("an index with bytes after its end is refused") {
    Bytes longer = small_index();
    longer.push_back(std::byte{0});
    CHECK(is_refused(longer));
    CHECK(status_of(longer) == GEOIDX_ERROR_CORRUPT);
}

TEST_CASE("a file that is no index of this version is refused by its first bytes, however long it is") {
    if (!std::filesystem::exists("/dev/fd")) return;
    Bytes other_version = small_index();
    other_version[8] = std::byte{99};
    for (Bytes start : {Bytes(100), other_version}) {
        const geoidx_status expected = status_of(start);
        start.resize(60'000);
        const FilledPipe pipe(start);
        geoidx* index = not_null();
        CHECK(geoidx_open(pipe.path().c_str(), nullptr, &index) == expected);
        CHECK(index == nullptr);
        CHECK(pipe.left() > 50'000);
    }
}

TEST_CASE("an index that comes through a pipe is opened, and refused if the pipe brings more or less") {
    if (!std::filesystem::exists("/dev/fd")) return;
    const Bytes whole = small_index();
    const auto open_through_pipe = [](const Bytes& bytes) {
        geoidx* index = nullptr;
        const geoidx_status status = geoidx_open(FilledPipe(bytes).path().c_str(), nullptr, &index);
        geoidx_close(index);
        return status;
    };
    CHECK(open_through_pipe(whole) == GEOIDX_OK);
    CHECK(open_through_pipe(Bytes(whole.begin(), whole.end() - 1)) == GEOIDX_ERROR_TRUNCATED);
    Bytes longer = whole;
    longer.resize(50'000);
    CHECK(open_through_pipe(longer) == GEOIDX_ERROR_CORRUPT);
}

TEST_CASE("a file of another size than its header says is refused by its header, however long it is") {
    constexpr std::uintmax_t HUGE_SIZE = std::uintmax_t{1} << 40; // more than there is memory
    const TemporaryDirectory directory;
    for (const uint32_t codec : {GEOIDX_CODEC_LOSSLESS, GEOIDX_CODEC_MAPPED}) {
        CAPTURE(codec);
        const Bytes bytes = save(build(small_mesh(), default_options()).get(), codec);
        const std::string path = (directory / "long").string();
        std::ofstream(path, std::ios::binary)
            .write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
        std::error_code error;
        std::filesystem::resize_file(path, HUGE_SIZE, error);
        if (error) return; // not every file system has such files
        geoidx* index = not_null();
        const std::string sizes =
            "the file has 1099511627776 bytes, its header says " + std::to_string(bytes.size());
        check_refused(geoidx_open(path.c_str(), nullptr, &index), GEOIDX_ERROR_CORRUPT, sizes.c_str());
    }
}

TEST_CASE("verify goes on after a problem and stops when the callback says so") {
    Bytes damaged = small_index();
    // The middle of the stored bytes of the first and the last section: two checksums.
    damaged[damaged.size() - 5] ^= std::byte{0x10};
    const auto read_u64 = [&](size_t offset) {
        uint64_t value;
        std::memcpy(&value, damaged.data() + offset, sizeof value); // little-endian hosts only, as CI is
        return value;
    };
    const uint64_t first_section = read_u64(48 + 16);
    damaged[first_section + 5] ^= std::byte{0x10};

    Issues all;
    all.file_size = damaged.size();
    CHECK(geoidx_verify(damaged.data(), damaged.size(), Issues::add, &all) == GEOIDX_ERROR_CHECKSUM);
    CHECK(all.count == 2);
    CHECK(std::string(geoidx_last_error()).size() > 0);
    Issues one;
    one.file_size = damaged.size();
    one.stop_after = 1;
    CHECK(geoidx_verify(damaged.data(), damaged.size(), Issues::add, &one) == GEOIDX_ERROR_CHECKSUM);
    CHECK(one.count == 1);
    CHECK(geoidx_verify(damaged.data(), damaged.size(), nullptr, nullptr) == GEOIDX_ERROR_CHECKSUM);

    const Bytes whole = small_index();
    Issues none;
    CHECK(geoidx_verify(whole.data(), whole.size(), Issues::add, &none) == GEOIDX_OK);
    CHECK(none.count == 0);
}
