#include "format/file_io.h"

#include <csignal>
#include <filesystem>
#include <fstream>
#include <iterator>

#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

#include <doctest/doctest.h>

#include "tests/format/helpers.h"
#include "tests/support/filled_pipe.h"

using namespace geodesic;
using namespace geodesic::format;
using namespace geodesic::format::test;
using geodesic::test::FilledPipe;

namespace {

namespace fs = std::filesystem;

// A new directory, removed with all it holds.
class Directory {
public:
    Directory() {
        std::string name = (fs::temp_directory_path() / "geoidx-file-io-XXXXXX").string();
        REQUIRE(::mkdtemp(name.data()) != nullptr);
        path_ = name;
    }
    Directory(const Directory&) = delete;
    Directory& operator=(const Directory&) = delete;
    ~Directory() { fs::remove_all(path_); }

    std::string file(const std::string& name) const { return (path_ / name).string(); }
    const fs::path& path() const { return path_; }
    std::ptrdiff_t entry_count() const {
        return std::distance(fs::directory_iterator(path_), fs::directory_iterator());
    }

private:
    fs::path path_;
};

// While it lives, a file of this process cannot grow over `size`: a full disk that root meets too.
class FileSizeLimit {
public:
    explicit FileSizeLimit(rlim_t size) : old_handler_(std::signal(SIGXFSZ, SIG_IGN)) {
        REQUIRE(::getrlimit(RLIMIT_FSIZE, &old_limit_) == 0);
        const rlimit limit{size, old_limit_.rlim_max};
        REQUIRE(::setrlimit(RLIMIT_FSIZE, &limit) == 0);
    }
    FileSizeLimit(const FileSizeLimit&) = delete;
    FileSizeLimit& operator=(const FileSizeLimit&) = delete;
    ~FileSizeLimit() {
        ::setrlimit(RLIMIT_FSIZE, &old_limit_);
        std::signal(SIGXFSZ, old_handler_);
    }

private:
    void (*old_handler_)(int);
    rlimit old_limit_{};
};

Bytes read_file(const std::string& path) {
    return format::read_file(path, [](const FileStart&) { return UINT64_MAX; });
}

geoidx_status write_status(const std::string& path, const Bytes& bytes, std::string* message = nullptr) {
    return status_of([&] { write_file_atomically(path, bytes); }, message);
}

bool contains(const std::string& text, const std::string& part) {
    return text.find(part) != std::string::npos;
}

}

TEST_CASE("a file holds what was written, also nothing and much") {
    const Directory directory;
    for (const std::size_t size :
         {std::size_t{0}, std::size_t{1}, std::size_t{65536}, std::size_t{3'000'001}}) {
        CAPTURE(size);
        const Bytes bytes = random_bytes(size, 1);
        write_file_atomically(directory.file("index"), bytes);
        CHECK(read_file(directory.file("index")) == bytes);
        CHECK(directory.entry_count() == 1);
    }
}

TEST_CASE("paths are UTF-8, may be relative and as long as the file system allows") {
    const Directory directory;
    const Bytes bytes = random_bytes(10, 1);
    write_file_atomically(directory.file("géodésique-測地線"), bytes);
    CHECK(read_file(directory.file("géodésique-測地線")) == bytes);
    write_file_atomically(directory.file(std::string(255, 'n')), bytes);
    CHECK(read_file(directory.file(std::string(255, 'n'))) == bytes);
    const fs::path before = fs::current_path();
    fs::current_path(directory.path());
    const geoidx_status status = write_status("relative", bytes);
    fs::current_path(before);
    CHECK(status == GEOIDX_OK);
    CHECK(read_file(directory.file("relative")) == bytes);
}

TEST_CASE("replacing a file keeps its permissions and the links to it") {
    const Directory directory;
    write_file_atomically(directory.file("index"), random_bytes(10, 1));
    fs::permissions(directory.file("index"), fs::perms::owner_read | fs::perms::group_read);
    fs::create_symlink("index", directory.file("link"));
    const Bytes bytes = random_bytes(20, 2);
    write_file_atomically(directory.file("link"), bytes);
    CHECK(fs::is_symlink(directory.file("link")));
    CHECK(read_file(directory.file("index")) == bytes);
    CHECK(fs::status(directory.file("index")).permissions() ==
          (fs::perms::owner_read | fs::perms::group_read));
    CHECK(directory.entry_count() == 2);
}

TEST_CASE("a write that fails half way leaves the old file and nothing else") {
    const Directory directory;
    const Bytes old = random_bytes(100, 1);
    write_file_atomically(directory.file("index"), old);
    std::string message;
    geoidx_status status = GEOIDX_OK;
    {
        const FileSizeLimit limit(8192);
        status = write_status(directory.file("index"), random_bytes(20000, 2), &message);
    }
    CHECK(status == GEOIDX_ERROR_IO);
    CHECK(contains(message, directory.file("index")));
    CHECK(contains(message, "File too large"));
    CHECK(read_file(directory.file("index")) == old);
    CHECK(directory.entry_count() == 1);
}

TEST_CASE("a directory, a pipe and a dangling link are not replaced") {
    const Directory directory;
    fs::create_directory(directory.file("folder"));
    std::string message;
    CHECK(write_status(directory.file("folder"), random_bytes(10, 1), &message) == GEOIDX_ERROR_IO);
    CHECK(contains(message, "it is a directory"));
    REQUIRE(::mkfifo(directory.file("pipe").c_str(), 0600) == 0);
    CHECK(write_status(directory.file("pipe"), random_bytes(10, 1), &message) == GEOIDX_ERROR_IO);
    CHECK(contains(message, "not a regular file"));
    CHECK(fs::is_fifo(directory.file("pipe")));
    fs::create_symlink("nowhere", directory.file("link"));
    CHECK(write_status(directory.file("link"), random_bytes(10, 1)) == GEOIDX_ERROR_IO);
    CHECK(fs::is_symlink(directory.file("link")));
    CHECK(directory.entry_count() == 3);
}

