#include "tools/output_file.h"

#include <cerrno>
#include <cstring>
#include <filesystem>

#include <fcntl.h>
#include <unistd.h>

#include "tools/failure.h"
#include "tools/signals.h"

namespace geodesic::tools {

namespace {

namespace fs = std::filesystem;

[[noreturn]] void fail(const std::string& path, int error) {
    throw Failure(path + ": " + std::strerror(error));
}

bool write_all(int descriptor, std::span<const unsigned char> bytes) {
    while (!bytes.empty()) {
        const ssize_t written = write(descriptor, bytes.data(), bytes.size());
        if (written < 0 && errno == EINTR) continue;
        if (written < 0) return false;
        bytes = bytes.subspan(static_cast<size_t>(written));
    }
    return true;
}

class OpenFile {
public:
    OpenFile(const std::string& path, int flags) : descriptor_(open(path.c_str(), flags | O_CLOEXEC, 0666)) {}
    ~OpenFile() {
        if (descriptor_ >= 0) close(descriptor_);
    }
    OpenFile(const OpenFile&) = delete;
    OpenFile& operator=(const OpenFile&) = delete;

    bool is_open() const { return descriptor_ >= 0; }
    bool write_all(std::span<const unsigned char> bytes) const {
        return tools::write_all(descriptor_, bytes);
    }
    bool sync() const { return fsync(descriptor_) == 0; }

private:
    int descriptor_;
};

// A new empty file next to `target`, removed at the end unless renamed.
class Sibling {
public:
    explicit Sibling(const std::string& target)
        : path_(target + "." + std::to_string(getpid()) + ".tmp"), file_(path_, O_WRONLY | O_CREAT | O_EXCL) {
    }
    ~Sibling() {
        if (file_.is_open() && !renamed_) unlink(path_.c_str());
    }
    Sibling(const Sibling&) = delete;
    Sibling& operator=(const Sibling&) = delete;

    const OpenFile& file() const { return file_; }
    bool rename_to(const std::string& target) {
        return renamed_ = std::rename(path_.c_str(), target.c_str()) == 0;
    }

private:
    std::string path_;
    OpenFile file_;
    bool renamed_ = false;
};

}

std::string behind_links(const std::string& path) {
    constexpr int MOST_LINKS = 40; // as Linux has it
    fs::path target = path;
    std::error_code error;
    for (int i = 0; fs::is_symlink(target, error); ++i) {
        if (i == MOST_LINKS) fail(path, ELOOP);
        target = target.parent_path() / fs::read_symlink(target, error);
    }
    return target;
}

bool is_device_or_pipe(const std::string& path) {
    std::error_code ignored;
    return fs::is_other(fs::status(path, ignored));
}

void require_no_terminal(const std::string& path) {
    if (path == STANDARD_OUTPUT && isatty(STDOUT_FILENO) == 1)
        throw Failure("standard output is a terminal, which shows text only: send it to a file or a program");
}

bool is_same_path(const std::string& a, const std::string& b) {
    std::error_code error_a, error_b;
    const fs::path whole_a = fs::weakly_canonical(fs::absolute(a, error_a), error_a);
    const fs::path whole_b = fs::weakly_canonical(fs::absolute(b, error_b), error_b);
    return error_a || error_b ? a == b : whole_a == whole_b;
}

void require_writable(const std::string& path, std::span<const std::string> inputs) {
    std::error_code ignored;
    if (path.empty()) throw Failure("the name of the output is empty");
    if (path == STANDARD_OUTPUT) return;
    if (fs::is_directory(path, ignored)) throw Failure(path + ": is a directory");
    if (is_device_or_pipe(path)) return;
    for (const std::string& input : inputs)
        if (fs::equivalent(path, input, ignored)) throw Failure(path + ": is an input of the same command");
    const SignalsHeldBack until_removed;
    const Sibling probe(behind_links(path));
    if (!probe.file().is_open()) fail(path, errno);
}

void write_file(const std::string& path, std::span<const unsigned char> bytes) {
    if (path == STANDARD_OUTPUT) {
        if (!write_all(STDOUT_FILENO, bytes)) fail("standard output", errno);
        return;
    }
    if (is_device_or_pipe(path)) {
        const OpenFile file(path, O_WRONLY);
        if (!file.is_open() || !file.write_all(bytes)) fail(path, errno);
        return;
    }
    const SignalsHeldBack until_renamed;
    const std::string target = behind_links(path);
    Sibling sibling(target);
    if (!sibling.file().is_open()) fail(path, errno);
    if (!sibling.file().write_all(bytes) || !sibling.file().sync()) fail(path, errno);
    if (!sibling.rename_to(target)) fail(path, errno);
}

}
