#include <algorithm>
#include <cerrno>
#include <vector>

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include "format/file_descriptor_posix.h"
#include "format/file_mapping.h"

namespace geodesic::format {
namespace {

#ifdef MAP_POPULATE
constexpr int FLAGS = MAP_PRIVATE | MAP_POPULATE; // opening reads all bytes anyway, to check them
#else
constexpr int FLAGS = MAP_PRIVATE;
#endif

// What the file begins with; less than `size` bytes if it cannot be read.
std::vector<std::byte> read_start(const FileDescriptor& file, std::size_t size) {
    std::vector<std::byte> start(size);
    std::size_t filled = 0;
    while (filled < size) {
        const ssize_t count =
            ::pread(file.get(), start.data() + filled, size - filled, static_cast<off_t>(filled));
        if (count < 0 && errno == EINTR) continue;
        if (count <= 0) break;
        filled += static_cast<std::size_t>(count);
    }
    start.resize(filled);
    return start;
}

bool is_regular(const struct stat& status) { return S_ISREG(status.st_mode) && status.st_size > 0; }

}

void FileMapping::Unmap::operator()(const std::byte* first) const {
    ::munmap(const_cast<std::byte*>(first), size);
}

std::optional<FileMapping> FileMapping::of_file(const std::string& utf8_path,
                                                const std::function<bool(const FileStart&)>& is_wanted) {
    struct stat status {};
    // A pipe must not be opened here, since who reads it then would miss what it brought.
    if (::stat(utf8_path.c_str(), &status) != 0 || !is_regular(status)) return {};
    const FileDescriptor file(::open(utf8_path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK));
    if (file.get() < 0 || ::fstat(file.get(), &status) != 0 || !is_regular(status)) return {};
    const auto size = static_cast<std::size_t>(status.st_size);
    if (!is_wanted({read_start(file, std::min(size, START)), size})) return {};
    void* const first = ::mmap(nullptr, size, PROT_READ, FLAGS, file.get(), 0);
    if (first == MAP_FAILED) return {};
    return FileMapping(static_cast<const std::byte*>(first), size);
}

}