TEST_CASE("a destination without a directory to hold it is refused with path and reason") {
    const Directory directory;
    std::string message;
    CHECK(write_status(directory.file("missing/index"), random_bytes(10, 1), &message) == GEOIDX_ERROR_IO);
    CHECK(contains(message, directory.file("missing")));
    CHECK(contains(message, "No such file or directory"));
    write_file_atomically(directory.file("plain"), {});
    CHECK(write_status(directory.file("plain/index"), random_bytes(10, 1), &message) == GEOIDX_ERROR_IO);
    CHECK(contains(message, "Not a directory"));
    CHECK(write_status("", {}) == GEOIDX_ERROR_IO);
    CHECK(write_status(directory.file(std::string(256, 'n')), {}) == GEOIDX_ERROR_IO);
    CHECK(write_status(directory.file("plain") + "/", {}) == GEOIDX_ERROR_IO);
    CHECK(write_status(directory.file("new") + "/", {}) == GEOIDX_ERROR_IO);
    CHECK(directory.entry_count() == 1);
}

TEST_CASE("a directory that takes no files is refused") {
    // Not even root can create a file there.
    CHECK(write_status("/proc/geoidx-test", random_bytes(10, 1)) == GEOIDX_ERROR_IO);
}

TEST_CASE("a file left behind under the name of a temporary one is neither used nor removed") {
    const Directory directory;
    const std::string left = directory.file(".geoidx-" + std::to_string(::getpid()) + "-0.tmp");
    std::ofstream(left) << "left";
    const Bytes bytes = random_bytes(10, 1);
    write_file_atomically(directory.file("index"), bytes);
    CHECK(read_file(directory.file("index")) == bytes);
    CHECK(read_file(left).size() == 4);
    CHECK(directory.entry_count() == 2);
}

TEST_CASE("reading what is not there or no file is refused with path and reason") {
    const Directory directory;
    std::string message;
    CHECK(status_of([&] { read_file(directory.file("missing")); }, &message) == GEOIDX_ERROR_IO);
    CHECK(contains(message, directory.file("missing")));
    CHECK(contains(message, "No such file or directory"));
    CHECK(status_of([&] { read_file(directory.path().string()); }, &message) == GEOIDX_ERROR_IO);
    CHECK(contains(message, "it is a directory"));
    CHECK(status_of([&] { read_file(""); }) == GEOIDX_ERROR_IO);
}

TEST_CASE("a read that fails is reported") {
    // Nothing is mapped at address 0, where reading starts.
    if (!fs::exists("/proc/self/mem")) return;
    std::string message;
    CHECK(status_of([&] { read_file("/proc/self/mem"); }, &message) == GEOIDX_ERROR_IO);
    CHECK(contains(message, "cannot read"));
}

TEST_CASE("a file that does not know its size is read to its end") {
    if (!fs::exists("/proc/self/maps")) return;
    CHECK(fs::file_size("/proc/self/maps") == 0);
    CHECK(read_file("/proc/self/maps").size() > 100);
}

TEST_CASE("of a file as much is read as its start is worth, and what shows that there is more") {
    const Directory directory;
    const Bytes bytes = random_bytes(1'000'000, 1);
    write_file_atomically(directory.file("index"), bytes);
    for (const std::size_t wanted : {std::size_t{5000}, bytes.size() - 1, bytes.size(), bytes.size() + 1}) {
        CAPTURE(wanted);
        Bytes shown;
        const Bytes content = format::read_file(directory.file("index"), [&](const FileStart& start) {
            shown.assign(start.bytes.begin(), start.bytes.end());
            CHECK(start.size == bytes.size());
            return wanted;
        });
        CHECK(shown.size() >= 48);
        CHECK(std::equal(shown.begin(), shown.end(), bytes.begin()));
        REQUIRE(content.size() == std::min(wanted + 1, bytes.size()));
        CHECK(std::equal(content.begin(), content.end(), bytes.begin()));
    }
}

TEST_CASE("a pipe is read as far as its start is worth") {
    if (!fs::exists("/dev/fd")) return;
    const Bytes bytes = random_bytes(60'000, 1);
    for (const std::size_t wanted : {std::size_t{30'000}, bytes.size()}) {
        const FilledPipe pipe(bytes);
        const Bytes content = format::read_file(pipe.path(), [&](const FileStart& start) {
            CHECK(!start.size);
            return wanted;
        });
        CHECK(content == Bytes(bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(content.size())));
        CHECK(content.size() == std::min(wanted + 1, bytes.size()));
        CHECK(pipe.left() == bytes.size() - content.size());
    }
}

TEST_CASE("a file that is refused by its start is not read on") {
    if (!fs::exists("/dev/fd")) return;
    const FilledPipe pipe(Bytes(60'000));
    const auto refuse = [](const FileStart&) -> std::uint64_t { throw Error(GEOIDX_ERROR_CORRUPT, "no"); };
    CHECK(status_of([&] { format::read_file(pipe.path(), refuse); }) == GEOIDX_ERROR_CORRUPT);
    CHECK(pipe.left() > 50'000);
}
