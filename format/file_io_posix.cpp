#include "format/file_io.h"

#include <algorithm>
#include <cerrno>
#include <filesystem>
#include <new>
#include <optional>
#include <system_error>
#include <utility>

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include "format/error.h"
#include "format/file_content.h"
#include "format/file_descriptor_posix.h"

namespace geodesic::format {
namespace {

[[noreturn]] void fail(const std::string& doing, const std::string& path, const std::string& reason) {
    throw Error(GEOIDX_ERROR_IO, "cannot " + doing + " '" + path + "': " + reason);
}

[[noreturn]] void fail_errno(const std::string& doing, const std::string& path, int code) {
    if (code == ENOMEM) throw std::bad_alloc();
    fail(doing, path, std::generic_category().message(code));
}

// read(2) and write(2) take at most this much at once on every system.
constexpr std::size_t MAX_TRANSFER = std::size_t{1} << 30;

// The number of bytes read, 0 at the end.
std::size_t read_some(const FileDescriptor& file, std::span<std::byte> into, const std::string& path) {
    for (;;) {
        const ssize_t count = ::read(file.get(), into.data(), std::min(into.size(), MAX_TRANSFER));
        if (count >= 0) return static_cast<std::size_t>(count);
        if (errno != EINTR) fail_errno("read", path, errno);
    }
}

void write_all(const FileDescriptor& file, std::span<const std::byte> bytes, const std::string& path) {
    while (!bytes.empty()) {
        const ssize_t count = ::write(file.get(), bytes.data(), std::min(bytes.size(), MAX_TRANSFER));
        if (count > 0) bytes = bytes.subspan(static_cast<std::size_t>(count));
        if (count < 0 && errno != EINTR) fail_errno("write", path, errno);
        if (count == 0) fail("write", path, "nothing was written");
    }
}

// ---- Reading

FileDescriptor open_to_read(const std::string& path) {
    FileDescriptor file(::open(path.c_str(), O_RDONLY | O_CLOEXEC));
    if (file.get() < 0) fail_errno("open", path, errno);
    return file;
}

// What a regular file holds now. The files of /proc say 0 and hold more.
std::optional<std::uint64_t> known_size(const FileDescriptor& file, const std::string& path) {
    struct stat status {};
    if (::fstat(file.get(), &status) != 0) fail_errno("read", path, errno);
    if (S_ISDIR(status.st_mode)) fail("read", path, "it is a directory");
    if (!S_ISREG(status.st_mode) || status.st_size == 0) return {};
    return static_cast<std::uint64_t>(status.st_size);
}

// ---- Writing

// A file that is removed again unless it was renamed to its destination.
class TemporaryFile {
public:
    explicit TemporaryFile(const std::filesystem::path& directory) : file_(create(directory)) {}
    TemporaryFile(const TemporaryFile&) = delete;
    TemporaryFile& operator=(const TemporaryFile&) = delete;
    ~TemporaryFile() {
        if (!renamed_) ::unlink(path_.c_str());
    }

    FileDescriptor& file() { return file_; }
    void rename_to(const std::string& destination) {
        if (::rename(path_.c_str(), destination.c_str()) != 0) fail_errno("replace", destination, errno);
        renamed_ = true;
    }

private:
    // The name does not contain the destination's, which may already be as long as the file system allows.
    int create(const std::filesystem::path& directory) {
        constexpr int MAX_ATTEMPTS = 1000;
        const std::string prefix = ".geoidx-" + std::to_string(::getpid()) + "-";
        for (int attempt = 0; attempt < MAX_ATTEMPTS; ++attempt) {
            path_ = (directory / (prefix + std::to_string(attempt) + ".tmp")).string();
            const int descriptor = ::open(path_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
            if (descriptor >= 0) return descriptor;
            if (errno != EEXIST) break;
        }
        fail_errno("create a file in the directory", directory.string(), errno);
    }

    std::string path_;
    FileDescriptor file_;
    bool renamed_ = false;
};

// Permissions of the file to be replaced; nothing when there is none yet.
std::optional<mode_t> check_destination(const std::string& path) {
    struct stat status {};
    if (::stat(path.c_str(), &status) != 0) {
        if (errno == ENOENT) return std::nullopt;
        fail_errno("write", path, errno);
    }
    if (S_ISDIR(status.st_mode)) fail("write", path, "it is a directory");
    if (!S_ISREG(status.st_mode)) fail("write", path, "it is not a regular file");
    return status.st_mode & static_cast<mode_t>(07777);
}

// The file that a rename has to replace so that symbolic links to it stay.
std::string follow_links(const std::string& path) {
    std::error_code error;
    if (!std::filesystem::is_symlink(path, error)) return path;
    const auto target = std::filesystem::canonical(path, error);
    if (error == std::errc::not_enough_memory) throw std::bad_alloc();
    if (error) fail("write", path, "following the symbolic link: " + error.message());
    return target.string();
}

void sync_directory(const std::filesystem::path& directory, const std::string& path) {
    const FileDescriptor opened(::open(directory.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
    // Who may write into a directory need not be allowed to read it: then it cannot be synced.
    if (opened.get() < 0 && errno == EACCES) return;
    // Some file systems cannot sync a directory and say EINVAL.
    if (opened.get() >= 0 && (::fsync(opened.get()) == 0 || errno == EINVAL)) return;
    fail_errno("sync the directory of the new file", path, errno);
}

void write_and_close(FileDescriptor& file, std::span<const std::byte> bytes, std::optional<mode_t> mode,
                     const std::string& path) {
    write_all(file, bytes, path);
    if (mode && ::fchmod(file.get(), *mode) != 0) fail_errno("set the permissions of", path, errno);
    if (::fsync(file.get()) != 0) fail_errno("sync", path, errno);
    if (!file.close()) fail_errno("close", path, errno);
}

}

std::vector<std::byte> read_file(const std::string& utf8_path, const SizeByStart& wanted) {
    const FileDescriptor file = open_to_read(utf8_path);
    const auto read = [&](std::span<std::byte> into) { return read_some(file, into, utf8_path); };
    return read_content(read, known_size(file, utf8_path), wanted);
}

void write_file_atomically(const std::string& utf8_path, std::span<const std::byte> bytes) {
    if (utf8_path.empty()) fail("write", utf8_path, "the path is empty");
    const std::optional<mode_t> mode = check_destination(utf8_path);
    const std::string destination = follow_links(utf8_path);
    std::filesystem::path directory = std::filesystem::path(destination).parent_path();
    if (directory.empty()) directory = ".";
    TemporaryFile temporary(directory);
    write_and_close(temporary.file(), bytes, mode, utf8_path);
    temporary.rename_to(destination);
    sync_directory(directory, utf8_path);
}

}
