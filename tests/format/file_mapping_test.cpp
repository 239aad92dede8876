#include "format/file_mapping.h"

#include <filesystem>

#include <sys/stat.h>

#include <doctest/doctest.h>

#include "format/file_io.h"
#include "tests/format/helpers.h"

using namespace geodesic;
using namespace geodesic::format;
using namespace geodesic::format::test;
namespace fs = std::filesystem;

namespace {

class Folder {
public:
    Folder() { fs::create_directories(path_); }
    Folder(const Folder&) = delete;
    Folder& operator=(const Folder&) = delete;
    ~Folder() { fs::remove_all(path_); }
    std::string file(const std::string& name) const { return (path_ / name).string(); }

private:
    fs::path path_ = fs::temp_directory_path() / ("geoidx-mapping-" + std::to_string(std::random_device()()));
};

bool any(const FileStart&) { return true; }

}

TEST_CASE("file mapping: the bytes of the file, and as long as it is mapped") {
    const Folder folder;
    for (const std::size_t size : {std::size_t{1}, FileMapping::START, std::size_t{3'000'001}}) {
        const Bytes bytes = random_bytes(size, 1);
        write_file_atomically(folder.file("x"), bytes);
        auto mapping = FileMapping::of_file(folder.file("x"), any);
        REQUIRE(mapping.has_value());
        fs::remove(folder.file("x"));
        const auto moved = std::move(mapping);
        CHECK(std::ranges::equal(moved->bytes(), bytes));
    }
}

TEST_CASE("file mapping: the start of the file decides") {
    const Folder folder;
    for (const std::size_t size : {std::size_t{100}, std::size_t{200'000}}) {
        const Bytes bytes = random_bytes(size, 2);
        write_file_atomically(folder.file("x"), bytes);
        for (const bool wanted : {false, true}) {
            Bytes shown;
            const auto mapping = FileMapping::of_file(folder.file("x"), [&](const FileStart& start) {
                shown.assign(start.bytes.begin(), start.bytes.end());
                CHECK(start.size == size);
                return wanted;
            });
            CHECK(mapping.has_value() == wanted);
            REQUIRE(shown.size() == std::min(size, FileMapping::START));
            CHECK(std::equal(shown.begin(), shown.end(), bytes.begin()));
        }
    }
}

TEST_CASE("file mapping: nothing where there is no file with bytes") {
    const Folder folder;
    CHECK(!FileMapping::of_file(folder.file("missing"), any));
    CHECK(!FileMapping::of_file("", any));
    CHECK(!FileMapping::of_file(folder.file(""), any));
    write_file_atomically(folder.file("empty"), {});
    CHECK(!FileMapping::of_file(folder.file("empty"), any));
    // Opening a pipe that nobody writes to would wait.
    REQUIRE(::mkfifo(folder.file("pipe").c_str(), 0600) == 0);
    CHECK(!FileMapping::of_file(folder.file("pipe"), any));
    CHECK(!FileMapping::of_file("/dev/zero", any));
}
